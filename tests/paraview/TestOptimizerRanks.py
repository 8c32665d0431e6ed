# SPDX-License-Identifier: BSD-3-Clause
# ctest-extended
# ctest-needs: display
# ctest-ranks: 2
# ctest-timeout: 300
"""Ranks share an optimisation: its bits are those of one, in a batch, on a server, and after a rank was killed; an error of one ends it in
all. TimeBudget stops all at the same iteration, whichever of them are asked for the result; ReleaseInput frees on all."""

import glob
import os
import re
import socket
import subprocess
import unittest

from cactus_testing import UNPARTED, CactusTestCase, environment_of_its_own, fetch, kill_at, main
from paraview.simple import (BundleInitializer, CapsuleOptimizer, FibreRadialGrowth, MyelinSurface, OutputPort, ProgrammableFilter,
                             SaveData)
from vtkmodules.vtkIOXML import vtkXMLImageDataReader
from vtkmodules.vtkParallelCore import vtkMultiProcessController

# On each rank a row: how many voxels are left in the images further up.
COUNT = """
from vtkmodules.vtkCommonCore import vtkIdTypeArray
from vtkmodules.vtkCommonDataModel import vtkImageData
column = vtkIdTypeArray()
column.SetName("Voxels")
consumer, voxels = self, 0
while consumer.GetNumberOfInputPorts() > 0 and consumer.GetNumberOfInputConnections(0) > 0:
    data = consumer.GetInputDataObject(0, 0)
    voxels += data.GetNumberOfPoints() if isinstance(data, vtkImageData) else 0
    consumer = consumer.GetInputAlgorithm(0, 0)
column.InsertNextValue(voxels)
self.GetOutputDataObject(0).AddColumn(column)
"""

LIMIT = 60  # seconds for a run of a few

# What a script begins with that is run on several ranks: an optimisation, and what is to be known of its result.
BEGIN = """
import hashlib, os, sys
from paraview.simple import *
from paraview import servermanager
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkParallelCore import vtkDummyController, vtkMultiProcessController

def bits(optimizer):
    fibres, table = (servermanager.Fetch(optimizer, idx=port) for port in (0, 1))
    if fibres.GetNumberOfCells() == 0:
        return "0 fibres"
    arrays = [fibres.GetPoints().GetData(), *(fibres.GetPointData().GetArray(name) for name in ("Radius", "Overlap"))]
    arrays += [table.GetColumn(i) for i in range(table.GetNumberOfColumns()) if table.GetColumnName(i) != "Seconds"]
    found = hashlib.sha256()
    for array in arrays:
        found.update(vtk_to_numpy(array).tobytes())
    return f"{fibres.GetNumberOfCells()} fibres {found.hexdigest()}"

def bundle():
    return BundleInitializer(Border="Walls", Side=10, MeanDispersion=15, DispersionModel="Watson", GrownFibreVolumeFraction=0)
"""

# What follows an update takes what is there.
SHARED = BEGIN + """
optimizer = CapsuleOptimizer(Input=bundle(), KeepHistory=int(sys.argv[1]))
filter, texts = optimizer.GetClientSideObject(), []
filter.AddObserver("ProgressEvent", lambda *_: texts.append(str(filter.GetProgressText())))
optimizer.UpdatePipeline()
print("bits", bits(optimizer), flush=True)
FibreRadialGrowth(Input=OutputPort(optimizer, 0), VoxelSize=1).UpdatePipeline()
SaveData(sys.argv[2], proxy=OutputPort(optimizer, 0))
print("runs", sum(text.startswith("iteration 0:") for text in texts), flush=True)
"""

# Ranks that run the script each by itself.
SYMMETRIC = BEGIN + """
if sys.argv[1] == "alone":
    alone = vtkDummyController()
    vtkMultiProcessController.SetGlobalController(alone)
optimizer = CapsuleOptimizer(Input=bundle())
found = bits(optimizer)
if not found.startswith("0 "):  # the first one's alone, where they share it
    print("bits", found, flush=True)
"""

CHECKPOINTS = BEGIN + """
optimizer = CapsuleOptimizer(Input=bundle(), CheckpointFile=sys.argv[1], CheckpointInterval=0, Resume=1)
print("process", os.getpid(), flush=True)
filter = optimizer.GetClientSideObject()
filter.AddObserver("ProgressEvent", lambda *_: print("at", filter.GetProgressText(), flush=True))
optimizer.UpdatePipeline()
print("bits", bits(optimizer), flush=True)
"""

