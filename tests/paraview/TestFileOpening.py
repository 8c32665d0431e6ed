# SPDX-License-Identifier: BSD-3-Clause
"""Files beside others': with the plugin loaded, every file of ParaView's own formats opens with the reader that it has without, by whatever
name; and ours open with ours."""

import gzip
import json
import os
import struct
import zipfile

import numpy
from cactus_testing import CactusTestCase, fetch, main
from paraview import servermanager
from paraview.simple import Delete, OpenDataFile, SaveData, Sphere, TractogramReader, UnstructuredCellTypes, Wavelet

STRANDS = "30\n1\n2\n0 0 -15 0.5\n0 0 15 0.5\n"
READERS = ("StrandReader", "TractogramReader", "NiftiReader", "SubstrateReader")
POINTS = numpy.array([[0, 0, 0], [1, 2, 3]], "<f4")


def tck():
    ends = numpy.array([[numpy.nan] * 3, [numpy.inf] * 3], "<f4")
    return b"mrtrix tracks\ndatatype: Float32LE\ncount: 1\nEND\n" + POINTS.tobytes() + ends.tobytes()


def trk():
    header = bytearray(1000)
    struct.pack_into("<6s3h3f", header, 0, b"TRACK", 9, 9, 9, 1, 1, 1)
    struct.pack_into("<16f", header, 440, *numpy.eye(4).ravel())
    struct.pack_into("<4s", header, 948, b"RAS")
    struct.pack_into("<3i", header, 988, 1, 2, 1000)
    return bytes(header) + struct.pack("<i", 2) + (POINTS + 0.5).tobytes()


def trx():
    return {"header.json": json.dumps({"NB_VERTICES": 2, "NB_STREAMLINES": 1}).encode(), "positions.3.float32": POINTS.tobytes(),
            "offsets.uint32": numpy.array([0, 2], "<u4").tobytes()}


class FileOpening(CactusTestCase):
    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, content):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with open(self.path(name), "wb") as file:
            file.write(content.encode() if isinstance(content, str) else content)
        return self.path(name)

    def reader(self, path):
        proxy = OpenDataFile(path)
        name = proxy.GetXMLName()
        Delete(proxy)
        return name

    def test_other_peoples_files_open_as_without_the_plugin(self):
        """A plain name has no part that the plugin looks for."""
        for extension, source in (("vtu", UnstructuredCellTypes()), ("vti", Wavelet()), ("stl", Sphere()), ("vtp", Sphere()),
                                  ("vtk", Sphere()), ("ply", Sphere()), ("csv", Sphere())):
            plain = self.path("plain." + extension)
            SaveData(plain, proxy=source)
            if not os.path.exists(plain):
                plain = self.path("plain_0." + extension)  # a table for each process, say
            wanted = self.reader(plain)
            with open(plain, "rb") as file:
                content = file.read()
            for part in ("init", "partial", "strands", "tck", "trk", "trx", "tck.gz", "json", "substrate"):
                with self.subTest(extension=extension, part=part):
                    self.assertEqual(self.reader(self.write(f"flow.{part}.{extension}", content)), wanted)

    def test_our_files_open_with_our_readers(self):
        with zipfile.ZipFile(self.path("a.trx"), "w") as archive:
            for name, content in trx().items():
                archive.writestr(name, content)
                self.write("folder.trx/" + name, content)
        for name, content in (("a.strands", STRANDS), ("a.init", STRANDS), ("a.partial", STRANDS), ("run.vtu.init", STRANDS)):
            self.assertEqual(self.reader(self.write(name, content)), "StrandReader", name)
        for name, content in (("a.tck", tck()), ("a.trk", trk()), ("a.tck.gz", gzip.compress(tck())), ("a.trk.gz", gzip.compress(trk())),
                              ("a.trx", None), ("folder.trx", None)):
            path = self.path(name) if content is None else self.write(name, content)
            with self.subTest(name=name):
                reader = OpenDataFile(path)
                self.assertEqual(reader.GetXMLName(), "TractogramReader")
                reader.LengthUnit = "Millimetre"
                data = fetch(reader)
                numpy.testing.assert_allclose([data.GetPoint(0), data.GetPoint(1)], POINTS, atol=1e-6)

    def test_a_damaged_file_is_ours_and_says_so(self):
        for name, pattern in (("damaged.tck", "no .tck file"), ("damaged.strands", "neither the side of a cube"), ("damaged.trx", "zip archive")):
            with self.assertError(pattern):
                OpenDataFile(self.write(name, "hello\n")).UpdatePipeline()
        with self.assertError(r"cut\.tck\.gz: it is truncated or damaged"):
            OpenDataFile(self.write("cut.tck.gz", gzip.compress(tck())[:-9])).UpdatePipeline()
        with self.assertError(r"\.tck\.gz"):
            TractogramReader(FileName=self.write("some.trx.gz", b"x")).UpdatePipeline()

    def test_the_choice_among_all_readers_offers_ours_for_our_content_alone(self):
        """As File > Open asks for a name that no reader knows."""
        factory = servermanager.vtkSMProxyManager.GetProxyManager().GetReaderFactory()
        session = servermanager.ActiveConnection.Session

        def offers(path):
            return {name for name in READERS if factory.CanReadFile(path, "sources", name, session)}

        table = "cell_type cell_id X Y Z outer_radius\naxon 0 0 0 0 1\naxon 0 0 0 1 1\n"
        self.assertEqual(offers(self.write("spheres.swc", table)), {"StrandReader"})
        self.assertEqual(offers(self.write("config_output_1.json", '{"voxelSize": 3, "axons": []}')), {"StrandReader"})
        self.assertEqual(offers(self.write("notes.json", '{"name": "of something else"}')), set())
        self.assertEqual(offers(self.write("manifest.json", '{"format": "of something else"}')), set())
        self.assertEqual(offers(self.write("manifest.json", '{"format": "CACTUS substrate folder"}')), {"SubstrateReader"})
        self.assertEqual(offers(self.write("tracks.tck", tck())), {"TractogramReader"})
        SaveData(self.path("image.nii.gz"), proxy=Wavelet())
        self.assertEqual(offers(self.path("image.nii.gz")), {"NiftiReader"})
        self.assertEqual(offers(self.write("radiance.hdr", "#?RADIANCE\n")), set())


if __name__ == "__main__":
    main()
