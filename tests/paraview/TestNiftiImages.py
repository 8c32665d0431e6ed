# SPDX-License-Identifier: BSD-3-Clause
"""NiftiReader gives every voxel the value and the place that nibabel gives it, and a header that cannot be true is one error."""

import gzip
import math
import os
import shutil
import struct

import nibabel
import numpy
from cactus_testing import CactusTestCase, fetch, main
from paraview.simple import NiftiReader, OpenDataFile
from scipy.spatial.transform import Rotation
from vtkmodules.util.numpy_support import vtk_to_numpy

TURNED = numpy.eye(4)
TURNED[:3, :3] = Rotation.from_euler("XYZ", [20, -35, 110], degrees=True).as_matrix() @ numpy.diag([2, 3, 0.5])
TURNED[:3, 3] = [-30, 12, 70]
FLIPPED = TURNED @ numpy.diag([-1, 1, 1, 1])
SHEARED = TURNED.copy()
SHEARED[0, 1] += 0.7
RADIOLOGICAL = numpy.array([[-2.0, 0, 0, 90], [0, 2, 0, -126], [0, 0, 2, -72], [0, 0, 0, 1]])
SAGITTAL = numpy.array([[0, 0, 1.25, -80], [-1, 0, 0, 120], [0, -1, 0, 130], [0, 0, 0, 1.0]])  # slices from left to right, rows downwards
SHAPE = (4, 5, 6)


def numbers(shape, kind="<i2"):
    return numpy.arange(numpy.prod(shape)).reshape(shape).astype(kind)


