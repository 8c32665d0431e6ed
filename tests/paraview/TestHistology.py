# SPDX-License-Identifier: BSD-3-Clause
"""Cuts as histology has them, read by Pillow; and radii measured from masks, held against known circles and scipy's labels."""

import math
import os

import numpy
from cactus_testing import CactusTestCase, fetch, main, produce
from paraview.simple import (BundleInitializer, CapsuleOptimizer, CSVReader, ExtractSubset, FibreRadialGrowth, HistologyMask,
                             HistologyRadii, MyelinSurface, OpenDataFile, OutputPort, SaveData, SubstrateSampler)
from PIL import Image
from scipy import ndimage
from surfaces import POLYGON, surfaces, tube, two_tubes, without
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData


def pixels(image, name="Mask"):
    """By rows."""
    columns, rows, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetArray(name)).reshape(rows, columns)


def column(table, name):
    return vtk_to_numpy(table.GetColumnByName(name))


def image_of(greys):
    """A flat image of rows."""
    image = vtkImageData()
    image.SetDimensions(greys.shape[1], greys.shape[0], 1)
    values = numpy_to_vtk(numpy.ascontiguousarray(greys).ravel(), deep=True)
    values.SetName("Grey")
    image.GetPointData().SetScalars(values)
    return produce(image)


def rings(shape, fibres):
    """A mask of rings {(column, row): (axon's radius, fibre's radius)} in pixels."""
    rows, columns = numpy.indices(shape)
    mask = numpy.zeros(shape, "u1")
    for (x, y), (axon, fibre) in fibres.items():
        distance = numpy.hypot(columns - x, rows - y)
        mask[distance < fibre] = 127
        mask[distance < axon] = 255
    return mask


