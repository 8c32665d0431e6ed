# SPDX-License-Identifier: BSD-3-Clause
"""A substrate in an image's space: points, grids and directions are where an affine of scipy's has them, whatever the data; files say
the same to nibabel; and stages that are given what is placed find the substrate as it was."""

import contextlib
import json
import os
import zipfile

import nibabel
import numpy
from cactus_testing import UNPARTED, CactusTestCase, fetch, main, produce
from nibabel.streamlines import TckFile
from paraview.simple import (CapsuleOptimizer, FibreRadialGrowth, GroupDatasets, HistologyMask, MyelinSurface, Placement, SaveData, SubstrateCertificate,
                             SubstrateSampler, SubstrateStatistics, SubstrateWriter, TractFibres, TractogramReader, Transform)
from scipy.spatial.transform import Rotation
from surfaces import two_tubes
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import (VTK_POLY_LINE, vtkImageData, vtkMultiBlockDataSet, vtkOverlappingAMR, vtkPartitionedDataSet,
                                           vtkPolyData, vtkRectilinearGrid, vtkStructuredGrid, vtkTable, vtkUniformHyperTreeGrid, vtkUnstructuredGrid)

PLACE = {"PositionX": -30.5, "PositionY": 12, "PositionZ": 48.25, "RotationX": 20, "RotationY": -35, "RotationZ": 110}


def affine(factor=1.0):
    """From µm to mm."""
    matrix = numpy.eye(4)
    matrix[:3, :3] = factor * 1e-3 * Rotation.from_euler("ZXY", [110, 20, -35], degrees=True).as_matrix()
    matrix[:3, 3] = [-30.5, 12, 48.25]
    return matrix


def moved(points, matrix):
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def points(data):
    return vtk_to_numpy(data.GetPoints().GetData())


def field(data, name):
    return vtk_to_numpy(data.GetFieldData().GetArray(name))