class NiftiImages(CactusTestCase):
    def path(self, name="image.nii"):
        return os.path.join(self.folder, name)

    def save(self, affine=TURNED, name="image.nii", values=None, version=nibabel.Nifti1Image, s_form=1, q_form=1, unit="mm", voxel=None):
        values = numbers(SHAPE) if values is None else values
        image = version(values, affine, dtype=values.dtype if values.dtype.kind in "iu" else None)  # which 64 bits have to be asked for
        image.set_qform(affine, code=q_form, strip_shears=True)
        image.set_sform(affine, code=s_form)
        image.header.set_xyzt_units(unit)
        if voxel:
            image.header["pixdim"][1:4] = voxel
        nibabel.save(image, self.path(name))
        return self.path(name)

    def change(self, path, *changes):
        """Overwrites numbers of the header: (place, form, value...)."""
        with open(path, "r+b") as file:
            for at, form, *values in changes:
                file.seek(at)
                file.write(struct.pack(form, *values))
        return path

    def assertAsNibabelHasIt(self, path, millimetres=1.0, values=None, unit="Millimetre"):
        """Each voxel has its place and its values, whatever the order of both programs."""
        wanted, image = nibabel.load(path), fetch(NiftiReader(FileName=path, LengthUnit=unit))
        values = wanted.get_fdata() if values is None else values
        values = values.reshape(*values.shape[:3], -1, order="F")
        array = image.GetPointData().GetScalars()
        self.assertEqual(array.GetNumberOfTuples(), numpy.prod(values.shape[:3]))
        found = vtk_to_numpy(array).reshape(array.GetNumberOfTuples(), -1)
        self.assertEqual(found.shape[1], values.shape[3])
        places = numpy.array([image.GetPoint(point) for point in range(image.GetNumberOfPoints())]) / millimetres
        voxels = nibabel.affines.apply_affine(numpy.linalg.inv(wanted.affine), places)
        numpy.testing.assert_allclose(voxels, numpy.rint(voxels), atol=1e-4)
        self.assertEqual(len(numpy.unique(numpy.rint(voxels), axis=0)), len(voxels))
        numpy.testing.assert_allclose(found, values[tuple(numpy.rint(voxels).astype(int).T)], rtol=1e-6, atol=1e-6)
        return image

    def test_places(self):
        for name, affine, options in (
            ("turned", TURNED, {}), ("left-handed", FLIPPED, {}), ("q-form", TURNED, {"s_form": 0}), ("left-handed q-form", FLIPPED, {"s_form": 0}),
            ("sheared", SHEARED, {"q_form": 0}), ("other voxels than the affine's", TURNED, {"q_form": 0, "voxel": (1, 1, 1)}),
            ("radiological", RADIOLOGICAL, {}), ("sagittal slices", SAGITTAL, {}),
        ):
            with self.subTest(name=name):
                image = self.assertAsNibabelHasIt(self.save(affine, **options))
                canonical = nibabel.as_closest_canonical(nibabel.load(self.path()))
                self.assertEqual(image.GetDimensions(), canonical.shape)
                matrix = image.GetDirectionMatrix()
                axes = numpy.array([[matrix.GetElement(row, column) for column in range(3)] for row in range(3)])
                numpy.testing.assert_allclose(axes * image.GetSpacing(), canonical.affine[:3, :3], atol=1e-5)

    def test_an_image_along_the_scanners_axes_has_no_directions_of_its_own(self):
        image = fetch(NiftiReader(FileName=self.save(SAGITTAL)))
        self.assertTrue(image.GetDirectionMatrix().IsIdentity())
        self.assertEqual(image.GetSpacing(), (1.25, 1.0, 1.0))

    def test_a_q_form_without_a_sense_is_right_handed(self):
        for factor in (0.0, 1.0, 2.0):
            with self.subTest(factor=factor):
                self.assertAsNibabelHasIt(self.change(self.save(s_form=0), (76, "<f", factor)))
        self.assertAsNibabelHasIt(self.change(self.save(TURNED, s_form=0), (76, "<f", -1.0)))

    def test_kinds_of_files(self):
        for name, version in (("packed.nii.gz", nibabel.Nifti1Image), ("second.nii", nibabel.Nifti2Image), ("second.nii.gz", nibabel.Nifti2Image),
                              ("pair.hdr", nibabel.Nifti1Pair), ("pair2.hdr", nibabel.Nifti2Pair)):
            with self.subTest(name=name):
                self.assertAsNibabelHasIt(self.save(name=name, version=version))
        self.assertAsNibabelHasIt(self.path("pair.img"))
        for end in ("hdr", "img"):  # packed apart
            with open(self.path("pair." + end), "rb") as file, gzip.open(self.path(f"packed.{end}.gz"), "wb") as packed:
                shutil.copyfileobj(file, packed)
        self.assertAsNibabelHasIt(self.path("packed.img.gz"))
        os.remove(self.path("pair.img"))
        with self.assertError(r"pair\.(hdr|img)"):
            NiftiReader(FileName=self.path("pair.hdr")).UpdatePipeline()

    def test_the_other_byte_order_and_extensions(self):
        for version, header in ((nibabel.Nifti1Image, nibabel.Nifti1Header), (nibabel.Nifti2Image, nibabel.Nifti2Header)):
            with self.subTest(version=version):
                image = version(numbers(SHAPE, ">f4"), TURNED, header(endianness=">"))
                image.header.extensions.append(nibabel.nifti1.Nifti1Extension("comment", b"a comment of some length"))
                nibabel.save(image, self.path("big.nii"))
                self.assertEqual(nibabel.load(self.path("big.nii")).header.endianness, ">")
                self.assertAsNibabelHasIt(self.path("big.nii"))

    def test_types_of_numbers(self):
        for kind in ("u1", "i1", "<u2", "<i2", "<u4", "<i4", "<u8", "<i8", "<f4", "<f8"):
            with self.subTest(kind=kind):
                image = self.assertAsNibabelHasIt(self.save(values=numbers(SHAPE, kind), name="kind.nii"))
                self.assertEqual(vtk_to_numpy(image.GetPointData().GetScalars()).dtype, numpy.dtype(kind))
        colours = numpy.zeros(SHAPE, [(channel, "u1") for channel in "RGB"])
        for channel, part in zip("RGB", numbers((*SHAPE, 3), "u1").transpose(3, 0, 1, 2)):
            colours[channel] = part
        self.assertAsNibabelHasIt(self.save(values=colours), values=numbers((*SHAPE, 3), "u1"))
        complex_numbers = (numbers(SHAPE) + 1j * numbers(SHAPE)[::-1]).astype("<c8")
        self.assertAsNibabelHasIt(self.save(values=complex_numbers), values=numpy.stack([complex_numbers.real, complex_numbers.imag], -1))

    def test_series_and_vectors_are_components(self):
        for shape in ((*SHAPE, 45), (*SHAPE, 1, 3), (*SHAPE, 2, 3), SHAPE[:2], (*SHAPE, 1, 1, 1, 1)):
            with self.subTest(shape=shape):
                path = self.save(FLIPPED, values=numbers(shape, "<f4"))
                values = numbers(shape).reshape(*(shape + (1,))[:3], *(shape[3:5] or (1,)))
                if values.ndim == 5:  # the numbers of a vector side by side, in each volume
                    values = values.transpose(0, 1, 2, 4, 3)
                self.assertAsNibabelHasIt(path, values=values.reshape(*values.shape[:3], -1, order="F"))
        with self.assertError("6 dimensions: images of three, series"):
            NiftiReader(FileName=self.save(values=numbers((*SHAPE, 1, 1, 2)))).UpdatePipeline()

    def test_lengths_are_millimetres_or_micrometres(self):
        for unit, millimetres in (("micron", 0.001), ("meter", 1000.0), ("unknown", 1.0)):
            with self.subTest(unit=unit):
                self.assertAsNibabelHasIt(self.save(unit=unit), millimetres)
        self.assertAsNibabelHasIt(self.save(), 1000.0, unit="Micrometre")

    def test_values_are_those_that_the_header_means(self):
        nan = float("nan")
        for scale, wanted in (((0.5, -3), (-3, 56.5)), ((-2, 0), (-238, 0)), ((1, 7), (7, 126)), ((0, 7), (0, 119)), ((nan, nan), (0, 119)),
                              ((nan, 7), (0, 119))):
            with self.subTest(scale=scale):
                image = self.assertAsNibabelHasIt(self.change(self.save(), (112, "<2f", *scale)))
                self.assertEqual(image.GetPointData().GetArray("image").GetRange(), wanted)

    def test_a_header_that_lies_is_one_error(self):
        with open(self.save(name="good.nii"), "rb") as file:
            good = file.read()
        nan = float("nan")

        def changed(at, form, *values):
            content = bytearray(good)
            struct.pack_into(form, content, at, *values)
            return bytes(content)

        for content, pattern in (
            (good[:-1], "file is truncated, some data is missing"),
            (good[:300], "Bad NIfTI header"),
            (b"", "Bad NIfTI header"),
            (b"mrtrix tracks\n" * 100, "Bad NIfTI header"),
            (changed(344, "4s", b"\0\0\0\0"), "no NIfTI image"),  # but an image of Analyze, which has no place
            (changed(344, "4s", b"ni1\0"), "its voxels are in another file"),
            (changed(40, "<8h", 3, 30000, 30000, 30000, 1, 1, 1, 1), "memory"),
            (changed(40, "<8h", 3, 4, 5, 600, 1, 1, 1, 1), "file is truncated"),
            (changed(40, "<8h", 3, -4, 5, 6, 1, 1, 1, 1), "dimension 1 is negative"),
            (changed(40, "<h", 9), "illegal ndim"),
            (changed(42, "<h", 0), "0 voxels along dimension 1"),
            (changed(40, "<h", 0), "0 dimensions"),
            (changed(70, "<2h", 99, 16), "type 99 with 16 bits"),
            (changed(72, "<h", 64), "type 4 with 64 bits"),
            (changed(108, "<f", 1e9), "file is truncated"),
            (changed(108, "<f", nan), "the voxels at byte -"),
            (changed(108, "<f", 100), "the voxels at byte 100"),
            (changed(112, "<f", math.inf), "scales numbers by inf and adds 0"),
            (changed(116, "<f", -math.inf), "scales numbers by 1 and adds -inf"),
            (changed(280, "<4f", nan, 0, 0, 0), "leaves the image no volume"),
            (changed(280, "<12f", *12 * (0,)), "leaves the image no volume"),
            (changed(252, "<2h", 0, 0), "it does not say where it lies"),
        ):
            for name, write in (("image.nii", lambda raw: raw), ("image.nii.gz", gzip.compress)):
                with self.subTest(pattern=pattern, name=name):
                    with open(self.path(name), "wb") as file:
                        file.write(write(content))
                    with self.assertError(pattern):
                        OpenDataFile(self.path(name)).UpdatePipeline()
        with open(self.path("cut.nii.gz"), "wb") as file:
            file.write(gzip.compress(good)[:-30])
        with self.assertError(r"cut\.nii\.gz: NIFTI file is truncated"):
            NiftiReader(FileName=self.path("cut.nii.gz")).UpdatePipeline()
        with self.assertError(r"missing\.nii"):
            NiftiReader(FileName=self.path("missing.nii")).UpdatePipeline()
        with self.assertError("FileName is empty: name the image to read"):
            NiftiReader().UpdatePipeline()


if __name__ == "__main__":
    main()