class Histology(CactusTestCase):
    def path(self, name):
        return os.path.join(self.folder, name)

    def test_a_cut_of_tubes(self):
        _, outer, inner = two_tubes()
        image = fetch(HistologyMask(Outer=produce(outer), Inner=produce(inner), PixelSize=0.05))
        mask, ids = pixels(image), pixels(image, "FibreId")
        self.assertEqual(mask.shape, (200, 200))
        self.assertEqual(mask.dtype, numpy.uint8)
        self.assertEqual(image.GetFieldData().GetArray("PixelSize_um").GetValue(0), 0.05)
        self.assertAlmostEqual((mask == 255).sum() * 0.05**2, POLYGON * (0.7**2 + 0.9**2), delta=0.03)
        self.assertAlmostEqual((mask == 127).sum() * 0.05**2, POLYGON * (1 + 1.5**2 - 0.7**2 - 0.9**2), delta=0.04)
        x, y = numpy.meshgrid(*[numpy.arange(200) * 0.05 - 4.975] * 2)
        for fibre, centre, radius, axon in ((3, -2, 1, 0.7), (5, 2, 1.5, 0.9)):
            distance = numpy.hypot(x - centre, y)
            self.assertEqual(set(ids[distance < radius * 0.99]), {fibre})
            self.assertEqual(set(mask[distance < axon * 0.99]), {255})
            self.assertEqual(set(mask[(distance > axon * 1.01) & (distance < radius * 0.99)]), {127})
        self.assertEqual(set(mask[ids == 0]), {0})

    def test_cuts_along_the_fibres_and_in_the_faces(self):
        _, outer, inner = two_tubes(inset=0.5)
        data = {"Outer": produce(outer), "Inner": produce(inner), "PixelSize": 0.1}
        along = pixels(fetch(HistologyMask(Normal="Y", **data)))  # columns along x, rows along z
        self.assertEqual([set(along[50, 24:36]), set(along[50, 62:78]), set(along[2, 22:38])], [{255}, {255}, {127}])
        self.assertEqual(set(along[:, 45:54].ravel()), {0})
        across = pixels(fetch(HistologyMask(Normal="X", Position=-2, **data)))  # columns along y, rows along z
        self.assertEqual(set(across[50, 44:56]), {255})
        for face in (-5, 5):
            mask = pixels(fetch(HistologyMask(Position=face, **data)))
            self.assertAlmostEqual((mask == 127).sum() * 0.01, POLYGON * (1 + 1.5**2), delta=0.15)

    def test_a_png(self):
        """What AxonDeepSeg reads: 8 bits of grey, rows from the top."""
        _, outer, inner = two_tubes()
        proxy = HistologyMask(Outer=produce(outer), Inner=produce(inner), PixelSize=0.1)
        SaveData(self.path("mask.png"), proxy=proxy)
        read = Image.open(self.path("mask.png"))
        self.assertEqual(read.mode, "L")
        numpy.testing.assert_array_equal(numpy.asarray(read)[::-1], pixels(fetch(proxy)))
        again = fetch(HistologyRadii(Input=OpenDataFile(self.path("mask.png")), PixelSize=0.1))
        numpy.testing.assert_allclose(sorted(column(again, "AxonRadius_um")), [0.7, 0.9], atol=0.02)
        numpy.testing.assert_allclose(sorted(column(again, "FibreRadius_um")), [1.0, 1.5], atol=0.02)
        numpy.testing.assert_allclose(sorted(column(again, "X_um")), [3, 7], atol=0.01)

    def test_a_substrate_has_the_fractions_of_its_cuts(self):
        self.expected = "has not parted"
        bundle = BundleInitializer(Border="Walls", Side=6, FibreVolumeFraction=0.5, MinimumRadius=0.4)
        fibres = OutputPort(CapsuleOptimizer(Input=bundle), 0)
        surfaces = MyelinSurface(Input=FibreRadialGrowth(Input=fibres, VoxelSize=0.15))
        sampled = fetch(SubstrateSampler(Outer=surfaces, VoxelSize=6))
        masks = [pixels(fetch(HistologyMask(Outer=surfaces, Position=z, PixelSize=0.05))) for z in numpy.linspace(-2.4, 2.4, 7)]
        for grey, name in ((255, "AVF"), (127, "MVF")):
            found = numpy.mean([(mask == grey).mean() for mask in masks])
            self.assertAlmostEqual(found, sampled.GetPointData().GetArray(name).GetValue(0), delta=0.03)
        # Pixels that do not divide the side: what a face cuts off reaches the border.
        cut = pixels(fetch(HistologyMask(Outer=surfaces, PixelSize=0.13)))
        self.assertEqual(cut.shape, (46, 46))
        self.assertTrue(all(edge.any() for edge in (cut[0], cut[-1], cut[:, 0], cut[:, -1])))
        one, two = (pixels(fetch(HistologyMask(Outer=surfaces, PixelSize=0.05, NumberOfThreads=n))) for n in (1, 2))
        numpy.testing.assert_array_equal(one, two)

    def test_radii_of_rings(self):
        mask = rings((300, 400), {(60, 50): (20, 30), (300, 200): (40, 60), (150, 220): (9, 14.5), (0, 250): (10, 20)})
        mask[100:103, 200:203] = 127  # myelin without an axon
        proxy = HistologyRadii(Input=image_of(mask), PixelSize=0.05)
        table = fetch(proxy)
        for name, wanted in (("AxonRadius_um", [1, 2, 0.45]), ("FibreRadius_um", [1.5, 3, 0.725]), ("X_um", [3.025, 15.025, 7.525])):
            numpy.testing.assert_allclose(column(table, name), wanted, atol=0.01)
        numpy.testing.assert_allclose(column(table, "GRatio"), column(table, "AxonRadius_um") / column(table, "FibreRadius_um"))
        self.assertAlmostEqual(table.GetFieldData().GetArray("LooseMyelin_um2").GetValue(0), 9 * 0.05**2)
        proxy.LeaveOutBorder = 0
        self.assertEqual(list(column(fetch(proxy), "AtBorder")), [0, 0, 0, 1])
        proxy.SmallestRadius = 0.6
        self.assertEqual(fetch(proxy).GetNumberOfRows(), 2)

    def test_axons_are_those_of_scipy(self):
        """In a mask at random: axons by sides, myelin by sides and corners, all of which goes to somebody or is loose."""
        random = numpy.random.default_rng(5)
        mask = random.choice(numpy.array([0, 127, 255], "u1"), (120, 90), p=[0.55, 0.25, 0.2])
        table = fetch(HistologyRadii(Input=image_of(mask), PixelSize=1, LeaveOutBorder=0))
        labels, count = ndimage.label(mask == 255)
        self.assertEqual(table.GetNumberOfRows(), count)
        numpy.testing.assert_allclose(column(table, "AxonArea_um2"), ndimage.sum_labels(mask == 255, labels, range(1, count + 1)))
        hangs, _ = ndimage.label(mask > 0, structure=numpy.ones((3, 3)))
        loose = (mask == 127) & ~numpy.isin(hangs, hangs[mask == 255])
        self.assertAlmostEqual(table.GetFieldData().GetArray("LooseMyelin_um2").GetValue(0), loose.sum())
        self.assertAlmostEqual(column(table, "MyelinArea_um2").sum(), (mask == 127).sum() - loose.sum())

    def test_a_mask_in_colours(self):
        """As drawn over its image, by Pillow: blue axons and red myelin, with a grey image and a transparent part beside them."""
        mask = rings((60, 80), {(20, 30): (8, 12), (55, 30): (10, 15)})
        grey = fetch(HistologyRadii(Input=image_of(mask), PixelSize=0.1))
        picture = numpy.full((60, 80, 4), 150, "u1")
        picture[..., 3] = 255
        picture[mask == 127] = 230, 20, 30, 255
        picture[mask == 255] = 10, 30, 200, 255
        picture[:4] = 10, 30, 200, 0
        Image.fromarray(picture[::-1]).save(self.path("overlay.png"))
        proxy = HistologyRadii(Input=OpenDataFile(self.path("overlay.png")), PixelSize=0.1, AxonColour="Blue", MyelinColour="Red")
        for name in ("X_um", "AxonRadius_um", "FibreRadius_um"):
            numpy.testing.assert_array_equal(column(fetch(proxy), name), column(grey, name))
        proxy.AxonColour, proxy.MyelinColour = "White", "Grey"
        with self.assertError(r"not grey: Red \(\d+ of 4800 pixels\), Blue \(\d+ of 4800 pixels\)\. Choose AxonColour"):
            proxy.UpdatePipeline()
        # Pixels that count the colours of a palette.
        palette = Image.fromarray(numpy.where(picture[..., 3:] > 0, picture[..., :3], 0)[::-1]).convert("P", palette=Image.ADAPTIVE)
        palette.save(self.path("palette.png"))
        again = fetch(HistologyRadii(Input=OpenDataFile(self.path("palette.png")), PixelSize=0.1, AxonColour="Blue", MyelinColour="Red"))
        numpy.testing.assert_array_equal(column(again, "FibreRadius_um"), column(grey, "FibreRadius_um"))
        # The same in grey, in three channels and with a background that nobody sees.
        picture = numpy.repeat(mask[..., None], 4, axis=2)
        picture[..., 3] = 255
        picture[:4] = 255, 255, 255, 0
        Image.fromarray(picture[::-1]).save(self.path("grey.png"))
        again = fetch(HistologyRadii(Input=OpenDataFile(self.path("grey.png")), PixelSize=0.1))
        numpy.testing.assert_array_equal(column(again, "FibreRadius_um"), column(grey, "FibreRadius_um"))

    def test_touching_fibres_share_their_myelin_where_it_is_nearer(self):
        mask = numpy.full((41, 101), 127, "u1")
        mask[20, 20] = mask[20, 80] = 255
        table = fetch(HistologyRadii(Input=image_of(mask), PixelSize=1, LeaveOutBorder=0))
        left, right = column(table, "MyelinArea_um2")
        self.assertEqual(left + right, 41 * 101 - 2)
        self.assertLessEqual(abs(left - right), 41)  # the column between them

    def test_a_bundle_of_measured_radii(self):
        mask = rings((300, 400), {(60, 50): (20, 30), (300, 200): (12, 20), (150, 220): (9, 14.5)})
        path = self.path("radii.csv")
        SaveData(path, proxy=HistologyRadii(Input=image_of(mask), PixelSize=0.02))
        table = fetch(CSVReader(FileName=[path]))
        fibre = set(numpy.round(column(table, "FibreRadius_um"), 9))
        bundle = {"Side": 8, "FibreVolumeFraction": 0.5, "RadiusDistribution": "Table", "RadiusTableFile": path, "GrownFibreVolumeFraction": 0}
        drawn = fetch(BundleInitializer(Border="Walls", RadiusTableColumn="FibreRadius_um", **bundle))
        self.assertLessEqual(set(numpy.round(vtk_to_numpy(drawn.GetCellData().GetArray("TargetRadius")), 9)), fibre)
        drawn = fetch(BundleInitializer(Border="Walls", RadiusTableColumn="AxonRadius_um", RadiusTableFactor=1 / 0.7, **bundle))
        inner = set(numpy.round(column(table, "AxonRadius_um") / 0.7, 9))
        self.assertLessEqual(set(numpy.round(vtk_to_numpy(drawn.GetCellData().GetArray("TargetRadius")), 9)), inner)
        with self.assertError(r'no column "Radius".*FibreRadius_um'):
            BundleInitializer(Border="Walls", RadiusTableColumn="Radius", **bundle).UpdatePipeline()

    def test_tables_of_other_programs(self):
        """AxonDeepSeg's, with semicolons and decimal points, and one with a gap."""
        bundle = {"Side": 6, "FibreVolumeFraction": 0.4, "RadiusDistribution": "Table", "RadiusTableFile": self.path("axons.csv")}
        with open(self.path("axons.csv"), "w", encoding="utf-8-sig") as file:
            file.write('x0 (px);"axon_diam (um)";myelin\r\n1;1.0;a;b\r\n\r\n2; 1.4 ;"c;d"\r\n')
        drawn = fetch(BundleInitializer(Border="Walls", RadiusTableColumn="axon_diam (um)", RadiusTableFactor=0.5, GrownFibreVolumeFraction=0, **bundle))
        self.assertLessEqual(set(vtk_to_numpy(drawn.GetCellData().GetArray("TargetRadius"))), {0.5, 0.7})
        with open(self.path("axons.csv"), "w", encoding="utf-8-sig") as file:
            file.write("x0 (px);axon_diam (µm);myelin\n1;1,0;a\n2;1,4;b\n")
        again = fetch(BundleInitializer(Border="Walls", RadiusTableColumn="axon_diam (um)", RadiusTableFactor=0.5, GrownFibreVolumeFraction=0, **bundle))
        self.assertEqual(set(vtk_to_numpy(again.GetCellData().GetArray("TargetRadius"))), set(vtk_to_numpy(drawn.GetCellData().GetArray("TargetRadius"))))
        with open(self.path("axons.csv"), "a", encoding="utf-8") as file:
            file.write("\n3;nan;e\n")
        with self.assertError(r"line 5, has no number in column"):
            BundleInitializer(Border="Walls", RadiusTableColumn="axon_diam (um)", **bundle).UpdatePipeline()

    def test_open_surfaces(self):
        leaking = surfaces({3: without(tube(-2, 0, 1, 10), [7]), 5: tube(2, 0, 1.5, 10)}, 0, 10)
        with self.assertError("1 surfaces are not closed; what the mask shows of them"):
            HistologyMask(Outer=produce(leaking)).UpdatePipeline()

    def test_bad_requests(self):
        _, outer, _ = two_tubes()
        for properties, pattern in (({"Position": 6}, "Position 6 µm lies beside"), ({"PixelSize": 0}, "PixelSize"),
                                    ({"PixelSize": 0.001, "Position": 7}, "Position"), ({"Position": math.nan}, "Position")):
            with self.assertError(pattern):
                HistologyMask(Outer=produce(outer), **properties).UpdatePipeline()
        with self.assertError("no axons"):
            HistologyRadii(Input=image_of(numpy.full((4, 5), 127, "u1"))).UpdatePipeline()
        mask = HistologyMask(Outer=produce(outer), PixelSize=0.05)
        with self.assertError("edge of 0.05 µm, and PixelSize is 0.1 µm: set PixelSize to 0.05"):
            HistologyRadii(Input=mask).UpdatePipeline()
        with self.assertError("edge of 0.1 µm, and PixelSize is 0.05 µm"):
            HistologyRadii(Input=ExtractSubset(Input=mask, VOI=[0, 199, 0, 199, 0, 0], SampleRateI=2, SampleRateJ=2), PixelSize=0.05).UpdatePipeline()
        with self.assertError("grey values above 255.*divided by 257"):
            HistologyRadii(Input=image_of(rings((60, 60), {(30, 30): (9, 14.5)}).astype("u2") * 257)).UpdatePipeline()
        with self.assertError("is a vtkPolyData, and one mask is expected"):
            HistologyRadii(Input=produce(vtkPolyData())).UpdatePipeline()
        solid = vtkImageData()
        solid.SetDimensions(3, 3, 3)
        solid.AllocateScalars(3, 1)
        with self.assertError("3 × 3 × 3"):
            HistologyRadii(Input=produce(solid)).UpdatePipeline()


if __name__ == "__main__":
    main()
