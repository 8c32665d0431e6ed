# SPDX-License-Identifier: BSD-3-Clause
"""Single fibres' fields and ParaView's own filters on them: what comes out is closed and apart, and goes into the product's filters."""

import os

import numpy
from cactus_testing import UNPARTED, CactusTestCase, fetch, main, mesh_oracle, produce
from paraview.simple import (
    BundleInitializer,
    Contour,
    Decimate,
    ExtractSurface,
    FibreField,
    FibreRadialGrowth,
    Smooth,
    SubstrateCertificate,
    SubstrateStatistics,
    SubstrateWriter,
)
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkMultiBlockDataSet

SIDE = 4.5


def blocks_of(data):
    return [data.GetBlock(i) for i in range(data.GetNumberOfBlocks())]


def number(data, name):
    return int(data.GetFieldData().GetArray(name).GetTuple1(0))


def mesh(data):
    """Points and triangles."""
    return vtk_to_numpy(data.GetPoints().GetData()).astype(float), vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def volume(part):
    a, b, c = (part[0][part[1][:, i]] for i in range(3))
    return numpy.einsum("ij,ij->i", a, numpy.cross(b, c)).sum() / 6


class FibreFieldTest(CactusTestCase):
    expected = UNPARTED

    @classmethod
    def setUpClass(cls):
        fibres = BundleInitializer(Border="Walls", Side=SIDE, FibreVolumeFraction=0.5, GrownFibreVolumeFraction=0.8, MeanDispersion=5, NumberOfBundles=2, CrossingAngle=90)
        growth = FibreRadialGrowth(Input=fibres, VoxelSize=0.15)
        cls.fibres, cls.image = fetch(fibres), fetch(growth)

    def field(self, **properties):
        return FibreField(Input=produce(self.image), **properties)

    def contour(self, field, level=0.0):
        return Contour(Input=field, ContourBy=["POINTS", "Field"], Isosurfaces=[level])

    def judge(self, parts, *arguments):
        for name, (points, triangles) in parts.items():
            with open(os.path.join(self.folder, name + ".off"), "w") as file:
                file.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
                file.writelines("%.17g %.17g %.17g\n" % tuple(point) for point in points)
                file.writelines("3 %d %d %d\n" % tuple(triangle) for triangle in triangles)
        return mesh_oracle(self.folder, *arguments)

    def table_ids(self, name):
        return vtk_to_numpy(self.image.GetFieldData().GetArray("FibreTable." + name))

    def test_the_first_fibre_by_default(self):
        image = vtkImageData()
        image.DeepCopy(self.image)
        ids = vtk_to_numpy(image.GetFieldData().GetArray("FibreTable.FibreId"))
        labels = vtk_to_numpy(image.GetPointData().GetArray("FibreId"))
        labels[labels > 0] += 4  # as in a bundle of which the first fibres miss the domain
        ids += 4
        (block,) = blocks_of(fetch(FibreField(Input=produce(image))))
        self.assertEqual(number(block, "FibreId"), 5)
        (wanted,) = blocks_of(fetch(self.field(FibreId=1)))
        numpy.testing.assert_array_equal(*(vtk_to_numpy(each.GetPointData().GetArray("Field")) for each in (block, wanted)))

    def test_one_fibre(self):
        data = fetch(self.field(FibreId=3))
        (block,) = blocks_of(data)
        self.assertEqual((number(block, "FibreId"), number(block, "BundleId")), (3, self.table_ids("BundleId")[2]))
        self.assertTrue(block.GetFieldData().HasArray("Domain") and block.GetFieldData().HasArray("Provenance"))
        self.assertEqual(data.GetMetaData(0).Get(data.NAME()), "fibre 3")
        # Its samples lie where those of the label image do, and the fibre is where the field is positive.
        field = vtk_to_numpy(block.GetPointData().GetArray("Field"))
        labels = vtk_to_numpy(self.image.GetPointData().GetArray("FibreId"))
        depth = vtk_to_numpy(self.image.GetPointData().GetArray("Depth"))
        found = 0
        for point in numpy.flatnonzero(field > 0):
            place = self.image.FindPoint(block.GetPoint(point))
            beyond = abs(numpy.array(block.GetPoint(point))).max() > 0.5 * SIDE
            if not beyond:
                self.assertLess(numpy.abs(numpy.subtract(self.image.GetPoint(place), block.GetPoint(point))).max(), 1e-9)
                self.assertEqual((labels[place], depth[place]), (3, field[point]))
                found += 1
        self.assertEqual(found, (labels == 3).sum())

    def test_one_bundle_and_all(self):
        ids, bundles = self.table_ids("FibreId"), self.table_ids("BundleId")
        self.assertEqual(set(bundles), {1, 2})
        second = blocks_of(fetch(self.field(Select="One bundle", BundleId=2)))
        self.assertEqual([number(block, "FibreId") for block in second], sorted(ids[bundles == 2]))
        every = blocks_of(fetch(self.field(Select="All fibres", NumberOfThreads=1)))
        self.assertEqual([number(block, "FibreId") for block in every], sorted(ids))
        again = blocks_of(fetch(self.field(Select="All fibres", NumberOfThreads=2)))
        for one, other in zip(every, again):
            self.assertEqual(one.GetBounds(), other.GetBounds())
            pair = [vtk_to_numpy(block.GetPointData().GetArray("Field")) for block in (one, other)]
            self.assertTrue(numpy.array_equal(*pair))

    def test_contours_are_closed_and_apart(self):
        contour = self.contour(self.field(Select="All fibres"))
        parts = {f"fibre{number(block, 'FibreId')}": mesh(block) for block in blocks_of(fetch(contour))}
        found = self.judge(parts)["summary"]
        for name in ("closed", "outward"):
            self.assertEqual(found[name], len(parts), name)
        self.assertEqual(found["intersecting_pairs"], 0)
        # Caps are flat, on the faces of the domain.
        for name, (points, _) in parts.items():
            self.assertLessEqual(numpy.abs(points).max(), 0.5 * SIDE + 1e-5, name)
            self.assertGreater((numpy.abs(numpy.abs(points) - 0.5 * SIDE) < 1e-5).any(axis=1).sum(), 20, name)
        whole = fetch(SubstrateCertificate(Outer=contour, MinimumGap=0))
        row = {whole.GetColumnName(i): whole.GetColumn(i).GetValue(0) for i in range(whole.GetNumberOfColumns())}
        self.assertEqual([row[name] for name in ("OuterSurfaces", "NotClosed", "NotOutward", "OuterPairsMeeting")], [len(parts), 0, 0, 0])
        self.assertGreater(row["SmallestGap_um"], 0.0)

    def test_contours_at_a_depth_lie_inside(self):
        outer = self.contour(self.field(FibreId=2))
        inner = self.contour(self.field(FibreId=2, Level=0.15), 0.15)
        parts = {name: mesh(blocks_of(fetch(proxy))[0]) for name, proxy in (("outer", outer), ("inner", inner))}
        # The caps are in the same planes: the axon's wall lies inside.
        inside = parts["inner"][0][numpy.abs(parts["inner"][0]).max(axis=1) < 0.5 * SIDE - 1e-4]
        outside = parts["outer"][0][numpy.abs(parts["outer"][0]).max(axis=1) < 0.5 * SIDE - 1e-4]
        gaps = [numpy.sqrt(((outside - point) ** 2).sum(axis=1).min()) for point in inside[::7]]
        self.assertGreater(min(gaps), 0.1)
        self.assertLess(min(gaps), 0.2)
        self.assertGreater(volume(parts["inner"]), 0.2 * volume(parts["outer"]))
        self.assertLess(volume(parts["inner"]), 0.9 * volume(parts["outer"]))
        found = self.judge(parts)["summary"]
        self.assertEqual((found["closed"], found["outward"]), (2, 2))
        # Beyond the deepest point there is nothing, and nothing is said.
        self.assertEqual(blocks_of(fetch(self.contour(self.field(FibreId=2, Level=50), 50)))[0].GetNumberOfCells(), 0)

    def test_what_the_window_makes_goes_into_our_filters(self):
        field = self.field(Select="All fibres")
        smoothed = Smooth(Input=ExtractSurface(Input=self.contour(field)), NumberofIterations=10)
        surface = Decimate(Input=smoothed, TargetReduction=0.5)
        made = blocks_of(fetch(surface))
        ids = self.table_ids("FibreId")
        self.assertEqual([number(block, "FibreId") for block in made], sorted(ids))
        total = sum(volume(mesh(block)) for block in made) / SIDE**3
        self.assertAlmostEqual(total, 0.8, delta=0.04)
        for threads in (1, 2):
            whole = fetch(SubstrateStatistics(Fibres=produce(self.fibres), Outer=surface, NumberOfThreads=threads))
            self.assertAlmostEqual(whole.GetColumnByName("FVF").GetValue(0), total, places=5)
        certificate = SubstrateCertificate(Outer=surface, MinimumGap=0)
        certificate.UpdatePipeline()
        self._messages.clear()  # what VTK's filters have done to them is told; here it only counts that all are looked at
        per_fibre = fetch(certificate, 1)
        self.assertEqual(list(vtk_to_numpy(per_fibre.GetColumnByName("FibreId"))), sorted(ids))
        self.assertEqual(list(vtk_to_numpy(per_fibre.GetColumnByName("BundleId"))), list(self.table_ids("BundleId")))
        self.assertEqual(fetch(certificate).GetColumnByName("OuterSurfaces").GetValue(0), len(ids))
        # Decimate may leave surfaces that are not closed, which the writer refuses.
        folder = os.path.join(self.folder, "written")
        SubstrateWriter(Fibres=produce(self.fibres), Outer=smoothed, FolderName=folder, MinimumGap=0).UpdatePipeline()
        self._messages.clear()
        written = [name for _, _, names in os.walk(folder) for name in names if name.endswith(".ply")]
        self.assertEqual(len(written), len(ids))

    def test_without_clipping_fibres_reach_to_the_end_of_the_image(self):
        growth = FibreRadialGrowth(Input=produce(self.fibres), GrowthIterations=0, VoxelSize=0.25, Margin=0.5)
        ends = {}
        for clip in (0, 1):
            contour = self.contour(FibreField(Input=growth, FibreId=1, ClipToDomain=clip))
            ends[clip] = blocks_of(fetch(contour))[0].GetBounds()[5]
        self.assertAlmostEqual(ends[1], 0.5 * SIDE, delta=1e-4)
        self.assertAlmostEqual(ends[0], growth.GetDataInformation().GetBounds()[5] + 0.125, delta=1e-4)

    def test_errors(self):
        for properties, message in (
            ({"FibreId": 9999}, r"FibreId 9999 is not in the label image, whose ids go from 1 to \d+"),
            ({"Select": "One bundle", "BundleId": 7}, r"BundleId 7 is not in the label image, whose ids go from 1 to 2"),
            ({"Level": float("nan")}, r"Level"),
            ({"Level": -0.1}, r"Level"),
        ):
            field = self.field(**properties)
            with self.assertError(message):
                field.UpdatePipeline()
            self.assertEqual(fetch(field).GetNumberOfBlocks(), 0)
        # A good value then works.
        field.Level = 0
        self.assertEqual(fetch(field).GetNumberOfBlocks(), 1)

        both = vtkMultiBlockDataSet()
        both.SetBlock(0, self.image)
        for data, message in ((both, "one label image is expected"), (vtkImageData(), "the label image is empty")):
            with self.assertError(message):
                FibreField(Input=produce(data)).UpdatePipeline()
        damaged = vtkImageData()
        damaged.DeepCopy(self.image)
        damaged.GetFieldData().GetArray("MinimumGap").SetTuple1(0, float("nan"))
        with self.assertError("MinimumGap of the label image"):
            FibreField(Input=produce(damaged)).UpdatePipeline()

    def test_a_fibre_without_a_voxel_is_an_empty_block(self):
        lonely = vtkImageData()
        lonely.DeepCopy(self.image)
        labels = vtk_to_numpy(lonely.GetPointData().GetArray("FibreId"))
        depth = vtk_to_numpy(lonely.GetPointData().GetArray("Depth"))
        depth[labels == 4] = -1.0
        labels[labels == 4] = 0
        field = FibreField(Input=produce(lonely), Select="All fibres")
        with self.assertError("1 of .* fibres have no voxel in the label image"):
            field.UpdatePipeline()
        self.assertEqual([i for i, block in enumerate(blocks_of(fetch(field))) if block is None], [3])


if __name__ == "__main__":
    main()
