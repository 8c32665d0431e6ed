# SPDX-License-Identifier: BSD-3-Clause
"""Strand files through ParaView: what is written is what was read, and a bad file or place gives one error and leaves nothing."""

import os

from cactus_testing import CactusTestCase, fetch, main, produce
from paraview.simple import BundleInitializer, OpenDataFile, SaveData, StrandReader
from vtkmodules.util.numpy_support import vtk_to_numpy

STRANDS = """30
2
3
0 0 -15 0.5
0.1 0.123456789 0 0.75
0 0 15 1
2
3 3 -15 0.25
3 3 15 0.25
"""


def numbers(path):
    with open(path) as file:
        return [float(word) for word in file.read().split()]


class StrandFiles(CactusTestCase):
    def write(self, text, name="some.strands"):
        path = os.path.join(self.folder, name)
        with open(path, "w") as file:
            file.write(text)
        return path

    def test_reader_gives_the_data_model(self):
        fibres = fetch(StrandReader(FileName=self.write(STRANDS)))
        self.assertEqual(fibres.GetNumberOfLines(), 2)
        self.assertEqual(fibres.GetNumberOfCells(), 2)
        radius = fibres.GetPointData().GetArray("Radius")
        self.assertEqual([radius.GetValue(i) for i in range(5)], [0.5, 0.75, 1, 0.25, 0.25])
        self.assertEqual(fibres.GetPoint(1), (0.1, 0.123456789, 0))
        cells = fibres.GetCellData()
        self.assertEqual([cells.GetArray("FibreId").GetValue(i) for i in range(2)], [1, 2])
        self.assertEqual([cells.GetArray("BundleId").GetValue(i) for i in range(2)], [1, 1])
        targets = [cells.GetArray("TargetRadius").GetValue(i) for i in range(2)]
        self.assertAlmostEqual(targets[0] ** 2, (0.5**2 + 0.75**2 + 1) / 3)
        self.assertEqual(targets[1], 0.25)
        domain = fibres.GetFieldData().GetArray("Domain")
        self.assertEqual([domain.GetValue(i) for i in range(6)], [-15, 15, -15, 15, -15, 15])
        self.assertIn("StrandReader", fibres.GetFieldData().GetAbstractArray("Provenance").GetValue(0))

    def test_every_extension_opens(self):
        for extension in ("strands", "init", "partial"):
            reader = OpenDataFile(self.write(STRANDS, "some." + extension))
            self.assertEqual(reader.GetXMLName(), "StrandReader")
            self.assertEqual(fetch(reader).GetNumberOfLines(), 2)

    def test_tables_of_other_generators_are_read_by_content(self):
        table = "cell_type cell_id component component_id X Y Z inner_radius outer_radius\n"
        table += "".join(f"axon 0 axon 0 3 3 {z} 0.3 0.5\n" for z in range(7)) + "glial_cell 0 soma 0 1 1 1 2 2\n"
        with open(os.path.join(self.folder, "run_growth_info.txt"), "w") as file:
            file.write("Voxel Size 6\n")
        with self.assertError(r"1 sphere\(s\) of type glial_cell are left out"):
            fibres = fetch(StrandReader(FileName=self.write(table, "run.csv")))
        self.assertEqual((fibres.GetNumberOfLines(), fibres.GetNumberOfPoints()), (1, 7))
        domain = fibres.GetFieldData().GetArray("Domain")
        self.assertEqual([domain.GetValue(i) for i in range(6)], [0, 6, 0, 6, 0, 6])
        with self.assertError("no strand file"):
            StrandReader(FileName=self.write('{"name": "of something else"}', "some.json")).UpdatePipeline()

    def test_round_trip_keeps_nine_digits(self):
        source = self.write(STRANDS)
        target = os.path.join(self.folder, "again.strands")
        SaveData(target, proxy=StrandReader(FileName=source))
        before, after = numbers(source), numbers(target)
        self.assertEqual(len(before), len(after))
        for a, b in zip(before, after):
            self.assertLessEqual(abs(a - b), 1e-9 * abs(a))
        self.assertEqual(sorted(os.listdir(self.folder)), ["again.strands", "some.strands"])

    def test_vtp_keeps_what_strand_files_do_not(self):
        path = os.path.join(self.folder, "fibres.vtp")
        fibres = BundleInitializer(Border="Walls", Side=6, NumberOfBundles=2, CrossingAngle=60, CrossingStyle="Sheets", FibreVolumeFraction=0.5, GrownFibreVolumeFraction=0.6)
        SaveData(path, proxy=fibres, DataMode="Binary")
        before, after = fetch(fibres), fetch(OpenDataFile(path))
        for kind, names in (("GetPointData", ["Radius"]), ("GetCellData", ["FibreId", "BundleId", "TargetRadius"]),
                            ("GetFieldData", ["Domain", "GrownFibreVolumeFraction"])):
            for name in names:
                one, other = (vtk_to_numpy(getattr(data, kind)().GetArray(name)).tolist() for data in (before, after))
                self.assertEqual(one, other, name)

    def test_truncated_file(self):
        for lines in range(1, STRANDS.count("\n")):
            path = self.write("\n".join(STRANDS.split("\n")[:lines]) + "\n")
            with self.assertError(r"some\.strands.*truncated"):
                StrandReader(FileName=path).UpdatePipeline()

    def test_bad_values_name_the_line_or_the_fibre(self):
        for old, new, pattern in (
            ("0.1 0.123456789 0 0.75", "0.1 nan 0 0.75", r"line 5"),
            ("0.1 0.123456789 0 0.75", "0.1 0 0 -0.75", r"fibre 1 .*control point 1\b.*Radius"),
            ("0.1 0.123456789 0 0.75", "0 0 -15 0.75", r"fibre 1 .*control point 1 .*zero-length"),
            ("3 3 -15 0.25", "3 3 fifteen 0.25", r"line 8"),
            ("30\n", "-30\n", r"line 1: the side"),
            ("30\n2\n", "30\nmany\n", r"line 2"),
            ("30\n2\n", "30\n0\n", r"no fibres"),
        ):
            with self.assertError(pattern):
                StrandReader(FileName=self.write(STRANDS.replace(old, new, 1))).UpdatePipeline()

    def test_one_point_fibre(self):
        with self.assertError(r"fibre 1 .*at least two"):
            StrandReader(FileName=self.write("30\n1\n1\n0 0 0 1\n")).UpdatePipeline()

    def test_missing_file(self):
        with self.assertError(r"nowhere\.strands"):
            StrandReader(FileName=os.path.join(self.folder, "nowhere.strands")).UpdatePipeline()

    def test_unwritable_place(self):
        reader = StrandReader(FileName=self.write(STRANDS))
        for place in ("no-such-folder", "some.strands"):
            with self.assertError(r"cannot write .*x\.strands"):
                SaveData(os.path.join(self.folder, place, "x.strands"), proxy=reader)
        self.assertEqual(os.listdir(self.folder), ["some.strands"])

    def test_special_places(self):
        reader = StrandReader(FileName=self.write(STRANDS))
        wanted = os.path.join(self.folder, "wanted.strands")
        SaveData(wanted, proxy=reader)
        with open(wanted) as file:
            written = file.read()
        os.mkdir(os.path.join(self.folder, "folder.strands"))
        with self.assertError(r"cannot write .*folder\.strands: it is a folder"):
            SaveData(os.path.join(self.folder, "folder.strands"), proxy=reader)
        self.write("former", "real.strands")
        os.chmod(os.path.join(self.folder, "real.strands"), 0o604)
        for link, target in (("link.strands", "real.strands"), ("dangling.strands", "folder.strands/new")):
            os.symlink(target, os.path.join(self.folder, link))
            SaveData(os.path.join(self.folder, link), proxy=reader)
            self.assertTrue(os.path.islink(os.path.join(self.folder, link)))
            with open(os.path.join(self.folder, target)) as file:
                self.assertEqual(file.read(), written)
        self.assertEqual(os.stat(os.path.join(self.folder, "real.strands")).st_mode & 0o777, 0o604)
        self.assertEqual(os.listdir(os.path.join(self.folder, "folder.strands")), ["new"])

    def test_failed_write_leaves_the_old_file_alone(self):
        bad = fetch(StrandReader(FileName=self.write(STRANDS)))
        bad.GetPointData().GetArray("Radius").SetValue(1, -1)
        old = self.write("precious", "old.strands")
        with self.assertError(r"fibre 1 .*control point 1\b.*Radius"):
            SaveData(old, proxy=produce(bad))
        with open(old) as file:
            self.assertEqual(file.read(), "precious")
        self.assertEqual(sorted(os.listdir(self.folder)), ["old.strands", "some.strands"])


if __name__ == "__main__":
    main()
