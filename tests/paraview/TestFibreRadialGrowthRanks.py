# SPDX-License-Identifier: BSD-3-Clause
# ctest-ranks: 2
"""An image grown in pieces, one per MPI rank, is the image grown at once, bit for bit."""

import os

from cactus_testing import CactusTestCase, main
from paraview.simple import FibreRadialGrowth, SaveData, StrandReader
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPImageDataReader

STRANDS = """6
3
3
-1 0 -4 0.7
-0.9 0.2 0 0.5
-1 0 4 0.6
2
0.5 -1 -4 0.8
0.7 0.4 4 0.9
2
-4 2 0.1 0.5
4 2 0.1 0.5
"""


def arrays(image):
    return [vtk_to_numpy(image.GetPointData().GetArray(name)).tobytes() for name in ("FibreId", "Depth")]


class Ranks(CactusTestCase):
    def test_pieces_are_parts_of_the_whole(self):
        path = os.path.join(self.folder, "three.strands")
        with open(path, "w") as file:
            file.write(STRANDS)
        fibres = StrandReader(FileName=path)
        fibres.UpdatePipeline()  # which asks all ranks but the first for nothing: growth has to ask again
        growth = FibreRadialGrowth(Input=fibres, VoxelSize=0.12, TargetFibreVolumeFraction=0.5)
        growth.UpdatePipeline()
        together = os.path.join(self.folder, "together.pvti")
        SaveData(together, proxy=growth, DataMode="Binary")  # Debian's ParaView cannot read the appended data that is the default
        reader = vtkXMLPImageDataReader()
        reader.SetFileName(together)
        reader.Update()
        pieces = reader.GetOutput()
        self.assertEqual(pieces.GetExtent(), (0, 49, 0, 49, 0, 49))

        algorithm = growth.GetClientSideObject()
        algorithm.Modified()
        algorithm.UpdateWholeExtent()
        whole = algorithm.GetOutputDataObject(0)
        self.assertEqual(whole.GetExtent(), (0, 49, 0, 49, 0, 49))
        self.assertEqual(arrays(pieces), arrays(whole))


if __name__ == "__main__":
    main()
