# SPDX-License-Identifier: BSD-3-Clause
# ctest-ranks: 2
# ctest-timeout: 600
"""On any number of ranks: statistics and certificate are the same, and one row; a substrate is grown whole; MyelinSurface shares its
work, each rank holds a piece, and files are the same."""

import os
import re
import subprocess
import unittest

from cactus_testing import CactusTestCase, environment_of_its_own, fetch, main
from folder_content import files
from paraview import servermanager
from paraview.simple import (BundleInitializer, CapsuleOptimizer, FibreRadialGrowth, HistologyMask, MyelinSurface, OutputPort, Placement,
                             SubstrateCertificate, SubstrateSampler, SubstrateStatistics, SubstrateWriter, XMLPolyDataReader)
from surfaces import POLYGON, two_tubes
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter
from vtkmodules.vtkParallelCore import vtkMultiProcessController

CHAIN = """
import sys
from paraview import servermanager
from paraview.simple import *
fibres = OutputPort(CapsuleOptimizer(Input=BundleInitializer(Border="Walls", Side=5, MeanDispersion=10, MaximumRadius=1, Seed=1)), 0)
grown = FibreRadialGrowth(Input=fibres, VoxelSize=0.12)
"""

# Makes surfaces; says what each rank holds as its piece, and writes both the pieces and a substrate.
SHARED = CHAIN + """
surfaces = MyelinSurface(Input=grown)
outside, inside = OutputPort(surfaces, 0), OutputPort(surfaces, 1)
maker = surfaces.GetClientSideObject()
progress = [1.0]
maker.AddObserver("ProgressEvent", lambda *_: progress.append(maker.GetProgress()) if maker.GetProgressText() else None)
HELD = '''
from vtkmodules.vtkParallelCore import vtkMultiProcessController
held = self.GetPolyDataInput()
ids = held.GetCellData().GetArray("FibreId").GetRange()
print("piece", vtkMultiProcessController.GetGlobalController().GetLocalProcessId(), *map(int, ids), held.GetNumberOfCells(), flush=True)
'''
ProgrammableFilter(Input=outside, Script=HELD).UpdatePipeline()
SaveData(sys.argv[1] + "/pieces.ply", proxy=inside)
writer = SubstrateWriter(Outer=outside, FolderName=sys.argv[1] + "/written")
writer.UpdatePipeline()
certificate = SubstrateCertificate(Outer=outside)
certificate.UpdatePipeline()
print("rows", servermanager.Fetch(certificate, idx=0).GetNumberOfRows(), servermanager.Fetch(writer).GetNumberOfRows(), flush=True)
surfaces.GRatio = 0.6
SaveData(sys.argv[1] + "/thicker.ply", proxy=inside)
print("runs", [after < before for before, after in zip(progress, progress[1:])].count(True), flush=True)
"""

# One rank's image is another one, or has failed, and then none; the first rank is asked to stop, and once more when it is too late.
FAULTS = CHAIN + """
CHANGE = '''
from vtkmodules.vtkCommonCore import vtkFloatArray, vtkStringArray
from vtkmodules.vtkParallelCore import vtkMultiProcessController
output = self.GetOutputDataObject(0)
output.ShallowCopy(self.GetInputDataObject(0, 0))
rank = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
if rank == 1 and KIND == "other":
    depth = vtkFloatArray()
    depth.DeepCopy(output.GetPointData().GetArray("Depth"))
    depth.SetValue(0, depth.GetValue(0) - 0.001)
    output.GetPointData().AddArray(depth)
if rank == 1 and KIND == "fault":
    mark = vtkStringArray()
    mark.SetName("Error")
    mark.InsertNextValue("no such file on this machine")
    output.GetFieldData().AddArray(mark)
'''
changed = ProgrammableFilter(Input=grown)
surfaces = MyelinSurface(Input=changed)
filter = surfaces.GetClientSideObject()
def run(kind):
    OutputPort(surfaces, 0).UpdatePipeline()
    error = servermanager.Fetch(surfaces, idx=0).GetFieldData().GetAbstractArray("Error")
    cells = OutputPort(surfaces, 0).GetDataInformation().GetNumberOfCells()
    print(kind, "->", cells, error.GetValue(0) if error else "", flush=True)
for kind in ("other", "fault", "none"):
    changed.Script = f"KIND = {kind!r}" + CHANGE
    run(kind)
observer = filter.AddObserver("ProgressEvent", lambda *_: filter.SetAbortExecute(1) if 0.3 < filter.GetProgress() < 0.9 else None)
surfaces.DecimationError = 0.002
run("stopped")
filter.RemoveObserver(observer)
surfaces.DecimationError = 0.0025
run("again")
filter.SetAbortExecute(1)
run("late")
"""


def ranks():
    controller = vtkMultiProcessController.GetGlobalController()
    return controller.GetNumberOfProcesses() if controller else 1