# The first rank is asked to stop while it runs, and once more when it is too late.
STOPPED = BEGIN + """
optimizer = CapsuleOptimizer(Input=bundle())
filter = optimizer.GetClientSideObject()
stop = lambda *_: filter.SetAbortExecute(1) if "iteration 20:" in str(filter.GetProgressText()) else None
observer = filter.AddObserver("ProgressEvent", stop)
optimizer.UpdatePipeline()
print("bits stopped", bits(optimizer), flush=True)
filter.RemoveObserver(observer)
filter.SetAbortExecute(1)
optimizer.UpdatePipeline()
FibreRadialGrowth(Input=OutputPort(optimizer, 0), VoxelSize=1).UpdatePipeline()
print("bits stopped", bits(optimizer), flush=True)
optimizer.MaximumIterations = 2999
print("bits", bits(optimizer), flush=True)
"""

# The second rank has something else: a radius below 0, another place of a point, a fault of what comes before, or nothing.
FAULTS = BEGIN + """
CHANGE = '''
from vtkmodules.vtkCommonCore import vtkStringArray
from vtkmodules.vtkParallelCore import vtkMultiProcessController
output = self.GetPolyDataOutput()
output.DeepCopy(self.GetPolyDataInput())
rank = vtkMultiProcessController.GetGlobalController().GetLocalProcessId()
if rank == 1 and KIND == "radius":
    output.GetPointData().GetArray("Radius").SetTuple1(0, -1)
if rank == 1 and KIND == "place":
    output.GetPoints().SetPoint(0, 1, 2, -5)
if rank == 1 and KIND == "fault":
    mark = vtkStringArray()
    mark.SetName("Error")
    mark.InsertNextValue("no such file on this machine")
    output.Initialize()
    output.GetFieldData().AddArray(mark)
'''
changed = ProgrammableFilter(Input=bundle(), RequestUpdateExtentScript='''
from paraview import util
self.GetInputInformation().Set(self.GetExecutive().UPDATE_PIECE_NUMBER(), 0)
self.GetInputInformation().Set(self.GetExecutive().UPDATE_NUMBER_OF_PIECES(), 1)
''')
optimizer = CapsuleOptimizer(Input=changed)
for kind in ("radius", "place", "fault", "none"):
    changed.Script = f"KIND = {kind!r}" + CHANGE
    optimizer.UpdatePipeline()
    fibres = servermanager.Fetch(optimizer, idx=0)
    mark = fibres.GetFieldData().GetAbstractArray("Error")
    print(kind, "->", fibres.GetNumberOfCells(), mark.GetValue(0) if mark else "", flush=True)
"""

CLIENT = BEGIN + """
Connect("127.0.0.1", int(sys.argv[1]))
optimizer = CapsuleOptimizer(Input=bundle())
view = CreateRenderView()
Show(OutputPort(optimizer, 0), view)
Render(view)
print("bits", bits(optimizer), flush=True)
Disconnect()
"""


def ranks():
    controller = vtkMultiProcessController.GetGlobalController()
    return controller.GetNumberOfProcesses() if controller else 1


