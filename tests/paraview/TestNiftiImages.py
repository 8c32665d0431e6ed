# SPDX-License-Identifier: BSD-3-Clause
"""Images that scripts show beside a substrate lie where nibabel has them, and a header that cannot be true is one error."""

import gzip
import math
import os
import struct
import sys

import nibabel
import numpy
from cactus_testing import CactusTestCase, fetch, main
from scipy.spatial.transform import Rotation

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "examples"))
from nifti import read_image  # noqa: E402  (which is in another folder)

TURNED = numpy.eye(4)
TURNED[:3, :3] = Rotation.from_euler("XYZ", [20, -35, 110], degrees=True).as_matrix() @ numpy.diag([2, 3, 0.5])
TURNED[:3, 3] = [-30, 12, 70]
FLIPPED = TURNED @ numpy.diag([-1, 1, 1, 1])
SHAPE = (4, 5, 6)


class NiftiImages(CactusTestCase):
    def path(self, name="image.nii.gz"):
        return os.path.join(self.folder, name)

    def save(self, affine, name="image.nii.gz", s_form=1, q_form=1, unit="mm", voxel=None):
        numbers = numpy.arange(numpy.prod(SHAPE), dtype="<i2").reshape(SHAPE)
        image = nibabel.Nifti1Image(numbers, affine)
        image.set_qform(affine, code=q_form, strip_shears=True)
        image.set_sform(affine, code=s_form)
        image.header.set_xyzt_units(unit)
        if voxel:
            image.header["pixdim"][1:4] = voxel
        nibabel.save(image, self.path(name))
        return self.path(name)

    def assertInItsPlace(self, path, millimetres=1.0):
        """Each number lies where nibabel has the voxel with this number."""
        wanted, image = nibabel.load(path), fetch(read_image(path))
        numbers = wanted.get_fdata()
        self.assertEqual(image.GetNumberOfPoints(), numbers.size)
        for i in range(image.GetNumberOfPoints()):
            number = image.GetPointData().GetScalars().GetTuple1(i)
            place = wanted.affine @ [*numpy.argwhere(numbers == number)[0], 1]
            numpy.testing.assert_allclose(image.GetPoint(i), millimetres * place[:3], atol=1e-4)

    def test_lie_where_nibabel_has_them(self):
        sheared = TURNED.copy()
        sheared[0, 1] += 0.7
        for name, affine, options in (
            ("turned", TURNED, {}), ("left-handed", FLIPPED, {}), ("q-form", TURNED, {"s_form": 0}), ("left-handed q-form", FLIPPED, {"s_form": 0}),
            ("sheared", sheared, {"q_form": 0}), ("other voxels than the affine's", TURNED, {"q_form": 0, "voxel": (1, 1, 1)}),
        ):
            for file in ("image.nii", "image.nii.gz"):
                with self.subTest(name=name, file=file):
                    self.assertInItsPlace(self.save(affine, file, **options))

    def test_lengths_are_millimetres(self):
        for unit, millimetres in (("micron", 0.001), ("meter", 1000.0), ("unknown", 1.0)):
            with self.subTest(unit=unit):
                self.assertInItsPlace(self.save(TURNED, unit=unit), millimetres)

    def test_numbers_are_those_that_the_header_means(self):
        path = self.save(TURNED, "image.nii")
        for scale, wanted in (((0.5, -3), (-3, 56.5)), ((-2, 0), (-238, 0)), ((1, 7), (7, 126)), ((0, 7), (0, 119))):
            with self.subTest(scale=scale):
                with open(path, "r+b") as file:
                    file.seek(112)
                    file.write(struct.pack("<2f", *scale))
                self.assertInItsPlace(path)
                self.assertEqual(fetch(read_image(path)).GetPointData().GetArray("NIFTI").GetRange(), wanted)

    def test_a_header_that_lies_is_one_error(self):
        with open(self.save(TURNED, "good.nii"), "rb") as file:
            good = file.read()
        nan = float("nan")

        def changed(at, form, *values):
            content = bytearray(good)
            struct.pack_into(form, content, at, *values)
            return bytes(content)

        for content, pattern in (
            (good[:-1], "truncated, or its header wrong: 244 bytes are to follow it, and 243 do"),
            (good[:300], "no NIfTI-1 image"),
            (b"", "no NIfTI-1 image"),
            (b"mrtrix tracks\n" * 100, "no NIfTI-1 image"),
            (changed(344, "4s", b"ni1\0"), "no NIfTI-1 image in one file"),
            (changed(40, "<8h", 3, 30000, 30000, 30000, 1, 1, 1, 1), "54000000000004 bytes are to follow it, and 244 do"),
            (changed(40, "<8h", 3, -4, 5, 6, 1, 1, 1, 1), r"3 dimensions of \[-4, 5, 6\]"),
            (changed(40, "<h", 9), "9 dimensions"),
            (changed(40, "<h", 0), "0 dimensions"),
            (changed(70, "<2h", 99, 16), "type 99 with 16 bits"),
            (changed(72, "<h", 64), "type 4 with 64 bits"),
            (changed(108, "<f", 1e9), "truncated, or its header wrong"),
            (changed(108, "<f", nan), "from byte nan on"),
            (changed(112, "<f", nan), "scaled by nan and moved by 0"),
            (changed(116, "<f", -math.inf), "scaled by 1.0 and moved by -inf"),
            (changed(80, "<f", nan), r"voxels of \(nan, 3\.0, 0\.5\)"),
            (changed(84, "<f", 0.0), "voxels of"),
            (changed(280, "<4f", nan, 0, 0, 0), "leaves the image no volume"),
            (changed(280, "<12f", *12 * (0,)), "leaves the image no volume"),
            (changed(252, "<2h", 0, 0), "neither its s-form nor its q-form is set"),
        ):
            for name, write in (("image.nii", lambda raw: raw), ("image.nii.gz", gzip.compress)):
                with self.subTest(pattern=pattern, name=name):
                    with open(self.path(name), "wb") as file:
                        file.write(write(content))
                    with self.assertRaisesRegex(ValueError, pattern):
                        read_image(self.path(name))
        with open(self.path("cut.nii.gz"), "wb") as file:
            file.write(gzip.compress(good)[:-30])
        self.assertRaisesRegex(ValueError, "cut.nii.gz cannot be read: ", read_image, self.path("cut.nii.gz"))
        self.assertRaises(FileNotFoundError, read_image, self.path("missing.nii"))


if __name__ == "__main__":
    main()
