# SPDX-License-Identifier: BSD-3-Clause
# ctest-ranks: 2
"""BundleInitializer through ParaView: its faces, radii and directions checked with code of this file's own, and its errors."""

import json
import os

import nibabel
import numpy as np
from cactus_testing import CactusTestCase, fetch, main
from paraview.simple import BundleInitializer, CapsuleOptimizer, FibreRadialGrowth, MyelinSurface, OutputPort, Placement, SubstrateSampler, SubstrateStatistics, SubstrateWriter
from vtkmodules.util.numpy_support import vtk_to_numpy


def drawn_radii(**properties):
    """A bundle between walls that starts with the radii drawn, so that these say where its circles touch."""
    return BundleInitializer(**{"GrownFibreVolumeFraction": 0, "Border": "Walls", "CorrelationLength": 0, "CalibreVariation": 0, "FibreVolumeFraction": 0.7, **properties})


def ends(data):
    """First points, last points, radii and bundles of all fibres."""
    points = vtk_to_numpy(data.GetPoints().GetData())
    offsets = vtk_to_numpy(data.GetLines().GetOffsetsArray())
    ids = vtk_to_numpy(data.GetLines().GetConnectivityArray())
    cells = data.GetCellData()
    return (
        points[ids[offsets[:-1]]],
        points[ids[offsets[1:] - 1]],
        vtk_to_numpy(cells.GetArray("TargetRadius")),
        vtk_to_numpy(cells.GetArray("BundleId")),
    )


def smallest_gap(centres, radii):
    distances = np.linalg.norm(centres[:, None, :] - centres[None, :, :], axis=2) - radii[:, None] - radii[None, :]
    np.fill_diagonal(distances, np.inf)
    return distances.min()


def angles_to(first, last, axis):
    direction = (last - first) / np.linalg.norm(last - first, axis=1)[:, None]
    return np.degrees(np.arccos(np.clip(direction @ axis, -1, 1)))


