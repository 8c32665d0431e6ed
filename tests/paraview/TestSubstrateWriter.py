# SPDX-License-Identifier: BSD-3-Clause
"""The substrate folder, read again by a parser of its own: what is written is what went in, once, whole, or not at all."""

import csv
import hashlib
import json
import os

import numpy
from cactus_testing import UNPARTED, CactusTestCase, fetch, main, produce
from paraview.simple import (BundleInitializer, FibreRadialGrowth, MyelinSurface, OpenDataFile, OutputPort, Placement, SaveData, SubstrateCertificate,
                             SubstrateReader, SubstrateStatistics, SubstrateWriter)
from paraview.vtk.util.numpy_support import vtk_to_numpy
from surfaces import EQUIVALENT, POLYGON, surfaces, tube, two_tubes
from vtkmodules.vtkCommonCore import vtkIntArray
from vtkmodules.vtkFiltersCore import vtkMassProperties
from vtkmodules.vtkIOPLY import vtkPLYReader


def read_ply(path):
    """Points and triangles of an ASCII PLY file, read as strictly as a simulator that knows one dialect does."""
    with open(path, encoding="ascii") as file:
        lines = [line.rstrip("\n") for line in file]
    end = lines.index("end_header")
    header = [line for line in lines[:end] if not line.startswith("comment")]
    assert header[:2] == ["ply", "format ascii 1.0"], header
    vertices, faces = int(header[2].split()[-1]), int(header[6].split()[-1])
    assert header[2:] == [
        f"element vertex {vertices}",
        "property float x",
        "property float y",
        "property float z",
        f"element face {faces}",
        "property list uchar int vertex_indices",
    ], header
    body = lines[end + 1 :]
    assert len(body) == vertices + faces
    points = [tuple(map(float, line.split())) for line in body[:vertices]]
    triangles = [tuple(map(int, line.split())) for line in body[vertices:]]
    assert all(len(point) == 3 for point in points)
    assert all(len(t) == 4 and t[0] == 3 and all(0 <= i < vertices for i in t[1:]) for t in triangles)
    return points, [t[1:] for t in triangles]


def volume_of(points, triangles):
    volume = 0.0
    for triangle in triangles:
        a, b, c = (points[i] for i in triangle)
        volume += (
            a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])
        ) / 6
    return volume


def is_closed(triangles):
    """Every directed edge stands there once, and its reverse, too."""
    edges = [(t[i], t[(i + 1) % 3]) for t in triangles for i in range(3)]
    return len(set(edges)) == len(edges) and all((b, a) in set(edges) for a, b in edges)


