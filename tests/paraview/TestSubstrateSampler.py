# SPDX-License-Identifier: BSD-3-Clause
"""The sampled image: its fractions are those of the statistics, which measure otherwise, its labels and directions those of tubes that
are known; and what NIfTI files hold is what nibabel reads."""

import math
import os
import shutil
import subprocess

import nibabel
import numpy
from cactus_testing import UNPARTED, CactusTestCase, fetch, main, produce
from paraview.simple import (BundleInitializer, CapsuleOptimizer, FibreRadialGrowth, MyelinSurface, OutputPort, Placement, SaveData,
                             SubstrateSampler, SubstrateStatistics)
from scipy.spatial.transform import Rotation
from scipy.special import sph_harm
from surfaces import POLYGON, surfaces, tube, two_tubes, without
from vtkmodules.util.numpy_support import vtk_to_numpy


def array(image, name):
    """With indices x, y, z."""
    numbers = vtk_to_numpy(image.GetPointData().GetArray(name))
    return numbers.reshape(image.GetDimensions()[::-1] + numbers.shape[1:]).swapaxes(0, 2)


def real_harmonics(directions, order):
    """MRtrix's basis by scipy's complex one, a row for each direction."""
    polar, azimuth = numpy.arccos(directions[:, 2]), numpy.arctan2(directions[:, 1], directions[:, 0])
    columns = []
    for degree in range(0, order + 1, 2):
        for m in range(-degree, degree + 1):
            value = sph_harm(abs(m), degree, azimuth, polar)
            columns.append(value.real if m == 0 else math.sqrt(2) * (value.imag if m < 0 else value.real))
    return numpy.array(columns).T


