# SPDX-License-Identifier: BSD-3-Clause
# ctest-ranks: 2
"""On several ranks TimeBudget stops all at the same iteration, whichever of them are asked for the result; ReleaseInput frees on all."""

import glob
import os

from cactus_testing import UNPARTED, CactusTestCase, fetch, main
from paraview.simple import (BundleInitializer, CapsuleOptimizer, FibreRadialGrowth, MyelinSurface, OutputPort, ProgrammableFilter,
                             SaveData)
from vtkmodules.vtkIOXML import vtkXMLImageDataReader

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


class Ranks(CactusTestCase):
    expected = UNPARTED

    def grown(self, first, **properties):
        """The provenance of each rank's part of an image of more fibres than are parted in a fifth of a second."""
        bundle = BundleInitializer(Side=30, MeanDispersion=20, DispersionModel="Watson", FibreVolumeFraction=0.7)
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
        growth = FibreRadialGrowth(Input=BundleInitializer(Side=6, MeanDispersion=2, FibreVolumeFraction=0.2, GrownFibreVolumeFraction=0), VoxelSize=0.2)
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
