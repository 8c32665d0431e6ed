# SPDX-License-Identifier: BSD-3-Clause
# ctest-extended
# ctest-needs: display
"""./cactus preview makes a file that ParaView opens of a substrate folder: cuts with the very areas of the surfaces, tubes as thick as
the fibres; it overwrites nothing."""

import glob
import os
import shutil
import subprocess
import tempfile

import numpy as np
from cactus_testing import CactusTestCase, main
from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet
from vtkmodules.vtkFiltersCore import vtkMassProperties, vtkTriangleFilter
from vtkmodules.vtkIOPLY import vtkPLYReader

SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tools", "scripts", "preview.py")


def triangles_of(path):
    """Corners of a PLY file's triangles, n x 3 x 3."""
    reader = vtkPLYReader()
    reader.SetFileName(path)
    reader.Update()
    cells = vtk_to_numpy(reader.GetOutput().GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return vtk_to_numpy(reader.GetOutput().GetPoints().GetData()).astype(float)[cells]


def area_of_cut(corners, axis):
    """Of the cross-section at 0 of a closed, outward surface: by Green's theorem over where triangles cross the plane."""
    area = 0.0
    a, b = (axis + 1) % 3, (axis + 2) % 3
    for triangle in corners[(corners[:, :, axis].min(1) < 0) & (corners[:, :, axis].max(1) >= 0)]:
        ends = []
        for p, q in ((0, 1), (1, 2), (2, 0)):
            u, v = triangle[p], triangle[q]
            if (u[axis] < 0) != (v[axis] < 0):
                ends.append(u + (v - u) * u[axis] / (u[axis] - v[axis]))
        normal = np.cross(triangle[1] - triangle[0], triangle[2] - triangle[0])
        along = ends[1] - ends[0]
        sense = np.sign(normal[a] * along[b] - normal[b] * along[a])  # the surface's outside is on the right
        area += 0.5 * sense * (ends[0][a] * ends[1][b] - ends[0][b] * ends[1][a])
    return area


def area_of(polygons):
    triangles = vtkTriangleFilter()
    triangles.SetInputData(polygons)
    measure = vtkMassProperties()
    measure.SetInputConnection(triangles.GetOutputPort())
    return measure.GetSurfaceArea()


class Preview(CactusTestCase):
    @classmethod
    def setUpClass(cls):
        cls.home = tempfile.mkdtemp(prefix="cactus-preview-test-")
        cls.addClassCleanup(shutil.rmtree, cls.home)
        cls.substrate = os.path.join(cls.home, "substrate")
        bundle = simple.BundleInitializer(Border="Walls", Side=6, FibreVolumeFraction=0.5, GrownFibreVolumeFraction=0.6, MinimumRadius=0.3)
        fibres = simple.OutputPort(simple.CapsuleOptimizer(Input=bundle), 0)
        simple.SubstrateProduction(Input=fibres, FolderName=cls.substrate, Format="Surfaces alone", VoxelSize=0.15).UpdatePipeline()

    def preview(self, *words):
        done = subprocess.run(["pvpython", SCRIPT, *words], capture_output=True, text=True)
        return done.returncode, done.stdout + done.stderr.replace("ERR|", "")

    def blocks(self, *words):
        output = os.path.join(self.folder, "small.vtm")
        code, said = self.preview(self.substrate, "--output", output, *words)
        self.assertEqual(code, 0, said)
        for path in glob.glob(os.path.join(output[:-4], "*")):
            with open(path, "rb") as file:
                self.assertNotIn(b"<AppendedData", file.read())  # which the ParaView of an up-to-date Debian 12 cannot read
        data = servermanager.Fetch(simple.OpenDataFile(output))
        return {data.GetMetaData(i).Get(vtkCompositeDataSet.NAME()): data.GetBlock(i) for i in range(data.GetNumberOfBlocks())}

    def test_the_file(self):
        blocks = self.blocks("--triangles", "20000")
        for axis, name in enumerate("xyz"):
            for kind, words in (("outer", "fibres"), ("inner", "axons")):
                expected = sum(area_of_cut(triangles_of(path), axis) for path in glob.glob(os.path.join(self.substrate, kind, "*.ply")))
                cut = blocks[f"Cut across {name}, {words}"]
                self.assertGreater(expected, 1.0)
                self.assertAlmostEqual(area_of(cut), expected, delta=1e-4 * expected)
                self.assertEqual(cut.GetCellData().GetArray("Compartment").GetRange(), (float(kind == "inner"),) * 2)
                for array in ("FibreId", "BundleId"):
                    self.assertGreaterEqual(cut.GetCellData().GetArray(array).GetRange()[0], 1)
        # The tubes fill what the fibres fill, but for their corners and what lies outside the domain.
        tubes = blocks["Fibres"]
        self.assertLess(tubes.GetNumberOfPoints(), 20000)
        measure = vtkMassProperties()
        triangles = vtkTriangleFilter()
        triangles.SetInputData(tubes)
        measure.SetInputConnection(triangles.GetOutputPort())
        self.assertAlmostEqual(measure.GetVolume(), 0.6 * 6**3, delta=0.25 * 0.6 * 6**3)

    def test_nothing_is_overwritten(self):
        output = os.path.join(self.folder, "small.vtm")
        for existing in (output, output[:-4]):
            with open(existing, "w", encoding="utf-8") as file:
                file.write("mine")
            code, said = self.preview(self.substrate, "--output", output)
            self.assertEqual(code, 2)
            self.assertIn("is there already", said)
            with open(existing, encoding="utf-8") as file:
                self.assertEqual(file.read(), "mine")
            os.remove(existing)

    def test_what_was_not_copied_as_a_whole_is_refused(self):
        folder = os.path.join(self.folder, "copy")
        shutil.copytree(self.substrate, folder)
        path = sorted(glob.glob(os.path.join(folder, "inner", "*.ply")))[0]
        with open(path, "rb") as file:
            content = file.read()
        with open(path, "wb") as file:
            file.write(content[: len(content) // 2])
        code, said = self.preview(folder)
        self.assertEqual(code, 2, said)
        self.assertRegex(said, r"inner/.*\.ply is not as it was written: if it was not copied as a whole, copy it again")
        os.remove(path)
        code, said = self.preview(folder)
        self.assertEqual(code, 2, said)
        self.assertRegex(said, r"1 of \d+ surfaces are not in the folder, such as inner/")
        self.assertEqual(os.listdir(self.folder), ["copy"])

    def test_refusals(self):
        for words, reason in ((("--output", os.path.join(self.substrate, "a.vtm")), "in the folder itself"),
                              (("--output", os.path.join(self.folder, "a.vtp")), "does not end with .vtm"),
                              (("--output", os.path.join(self.folder, "a.vtm"), "--triangles", "0"), "has to be 1 or more")):
            code, said = self.preview(self.substrate, *words)
            self.assertEqual(code, 2, said)
            self.assertIn(reason, said)
        self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    main()