class BundleInitializerTest(CactusTestCase):
    def test_single_bundle(self):
        data = fetch(drawn_radii(MeanDispersion=10))
        first, last, radii, bundles = ends(data)
        self.assertEqual(data.GetNumberOfLines(), len(radii))
        self.assertAlmostEqual((np.pi * radii**2).sum() / 900, 0.7, delta=0.005)
        self.assertTrue((bundles == 1).all())
        self.assertTrue(((radii >= 0.2) & (radii <= 2)).all())
        for face, z in ((first, -15), (last, 15)):
            self.assertTrue((face[:, 2] == z).all())
            self.assertGreater(smallest_gap(face, radii), -1e-9)
            self.assertLessEqual((np.abs(face[:, :2]) + radii[:, None]).max(), 15 + 1e-9)
        self.assertAlmostEqual(angles_to(first, last, np.array([0, 0, 1])).mean(), 10, delta=0.25)
        provenance = data.GetFieldData().GetAbstractArray("Provenance").GetValue(0)
        for parameter in ('"Side": 30.0', '"MeanDispersion": 10.0', '"GammaShape": 2.4', '"Seed": 1'):
            self.assertIn(parameter, provenance)
        domain = data.GetFieldData().GetArray("Domain")
        self.assertEqual([domain.GetValue(i) for i in range(6)], [-15, 15] * 3)

    def test_is_made_for_growth_by_default(self):
        """Capsules that fill 0.6 of the faces, thinner than the radii drawn, by as much as these would fill 0.9 with."""
        data = fetch(BundleInitializer(Side=20, Border="Walls", CalibreVariation=0))
        first = vtk_to_numpy(data.GetLines().GetOffsetsArray())[:-1]
        radii, targets = vtk_to_numpy(data.GetPointData().GetArray("Radius"))[first], ends(data)[2]
        np.testing.assert_allclose(radii, targets * np.sqrt(0.6 / 0.9))
        self.assertAlmostEqual((np.pi * radii**2).sum() / 400, 0.6, delta=0.005)
        self.assertEqual(data.GetFieldData().GetArray("GrownFibreVolumeFraction").GetValue(0), 0.9)

    def test_calibre_varies_by_default(self):
        """About the radius that a fibre is to have, and more with a larger CalibreVariation."""
        spreads = []
        for properties in ({"CalibreVariation": 0}, {}, {"CalibreVariation": 0.4}):
            data = fetch(BundleInitializer(Side=20, **properties))
            first = vtk_to_numpy(data.GetLines().GetOffsetsArray())[:-1]
            counts = np.diff(vtk_to_numpy(data.GetLines().GetOffsetsArray()))
            radii, targets = vtk_to_numpy(data.GetPointData().GetArray("Radius")), ends(data)[2]
            ratios = np.sqrt(np.add.reduceat(radii**2, first) / counts) / (targets * np.sqrt(0.6 / 0.9))
            self.assertAlmostEqual(ratios.mean(), 1, delta=0.02)
            means = np.add.reduceat(np.log(radii), first) / counts
            spreads.append(np.sqrt(np.mean((np.log(radii) - np.repeat(means, counts)) ** 2)))
        self.assertLess(spreads[0], 1e-9)
        self.assertGreater(spreads[1], 0.1)
        self.assertGreater(spreads[2], 1.3 * spreads[1])

    def test_crossing(self):
        for style in ("Interwoven", "Sheets"):
            data = fetch(drawn_radii(NumberOfBundles=2, CrossingAngle=60, CrossingStyle=style, FibreVolumeFraction=0.6))
            first, last, radii, bundles = ends(data)
            for bundle, x in ((1, 0.5), (2, -0.5)):
                own = bundles == bundle
                angles = angles_to(first[own], last[own], np.array([x, 0, np.sqrt(0.75)]))
                self.assertAlmostEqual(angles.mean(), 5, delta=0.25)
                self.assertGreater(smallest_gap(first[own], radii[own]), -1e-9)
                self.assertGreater(smallest_gap(last[own], radii[own]), -1e-9)

    def test_too_few_layers_to_be_interwoven_are_told(self):
        with self.assertError(r"the bundles lie in [23] layers, which is too few to be interwoven"):
            fetch(BundleInitializer(Side=8, NumberOfBundles=2, Border="Walls"))
        fetch(BundleInitializer(Side=16, NumberOfBundles=2, Border="Walls"))

    def test_radii(self):
        table = fetch(drawn_radii(Side=12, RadiusDistribution="Table", RadiusTable="0.4, 0.5 0.75", FibreVolumeFraction=0.5))
        self.assertEqual(sorted(set(ends(table)[2])), [0.4, 0.5, 0.75])
        path = os.path.join(self.folder, "radii.txt")
        with open(path, "w") as file:
            file.write("0.4\n0.5\n0.75\n")
        from_file = fetch(
            drawn_radii(Side=12, RadiusDistribution="Table", RadiusTableFile=path, FibreVolumeFraction=0.5)
        )
        self.assertTrue((ends(from_file)[2] == ends(table)[2]).all())
        lognormal = drawn_radii(RadiusDistribution="Lognormal", LognormalMean=0.7, LognormalDeviation=0.1, Side=40)
        radii = ends(fetch(lognormal))[2]
        self.assertAlmostEqual(radii.mean(), 0.7, delta=0.015)
        self.assertAlmostEqual(radii.std(), 0.1, delta=0.01)

    def test_radii_as_they_were_published(self):
        """Of many fibres, as large as they have to be to count them."""
        bundle = {"RadiusDistribution": "Histogram", "MinimumRadius": 0.01, "MaximumRadius": 20, "Side": 60, "FibreVolumeFraction": 0.5}
        genu = ends(fetch(drawn_radii(RadiusHistogramGRatio=1, **bundle)))[2]
        self.assertAlmostEqual(genu.mean(), 0.470, delta=4 * 0.275 / np.sqrt(len(genu)))
        self.assertGreater(len(genu), 1000)
        self.assertTrue(((genu > 0.05) & (genu < 1.85)).all())
        visual = {**bundle, "RadiusHistogram": "Human visual (Caminiti 2009)"}
        inner = 0.7 * ends(fetch(drawn_radii(**visual)))[2]
        self.assertAlmostEqual(inner.mean(), 0.611, delta=4 * 0.245 / np.sqrt(len(inner)))
        swollen = ends(fetch(drawn_radii(RadiusHistogramFactor=1.5, **visual)))[2]
        self.assertAlmostEqual(0.7 * swollen.mean(), 1.5 * 0.611, delta=4 * 1.5 * 0.245 / np.sqrt(len(swollen)))
        names = BundleInitializer().GetProperty("RadiusHistogram").Available
        self.assertEqual(len(names), 10)
        for name in names:
            radii = ends(fetch(drawn_radii(RadiusHistogram=name, RadiusHistogramGRatio=0, **bundle)))[2]
            self.assertGreater(radii.min(), 0.3, f"{name}: the relation's myelin is more than 0.3 µm thick")

    def test_seeds(self):
        one = ends(fetch(drawn_radii(Seed=5)))
        again = ends(fetch(drawn_radii(Seed=5)))
        other = ends(fetch(drawn_radii(Seed=6)))
        self.assertTrue((one[1] == again[1]).all())
        self.assertFalse(one[1].shape == other[1].shape and (one[1] == other[1]).all())

    ANYWHERE = {"Side": 12, "FibreVolumeFraction": 0.3}

    def save(self, voxel, values, affine, scale=1):
        """A NIfTI image of 3 x 4 x 5 voxels that has these values in one voxel only."""
        image = np.zeros((3, 4, 5, len(values)), np.float32 if scale == 1 else np.int16)
        image[voxel] = np.asarray(values) / scale
        nifti = nibabel.Nifti1Image(image, np.asarray(affine, float))
        nifti.header.set_slope_inter(scale, 0)
        path = os.path.join(self.folder, "image.nii.gz")
        nibabel.save(nifti, path)
        return path

    def test_a_distribution_from_a_voxel_of_an_image(self):
        """As the same numbers in a text; whichever way the image's axes run, and with numbers that are scaled."""
        values = [1, 0, 0.25, 0.5, 0, -0.25]
        asked = fetch(BundleInitializer(DispersionModel="Harmonics", OrientationHarmonics=" ".join(map(str, values)), **self.ANYWHERE))
        harmonics = vtk_to_numpy(asked.GetFieldData().GetArray("OrientationHarmonics"))
        np.testing.assert_allclose(harmonics, np.array(values) * 0.3 / np.sqrt(4 * np.pi), rtol=1e-12)
        for affine, scale in ((np.diag([2, 2, 2, 1]), 1), (np.diag([-2, 2, 2, 1]), 1), (np.diag([2, 2, -2, 1]), 1), (np.diag([-2, 2, 2, 1]), 0.25)):
            with self.subTest(affine=affine, scale=scale):
                path = self.save((2, 1, 3), values, affine, scale)
                found = BundleInitializer(DispersionModel="Harmonics", OrientationFile=path, OrientationVoxel=[2, 1, 3], **self.ANYWHERE)
                np.testing.assert_array_equal(ends(fetch(found))[1], ends(asked)[1])
                self.assertIn("OrientationHarmonics", fetch(found).GetFieldData().GetAbstractArray("Provenance").GetValue(0))
        # A manifest has the numbers, so that the file is not needed again.
        self.assertNotIn("image.nii.gz", fetch(found).GetFieldData().GetAbstractArray("Provenance").GetValue(0))

    def test_peaks_are_bundles(self):
        self.save((0, 3, 4), [0, 0, 0.5, np.nan, 0.3, 0.4], np.eye(4))
        half = BundleInitializer(DispersionModel="Peaks", OrientationFile=os.path.join(self.folder, "image.nii.gz"), OrientationVoxel=[0, 3, 4], **self.ANYWHERE)
        with self.assertError("nan"):
            half.UpdatePipeline()
        values = [0, 0, 0.5, np.nan, np.nan, np.nan, 0.18, 0, 0.24]
        path = self.save((0, 3, 4), values, np.diag([-1, 1, 1, 1]))
        image = BundleInitializer(DispersionModel="Peaks", MeanDispersion=4, OrientationFile=path, OrientationVoxel=[0, 3, 4], **self.ANYWHERE)
        first, last, radii, bundles = ends(fetch(image))
        self.assertEqual(set(bundles), {1, 3})
        for bundle, axis in ((1, [0, 0, 1]), (3, [0.6, 0, 0.8])):
            angles = angles_to(first[bundles == bundle], last[bundles == bundle], np.array(axis))
            self.assertAlmostEqual(np.minimum(angles, 180 - angles).mean(), 4, delta=0.5)
        text = BundleInitializer(DispersionModel="Peaks", MeanDispersion=4, OrientationPeaks="0 0 0.5 0 0 0 0.18 0 0.24", **self.ANYWHERE)
        np.testing.assert_allclose(ends(fetch(text))[1], last, atol=1e-5)  # the image has single precision

    def test_directions_reached_are_compared_with_those_asked_for(self):
        """On surfaces and in the manifest, by the distribution that SubstrateSampler finds."""
        peaks = BundleInitializer(DispersionModel="Peaks", OrientationPeaks="0 0 0.5 0.3 0 0.4", Side=8, FibreVolumeFraction=0.2, GrownFibreVolumeFraction=0.4, MinimumRadius=0.4)
        fibres = OutputPort(CapsuleOptimizer(Input=peaks), 0)
        asked = vtk_to_numpy(fetch(peaks).GetFieldData().GetArray("OrientationHarmonics"))
        surfaces = MyelinSurface(Input=FibreRadialGrowth(Input=fibres, VoxelSize=0.15))
        outer, inner = (OutputPort(surfaces, port) for port in (0, 1))
        sampled = fetch(SubstrateSampler(Outer=outer, Inner=inner, Fibres=fibres, VoxelSize=8, HarmonicsOrder="8"))
        reached = vtk_to_numpy(sampled.GetPointData().GetArray("FOD"))[0]
        expected = reached[1:] @ asked[1:] / np.linalg.norm(reached[1:]) / np.linalg.norm(asked[1:])
        table = fetch(SubstrateStatistics(Fibres=fibres, Outer=outer, Inner=inner))
        self.assertAlmostEqual(table.GetColumnByName("AngularCorrelation").GetValue(0), expected, delta=0.01)
        self.assertLess(expected, 0.995)
        place = {"RotationX": 50, "RotationZ": 20, "PositionX": 3}
        placed = Placement(Input=outer, **place)
        turned = fetch(SubstrateStatistics(Fibres=Placement(Input=fibres, **place), Outer=OutputPort(placed, 0), Inner=OutputPort(placed, 1)))
        self.assertAlmostEqual(turned.GetColumnByName("AngularCorrelation").GetValue(0), table.GetColumnByName("AngularCorrelation").GetValue(0), places=5)
        folder = os.path.join(self.folder, "substrate")
        SubstrateWriter(Outer=outer, Inner=inner, Fibres=fibres, FolderName=folder).UpdatePipeline()
        with open(os.path.join(folder, "manifest.json"), encoding="utf-8") as file:
            self.assertAlmostEqual(json.load(file)["directions"]["angular_correlation"], expected, delta=0.01)
        table = fetch(SubstrateStatistics(Fibres=BundleInitializer(Side=8)))
        self.assertTrue(np.isnan(table.GetColumnByName("AngularCorrelation").GetValue(0)))

    def test_each_source_has_its_own_g_ratio(self):
        common = {"Side": 8, "FibreVolumeFraction": 0.15, "GrownFibreVolumeFraction": 0.3, "MinimumRadius": 0.7, "MaximumRadius": 1, "CalibreVariation": 0}
        sources = [BundleInitializer(GRatio=0.55, **common), BundleInitializer(Seed=2, **common)]
        fibres = OutputPort(CapsuleOptimizer(Input=sources), 0)
        surfaces = MyelinSurface(Input=FibreRadialGrowth(Input=fibres, VoxelSize=0.12), GRatio=0.75)
        outer, inner = (OutputPort(surfaces, port) for port in (0, 1))
        table = fetch(SubstrateStatistics(Fibres=fibres, Outer=outer, Inner=inner), 1)
        bundles, g_ratios = (vtk_to_numpy(table.GetColumnByName(name)) for name in ("BundleId", "GRatio"))
        for bundle, asked in ((1, 0.55), (2, 0.75)):
            self.assertAlmostEqual(np.nanmean(g_ratios[bundles == bundle]), asked, delta=0.03)

    def test_images_that_give_no_directions_are_refused(self):
        path = self.save((0, 0, 0), [1, 0, 0, 0, 0, 0, 0], np.eye(4))
        with open(os.path.join(self.folder, "text.nii"), "w", encoding="utf-8") as file:
            file.write("no image")
        for pattern, values in (
            (r"OrientationVoxel has -1", {"OrientationVoxel": [0, -1, 0]}),
            (r"OrientationVoxel has 0\.5", {"OrientationVoxel": [0.5, 0, 0]}),
            (r"voxel 3 0 0 lies outside .*image\.nii\.gz, which has 3 x 4 x 5 voxels", {"OrientationVoxel": [3, 0, 0]}),
            (r"voxel 1 0 0 of OrientationFile .*image\.nii\.gz has no directions", {"OrientationVoxel": [1, 0, 0]}),
            (r"OrientationHarmonics has 7 coefficients", {}),
            (r"OrientationPeaks has 7 numbers", {"DispersionModel": "Peaks"}),
            (r"OrientationHarmonics and OrientationFile are both given", {"OrientationHarmonics": "1"}),
            (r"OrientationPeaks and OrientationFile are both given", {"DispersionModel": "Peaks", "OrientationPeaks": "0 0 1"}),
            (r"cannot open /no/such", {"OrientationFile": "/no/such"}),
            (r"text\.nii: (this is no NIfTI image|.*[Hh]eader)", {"OrientationFile": os.path.join(self.folder, "text.nii")}),
            (r"Border Cut", {"Border": "Walls"}),
            (r"NumberOfBundles is 2", {"NumberOfBundles": 2, "DispersionModel": "Peaks", "OrientationFile": "", "OrientationPeaks": "0 0 1"}),
        ):
            with self.subTest(values=values):
                bundle = BundleInitializer(**{"DispersionModel": "Harmonics", "OrientationFile": path, **self.ANYWHERE, **values})
                with self.assertError(pattern):
                    bundle.UpdatePipeline()
                self.assertEqual(bundle.GetDataInformation().GetNumberOfCells(), 0)

    def test_what_cannot_be_is_refused_by_name(self):
        for pattern, values in (
            (r"FibreVolumeFraction 0\.95 .* only at 0\.[78]", {"Side": 15, "FibreVolumeFraction": 0.95}),
            (r"MeanDispersion 45.* came to [34]\d", {"Side": 15, "MeanDispersion": 45}),
            (r"Side is -1", {"Side": -1}),
            (r"Side is nan", {"Side": float("nan")}),
            (r"Side 1e\+05 .* GB", {"Side": 1e5}),
            (r"Side gives", {"Side": 0.5}),
            (r"FibreVolumeFraction is 1", {"FibreVolumeFraction": 1}),
            (r"FibreVolumeFraction is 0", {"FibreVolumeFraction": 0}),
            (r"GammaShape is 0", {"GammaShape": 0}),
            (r"GammaScale is -1", {"GammaScale": -1}),
            (r"LognormalMean is 0", {"RadiusDistribution": "Lognormal", "LognormalMean": 0}),
            (r"LognormalDeviation is 0", {"RadiusDistribution": "Lognormal", "LognormalDeviation": 0}),
            (r"RadiusHistogramGRatio is 0\.05", {"RadiusDistribution": "Histogram", "RadiusHistogramGRatio": 0.05}),
            (r"RadiusHistogramFactor is 0", {"RadiusDistribution": "Histogram", "RadiusHistogramFactor": 0}),
            (r"hardly any of the RadiusDistribution", {"RadiusDistribution": "Histogram", "MinimumRadius": 5, "MaximumRadius": 6}),
            (r"RadiusTable is empty", {"RadiusDistribution": "Table"}),
            (r"RadiusTable holds \"thin\"", {"RadiusDistribution": "Table", "RadiusTable": "0.5 thin"}),
            (r"RadiusTable holds 7", {"RadiusDistribution": "Table", "RadiusTable": "0.5 7"}),
            (r"RadiusTableFile /no/such", {"RadiusDistribution": "Table", "RadiusTableFile": "/no/such"}),
            (r"MinimumRadius is 0", {"MinimumRadius": 0}),
            (r"MinimumRadius 3 is larger than MaximumRadius 2", {"MinimumRadius": 3}),
            (r"hardly any", {"MinimumRadius": 50, "MaximumRadius": 51}),
            (r"MeanDispersion is 46", {"MeanDispersion": 46}),
            (r"NumberOfBundles is 3", {"NumberOfBundles": 3}),
            (r"CrossingAngle is 91", {"NumberOfBundles": 2, "CrossingAngle": 91}),
            (r"SheetThickness is -1", {"NumberOfBundles": 2, "CrossingStyle": "Sheets", "SheetThickness": -1}),
            (r"SheetThickness gives", {"NumberOfBundles": 2, "CrossingStyle": "Sheets", "SheetThickness": 1}),
            (r"Margin is -0.5", {"Margin": -0.5}),
            (r"SpacingFactor is 0", {"SpacingFactor": 0}),
            (r"MinimumSpacing is 0", {"MinimumSpacing": 0}),
            (r"MaximumSpacing 0\.5 is below", {"MaximumSpacing": 0.5}),
            (r"Seed is -1", {"Seed": -1}),
        ):
            with self.subTest(values=values):
                bundle = drawn_radii(**values)
                with self.assertError(pattern):
                    bundle.UpdatePipeline()
                self.assertEqual(bundle.GetDataInformation().GetNumberOfCells(), 0)


if __name__ == "__main__":
    main()
