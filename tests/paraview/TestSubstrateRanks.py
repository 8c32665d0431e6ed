# SPDX-License-Identifier: BSD-3-Clause
# ctest-ranks: 2
"""The statistics and the certificate are the same, and one row, on any number of ranks."""

import os

from cactus_testing import CactusTestCase, fetch, main
from paraview.simple import SubstrateCertificate, SubstrateStatistics, XMLPolyDataReader
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


if __name__ == "__main__":
    main()