class Writer(CactusTestCase):
    def setUp(self):
        super().setUp()
        self.fibres, self.outer, self.inner = two_tubes(inset=0.1)
        self.target = os.path.join(self.folder, "substrate")

    def write(self, **properties):
        arguments = {"Outer": produce(self.outer), "Inner": produce(self.inner), "FolderName": self.target}
        arguments.update(properties)
        writer = SubstrateWriter(**arguments)
        writer.UpdatePipeline()
        return writer

    def test_files_hold_the_surfaces(self):
        table = fetch(self.write(Fibres=produce(self.fibres)))
        self.assertEqual(os.listdir(self.folder), ["substrate"])
        self.assertEqual(
            sorted(os.listdir(self.target)), ["README.txt", "certificate.csv", "certificate_fibres.csv", "fibres.strands", "inner", "manifest.json", "mcdc", "outer"]
        )
        with open(os.path.join(self.target, "manifest.json")) as file:
            manifest = json.load(file)
        self.assertEqual(manifest["domain"], [-5, 5, -5, 5, -5, 5])
        self.assertEqual(manifest["fibres"], 2)
        wanted = {
            "outer/fibre_00003.ply": (3, 10 * POLYGON),
            "outer/fibre_00005.ply": (5, 22.5 * POLYGON),
            "inner/fibre_00003.ply": (3, 4.9 * 0.98 * POLYGON),
            "inner/fibre_00005.ply": (5, 8.1 * 0.98 * POLYGON),
        }
        self.assertEqual({entry["path"] for entry in manifest["files"]}, set(wanted))
        self.assertEqual(table.GetNumberOfRows(), 4)
        for entry in manifest["files"]:
            fibre, volume = wanted[entry["path"]]
            points, triangles = read_ply(os.path.join(self.target, entry["path"]))
            self.assertEqual(entry["fibre"], fibre)
            self.assertEqual(entry["bundle"], 1 + fibre % 2)
            self.assertEqual(len(triangles), entry["triangles"])
            self.assertAlmostEqual(volume_of(points, triangles), volume, places=3)
            self.assertAlmostEqual(entry["volume_um3"], volume_of(points, triangles), places=5)
            self.assertTrue(is_closed(triangles))
            self.assertTrue(entry["closed"])
            self.assertEqual(len({i for t in triangles for i in t}), len(points), "no point is left over")

    def test_vtk_reads_binary_files(self):
        self.write(Format="Surfaces alone", Encoding="Binary", StartPositions=3)
        self.assertEqual(sorted(os.listdir(self.target)), ["README.txt", "certificate.csv", "certificate_fibres.csv", "inner", "manifest.json", "outer", "start"])
        for name, surface in (("outer/fibre_00003.ply", 3), ("outer/fibre_00005.ply", 5)):
            path = os.path.join(self.target, name)
            reader = vtkPLYReader()
            reader.SetFileName(path)
            reader.Update()
            mass = vtkMassProperties()
            mass.SetInputData(reader.GetOutput())
            self.assertAlmostEqual(mass.GetVolume(), {3: 10, 5: 22.5}[surface] * POLYGON, places=3)
            with open(path, "rb") as file:
                body = file.read().split(b"end_header\n", 1)[1]
            self.assertEqual(len(body), 13 * reader.GetOutput().GetNumberOfCells() + 12 * reader.GetOutput().GetNumberOfPoints())
        with open(os.path.join(self.target, "start", "intra.txt")) as file:
            self.assertTrue(all(abs(float(number)) < 5 for number in file.read().split()), "µm")

    def test_vtk_reads_a_file_for_each_bundle(self):
        """Both fibres are of bundle 2."""
        for encoding in ("ASCII", "Binary"):
            self.write(Format="Surfaces by bundle", Encoding=encoding)
            self.assertEqual(os.listdir(os.path.join(self.target, "outer")), ["bundle_00002.ply"])
            reader = vtkPLYReader()
            reader.SetFileName(os.path.join(self.target, "outer", "bundle_00002.ply"))
            reader.Update()
            mass = vtkMassProperties()
            mass.SetInputData(reader.GetOutput())
            self.assertAlmostEqual(mass.GetVolume(), (10 + 22.5) * POLYGON, places=3)

    def test_simulators_get_no_binary_files(self):
        for name in ("MC/DC", "Reference program", "Camino", "Disimpy"):
            with self.subTest(Format=name), self.assertError("Encoding Binary is not for simulators whose readers of PLY files"):
                self.write(Format=name, Encoding="Binary", Fibres=produce(self.fibres))
            self.assertFalse(os.path.exists(self.target))

    def test_holds_its_certificate(self):
        self.write(Fibres=produce(self.fibres))
        with open(os.path.join(self.target, "manifest.json")) as file:
            manifest = json.load(file)
        self.assertIs(manifest["certified"], True)
        self.assertEqual(manifest["faults"], [])
        with open(os.path.join(self.target, "certificate.csv"), newline="") as file:
            values = dict(list(csv.reader(file))[1:])
        self.assertEqual(values["Certified"], "1")
        self.assertAlmostEqual(float(values["SmallestGap_um"]), 1.5, places=6)
        with open(os.path.join(self.target, "certificate_fibres.csv"), newline="") as file:
            fibres = list(csv.DictReader(file))
        self.assertEqual([row["NearestFibre"] for row in fibres], ["5", "3"])
        self.assertAlmostEqual(float(fibres[0]["OuterRadius_um"]), EQUIVALENT, places=5)

    def test_says_what_is_not_certified(self):
        with self.assertError(r"not certified: fibres 3 and 5 come as near as 1\.5"):
            self.write(MinimumGap=2.0)
        with open(os.path.join(self.target, "manifest.json")) as file:
            manifest = json.load(file)
        self.assertIs(manifest["certified"], False)
        self.assertEqual(len(manifest["faults"]), 1)

    def test_points_keep_nine_digits(self):
        self.write()
        points, _ = read_ply(os.path.join(self.target, "outer/fibre_00003.ply"))
        for index, point in enumerate(points):
            for got, wanted in zip(point, self.outer.GetPoint(index)):
                self.assertLessEqual(abs(got - wanted), 5e-9 * abs(wanted) + 1e-30)

    def test_configuration_finds_its_files(self):
        self.write()
        for compartment, kind in (("intra", "inner"), ("extra", "outer")):
            with open(os.path.join(self.target, "mcdc", compartment + ".conf")) as file:
                words = file.read().split()
            self.assertEqual(words[-1], "<END>")
            self.assertEqual(words[words.index("ini_walkers_pos") + 1], compartment)
            with open(os.path.join(self.target, words[words.index("ply_file_list") + 1])) as file:
                scale, *paths = file.read().split()
            self.assertEqual(float(scale), 1e-3)
            self.assertEqual(paths, [f"{kind}/fibre_00003.ply", f"{kind}/fibre_00005.ply"])
            for path in paths:
                self.assertTrue(os.path.isfile(os.path.join(self.target, path)))

    def test_manifest_knows_every_file(self):
        self.write(Fibres=produce(self.fibres))
        with open(os.path.join(self.target, "manifest.json")) as file:
            text = file.read()
        manifest = json.loads(text)
        found = {}
        for folder, _, names in os.walk(self.target):
            for name in names:
                path = os.path.join(folder, name)
                with open(path, "rb") as file:
                    found[os.path.relpath(path, self.target)] = hashlib.sha256(file.read()).hexdigest()
        del found["manifest.json"]
        self.assertEqual(manifest["sha256"], found)
        own = manifest["manifest_sha256"]
        self.assertEqual(hashlib.sha256(text.replace(own, 64 * "0").encode()).hexdigest(), own)

    def test_writing_again_keeps_what_is_the_users(self):
        self.write()
        with open(os.path.join(self.target, "mcdc", "intra.conf")) as file:
            configuration = file.read()
        for path in ("mcdc/intra.conf", "mcdc/pgse.scheme", "README.txt"):
            with open(os.path.join(self.target, path), "a") as file:
                file.write("edited")
        for path in ("outer/mine.ply", "mcdc/output/intra_DWI.txt"):
            with open(os.path.join(self.target, path), "w") as file:
                file.write("precious")
        with self.assertError(
            r"results of simulations \(mcdc/output/intra_DWI\.txt\); other data \(outer/mine\.ply\); "
            r"files that were changed .*\(README\.txt, mcdc/intra\.conf, mcdc/pgse\.scheme\): choose another FolderName"
        ):
            self.write()
        with open(os.path.join(self.target, "mcdc", "intra.conf")) as file:
            self.assertEqual(file.read(), configuration + "edited")
        self.assertTrue(os.path.exists(os.path.join(self.target, "outer", "mine.ply")))
        for path in ("mcdc/intra.conf", "mcdc/pgse.scheme", "README.txt", "outer/mine.ply", "mcdc/output/intra_DWI.txt"):
            os.rename(os.path.join(self.target, path), os.path.join(self.folder, os.path.basename(path)))
        self.write()
        with open(os.path.join(self.target, "mcdc", "intra.conf")) as file:
            self.assertEqual(file.read(), configuration)

    def test_the_folder_it_runs_in(self):
        self.addCleanup(os.chdir, os.getcwd())
        os.mkdir(self.target)
        os.chdir(self.target)
        with self.assertError(r"the folder that this program runs in"):
            self.write(FolderName=".")
        self.write(FolderName="relative")
        self.assertEqual(os.listdir("."), ["relative"])
        os.chdir("relative")
        with self.assertError(r"above the folder that this program runs in"):
            self.write(FolderName="..")
        os.chdir(self.target)
        os.rename("relative", os.path.join(self.folder, "elsewhere"))
        os.rmdir(self.target)
        with self.assertError(r"cannot write folder relative: the folder that this program runs in is no more"):
            self.write(FolderName="relative")

    def test_links(self):
        place = os.path.join(self.folder, "place")
        os.symlink(place, self.target)
        for _ in range(2):
            self.write()
            self.assertTrue(os.path.islink(self.target))
            self.assertTrue(os.path.isfile(os.path.join(place, "manifest.json")))
        self.assertEqual(sorted(os.listdir(self.folder)), ["place", "substrate"])

    def test_without_inner_surfaces(self):
        writer = SubstrateWriter(Outer=produce(self.outer), FolderName=self.target)
        writer.UpdatePipeline()
        self.assertEqual(fetch(writer).GetNumberOfRows(), 2)
        self.assertEqual(sorted(os.listdir(self.target)), ["README.txt", "certificate.csv", "certificate_fibres.csv", "manifest.json", "mcdc", "outer"])

    def test_writes_for_changes_of_its_own_only(self):
        """What comes in is written when it is asked for; of what is not, it is said once."""
        source = produce(self.outer)
        writer = SubstrateWriter(Outer=source, FolderName=self.target)
        writer.UpdatePipeline()

        def time():
            return os.stat(os.path.join(self.target, "manifest.json")).st_mtime_ns

        first = time()
        moved = surfaces({3: tube(-2, 0, 0.9, 10)}, 0, 10)
        source.GetClientSideObject().SetOutput(moved)
        source.MarkModified(None)
        with self.assertError(r"has changed since .*substrate was written, which stays as it is: press Write"):
            for _ in range(2):
                writer.UpdatePipeline()
        self.assertEqual(time(), first)
        self.assertEqual(fetch(writer).GetNumberOfRows(), 2)
        writer.SMProxy.InvokeCommand("Write")
        self.assertGreater(time(), first)
        writer.UpdatePipeline()
        self.assertEqual(fetch(writer).GetNumberOfRows(), 1)
        writer.AllowOpenSurfaces = 1
        second = time()
        writer.UpdatePipeline()
        self.assertGreater(time(), second)

    def test_bad_places(self):
        with self.assertError(r"FolderName is empty"):
            self.write(FolderName="")
        with self.assertError(r"cannot write folder .*nowhere"):
            self.write(FolderName=os.path.join(self.folder, "nowhere", "substrate"))
        with self.assertError(r"cannot write folder"):
            self.write(FolderName="/proc/substrate")
        self.assertEqual(os.listdir(self.folder), [])
        os.mkdir(self.target)
        with open(os.path.join(self.target, "thesis.tex"), "w") as file:
            file.write("precious")
        with self.assertError(r"is there already and is not a substrate folder"):
            self.write()
        self.assertEqual(os.listdir(self.target), ["thesis.tex"])

    def test_bad_surfaces(self):
        part = tube(-2, 0, 1, 10)
        part.BuildCells()
        part.DeleteCell(7)
        part.RemoveDeletedCells()
        leaking = surfaces({3: part, 5: tube(2, 0, 1.5, 10)}, 0, 10)
        with self.assertError(r"outer surface of fibre 3 is not closed \(3 open"):
            self.write(Outer=produce(leaking))
        with self.assertError(r"Outer holds inner surfaces"):
            self.write(Outer=produce(self.inner))
        self.outer.GetFieldData().RemoveArray("Domain")
        with self.assertError(r"Domain"):
            self.write()
        self.assertEqual(os.listdir(self.folder), [])
        with self.assertError(r"not closed \(3 open.* which StartPositions are inside"):
            self.write(Outer=produce(leaking), AllowOpenSurfaces=1, StartPositions=3)
        self.assertEqual(os.listdir(self.folder), [])
        with self.assertError(r"not certified: 1 surfaces are not closed \(fibre 3 first\)"):
            self.write(Outer=produce(leaking), AllowOpenSurfaces=1)
        self.assertEqual(os.listdir(self.folder), ["substrate"])