class Ranks(CactusTestCase):
    def inputs(self):
        readers = {}
        for name, data in zip(("Fibres", "Outer", "Inner"), two_tubes(inset=0.1)):
            path = os.path.join(self.folder, name + ".vtp")
            writer = vtkXMLPolyDataWriter()
            writer.SetFileName(path)
            writer.SetInputData(data)
            writer.SetDataModeToBinary()  # Debian's ParaView cannot read the appended data that is the default
            self.assertEqual(writer.Write(), 1)
            readers[name] = XMLPolyDataReader(FileName=[path])
        return readers

    def test_statistics(self):
        table = fetch(SubstrateStatistics(**self.inputs()))
        self.assertEqual(table.GetNumberOfRows(), 1)
        self.assertEqual(table.GetValueByName(0, "Fibres").ToInt(), 2)
        self.assertAlmostEqual(table.GetValueByName(0, "FVF").ToDouble(), POLYGON * 3.25 * 10 / 1000, places=6)

    def test_certificate(self):
        table = fetch(SubstrateCertificate(**self.inputs()))
        self.assertEqual(table.GetNumberOfRows(), 1)
        self.assertEqual(table.GetValueByName(0, "Certified").ToInt(), 1)

    def test_images_are_those_of_one_rank(self):
        inputs = self.inputs()
        surfaces = {name: inputs[name] for name in ("Outer", "Inner")}
        for proxy, count in ((SubstrateSampler(VoxelSize=2, **inputs), 5**3), (HistologyMask(PixelSize=0.5, **surfaces), 20**2)):
            proxy.UpdatePipeline()
            self.assertEqual(proxy.GetDataInformation().GetNumberOfPoints(), count, proxy.SMProxy.GetXMLName())

    def test_placement(self):
        """Where only the first rank has something, that is placed, and no other complains."""
        bundle = BundleInitializer(Border="Walls", Side=6, Seed=1)
        placed = Placement(Input=bundle, PositionX=5)
        placed.UpdatePipeline()
        self.assertEqual(placed.GetDataInformation().GetNumberOfCells(), bundle.GetDataInformation().GetNumberOfCells())
        self.assertIsNone(placed.GetDataInformation().GetFieldDataInformation().GetArrayInformation("Error"))

    def test_what_was_updated_by_itself_is_whole_for_the_next_stage(self):
        """An update asks each rank for a piece of its own, and all but the first get nothing: the next stage has to ask again."""
        fibres = OutputPort(CapsuleOptimizer(Input=BundleInitializer(Border="Walls", Side=6, MeanDispersion=10, MaximumRadius=1, Seed=1)), 0)
        fibres.UpdatePipeline()
        # A fibre fills the corner of the image: were that all that a rank sees of it, its surface would not be closed.
        grown = FibreRadialGrowth(Input=fibres, VoxelSize=0.1)
        surfaces = MyelinSurface(Input=grown)
        outer, inner = OutputPort(surfaces, 0), OutputPort(surfaces, 1)
        # Each rank makes the whole substrate, and an error of any fails the test; the first writes it.
        folder = os.path.join(self.folder, "substrate")
        SubstrateWriter(Fibres=fibres, Outer=outer, Inner=inner, FolderName=folder).UpdatePipeline()
        count = servermanager.Fetch(fibres).GetNumberOfCells()
        self.assertGreater(count, 3)
        self.assertEqual(len(os.listdir(os.path.join(folder, "outer"))), count)

    def said(self, count, script):
        """What a script says in pvbatch on so many ranks; its argument is a folder of its own, `self.made`."""
        path = os.path.join(self.folder, "script.py")
        with open(path, "w") as file:
            file.write(script)
        self.made = os.path.join(self.folder, f"on-{count}")
        os.mkdir(self.made)
        command = ["mpiexec", "-n", str(count), "pvbatch", path, self.made]
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment_of_its_own(), timeout=200)
        said = done.stdout.replace("ERR|", "")
        self.assertEqual(done.returncode, 0, said)
        return said

    @unittest.skipIf(ranks() > 1, "starts processes of its own")
    def test_ranks_share_the_surfaces(self):
        expected = None
        for count in (1, 2, 3):
            said = self.said(count, SHARED)
            pieces = sorted([int(number) for number in piece.split()] for piece in re.findall(r"(?m)^piece (.*)$", said))
            self.assertEqual([rank for rank, *_ in pieces], list(range(count)), said)
            for (_, _, last, _), (_, first, _, _) in zip(pieces, pieces[1:]):
                self.assertLess(last, first)
            cells = [held for *_, held in pieces]
            self.assertLess(max(cells), 1.5 * min(cells), "pieces of about the same size")
            found = (sum(cells), re.findall(r"(?m)^rows (.*)$", said), files(self.made))
            self.assertGreater(len(found[2]), 20)
            expected = expected or found
            self.assertEqual(found[:2], expected[:2])
            self.assertEqual(set(found[2]), set(expected[2]))
            for name, data in expected[2].items():
                self.assertTrue(found[2][name] == data, f"{name} on {count} ranks")
            self.assertIn("runs 2\n", said)

    @unittest.skipIf(ranks() > 1, "starts processes of its own")
    def test_ranks_fail_and_stop_together(self):
        said = self.said(2, FAULTS)
        for kind, pattern in (("other", "the ranks were given different label images"), ("fault", "no such file on this machine"),
                              ("stopped", "stopped by the user")):
            self.assertRegex(said, f"(?m)^{kind} -> 0 .*{pattern}", said)
        for kind in ("none", "again", "late"):
            self.assertRegex(said, f"(?m)^{kind} -> [1-9][0-9]* $", said)


if __name__ == "__main__":
    main()
