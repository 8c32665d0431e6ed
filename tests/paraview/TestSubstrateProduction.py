# SPDX-License-Identifier: BSD-3-Clause
# ctest-timeout: 900
# ctest-ranks: 2
"""Substrates made without holding label image and surfaces: the same files as from the filters one after the other, in less memory, and
a run that is killed goes on."""

import json
import os
import signal
import subprocess
import unittest

from cactus_testing import CactusTestCase, environment_of_its_own, fetch, kill_at, main, mesh_oracle, random_walk
from folder_content import files
from paraview.simple import (BundleInitializer, CapsuleOptimizer, FibreRadialGrowth, MyelinSurface, OutputPort, SubstrateProduction,
                             SubstrateWriter)
from vtkmodules.vtkParallelCore import vtkMultiProcessController

GROWTH = {"TargetFibreVolumeFraction": 0.85, "SurfaceTolerance": 0.006}
SURFACES = {"GRatioModel": "Distributed", "GRatio": 0.65, "Seed": 3}

# Makes a substrate, and says each stage of the work as it begins.
SCRIPT = """
import os
from paraview.simple import *
print("process", os.getpid(), flush=True)
side, folder, margin = float(sys.argv[1]), sys.argv[2], float(sys.argv[3])
fibres = CapsuleOptimizer(Input=BundleInitializer(Border="Walls", Side=side, GrownFibreVolumeFraction=0.85))
made = SubstrateProduction(Input=OutputPort(fibres, 0), FolderName=folder, NumberOfThreads=1, Margin=margin, Format="Surfaces alone")
made.TargetFibreVolumeFraction = 0.85
made.GRatioModel, made.TargetAxonVolumeFraction = "TargetAxonVolumeFraction", 0.4 # inner surfaces after all outer ones
filter = made.GetClientSideObject()
filter.AddObserver("ProgressEvent", lambda *_: print("at", filter.GetProgress(), filter.GetProgressText(), flush=True))
made.UpdatePipeline()
print("peak", [line for line in open("/proc/self/status") if line.startswith("VmHWM")][0].split()[1], flush=True)
"""

# The first rank is asked to stop while it works, and once more when it is too late.
STOPPED = """
import os, sys
from paraview.simple import *
folder = sys.argv[2]
fibres = CapsuleOptimizer(Input=BundleInitializer(Border="Walls", Side=float(sys.argv[1]), GrownFibreVolumeFraction=0.85))
made = SubstrateProduction(Input=OutputPort(fibres, 0), FolderName=folder, NumberOfThreads=1, Format="Surfaces alone")
filter = made.GetClientSideObject()
observer = filter.AddObserver("ProgressEvent", lambda *_: filter.SetAbortExecute(1) if 0.3 < filter.GetProgress() < 0.9 else None)
made.UpdatePipeline()
print("folder", os.path.exists(folder), flush=True)
filter.RemoveObserver(observer)
made.NumberOfThreads = 2
made.UpdatePipeline()
filter.SetAbortExecute(1)
made.UpdatePipeline()
print("folder", os.path.exists(folder), flush=True)
"""

# A stage before it fails on one rank, and then on none.
FAULT = """
import sys
from paraview import servermanager
from paraview.simple import *
CHANGE = '''
from vtkmodules.vtkCommonCore import vtkStringArray
from vtkmodules.vtkParallelCore import vtkMultiProcessController
output = self.GetPolyDataOutput()
output.ShallowCopy(self.GetPolyDataInput())
if IS_BAD and vtkMultiProcessController.GetGlobalController().GetLocalProcessId() == 1:
    mark = vtkStringArray()
    mark.SetName("Error")
    mark.InsertNextValue("no such file on this machine")
    output.Initialize()
    output.GetFieldData().AddArray(mark)
'''
fibres = CapsuleOptimizer(Input=BundleInitializer(Border="Walls", Side=float(sys.argv[1]), GrownFibreVolumeFraction=0.85))
changed = ProgrammableFilter(Input=OutputPort(fibres, 0), Script="IS_BAD = True" + CHANGE)
changed.RequestUpdateExtentScript = '''
self.GetInputInformation().Set(self.GetExecutive().UPDATE_PIECE_NUMBER(), 0)
self.GetInputInformation().Set(self.GetExecutive().UPDATE_NUMBER_OF_PIECES(), 1)
'''
made = SubstrateProduction(Input=changed, FolderName=sys.argv[2])
made.UpdatePipeline()
print("rank 0:", servermanager.Fetch(made, idx=0).GetFieldData().GetAbstractArray("Error").GetValue(0), flush=True)
changed.Script = "IS_BAD = False" + CHANGE
made.FolderName = sys.argv[2] + "-after"
made.UpdatePipeline()
print("files after:", servermanager.Fetch(made, idx=0).GetNumberOfRows(), flush=True)
"""