class Sampler(CactusTestCase):
    expected = UNPARTED

    def tubes(self, **properties):
        lines, outer, inner = two_tubes()
        return SubstrateSampler(Outer=produce(outer), Inner=produce(inner), Fibres=produce(lines), **properties)

    def test_tubes(self):
        image = fetch(self.tubes(VoxelSize=1))
        self.assertEqual(image.GetDimensions(), (10, 10, 10))
        self.assertEqual(image.GetOrigin(), (-4.5, -4.5, -4.5))
        avf, mvf = array(image, "AVF"), array(image, "MVF")
        self.assertAlmostEqual(avf.sum(), 10 * POLYGON * (0.7**2 + 0.9**2), 4)
        self.assertAlmostEqual(mvf.sum(), 10 * POLYGON * (1.0**2 + 1.5**2 - 0.7**2 - 0.9**2), 4)
        numpy.testing.assert_allclose(avf[..., 0], avf[..., 9], atol=1e-6)  # tubes along z
        # The quarter of fibre 3, whose axis is at (-2, 0).
        self.assertAlmostEqual(avf[2, 4, 5], POLYGON * 0.7**2 / 4, 5)
        self.assertAlmostEqual(mvf[2, 4, 5], POLYGON * (1 - 0.7**2) / 4, 5)
        numpy.testing.assert_allclose(array(image, "ExtraAxonalFraction"), 1 - avf - mvf, atol=1e-6)
        numpy.testing.assert_allclose(array(image, "BundleFraction_2"), avf + mvf, atol=1e-6)  # 3 and 5 are of one bundle
        self.assertEqual(array(image, "FibreId")[2, 4, 5], 3)
        self.assertEqual(array(image, "FibreId")[6, 4, 5], 5)
        self.assertEqual(array(image, "FibreCount").max(), 1)
        inside = array(image, "FibreCount") > 0
        numpy.testing.assert_allclose(array(image, "MeanDirection")[inside], [[0, 0, 1]] * inside.sum(), atol=1e-6)
        numpy.testing.assert_allclose(array(image, "Dispersion")[inside], 0, atol=1e-3)
        self.assertTrue(numpy.isnan(array(image, "Dispersion")[~inside]).all())

    def test_labels_at_fine_voxels(self):
        """Where a voxel lies wholly in a compartment, its label is that one."""
        image = fetch(self.tubes(VoxelSize=0.25))
        x, y = numpy.meshgrid(-4.875 + 0.25 * numpy.arange(40), -4.875 + 0.25 * numpy.arange(40), indexing="ij")
        labels = array(image, "Compartment")[..., 20]
        for centre, outer, inner in ((-2, 1.0, 0.7), (2, 1.5, 0.9)):
            distance = numpy.hypot(x - centre, y)
            self.assertEqual(set(labels[distance < inner - 0.2]), {1})
            ring = (distance > inner + 0.18) & (distance < outer - 0.18)
            self.assertLessEqual(set(labels[ring]), {2})
        self.assertEqual(set(labels[numpy.minimum(numpy.hypot(x + 2, y) - 1, numpy.hypot(x - 2, y) - 1.5) > 0.2]), {0})

    def test_voxels_that_do_not_divide_the_domain(self):
        """Fractions are of a voxel's part in the domain: weighted with that, they give the whole."""
        image = fetch(self.tubes(VoxelSize=3))
        self.assertEqual(image.GetDimensions(), (4, 4, 4))
        lengths = numpy.array([3, 3, 3, 1.0])
        volumes = lengths[:, None, None] * lengths[None, :, None] * lengths[None, None, :]
        self.assertAlmostEqual((array(image, "AVF") * volumes).sum(), 10 * POLYGON * (0.7**2 + 0.9**2), 3)
        whole = fetch(self.tubes(VoxelSize=10))
        self.assertAlmostEqual(array(whole, "AVF")[0, 0, 0], POLYGON * (0.7**2 + 0.9**2) / 100, 6)

    def chain(self):
        bundle = BundleInitializer(Border="Walls", CalibreVariation=0, Side=8, FibreVolumeFraction=0.5, MinimumRadius=0.4, NumberOfBundles=2, CrossingStyle="Sheets")
        fibres = OutputPort(CapsuleOptimizer(Input=bundle), 0)
        return fibres, MyelinSurface(Input=FibreRadialGrowth(Input=fibres, VoxelSize=0.2, GrowthIterations=1))

    def test_a_substrate_has_the_fractions_of_its_statistics(self):
        fibres, surfaces = self.chain()
        table = fetch(SubstrateStatistics(Fibres=fibres, Outer=OutputPort(surfaces, 0), Inner=OutputPort(surfaces, 1)))
        for voxel in (8, 1, 0.5):
            image = fetch(SubstrateSampler(Outer=surfaces, VoxelSize=voxel))  # the rest comes from MyelinSurface itself
            for name in ("AVF", "MVF"):
                self.assertAlmostEqual(array(image, name).mean(), table.GetColumnByName(name).GetValue(0), 6)
        # As one voxel of an image, of which they fill little.
        one = fetch(SubstrateSampler(Outer=surfaces, VoxelSize=2000))
        for name in ("AVF", "MVF"):
            self.assertAlmostEqual(array(one, name)[0, 0, 0], table.GetColumnByName(name).GetValue(0), 6)
        self.assertEqual(array(one, "FibreCount")[0, 0, 0], len(set(vtk_to_numpy(fetch(surfaces).GetCellData().GetArray("FibreId")))))
        bundles = [array(image, f"BundleFraction_{n}") for n in (1, 2)]
        numpy.testing.assert_allclose(bundles[0] + bundles[1], 1 - array(image, "ExtraAxonalFraction"), atol=1e-5)
        # Bundles cross at 90°: where one is alone, its fibres point along its axis.
        for fraction, other in (bundles, bundles[::-1]):
            alone = array(image, "MeanDirection")[(fraction > 0.3) & (other == 0)]
            spread = numpy.linalg.eigvalsh(alone.T @ alone / len(alone))
            self.assertGreater(spread[2], 0.9)

    def slanted(self, **properties):
        """Tubes along z whose centre lines lead along (0.6, 0, 0.8) (fibre 3, bundle 2) and along z (fibre 5, bundle 2)."""
        lines, outer, inner = two_tubes()
        for i in range(13):
            x, y, z = lines.GetPoint(i)
            lines.GetPoints().SetPoint(i, -2 + 0.75 * z, y, z)
        bundle = lines.GetCellData().GetArray("BundleId")
        for data in (outer, inner):
            ids, bundles = (data.GetCellData().GetArray(name) for name in ("FibreId", "BundleId"))
            for cell in range(data.GetNumberOfCells()):
                bundles.SetValue(cell, 7 if ids.GetValue(cell) == 3 else 4)
        bundle.SetValue(0, 7)
        bundle.SetValue(1, 4)
        return SubstrateSampler(Outer=produce(outer), Inner=produce(inner), Fibres=produce(lines), **properties)

    def test_orientation_distributions(self):
        """By scipy's harmonics, with the fibres' fractions as weights."""
        image = fetch(self.slanted(VoxelSize=10, HarmonicsOrder="8", Peaks=1))
        fractions = numpy.array([1, 1.5**2]) * POLYGON / 100
        directions = numpy.array([[0.6, 0, 0.8], [0, 0, 1]])
        wanted = fractions @ real_harmonics(directions, 8)
        fod = array(image, "FOD")[0, 0, 0]
        numpy.testing.assert_allclose(fod, wanted, atol=1e-5)
        self.assertAlmostEqual(fod[0] * math.sqrt(4 * math.pi), fractions.sum(), 6)  # the integral over the sphere
        peaks = array(image, "Peaks")[0, 0, 0]
        numpy.testing.assert_allclose(peaks[:6], (fractions[:, None] * directions)[::-1].ravel(), atol=1e-6)
        self.assertTrue(numpy.isnan(peaks[6:]).all())
        small = fetch(self.slanted(VoxelSize=2.5, HarmonicsOrder="4", Peaks=1))
        fractions = 1 - array(small, "ExtraAxonalFraction")
        numpy.testing.assert_allclose(array(small, "FOD")[..., 0] * math.sqrt(4 * math.pi), fractions, atol=1e-6)
        self.assertEqual(array(small, "FOD").shape[-1], 15)
        numpy.testing.assert_array_equal(numpy.isnan(array(small, "Peaks")[..., 0]), fractions == 0)

    def test_placed_distributions_turn(self):
        place = {"RotationX": 20, "RotationY": -35, "RotationZ": 110}
        image = fetch(Placement(Input=self.slanted(VoxelSize=10, HarmonicsOrder="8", Peaks=1), **place))
        turn = Rotation.from_euler("ZXY", [110, 20, -35], degrees=True).as_matrix()
        fractions = numpy.array([1, 1.5**2]) * POLYGON / 100
        directions = numpy.array([[0.6, 0, 0.8], [0, 0, 1]]) @ turn.T
        numpy.testing.assert_allclose(array(image, "FOD")[0, 0, 0], fractions @ real_harmonics(directions, 8), atol=1e-5)
        numpy.testing.assert_allclose(array(image, "Peaks")[0, 0, 0][:6], (fractions[:, None] * directions)[::-1].ravel(), atol=1e-6)
        # What a bundle was asked for turns with it.
        bundle = BundleInitializer(DispersionModel="Peaks", MeanDispersion=0, OrientationPeaks="0.6 0 0.8", Side=6, FibreVolumeFraction=0.3)
        placed = Placement(Input=bundle, **place)
        asked = 0.3 * real_harmonics(numpy.array([[0.6, 0, 0.8]]) @ turn.T, 8)[0]
        numpy.testing.assert_allclose(vtk_to_numpy(fetch(placed).GetFieldData().GetArray("OrientationHarmonics")), asked, atol=1e-9)

    def test_orientation_files_are_mrtrixs(self):
        """Volumes of a fourth dimension; MRtrix itself, where it is installed, finds the fibres' direction in them."""
        path = os.path.join(self.folder, "fod.nii")
        SaveData(path, proxy=self.slanted(VoxelSize=5, HarmonicsOrder="8", Peaks=1), Array="FOD")
        self.assertEqual(nibabel.load(path).shape, (2, 2, 2, 45))
        if shutil.which("sh2peaks"):
            found = os.path.join(self.folder, "peaks.nii")
            subprocess.run(["sh2peaks", path, found, "-num", "1", "-quiet"], check=True)
            peak = numpy.asarray(nibabel.load(found).dataobj)[0, 0, 0]
            axis = numpy.abs(peak) / numpy.linalg.norm(peak)
            numpy.testing.assert_allclose(axis, [0.6, 0, 0.8], atol=0.02)
        SaveData(path, proxy=self.slanted(VoxelSize=5, Peaks=1), Array="Peaks")
        self.assertEqual(nibabel.load(path).shape, (2, 2, 2, 9))

    def test_threads_make_no_difference(self):
        _, surfaces = self.chain()
        one, two = (fetch(SubstrateSampler(Outer=surfaces, NumberOfThreads=n)) for n in (1, 2))
        for i in range(one.GetPointData().GetNumberOfArrays()):
            name = one.GetPointData().GetArrayName(i)
            numpy.testing.assert_array_equal(array(one, name), array(two, name))

    def test_nifti(self):
        sampler = self.tubes(VoxelSize=2)
        image = fetch(sampler)
        for ending in (".nii", ".nii.gz"):
            for name in ("AVF", "Compartment", "FibreId", "MeanDirection", ""):
                path = os.path.join(self.folder, "image" + ending)
                SaveData(path, proxy=sampler, Array=name)
                read = nibabel.load(path)
                wanted = array(image, name or "AVF")
                numpy.testing.assert_array_equal(numpy.squeeze(numpy.asarray(read.dataobj)), wanted)
                self.assertEqual(read.header.get_data_dtype(), wanted.dtype)
                self.assertEqual(read.header.get_xyzt_units()[0], "mm")
                affine = numpy.array([[2e-3, 0, 0, -4e-3], [0, 2e-3, 0, -4e-3], [0, 0, 2e-3, -4e-3], [0, 0, 0, 1.0]])
                for wanted_code, (form, code) in ((1, read.header.get_qform(coded=True)), (2, read.header.get_sform(coded=True))):
                    numpy.testing.assert_allclose(form, affine, atol=1e-9)
                    self.assertEqual(code, wanted_code)
        self.assertEqual(sorted(os.listdir(self.folder)), ["image.nii", "image.nii.gz"])

    def test_open_surfaces(self):
        leaking = surfaces({3: without(tube(-2, 0, 1, 10), [7]), 5: tube(2, 0, 1.5, 10)}, 0, 10)
        with self.assertError(r"1 surfaces are not closed, outward 2-manifolds"):
            SubstrateSampler(Outer=produce(leaking)).UpdatePipeline()

    def test_bad_requests(self):
        sampler = self.tubes()
        with self.assertError(r"no point data called None"):
            SaveData(os.path.join(self.folder, "image.nii"), proxy=sampler, Array="None")
        with self.assertError(r"cannot write .*nowhere"):
            SaveData(os.path.join(self.folder, "nowhere", "image.nii"), proxy=sampler)
        _, outer, _ = two_tubes()
        for properties in ({"HarmonicsOrder": "2"}, {"Peaks": 1}):
            with self.assertError(f"{list(properties)[0]} asks for directions.*connect Fibres"):
                SubstrateSampler(Outer=produce(outer), **properties).UpdatePipeline()
        sampler.VoxelSize = 0.001
        with self.assertError(r"VoxelSize"):
            sampler.UpdatePipeline()
        self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    main()