def trx_streamlines(path):
    with zipfile.ZipFile(path) as archive:
        name = next(name for name in archive.namelist() if name.startswith("positions.3."))
        positions = numpy.frombuffer(archive.read(name), "<f" + str(int(name[-2:]) // 8)).reshape(-1, 3)
        offsets = numpy.frombuffer(archive.read("offsets.uint64"), "<u8").astype(int)
    return [positions[begin:end] for begin, end in zip(offsets[:-1], offsets[1:])]


def turned_image():
    image = vtkImageData()
    image.SetExtent(2, 4, -1, 3, 0, 1)
    image.SetOrigin(1, -2, 3)
    image.SetSpacing(0.5, 1, 2)
    image.SetDirectionMatrix(0, -1, 0, 1, 0, 0, 0, 0, 1)
    numbers = vtkDoubleArray()
    numbers.SetName("Number")
    for i in range(image.GetNumberOfPoints()):
        numbers.InsertNextValue(i)
    image.GetPointData().SetScalars(numbers)
    return image


def table():
    data, column = vtkTable(), vtkDoubleArray()
    column.SetName("Radius")
    column.InsertNextValue(0.5)
    data.AddColumn(column)
    return data


class Placing(CactusTestCase):
    expected = UNPARTED

    def setUp(self):
        super().setUp()
        self.lines, self.outer, self.inner = two_tubes(inset=0.1)

    def path(self, name):
        return os.path.join(self.folder, name)

    def assertAt(self, placed, data, matrix=None, tolerance=1e-12):
        numpy.testing.assert_allclose(points(placed), moved(points(data).astype(float), affine() if matrix is None else matrix), atol=tolerance)

    def assertSameGrid(self, placed, image, matrix):
        self.assertEqual(placed.GetExtent(), image.GetExtent())
        for corner in (0, 7, image.GetNumberOfPoints() - 1):
            numpy.testing.assert_allclose(placed.GetPoint(corner), moved(numpy.array(image.GetPoint(corner)), matrix), atol=1e-12)

    def test_on_its_tract(self):
        """Streamlines in mm, of which 1 mm became 1 µm: where the tract is, as large as it is; images, too."""
        arc = vtkPoints()
        for i in range(61):
            arc.InsertNextPoint(20 + 30 * numpy.cos(i * numpy.pi / 60), -15, 7 + 30 * numpy.sin(i * numpy.pi / 60))
        line = vtkPolyData()
        line.SetPoints(arc)
        line.Allocate(1)
        line.InsertNextCell(VTK_POLY_LINE, 61, list(range(61)))
        laid = TractFibres(Input=produce(line), Side=8, MinimumRadius=0.8, FibreVolumeFraction=0.3, LengthUnit="Millimetre", ScaleFactor=0.001)
        fibres = fetch(laid)
        middle = numpy.array(json.loads(fibres.GetFieldData().GetAbstractArray("Provenance").GetValue(0))["reached"]["Middle"])
        self.assertAlmostEqual(numpy.linalg.norm(middle - [20, -15, 7]), 30, delta=0.01)
        matrix = numpy.eye(4)
        matrix[:3, 3] = middle
        self.assertAt(fetch(Placement(Input=laid, Place="On its tract")), fibres, matrix)
        grown = FibreRadialGrowth(Input=laid, VoxelSize=0.4)
        placed = Placement(Input=grown, Place="On its tract")
        placed.UpdatePipelineInformation()
        self.assertSameGrid(fetch(placed), fetch(grown), matrix)
        self.assertSameGrid(fetch(Placement(Input=produce(fetch(grown)), Place="On its tract")), fetch(grown), matrix)
        with self.assertError("do not come from TractFibres"):
            Placement(Input=produce(self.lines), Place="On its tract").UpdatePipeline()

    def test_fibres(self):
        placed = fetch(Placement(Input=produce(self.lines), ScaleFactor=2, **PLACE))
        self.assertAt(placed, self.lines, affine(2))
        numpy.testing.assert_allclose(vtk_to_numpy(placed.GetPointData().GetArray("Radius")), 13 * [0.002] + 13 * [0.003])
        numpy.testing.assert_allclose(vtk_to_numpy(placed.GetCellData().GetArray("TargetRadius")), [0.002, 0.003])
        numpy.testing.assert_allclose(field(placed, "Placement").reshape(4, 4), affine(2), atol=1e-15)
        numpy.testing.assert_array_equal(field(placed, "Domain"), field(self.lines, "Domain"))
        numpy.testing.assert_array_equal(vtk_to_numpy(placed.GetCellData().GetArray("FibreId")), [3, 5])
        self.assertEqual(points(self.lines)[0, 2], -6)  # the input is as it was

    def test_as_paraviews_own_transform(self):
        transform = Transform(Input=produce(self.outer), Transform="Transform")
        transform.Transform.Translate = [PLACE["Position" + axis] for axis in "XYZ"]
        transform.Transform.Rotate = [PLACE["Rotation" + axis] for axis in "XYZ"]
        transform.Transform.Scale = [1e-3] * 3
        numpy.testing.assert_allclose(points(fetch(Placement(Input=produce(self.outer), **PLACE))), points(fetch(transform)), atol=1e-5)

    def test_colours_of_fibres_go_by_the_images_axes(self):
        from paraview.simple import BundleInitializer

        bundle = BundleInitializer(Border="Walls", Side=6, FibreVolumeFraction=0.2, MeanDispersion=0)
        placed = fetch(Placement(Input=bundle, RotationY=90))  # along x
        colours = vtk_to_numpy(placed.GetPointData().GetArray("Direction"))
        self.assertEqual([set(colours[:, axis]) for axis in range(3)], [{255}, {0}, {0}])

    def test_directions_turn(self):
        normals = vtkDoubleArray()
        normals.SetName("Normals")
        normals.SetNumberOfComponents(3)
        for _ in range(self.outer.GetNumberOfPoints()):
            normals.InsertNextTuple3(0, 0, 1)
        self.outer.GetPointData().SetNormals(normals)
        colours = vtkDoubleArray()
        colours.DeepCopy(normals)
        colours.SetName("Colours")  # three numbers, and no direction
        self.outer.GetPointData().AddArray(colours)
        placed = fetch(Placement(Input=produce(self.outer), **PLACE))
        numpy.testing.assert_array_equal(vtk_to_numpy(placed.GetPointData().GetArray("Colours")), vtk_to_numpy(colours))
        found = vtk_to_numpy(placed.GetPointData().GetNormals())
        numpy.testing.assert_allclose(found, numpy.tile(1e3 * affine()[:3, 2], (len(found), 1)), atol=1e-14)

    def test_images(self):
        image = turned_image()
        placed = fetch(Placement(Input=produce(image), **PLACE))
        self.assertSameGrid(placed, image, affine())
        self.assertEqual(placed.GetPointData().GetScalars().GetName(), "Number")

    def test_other_types(self):
        grid = vtkStructuredGrid()
        grid.SetDimensions(2, 2, 1)
        grid.SetPoints(vtkPoints())
        for point in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)):
            grid.GetPoints().InsertNextPoint(point)
        cloud = vtkUnstructuredGrid()
        cloud.SetPoints(grid.GetPoints())
        for data in (grid, cloud):
            placed = fetch(Placement(Input=produce(data), **PLACE))
            self.assertEqual(placed.GetClassName(), data.GetClassName())
            self.assertAt(placed, data)
        placed = fetch(Placement(Input=produce(table()), **PLACE))
        self.assertEqual(placed.GetColumnByName("Radius").GetValue(0), 0.5)

    def test_blocks_of_any_mixture(self):
        nested = vtkMultiBlockDataSet()
        nested.SetBlock(0, self.inner)
        nested.SetBlock(1, vtkPolyData())
        nested.SetBlock(2, None)
        mixed = vtkMultiBlockDataSet()
        for i, part in enumerate((self.outer, None, turned_image(), table(), nested, vtkMultiBlockDataSet(), vtkPolyData())):
            mixed.SetBlock(i, part)
        proxy = Placement(Input=produce(mixed), **PLACE)
        placed = fetch(proxy)
        self.assertEqual(placed.GetNumberOfBlocks(), 7)
        self.assertAt(placed.GetBlock(0), self.outer)
        self.assertIsNone(placed.GetBlock(1))
        self.assertSameGrid(placed.GetBlock(2), mixed.GetBlock(2), affine())
        self.assertEqual(placed.GetBlock(3).GetColumnByName("Radius").GetValue(0), 0.5)
        self.assertAt(placed.GetBlock(4).GetBlock(0), self.inner)
        self.assertEqual(placed.GetBlock(4).GetBlock(1).GetNumberOfPoints(), 0)
        self.assertIsNone(placed.GetBlock(4).GetBlock(2))
        proxy.RotationX = 0  # and again
        self.assertEqual(fetch(proxy).GetNumberOfBlocks(), 7)
        parts = vtkPartitionedDataSet()
        parts.SetPartition(0, self.outer)
        parts.SetPartition(2, self.inner)
        proxy = Placement(Input=produce(parts), **PLACE)
        proxy.UpdatePipeline()
        placed = proxy.GetClientSideObject().GetOutputDataObject(0)  # Fetch makes blocks of partitions
        self.assertEqual(placed.GetClassName(), "vtkPartitionedDataSet")
        self.assertAt(placed.GetPartition(2), self.inner)

    def test_the_type_follows_the_input(self):
        proxy = Placement(Input=produce(self.lines))
        self.assertEqual(fetch(proxy).GetClassName(), "vtkPolyData")
        for data in (turned_image(), GroupDatasets(Input=[produce(self.outer), produce(self.inner)]), table(), self.lines):
            proxy.Input = data if hasattr(data, "SMProxy") else produce(data)
            wanted = fetch(proxy.Input).GetClassName()
            self.assertEqual(fetch(proxy).GetClassName(), wanted)

    def test_nothing_to_place_gets_one_error(self):
        hollow = vtkMultiBlockDataSet()
        hollow.SetBlock(0, vtkPolyData())
        hollow.SetBlock(1, vtkMultiBlockDataSet())
        proxy = Placement(Input=produce(self.outer), **PLACE)
        for data in (vtkMultiBlockDataSet(), hollow, vtkPartitionedDataSet(), vtkPolyData(), vtkTable()):
            proxy.Input = produce(data)
            with self.assertError("the input is empty"):
                proxy.UpdatePipeline()
        proxy.Input = produce(self.outer)
        self.assertAt(fetch(proxy), self.outer)

    def test_what_cannot_be_placed_gets_one_error(self):
        for data, pattern in ((vtkRectilinearGrid(), "vtkRectilinearGrid"), (vtkOverlappingAMR(), "vtkOverlappingAMR"),
                              (vtkUniformHyperTreeGrid(), "vtkUniformHyperTreeGrid")):
            with self.assertError(pattern):
                Placement(Input=produce(data)).UpdatePipeline()
        mixed = vtkMultiBlockDataSet()
        mixed.SetBlock(0, self.outer)
        mixed.SetBlock(1, vtkRectilinearGrid())
        proxy = Placement(Input=produce(mixed))
        with self.assertError("vtkRectilinearGrid"):
            proxy.UpdatePipeline()
        self.assertEqual(proxy.GetClientSideObject().GetOutputDataObject(0).GetNumberOfBlocks(), 0)
        placed = Placement(Input=produce(self.outer), **PLACE)
        with self.assertError("are placed in an image's space"):
            Placement(Input=placed).UpdatePipeline()
        broken = fetch(placed)
        broken.GetFieldData().GetArray("Placement").SetValue(0, 7)
        with self.assertError("Placement is no rotation"):
            SubstrateCertificate(Outer=produce(broken)).UpdatePipeline()
        proxy = Placement(Input=produce(self.outer), ScaleFactor=0)
        with self.assertError("ScaleFactor"):
            proxy.UpdatePipeline()
        proxy.ScaleFactor = 1
        self.assertGreater(fetch(proxy).GetNumberOfPoints(), 0)

    def test_label_images_stay_where_they_are(self):
        self.expected = "has not parted"
        grown = FibreRadialGrowth(Input=produce(self.lines), VoxelSize=0.5, GrowthIterations=1, TargetFibreVolumeFraction=0)
        with self.assertError("connect what Placement was given"):
            MyelinSurface(Input=Placement(Input=grown, PositionX=3)).UpdatePipeline()

    def test_stages_measure_the_substrate_itself(self):
        plain = {"Fibres": produce(self.lines), "Outer": produce(self.outer), "Inner": produce(self.inner)}
        placed = {name: Placement(Input=data, ScaleFactor=50, **PLACE) for name, data in plain.items()}
        tables = [fetch(SubstrateStatistics(**inputs)) for inputs in (plain, placed)]
        for column in range(tables[0].GetNumberOfColumns()):
            one, other = (numpy.array(each.GetColumn(column).GetValue(0), float) for each in tables)
            numpy.testing.assert_allclose(other, one, rtol=1e-5, atol=1e-6, err_msg=tables[0].GetColumnName(column))
        self.assertEqual(fetch(SubstrateCertificate(**placed)).GetColumnByName("Certified").GetValue(0), 1)

    def test_what_stages_make_of_what_is_placed_is_not(self):
        inputs = {"Outer": Placement(Input=produce(self.outer), **PLACE), "Inner": Placement(Input=produce(self.inner), **PLACE)}
        sampler = SubstrateSampler(VoxelSize=2, **inputs)
        for proxy in (sampler, HistologyMask(**inputs), CapsuleOptimizer(Input=Placement(Input=produce(self.lines), **PLACE))):
            self.assertIsNone(fetch(proxy).GetFieldData().GetAbstractArray("Placement"), proxy.SMProxy.GetXMLName())
        self.assertSameGrid(fetch(Placement(Input=sampler, **PLACE)), fetch(sampler), affine())
        self.expected = "has not parted"
        grown = FibreRadialGrowth(Input=Placement(Input=produce(self.lines), **PLACE), VoxelSize=0.5, GrowthIterations=1, TargetFibreVolumeFraction=0)
        self.assertGreater(fetch(MyelinSurface(Input=grown)).GetNumberOfPoints(), 0)

    def test_folders_say_where_the_substrate_lies(self):
        manifests = []
        for name, options in (("plain", None), ("placed", PLACE)):
            inputs = [produce(data) for data in (self.outer, self.inner)]
            inputs = [Placement(Input=data, **options) for data in inputs] if options else inputs
            SubstrateWriter(Outer=inputs[0], Inner=inputs[1], FolderName=self.path(name)).UpdatePipeline()
            with open(os.path.join(self.path(name), "manifest.json"), encoding="utf-8") as file:
                manifests.append(json.load(file))
        self.assertIsNone(manifests[0]["placement_um_to_mm"])
        numpy.testing.assert_allclose(manifests[1]["placement_um_to_mm"], affine(), atol=1e-14)
        self.assertEqual(manifests[1]["provenance"][-1]["inputs"].keys(), {"Outer", "Inner"})
        self.assertIn("Placement", [stage.get("filter") for stage in manifests[1]["provenance"]])
        for file in ("outer/fibre_00003.ply", "inner/fibre_00005.ply"):
            surfaces = []
            for name in ("plain", "placed"):
                with open(os.path.join(self.path(name), file), encoding="utf-8") as ply:
                    body = ply.read().split("end_header\n")[1]
                surfaces.append(numpy.array(body.split(), float))
            numpy.testing.assert_allclose(surfaces[1], surfaces[0], atol=2e-8)

    def test_nifti(self):
        sampler = SubstrateSampler(Outer=produce(self.outer), Inner=produce(self.inner), Fibres=produce(self.lines), VoxelSize=2)
        placed = Placement(Input=sampler, ScaleFactor=3, **PLACE)
        SaveData(self.path("plain.nii.gz"), proxy=sampler, Array="AVF")
        SaveData(self.path("placed.nii.gz"), proxy=placed, Array="AVF")
        plain, read = nibabel.load(self.path("plain.nii.gz")), nibabel.load(self.path("placed.nii.gz"))
        numpy.testing.assert_array_equal(numpy.asarray(read.dataobj), numpy.asarray(plain.dataobj))
        self.assertEqual(read.header.get_xyzt_units()[0], "mm")
        for form in (read.get_qform(), read.get_sform()):
            numpy.testing.assert_allclose(form, affine(3) @ numpy.diag([1e3, 1e3, 1e3, 1]) @ plain.affine, atol=1e-5)
        SaveData(self.path("direction.nii"), proxy=placed, Array="MeanDirection")
        directions = numpy.squeeze(numpy.asarray(nibabel.load(self.path("direction.nii")).dataobj)).reshape(-1, 3)
        inside = numpy.linalg.norm(directions, axis=1) > 0
        numpy.testing.assert_allclose(directions[inside], numpy.tile(1e3 * affine()[:3, 2], (inside.sum(), 1)), atol=1e-6)

    def test_nifti_of_a_part_of_a_turned_image(self):
        image = turned_image()
        for name, matrix, data in (("plain", numpy.diag([1e-3, 1e-3, 1e-3, 1]), produce(image)), ("placed", affine(), Placement(Input=produce(image), **PLACE))):
            SaveData(self.path(name + ".nii"), proxy=data)
            read = nibabel.load(self.path(name + ".nii"))
            for point, index in ((0, (0, 0, 0)), (4, (1, 1, 0)), (29, (2, 4, 1))):
                wanted = moved(numpy.array(image.GetPoint(point)), matrix)
                numpy.testing.assert_allclose(nibabel.affines.apply_affine(read.affine, index), wanted, atol=1e-5)
                numpy.testing.assert_allclose(nibabel.affines.apply_affine(read.get_qform(), index), wanted, atol=1e-5)
                self.assertEqual(read.dataobj[index], point)

    def test_images_and_tractograms_lie_on_each_other(self):
        """By the affine alone, as readers take it that leave units to their user: points along a fibre are in voxels that have it."""
        sampler = SubstrateSampler(Outer=produce(self.outer), Inner=produce(self.inner), Fibres=produce(self.lines), VoxelSize=0.5)
        lines = produce(self.lines)
        for name, place, options in (("plain", None, {}), ("placed", PLACE, {}), ("micrometres", None, {"LengthUnit": "Micrometre"})):
            image, tracks = (Placement(Input=data, **place) if place else data for data in (sampler, lines))
            for kind, proxy, more in ((".nii", image, {"Array": "FibreId"}), (".tck", tracks, {}), (".trx", tracks, {})):
                with self.assertError(r"in micrometres, and most readers take them for millimetres") if options else contextlib.nullcontext():
                    SaveData(self.path(name + kind), proxy=proxy, **options, **more)
            read = nibabel.load(self.path(name + ".nii"))
            ids = numpy.asarray(read.dataobj)
            self.assertEqual(read.header.get_xyzt_units()[0], "micron" if options else "mm")
            for streamlines in (list(TckFile.load(self.path(name + ".tck")).streamlines), trx_streamlines(self.path(name + ".trx"))):
                self.assertEqual(len(streamlines), 2)
                for fibre, line in zip((3, 5), streamlines):
                    voxels = nibabel.affines.apply_affine(numpy.linalg.inv(read.affine), line)
                    inside = voxels[((voxels > -0.5) & (voxels < numpy.array(ids.shape) - 0.5)).all(axis=1)]
                    self.assertGreater(len(inside), 5)
                    self.assertEqual(set(ids[tuple(numpy.rint(inside).astype(int).T)]), {fibre})

    def test_what_is_placed_is_in_millimetres(self):
        placed = Placement(Input=produce(self.lines), **PLACE)
        with self.assertError(r"LengthUnit is Micrometre, and the data are placed"):
            SaveData(self.path("placed.tck"), proxy=placed, LengthUnit="Micrometre")
        self.assertFalse(os.path.exists(self.path("placed.tck")))

    def test_tractograms(self):
        placed = Placement(Input=produce(self.lines), ScaleFactor=2, **PLACE)
        wanted = moved(points(self.lines), affine(2)).reshape(2, 13, 3)
        SaveData(self.path("fibres.tck"), proxy=placed)
        numpy.testing.assert_allclose(list(TckFile.load(self.path("fibres.tck")).streamlines), wanted, atol=1e-5)
        SaveData(self.path("fibres.trx"), proxy=placed)
        again = fetch(TractogramReader(FileName=self.path("fibres.trx"), LengthUnit="Millimetre"))
        numpy.testing.assert_allclose(points(again).reshape(2, 13, 3), wanted, atol=1e-12)
        numpy.testing.assert_allclose(vtk_to_numpy(again.GetPointData().GetArray("Radius")), 13 * [0.002] + 13 * [0.003], atol=1e-9)


if __name__ == "__main__":
    main()
