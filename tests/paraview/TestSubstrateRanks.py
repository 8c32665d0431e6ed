# SPDX-License-Identifier: BSD-3-Clause
# ctest-ranks: 2
# ctest-timeout: 300
"""On any number of ranks: statistics and certificate are the same, and one row; a substrate is grown whole."""

import os

from cactus_testing import CactusTestCase, fetch, main
from paraview import servermanager
from paraview.simple import (BundleInitializer, CapsuleOptimizer, FibreRadialGrowth, HistologyMask, MyelinSurface, OutputPort, Placement,
                             SubstrateCertificate, SubstrateSampler, SubstrateStatistics, SubstrateWriter, XMLPolyDataReader)
from surfaces import POLYGON, two_tubes
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter


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
        bundle = BundleInitializer(Side=6, Seed=1)
        placed = Placement(Input=bundle, PositionX=5)
        placed.UpdatePipeline()
        self.assertEqual(placed.GetDataInformation().GetNumberOfCells(), bundle.GetDataInformation().GetNumberOfCells())
        self.assertIsNone(placed.GetDataInformation().GetFieldDataInformation().GetArrayInformation("Error"))

    def test_what_was_updated_by_itself_is_whole_for_the_next_stage(self):
        """An update asks each rank for a piece of its own, and all but the first get nothing: the next stage has to ask again."""
        fibres = OutputPort(CapsuleOptimizer(Input=BundleInitializer(Side=6, MeanDispersion=10, MaximumRadius=1, Seed=1)), 0)
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


if __name__ == "__main__":
    main()