def arrays_of(data):
    """Points, corners and all arrays."""
    arrays = {}
    for some in (data.GetPointData(), data.GetCellData()):
        arrays.update({some.GetArrayName(i): vtk_to_numpy(some.GetArray(i)) for i in range(some.GetNumberOfArrays())})
    arrays["corners"] = vtk_to_numpy((data.GetPolys() if data.GetNumberOfLines() == 0 else data.GetLines()).GetConnectivityArray())
    arrays["points"] = vtk_to_numpy(data.GetPoints().GetData())
    return arrays


def row_of(table):
    return {table.GetColumnName(i): table.GetColumn(i).GetValue(0) for i in range(table.GetNumberOfColumns())}


class Reader(CactusTestCase):
    """SubstrateReader: what a chain has made comes back from its folder."""

    expected = UNPARTED

    def setUp(self):
        super().setUp()
        self.target = os.path.join(self.folder, "substrate")

    def write(self, outer, **properties):
        SubstrateWriter(Outer=outer, FolderName=self.target, **{"Format": "Surfaces alone", **properties}).UpdatePipeline()
        return os.path.join(self.target, "manifest.json")

    def checksums(self, folder):
        with open(os.path.join(folder, "manifest.json"), encoding="utf-8") as file:
            manifest = json.load(file)
        return {path: checksum for path, checksum in manifest["sha256"].items() if path.endswith((".ply", ".strands"))}, manifest

    def test_what_was_written_comes_back(self):
        # Single precision misses the faces at 2.05.
        fibres = BundleInitializer(Border="Walls", Side=4.1, FibreVolumeFraction=0.3, MinimumRadius=0.4, GrownFibreVolumeFraction=0)
        made = MyelinSurface(Input=FibreRadialGrowth(Input=fibres, VoxelSize=0.15))
        outer = OutputPort(made, 0)
        certificate, lines = row_of(fetch(SubstrateCertificate(Outer=outer))), arrays_of(fetch(fibres))
        for name, encoding, exact in (("MC/DC", "ASCII", True), ("Surfaces by bundle", "Binary", True), ("Camino", "ASCII", False)):
            with self.subTest(Format=name):
                manifest = self.write(outer, Format=name, Encoding=encoding)
                reader = OpenDataFile(manifest)
                self.assertEqual(reader.GetXMLName(), "SubstrateReader")
                for port in range(2):
                    wanted, found = arrays_of(fetch(made, port)), arrays_of(fetch(reader, port))
                    self.assertEqual(wanted.keys(), found.keys())
                    for array in wanted:
                        # What MyelinSurface measured was before the rounding in binary files.
                        isExact = array not in ("Radius", "GRatio") and (exact or array != "points")
                        numpy.testing.assert_allclose(found[array], wanted[array], rtol=0 if isExact else 3e-7, err_msg=array)
                found = arrays_of(fetch(reader, 2))
                for array in ("points", "corners", "Radius", "FibreId", "BundleId"):
                    numpy.testing.assert_allclose(found[array], lines[array], rtol=1e-8, atol=1e-8, err_msg=array)
                again = row_of(fetch(SubstrateCertificate(Outer=OutputPort(reader, 0))))
                for finding, value in certificate.items():
                    numpy.testing.assert_allclose(again[finding], value, rtol=0 if exact else 1e-4, err_msg=finding)
                table = fetch(reader, 3)
                values = {table.GetValue(i, 0).ToString(): table.GetValue(i, 1).ToDouble() for i in range(table.GetNumberOfRows())}
                self.assertAlmostEqual(values["SmallestGap_um"], certificate["SmallestGap_um"], places=7)
                self.assertEqual(fetch(reader, 4).GetNumberOfRows(), fetch(fibres).GetNumberOfCells())
                self.assertEqual(row_of(fetch(SubstrateStatistics(Fibres=OutputPort(reader, 0))))["Fibres"], certificate["Fibres"])

    def test_lines_outside_a_cut_domain_come_back(self):
        self.expected += "|so small a domain"
        fibres = BundleInitializer(Side=4.1, FibreVolumeFraction=0.3, MinimumRadius=0.4, CalibreVariation=0, GrownFibreVolumeFraction=0)
        made = MyelinSurface(Input=FibreRadialGrowth(Input=fibres, VoxelSize=0.15))
        reader = SubstrateReader(FileName=self.write(OutputPort(made, 0), Fibres=fibres))
        wanted, found = arrays_of(fetch(fibres)), arrays_of(fetch(reader, 2))
        self.assertGreater(len(wanted["FibreId"]), len(set(arrays_of(fetch(made))["FibreId"])), "none is outside")
        for array in ("points", "corners", "Radius", "FibreId", "BundleId"):
            numpy.testing.assert_allclose(found[array], wanted[array], rtol=1e-8, atol=1e-8, err_msg=array)

    def test_a_folder_chosen_in_the_dialog_is_replaced(self):
        """ParaView's dialog walks into a folder that is there, and adds its name once more."""
        saved = os.path.join(self.folder, "one.substrate")
        two, one = produce(two_tubes()[1]), produce(surfaces({3: tube(-2, 0, 0.9, 10)}, 0, 10))
        SaveData(saved, proxy=two)
        SaveData(os.path.join(saved, "one.substrate"), proxy=one)
        SaveData(os.path.join(saved, "other.substrate"), proxy=two)
        self.assertEqual(fetch(SubstrateReader(FileName=saved), 4).GetNumberOfRows(), 1)
        self.assertFalse(os.path.exists(os.path.join(saved, "one.substrate")))
        self.assertTrue(os.path.exists(os.path.join(saved, "other.substrate", "manifest.json")), "one of another name is meant to be in it")

    def test_written_once_more(self):
        """Of a folder, the same files, and it says where they come from. Placement is not in them."""
        fibres, outer, inner = two_tubes(inset=0.1)
        manifest = self.write(Placement(Input=produce(outer), PositionX=3), Inner=produce(inner), Fibres=produce(fibres))
        saved = os.path.join(self.folder, "again.substrate")
        SaveData(saved, proxy=SubstrateReader(FileName=manifest))
        (wanted, _), (found, again) = self.checksums(self.target), self.checksums(saved)
        self.assertEqual(found.keys(), wanted.keys())
        self.assertEqual(found["fibres.strands"], wanted["fibres.strands"])
        self.assertIsNone(again["placement_um_to_mm"])
        self.assertEqual([stage["filter"] for stage in again["provenance"]], ["Placement", "SubstrateWriter", "SubstrateReader", "SubstrateWriter"])
        read, written = again["provenance"][-2:]
        with open(manifest, "rb") as file:
            self.assertEqual(read["files"], [{"property": "FileName", "path": manifest, "sha256": hashlib.sha256(file.read()).hexdigest()}])
        self.assertEqual(written["inputs"]["Outer"][0]["stage"], read["id"])
        # What was rounded once stays as it is. A folder is opened by its name, too.
        reader = OpenDataFile(saved)
        self.assertEqual(reader.GetXMLName(), "SubstrateReader")
        self.write(OutputPort(reader, 0))
        self.assertEqual(self.checksums(self.target)[0], found)

    def test_without_inner_surfaces_and_fibres(self):
        reader = SubstrateReader(FileName=os.path.dirname(self.write(produce(two_tubes()[1]))))
        self.assertEqual([fetch(reader, port).GetNumberOfCells() for port in range(3)], [2 * 1056, 0, 0])
        self.assertEqual(row_of(fetch(SubstrateCertificate(Outer=OutputPort(reader, 0))))["InnerJudged"], 0)

    def test_open_surfaces_are_named(self):
        outer = two_tubes()[1]
        periodic = vtkIntArray()
        periodic.SetName("Periodic")
        for axis in range(3):
            periodic.InsertNextValue(1)
        outer.GetFieldData().AddArray(periodic)
        manifest = self.write(produce(outer), PeriodicFaces="Open")
        with self.assertError(r"lack their caps in periodic faces \(PeriodicFaces Open\)"):
            self.assertLess(fetch(SubstrateReader(FileName=manifest)).GetNumberOfCells(), 2 * 1056)

    def test_a_folder_that_was_changed(self):
        _, outer, inner = two_tubes(inset=0.1)
        with self.assertError(r"FileName is empty"):
            SubstrateReader().UpdatePipeline()
        manifest = self.write(produce(outer), Inner=produce(inner), Format="Disimpy")
        with self.assertError(r"Format Disimpy cannot be read again, only those of Format MC/DC, .* or MCMRSimulator"):
            SubstrateReader(FileName=manifest).UpdatePipeline()
        for path, change, words in (
            ("inner/fibre_00005.ply", os.remove, r"cannot read .*inner/fibre_00005\.ply: No such file"),
            ("outer/fibre_00003.ply", self.append, r"outer/fibre_00003\.ply was changed after it was written"),
            ("certificate.csv", self.append, r"certificate\.csv was changed after it was written"),
            ("manifest.json", self.append, r"manifest\.json was changed after it was written"),
        ):
            with self.subTest(path=path):
                self.target = os.path.join(self.folder, path.replace("/", "-"))
                manifest = self.write(produce(outer), Inner=produce(inner))
                change(os.path.join(self.target, path))
                reader = SubstrateReader(FileName=manifest)
                with self.assertError(words):
                    reader.UpdatePipeline()
                self.assertEqual(fetch(reader).GetNumberOfCells(), 0)

    @staticmethod
    def append(path):
        with open(path, "a", encoding="utf-8") as file:
            file.write("\n")


if __name__ == "__main__":
    main()