@unittest.skipIf(ranks() > 1, "starts processes of its own")
class SharedRuns(CactusTestCase):
    def start(self, command, script, *arguments):
        path = os.path.join(self.folder, "script.py")
        with open(path, "w") as file:
            file.write(script)
        return subprocess.Popen([*command, path, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                env=environment_of_its_own())

    def said(self, command, script, *arguments):
        with self.start(command, script, *arguments) as process:
            try:
                said, _ = process.communicate(timeout=LIMIT)
            except subprocess.TimeoutExpired:
                process.terminate()
                said, _ = process.communicate()
                self.fail("ranks wait for each other:\n" + said.replace("ERR|", ""))
        self.assertEqual(process.returncode, 0, said.replace("ERR|", ""))
        return said

    def on_ranks(self, count, *options):
        return ["mpiexec", "-n", str(count), "pvbatch", *options]

    def bits(self, said):
        found = re.findall("^bits (.*)$", said, re.MULTILINE)
        self.assertGreaterEqual(len(found), 1, said.replace("ERR|", ""))
        return found

    def test_the_same_bits_on_any_number_of_ranks(self):
        """Of which core's SharedOptimisation tries more."""
        expected = None
        for count, history in ((1, 0), (2, 0), (3, 1)):
            with self.subTest(ranks=count, KeepHistory=history):
                strands = os.path.join(self.folder, "fibres.strands")
                said = self.said(self.on_ranks(count), SHARED, history, strands)
                with open(strands, "rb") as file:
                    found = (self.bits(said), file.read())
                expected = expected or found
                self.assertEqual(found, expected)
                # With its history it has run before anybody listened, since times are asked for at once.
                self.assertIn(f"runs {1 - history}\n", said)
        self.assertGreater(int(expected[0][0].split()[0]), 30)

    def test_ranks_that_work_alone_or_each_run_the_script(self):
        expected = self.bits(self.said(["pvpython"], SYMMETRIC, "alone"))
        for how, count in (("alone", 2), ("together", 1)):
            self.assertEqual(self.bits(self.said(self.on_ranks(2, "--sym"), SYMMETRIC, how)), count * expected, how)

    def test_goes_on_after_a_rank_was_killed(self):
        expected = self.bits(self.said(["pvpython"], CHECKPOINTS, os.path.join(self.folder, "whole")))
        checkpoint = os.path.join(self.folder, "killed")
        with self.start(self.on_ranks(2), CHECKPOINTS, checkpoint) as process:
            kill_at(process, "iteration 40:")
        self.assertNotEqual(process.returncode, 0)
        said = self.said(self.on_ranks(3), CHECKPOINTS, checkpoint)
        self.assertNotIn("iteration 0:", said)
        self.assertEqual(self.bits(said), expected)

    def test_stops_where_one_rank_is_asked_to(self):
        alone, shared = (self.said(self.on_ranks(count), STOPPED) for count in (1, 2))
        found = self.bits(alone)
        self.assertEqual(len(found), 3)
        self.assertEqual(found[0], found[1])
        self.assertNotEqual(found[0], "stopped " + found[2])
        self.assertEqual(self.bits(shared), found)
        self.assertEqual(shared.count("the run was stopped after 21 iterations"), 1, shared)

    def test_an_error_on_one_rank_ends_all_with_one_message(self):
        said = self.said(self.on_ranks(2), FAULTS)
        for kind, pattern in (("radius", "on rank 1: .*[Rr]adius"), ("place", "given different fibres or parameters"),
                              ("fault", "no such file on this machine")):
            self.assertRegex(said, f"(?m)^{kind} -> 0 .*{pattern}", said.replace("ERR|", ""))
        self.assertRegex(said, "(?m)^none -> [1-9][0-9]* $", said.replace("ERR|", ""))

    def test_a_server_of_two_ranks(self):
        with socket.socket() as listener:
            listener.bind(("127.0.0.1", 0))
            port = listener.getsockname()[1]
        server = subprocess.Popen(["mpiexec", "-n", "2", "pvserver", f"--server-port={port}"], stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, text=True, env=environment_of_its_own())
        try:
            for line in server.stdout:
                if "Accepting connection" in line:
                    break
            client = self.said(["pvpython"], CLIENT, port)
            server.wait(20)
        finally:
            server.kill()
            server.communicate()
        self.assertEqual(self.bits(client), self.bits(self.said(["pvpython"], SYMMETRIC, "alone")))


class Ranks(CactusTestCase):
    expected = UNPARTED

    def grown(self, first, **properties):
        """The provenance of each rank's part of an image of more fibres than are parted in a fifth of a second."""
        bundle = BundleInitializer(Border="Walls", Side=30, MeanDispersion=20, DispersionModel="Watson", FibreVolumeFraction=0.7)
        optimizer = CapsuleOptimizer(Input=bundle, TimeBudget=0.2, OverlapTolerance=1e-9, MaximumIterations=1000000, **properties)
        growth = FibreRadialGrowth(Input=OutputPort(optimizer, 0), VoxelSize=2)
        if first:
            optimizer.UpdatePipeline()  # which asks all ranks but the first for nothing
        SaveData(os.path.join(self.folder, "parts.pvti"), proxy=growth, DataMode="Ascii")
        self.assertRegex(self._messages.pop(0), "overlaps remain: TimeBudget ran out")
        self._messages = [message for message in self._messages if "overlap" not in message]
        stages = []
        for part in sorted(glob.glob(os.path.join(self.folder, "**", "*.vti"), recursive=True)):
            reader = vtkXMLImageDataReader()
            reader.SetFileName(part)
            reader.Update()
            provenance = reader.GetOutput().GetFieldData().GetAbstractArray("Provenance")
            stages.append(next(provenance.GetValue(i) for i in range(3) if "CapsuleOptimizer" in provenance.GetValue(i)))
        return stages

    def test_time_budget(self):
        for first in (False, True):
            for history in (0, 1):
                with self.subTest(first=first, KeepHistory=history):
                    stages = self.grown(first, KeepHistory=history)
                    self.assertGreaterEqual(len(stages), 1)
                    self.assertEqual(len(set(stages)), 1, stages)

    def test_release_input(self):
        growth = FibreRadialGrowth(Input=BundleInitializer(Border="Walls", Side=6, MeanDispersion=2, FibreVolumeFraction=0.2, GrownFibreVolumeFraction=0), VoxelSize=0.2)
        for release in (0, 1):
            surface = MyelinSurface(Input=growth, ReleaseInput=release)
            table = fetch(ProgrammableFilter(Input=OutputPort(surface, 0), OutputDataSetType="vtkTable", Script=COUNT))
            voxels = [table.GetValueByName(row, "Voxels").ToInt() for row in range(table.GetNumberOfRows())]
            with self.subTest(ReleaseInput=release):
                for count in voxels:
                    (self.assertEqual if release else self.assertGreater)(count, 0)
        self.assertGreaterEqual(len(voxels), 1)


if __name__ == "__main__":
    main()
