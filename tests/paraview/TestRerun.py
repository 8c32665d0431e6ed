# SPDX-License-Identifier: BSD-3-Clause
# ctest-extended
# ctest-timeout: 600
"""A substrate is made again from its manifest, with the same bits; what cannot be made again is refused with a reason."""

import json
import os
import re
import shutil
import subprocess

from cactus_testing import CactusTestCase, main
from paraview import servermanager, simple
from paraview.simple import (BundleInitializer, CapsuleOptimizer, FibreRadialGrowth, GroupDatasets, MyelinSurface, OutputPort,
                             SaveData, StrandReader, SubstrateReader, SubstrateWriter, TractFibres, TractogramReader)

SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tools", "scripts", "rerun.py")


def bundle(**properties):
    values = {"Side": 5, "FibreVolumeFraction": 0.25, "MinimumRadius": 0.4, "MeanDispersion": 3, "GrownFibreVolumeFraction": 0, **properties}
    return BundleInitializer(Border="Walls", **values)


class Rerun(CactusTestCase):
    expected = "The smallest gap between two fibres"  # by Format SpinDoctor

    def write(self, fibres, name="substrate", growth=None, surface=None, **properties):
        """A substrate folder, by all stages, and the path of its manifest."""
        optimizer = CapsuleOptimizer(Input=fibres, **properties)
        grown = FibreRadialGrowth(Input=OutputPort(optimizer, 0), VoxelSize=0.2, Seed=3, **(growth or {}))
        surfaces = MyelinSurface(Input=grown, **(surface or {}))
        folder = os.path.join(self.folder, name)
        writer = SubstrateWriter(Outer=OutputPort(surfaces, 0), Inner=OutputPort(surfaces, 1), Fibres=OutputPort(optimizer, 0), FolderName=folder)
        writer.UpdatePipeline()
        return os.path.join(folder, "manifest.json")

    def rerun(self, manifest, *arguments):
        done = subprocess.run(["pvpython", SCRIPT, manifest, *arguments], capture_output=True, text=True)
        return done.returncode, done.stdout + done.stderr.replace("ERR|", "")

    def assertSame(self, manifest, but=()):
        code, said = self.rerun(manifest)
        self.assertEqual(code, 0, said)
        self.assertIn("The same to the bit", said)
        old, new = os.path.dirname(manifest), os.path.dirname(manifest) + "-rerun"
        for name in ("outer/fibre_00001.ply", "inner/fibre_00001.ply", "fibres.strands", "manifest.json", "certificate.csv"):
            if name in but:
                continue
            with open(os.path.join(old, name), "rb") as one, open(os.path.join(new, name), "rb") as two:
                self.assertEqual(one.read(), two.read(), name)

    def test_two_bundles_at_one_optimiser(self):
        self.assertSame(self.write([bundle(), bundle(FibreVolumeFraction=0.2, RadiusDistribution="Lognormal", Seed=2)], NumberOfThreads=1))

    def test_blocks_and_a_table_of_radii(self):
        table = {"RadiusDistribution": "Table", "RadiusTable": "0.4 0.45;0.61", "DispersionModel": "Watson"}
        grouped = GroupDatasets(Input=[bundle(**table), bundle(Seed=5)])
        self.assertSame(self.write(grouped, growth={"TargetFibreVolumeFraction": 0.4}, surface={"GRatioModel": "Distributed", "GRatioDeviation": 0.05, "Seed": 9}))

    def test_a_tract_in_a_file(self):
        tract = os.path.join(self.folder, "tract.tck")
        SaveData(tract, proxy=bundle())
        fibres = TractFibres(Input=TractogramReader(FileName=tract), Side=5, FibreVolumeFraction=0.25, MinimumRadius=0.4, GrownFibreVolumeFraction=0)
        with self.assertError("end of a streamline|ends of streamlines"):  # they are as long as the domain
            fibres.UpdatePipeline()
        self.assertSame(self.write(fibres))

    def test_a_table_in_a_file(self):
        table = os.path.join(self.folder, "radii.txt")
        with open(table, "w", encoding="utf-8") as file:
            file.write("0.4 0.55\n0.7\n")
        manifest = self.write(bundle(RadiusDistribution="Table", RadiusTableFile=table))
        self.assertSame(manifest)
        with open(table, "a", encoding="utf-8") as file:
            file.write("0.5\n")
        code, said = self.rerun(manifest, "--output", os.path.join(self.folder, "other"))
        self.assertEqual(code, 2, said)
        self.assertRegex(said, r"radii\.txt, which BundleInitializer has read, is another file")
        os.remove(table)
        code, said = self.rerun(manifest, "--output", os.path.join(self.folder, "other"))
        self.assertEqual(code, 2, said)
        self.assertRegex(said, r"radii\.txt, which BundleInitializer has read, is missing")
        self.assertFalse(os.path.exists(os.path.join(self.folder, "other")))

    def test_a_strand_file_and_filters_of_vtk(self):
        path = os.path.join(self.folder, "two.strands")
        with open(path, "w", encoding="utf-8") as file:
            file.write("5\n2\n2\n-1 0 -4 0.7\n-1 0 4 0.7\n2\n0.3 0 -4 0.7\n0.2 0 4 0.7\n")
        # VTK's surfaces may be at fault; that is said, and no matter here.
        manifest = self.write(StrandReader(FileName=path), surface={"Meshing": "VTK filters", "TargetReduction": 0.5})
        read = os.path.join(self.folder, "read")
        SubstrateWriter(Outer=SubstrateReader(FileName=manifest), FolderName=read).UpdatePipeline()
        self._messages = [message for message in self._messages if "not certified" not in message and "not as asked" not in message]
        self.assertSame(manifest)
        # Of a folder that was read, the surfaces are read again, and not made.
        self.assertSame(os.path.join(read, "manifest.json"))

    def test_a_run_that_ran_out_of_time_takes_as_many_iterations(self):
        with self.assertError("overlaps remain: TimeBudget ran out"):
            fibres = CapsuleOptimizer(Input=bundle(FibreVolumeFraction=0.6, MeanDispersion=8, DispersionModel="Watson", GrownFibreVolumeFraction=0), TimeBudget=1e-6)
            fibres.UpdatePipeline()
        with self.assertError("still overlap"):
            manifest = self.write_from(fibres)
        self.assertSame(manifest, but=("manifest.json",))  # which has the number of iterations instead of the time

    def write_from(self, optimizer):
        surfaces = MyelinSurface(Input=FibreRadialGrowth(Input=OutputPort(optimizer, 0), VoxelSize=0.2))
        folder = os.path.join(self.folder, "substrate")
        SubstrateWriter(Outer=OutputPort(surfaces, 0), Inner=OutputPort(surfaces, 1), Fibres=OutputPort(optimizer, 0), FolderName=folder).UpdatePipeline()
        self._messages = [message for message in self._messages if "not as asked" not in message and "not certified" not in message]
        return os.path.join(folder, "manifest.json")

    def test_files_that_differ_are_named(self):
        manifest = self.write(bundle())
        with open(manifest, encoding="utf-8") as file:
            content = json.load(file)
        content["sha256"]["inner/fibre_00001.ply"] = 64 * "0"
        with open(manifest, "w", encoding="utf-8") as file:
            json.dump(content, file)
        code, said = self.rerun(manifest)
        self.assertEqual(code, 1, said)
        self.assertRegex(said, r"1 of \d+ files differ:\n    inner/fibre_00001\.ply")

    def test_files_of_any_format_are_compared(self):
        chain = self.write(bundle())
        surfaces = [servermanager.OutputPort(simple.FindSource("MyelinSurface1"), port) for port in (0, 1)]
        self.assertTrue(os.path.exists(chain))
        for name, changed in (("Disimpy", "inner_vertices.npy"), ("Reference program", "optimized_final.txt"), ("SpinDoctor", "substrate_dir/substrate_mesh.poly")):
            folder = os.path.join(self.folder, name.split(" ", maxsplit=1)[0])
            SubstrateWriter(Outer=surfaces[0], Inner=surfaces[1], FolderName=folder, Format=name).UpdatePipeline()
            manifest = os.path.join(folder, "manifest.json")
            with open(manifest, encoding="utf-8") as file:
                content = json.load(file)
            content["sha256"][changed] = 64 * "0"
            with open(manifest, "w", encoding="utf-8") as file:
                json.dump(content, file)
            code, said = self.rerun(manifest)
            self.assertEqual(code, 1, said)
            self.assertRegex(said, rf"1 of \d+ files differ:\n    {re.escape(changed)}\n")

    def test_other_values_make_another_substrate(self):
        """The comparison is one: it finds that the first stage has other values."""
        manifest = self.write(bundle())
        with open(manifest, encoding="utf-8") as file:
            text = file.read()
        self.assertIn('"Seed": 1, "WatsonKappa"', text)
        with open(manifest, "w", encoding="utf-8") as file:
            file.write(text.replace('"Seed": 1, "WatsonKappa"', '"Seed": 2, "WatsonKappa"', 1))
        code, said = self.rerun(manifest)
        self.assertEqual(code, 1, said)
        self.assertIn("came out otherwise are those at input Input of CapsuleOptimizer", said)

    def test_refusals(self):
        manifest = self.write(bundle())
        with open(manifest, encoding="utf-8") as file:
            good = json.load(file)

        def changed(change):
            content = json.loads(json.dumps(good))
            change(content)
            path = os.path.join(self.folder, "manifest.json")
            with open(path, "w", encoding="utf-8") as file:
                json.dump(content, file)
            return path

        def unknown_property(content):
            content["provenance"][0]["properties"]["Colour"] = 3

        def checkpoint(content):
            content["provenance"][0]["properties"]["CheckpointFile"] = os.path.join(self.folder, "again", "x")

        def unknown_stage(content):
            content["provenance"][1]["filter"] = "ProgrammableFilter"

        def lost_input(content):
            content["provenance"][2]["inputs"]["Input"] = [{}]

        def foreign(content):
            content["provenance"][2]["inputs"]["Input"] = [{"filter": "vtkTransformFilter", "inputs": content["provenance"][2]["inputs"]["Input"]}]

        def touched(content):
            content["provenance"][2]["inputs"]["Input"][0]["changed"] = True

        def words(content):
            content["provenance"] = ["BundleInitializer 0.1.0: Side=5"]

        for change, message in (
            (unknown_property, "BundleInitializer has no property Colour"),
            (unknown_stage, "there is no stage ProgrammableFilter"),
            (checkpoint, "BundleInitializer has no property CheckpointFile"),
            (lost_input, "where input Input of FibreRadialGrowth came from is not known"),
            (foreign, "a vtkTransformFilter was at work before input Input of FibreRadialGrowth"),
            (touched, "were changed after CapsuleOptimizer by something"),
            (words, "in words only"),
            (lambda content: content.update(format="another"), "is no manifest of a substrate"),
        ):
            with self.subTest(message=message):
                code, said = self.rerun(changed(change), "--output", os.path.join(self.folder, "again"))
                self.assertEqual(code, 2, said)
                self.assertIn(message, said)
                self.assertFalse(os.path.exists(os.path.join(self.folder, "again")))
        code, said = self.rerun(manifest, "--output", os.path.dirname(manifest))
        self.assertEqual(code, 2)
        self.assertIn("is there already", said)
        shutil.rmtree(os.path.dirname(manifest))
        self.assertIn("cannot read", self.rerun(manifest)[1])


if __name__ == "__main__":
    main()