def rank():
    controller = vtkMultiProcessController.GetGlobalController()
    return controller.GetLocalProcessId() if controller else 0


def ranks():
    controller = vtkMultiProcessController.GetGlobalController()
    return controller.GetNumberOfProcesses() if controller else 1


class SubstrateProductionTest(CactusTestCase):
    def fibres(self, side):
        return OutputPort(CapsuleOptimizer(Input=BundleInitializer(Border="Walls", Side=side, GrownFibreVolumeFraction=0.85)), 0)

    def test_writes_what_the_filters_write(self):
        fibres = self.fibres(6.0)
        surfaces = MyelinSurface(Input=FibreRadialGrowth(Input=fibres, Seed=3, **GROWTH), **SURFACES)
        one = os.path.join(self.folder, f"one-{rank()}")
        other = os.path.join(self.folder, f"other-{rank()}")
        written = fetch(SubstrateWriter(Outer=OutputPort(surfaces, 0), FolderName=one))
        produced = SubstrateProduction(Input=fibres, FolderName=other, **GROWTH, **SURFACES)
        stages = []
        filter = produced.GetClientSideObject()
        filter.AddObserver("ProgressEvent", lambda *_: stages.append((filter.GetProgress(), filter.GetProgressText())))
        table = fetch(produced, 0)
        self.assertFalse(os.path.exists(other + ".work"))
        if rank() > 0:
            self.assertFalse(os.path.exists(other))
            return
        told = {text.split(":")[0] for _, text in stages if text}
        self.assertLessEqual({"making surfaces", "keeping fibres apart"}, told)
        expected, found = files(one), files(other)
        manifest = json.loads(found.pop("manifest.json"))
        expected.pop("manifest.json")
        self.assertEqual(set(found), set(expected))
        self.assertGreater(len(found), 30)
        for name in expected:
            self.assertEqual(found[name], expected[name], name)
        records = manifest["provenance"]
        self.assertEqual([record["filter"].replace("vtk", "") for record in records], ["BundleInitializer", "CapsuleOptimizer", "SubstrateProduction"])
        self.assertEqual(records[-1]["properties"]["GRatioModel"], "Distributed")
        for found, expected in ((table, written), (fetch(produced, 1), fetch(surfaces, 2))):
            self.assertEqual(found.GetNumberOfRows(), expected.GetNumberOfRows())
            self.assertEqual(found.GetNumberOfColumns(), expected.GetNumberOfColumns())
            for column in range(found.GetNumberOfColumns()):
                for row in range(found.GetNumberOfRows()):
                    self.assertEqual(found.GetValue(row, column), expected.GetValue(row, column))

    def test_writes_a_file_for_each_bundle_as_the_writer_does(self):
        crossing = BundleInitializer(Border="Walls", Side=5.0, NumberOfBundles=2, FibreVolumeFraction=0.4, MaximumRadius=0.6, GrownFibreVolumeFraction=0.6)
        growth = {**GROWTH, "TargetFibreVolumeFraction": 0.6}
        fibres = OutputPort(CapsuleOptimizer(Input=crossing), 0)
        surfaces = MyelinSurface(Input=FibreRadialGrowth(Input=fibres, Seed=3, **growth), **SURFACES)
        one = os.path.join(self.folder, f"one-{rank()}")
        other = os.path.join(self.folder, f"other-{rank()}")
        kind = {"Format": "Surfaces by bundle", "Encoding": "Binary"}
        SubstrateWriter(Outer=OutputPort(surfaces, 0), FolderName=one, **kind).UpdatePipeline()
        SubstrateProduction(Input=fibres, FolderName=other, **kind, **growth, **SURFACES).UpdatePipeline()
        if rank() == 0:
            expected, found = files(one), files(other)
            self.assertEqual(len([name for name in found if name.endswith(".ply")]), 4)
            for name in expected:
                self.assertTrue(name == "manifest.json" or found[name] == expected[name], name)

    def test_writes_surfaces_alone_in_binary_files(self):
        """Which are judged by programs of their own."""
        folder = os.path.join(self.folder, "binary")
        SubstrateProduction(Input=self.fibres(4.0), FolderName=folder, Format="Surfaces alone", Encoding="Binary", **GROWTH, **SURFACES).UpdatePipeline()
        self.assertFalse(os.path.exists(os.path.join(folder, "mcdc")))
        with open(os.path.join(folder, "manifest.json"), encoding="utf-8") as file:
            manifest = json.load(file)
        self.assertTrue(manifest["certified"])
        self.assertEqual(manifest["simulator"], "Surfaces alone")
        meshes = mesh_oracle(folder)["meshes"]
        self.assertEqual(len(meshes), len(manifest["files"]))
        for mesh in meshes:
            self.assertTrue(mesh["closed"] and mesh["outward"] and not mesh["self_intersecting"], mesh)
            with open(os.path.join(folder, mesh["file"]), "rb") as file:
                self.assertEqual(file.read(31), b"ply\nformat binary_little_endian")
        triangles = sum(entry["triangles"] for entry in manifest["files"])
        size = sum(os.path.getsize(os.path.join(folder, entry["path"])) for entry in manifest["files"])
        heads = 260 * len(manifest["files"])
        self.assertLess((size - heads) / triangles, 19.5)
        walked = random_walk(folder, walkers=5, steps=2000, step=0.1)
        self.assertEqual([(walked[name]["walkers"], walked[name]["leaked"]) for name in ("inner", "myelin", "outside")], 3 * [(5, 0)])

    def script(self, folder, margin):
        """SCRIPT in a process of its own."""
        path = os.path.join(self.folder, "script.py")
        with open(path, "w") as file:
            file.write(SCRIPT)
        return subprocess.Popen(["pvpython", path, "5", folder, str(margin)], stdout=subprocess.PIPE, text=True)

    def test_keeps_the_folder_where_only_the_input_changes(self):
        bundle = BundleInitializer(Border="Walls", Side=4, GrownFibreVolumeFraction=0.85)
        folder = os.path.join(self.folder, "kept")
        produced = SubstrateProduction(Input=OutputPort(CapsuleOptimizer(Input=bundle), 0), FolderName=folder, **GROWTH)
        produced.UpdatePipeline()
        before = files(folder)
        bundle.Seed = 2
        with self.assertError("what comes in has changed since .* was written, which stays as it is: press Write"):
            produced.UpdatePipeline()
        self.assertEqual(files(folder), before)
        produced.InvokeCommand("Write")
        after = files(folder)
        self.assertNotEqual(after["fibres.strands"], before["fibres.strands"])
        self.assertEqual(fetch(produced, 0).GetNumberOfRows(), sum(name.endswith(".ply") for name in after))

    def on_ranks(self, count, folder, script=SCRIPT, arguments=("5", "0")):
        """A script in pvbatch on so many ranks."""
        path = os.path.join(self.folder, f"ranks-{count}.py")
        with open(path, "w") as file:
            file.write(script)
        return subprocess.Popen(["mpiexec", "-n", str(count), "pvbatch", path, arguments[0], folder, *arguments[1:]],
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment_of_its_own())

    @unittest.skipIf(ranks() > 1, "starts processes of its own")
    def test_the_same_files_from_any_number_of_ranks(self):
        """One that is killed goes on with another number, too; its journals show that all ranks work."""
        wanted = os.path.join(self.folder, "one")
        with self.script(wanted, 0) as process:
            process.communicate()
        folder = os.path.join(self.folder, "killed")
        with self.on_ranks(3, folder) as process:
            kill_at(process, "making inner surfaces")
        self.assertNotEqual(process.returncode, 0)
        self.assertFalse(os.path.exists(folder))
        journals = sorted(name for name in os.listdir(folder + ".work") if name.startswith("journal"))
        self.assertEqual(journals, ["journal", "journal-00001", "journal-00002"])
        for name in journals:
            self.assertGreater(os.path.getsize(os.path.join(folder + ".work", name)), 1000, name)
        with self.on_ranks(2, folder) as process:
            said = process.stdout.read()
        self.assertEqual(process.returncode, 0, said)
        self.assertNotIn("keeping fibres apart", said)
        self.assertEqual(files(folder), files(wanted))
        self.assertFalse(os.path.exists(folder + ".work"))
        whole = os.path.join(self.folder, "whole")
        with self.on_ranks(3, whole) as process:
            said = process.stdout.read()
        self.assertEqual(process.returncode, 0, said)
        self.assertEqual(files(whole), files(wanted))

    @unittest.skipIf(ranks() > 1, "starts processes of its own")
    def test_ranks_end_together_with_one_message(self):
        folder = os.path.join(self.folder, "refused")
        with self.on_ranks(3, folder, SCRIPT.replace("made.TargetFibre", "made.DecimationError = 0.02; made.TargetFibre")) as process:
            said = process.stdout.read()
        self.assertEqual(said.count("is more than the room"), 1, said)
        self.assertEqual([name for name in os.listdir(self.folder) if name.startswith("refused")], [])

    @unittest.skipIf(ranks() > 1, "starts processes of its own")
    def test_stops_where_one_rank_is_asked_to(self):
        """And nobody waits for the others afterwards, or where it is asked too late."""
        folder = os.path.join(self.folder, "stopped")
        with self.on_ranks(2, folder, STOPPED) as process:
            try:
                said, _ = process.communicate(timeout=90)
            except subprocess.TimeoutExpired:
                process.terminate()
                raise
        self.assertEqual(process.returncode, 0, said)
        self.assertEqual(said.count("stopped by the user, and what is finished is kept"), 1, said)
        self.assertRegex(said, r"(?m)^folder False$", said)
        self.assertRegex(said, r"(?m)^folder True$", said)

    @unittest.skipIf(ranks() > 1, "starts processes of its own")
    def test_a_fault_before_one_rank_ends_all(self):
        folder = os.path.join(self.folder, "fault")
        with self.on_ranks(2, folder, FAULT) as process:
            said = process.stdout.read()
        self.assertRegex(said, r"(?m)^rank 0: no such file on this machine$", said)
        self.assertRegex(said, r"(?m)^files after: [1-9]", said)

    @unittest.skipIf(ranks() > 1, "starts processes of its own")
    def test_goes_on_after_it_was_killed(self):
        folder = os.path.join(self.folder, "killed")
        whole = os.path.join(self.folder, "whole")
        with self.script(whole, 0) as process:
            undisturbed = process.stdout.read()
        self.assertEqual(process.returncode, 0)
        for wanted in ("making outer surfaces", "making inner surfaces"):
            with self.script(folder, 0) as process:
                seen = 0
                for line in process.stdout:
                    seen += wanted in line
                    if seen == 3:
                        process.send_signal(signal.SIGKILL)
                        break
            self.assertEqual(process.returncode, -signal.SIGKILL)
            self.assertFalse(os.path.exists(folder))
            self.assertTrue(os.path.exists(folder + ".work/journal"))
        with self.assertError("holds what was made of other fibres, with other parameters"):
            SubstrateProduction(Input=self.fibres(4.0), FolderName=folder, DecimationError=0.004).UpdatePipeline()
        with self.script(folder, 0) as process:
            rest = process.stdout.read()
        self.assertEqual(process.returncode, 0)
        self.assertIn("keeping fibres apart", undisturbed)
        self.assertNotIn("keeping fibres apart", rest)
        self.assertEqual(files(folder), files(whole))
        self.assertFalse(os.path.exists(folder + ".work"))

    @unittest.skipIf(ranks() > 1, "starts processes of its own")
    def test_is_made_again_from_its_manifest(self):
        folder = os.path.join(self.folder, "first")
        SubstrateProduction(Input=self.fibres(4.0), FolderName=folder, GrowthIterations=2, Seed=5, GRatio=0.6).UpdatePipeline()
        rerun = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tools", "scripts", "rerun.py")
        done = subprocess.run(["pvpython", rerun, folder], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr.replace("ERR|", ""))
        again = files(folder + "-rerun")
        for name, data in files(folder).items():
            if name.endswith(".ply"):
                self.assertEqual(again[name], data, name)

    @unittest.skipIf(ranks() > 1, "starts processes of its own")
    def test_takes_no_memory_for_the_image(self):
        peaks = []
        # With a margin of 20 µm the image has 460³ voxels, for which FibreRadialGrowth would take 0.8 GB.
        for margin in (0, 20):
            with self.script(os.path.join(self.folder, f"margin-{margin}"), margin) as process:
                peaks.append(int(process.stdout.read().split("peak")[1]) / 1024)
            self.assertEqual(process.returncode, 0)
        self.assertLess(peaks[1] - peaks[0], 100, "MB")

    def test_refuses(self):
        folder = os.path.join(self.folder, f"refused-{rank()}")
        fibres = self.fibres(4.0)
        if rank() > 0:
            return
        with self.assertError("FolderName is empty"):
            SubstrateProduction(Input=fibres).UpdatePipeline()
        with self.assertError("DecimationError 0.02 is more than the room"):
            SubstrateProduction(Input=fibres, FolderName=folder, DecimationError=0.02).UpdatePipeline()
        told = []
        production = SubstrateProduction(Input=fibres, FolderName=folder, Encoding="Binary")
        production.SMProxy.GetClientSideObject().AddObserver("ProgressEvent", lambda caller, _: told.append(caller.GetProgressText()))
        with self.assertError("Encoding Binary is not for simulators whose readers of PLY files"):
            production.UpdatePipeline()
        self.assertFalse([text for text in told if text], "said before anything is made")
        self.assertFalse(os.path.exists(folder + ".work"))


if __name__ == "__main__":
    main()
