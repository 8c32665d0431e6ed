# SPDX-License-Identifier: BSD-3-Clause
"""Tractograms through ParaView, held against nibabel: streamlines come in where nibabel has them, fibres go out so that it reads them,
and a bad file gives one error."""

import json
import os
import struct
import zipfile

import nibabel
import numpy
from cactus_testing import CactusTestCase, fetch, main
from nibabel.streamlines import Field, Tractogram, TckFile, TrkFile
from paraview import servermanager
from paraview.simple import BundleInitializer, Calculator, OpenDataFile, SaveData, TractFibres, TractogramReader
from vtkmodules.util.numpy_support import vtk_to_numpy

# A rotated, flipped and anisotropic image: no axis of its voxels is one of the scanner's.
AFFINE = numpy.array([[-0.1, 1.9, 0.2, -30], [1.2, 0.1, -0.1, 12], [0.1, -0.2, -2.5, 70], [0, 0, 0, 1]])


def some_streamlines():
    random = numpy.random.default_rng(7)
    return [random.uniform(-90, 90, (n, 3)).astype("f4") for n in (2, 17, 5)]


def lines(data):
    """The points of each polyline."""
    points = vtk_to_numpy(data.GetPoints().GetData())
    offsets = vtk_to_numpy(data.GetLines().GetOffsetsArray())
    return [points[begin:end] for begin, end in zip(offsets[:-1], offsets[1:])]


def array(data, name):
    return vtk_to_numpy(data.GetArray(name))


class Tractograms(CactusTestCase):
    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, content):
        with open(self.path(name), "wb") as file:
            file.write(content)
        return self.path(name)

    def assertSameStreamlines(self, data, wanted, tolerance, factor=1.0):
        self.assertEqual(data.GetNumberOfLines(), len(wanted))
        for found, one in zip(lines(data), wanted):
            numpy.testing.assert_allclose(found, factor * numpy.asarray(one, "f8"), rtol=0, atol=factor * tolerance)

    def trk(self, name, order="", dimensions=(40, 50, 60), **values):
        """What nibabel writes, and the header that it has written."""
        header = {Field.VOXEL_TO_RASMM: AFFINE, Field.VOXEL_SIZES: nibabel.affines.voxel_sizes(AFFINE),
                  Field.DIMENSIONS: numpy.array(dimensions, "i2")}
        if order:
            header[Field.VOXEL_ORDER] = order
        TrkFile(Tractogram(some_streamlines(), affine_to_rasmm=numpy.eye(4), **values), header).save(self.path(name))
        return self.path(name)

    def test_tck_in(self):
        wanted = some_streamlines()
        TckFile(Tractogram(wanted, affine_to_rasmm=numpy.eye(4))).save(self.path("some.tck"))
        reader = OpenDataFile(self.path("some.tck"))
        self.assertEqual(reader.GetXMLName(), "TractogramReader")
        self.assertSameStreamlines(fetch(reader), wanted, 1e-6, factor=1000.0)
        reader.LengthUnit = "Millimetre"
        self.assertSameStreamlines(fetch(reader), wanted, 1e-6)
        self.assertIsNone(fetch(reader).GetPointData().GetArray("Radius"))
        along = wanted[0][1].astype("f8") - wanted[0][0]
        colours = array(fetch(reader).GetPointData(), "Direction")
        numpy.testing.assert_allclose(colours[0], 255 * numpy.abs(along) / numpy.linalg.norm(along), atol=1)
        numpy.testing.assert_array_equal(colours[0], colours[1])
        reader.Radius = 0.5
        self.assertEqual(set(array(fetch(reader).GetPointData(), "Radius")), {0.0005})

    def test_trk_in(self):
        for order in ("", "RAS", "LPS", "ASR", "SLP"):
            with self.subTest(order=order):
                path = self.trk("some.trk", order)
                wanted = nibabel.streamlines.load(path).streamlines
                data = fetch(TractogramReader(FileName=path, LengthUnit="Millimetre"))
                self.assertSameStreamlines(data, wanted, 1e-4)

    def test_trk_with_values(self):
        streamlines = some_streamlines()
        fa = [numpy.arange(len(one), dtype="f4")[:, None] for one in streamlines]
        path = self.trk("some.trk", data_per_point={"FA": fa, "rgb": [numpy.hstack([one, one, one]) for one in fa]},
                        data_per_streamline={"weight": numpy.array([[3], [4], [5]])})
        data = fetch(TractogramReader(FileName=path))
        numpy.testing.assert_array_equal(array(data.GetPointData(), "FA"), numpy.concatenate(fa)[:, 0])
        self.assertEqual(data.GetPointData().GetArray("rgb").GetNumberOfComponents(), 3)
        numpy.testing.assert_array_equal(array(data.GetCellData(), "weight"), [3, 4, 5])

    def changed(self, path, name, swap=False, **fields):
        """A copy of a .trk with other values in its header, in the other byte order if need be."""
        with open(path, "rb") as file:
            content = file.read()
        header = numpy.frombuffer(content[:1000], nibabel.streamlines.trk.header_2_dtype).copy()
        body = content[1000:]
        for field, value in fields.items():
            header[field] = value
        if swap:
            header = header.byteswap()
            body = numpy.frombuffer(body, "<i4").byteswap().tobytes()
        return self.write(name, header.tobytes() + body)

    def test_trk_of_the_other_byte_order(self):
        path = self.trk("little.trk")
        big = self.changed(path, "big.trk", swap=True)
        wanted = nibabel.streamlines.load(big).streamlines
        self.assertSameStreamlines(fetch(TractogramReader(FileName=big, LengthUnit="Millimetre")), wanted, 1e-4)

    def test_trk_without_a_count(self):
        path = self.changed(self.trk("some.trk"), "uncounted.trk", nb_streamlines=0)
        self.assertEqual(fetch(TractogramReader(FileName=path)).GetNumberOfLines(), 3)

    def test_trk_without_its_space(self):
        """What is assumed is what nibabel assumes, and is said."""
        path = self.changed(self.trk("some.trk"), "version1.trk", version=1, voxel_order=b"LPS")
        wanted = nibabel.streamlines.load(path).streamlines
        reader = TractogramReader(FileName=path, LengthUnit="Millimetre")
        with self.assertError(r"no vox_to_ras.*identity"):
            reader.UpdatePipeline()
        self.assertSameStreamlines(fetch(reader), wanted, 1e-4)

    def test_what_nibabel_takes_is_read_with_a_warning(self):
        """Version 3 of .trk, which nibabel reads as version 2."""
        path = self.trk("some.trk", "LPS")
        wanted = nibabel.streamlines.load(path).streamlines
        for name, pattern, fields in (("third.trk", "version 3, which is read as version 2", {"version": 3}),
                                      ("blank.trk", "voxel_order 'LPS ' has blanks", {"voxel_order": b"LPS "})):
            reader = TractogramReader(FileName=self.changed(path, name, **fields), LengthUnit="Millimetre")
            with self.assertError(pattern):
                reader.UpdatePipeline()
            self.assertSameStreamlines(fetch(reader), wanted, 1e-4)

    def test_a_trx_of_nothing_is_read_with_a_warning(self):
        with zipfile.ZipFile(self.path("none.trx"), "w") as archive:
            archive.writestr("header.json", '{"NB_VERTICES": 0, "NB_STREAMLINES": 0}')
        reader = TractogramReader(FileName=self.path("none.trx"))
        with self.assertError("it holds no streamlines"):
            reader.UpdatePipeline()
        self.assertEqual(fetch(reader).GetNumberOfPoints(), 0)

    def test_short_streamlines_are_left_out_and_counted(self):
        streamlines = some_streamlines()[:1] + [numpy.ones((1, 3), "f4")] + some_streamlines()[1:]
        TckFile(Tractogram(streamlines, affine_to_rasmm=numpy.eye(4))).save(self.path("short.tck"))
        reader = TractogramReader(FileName=self.path("short.tck"))
        with self.assertError(r"1 of 4 streamlines have fewer than two points"):
            reader.UpdatePipeline()
        self.assertSameStreamlines(fetch(reader), some_streamlines(), 1e-6, factor=1000.0)

    def test_bad_files_get_one_error(self):
        with open(self.trk("some.trk"), "rb") as file:
            trk = file.read()
        no_numbers = trk[:1004] + struct.pack("<f", float("nan")) + trk[1008:]
        for name, content, pattern in (
            ("cut.trk", trk[:-4], r"cut\.trk is truncated.*streamline 3"),
            ("cut.tck", b"mrtrix tracks\ndatatype: Float32LE\nEND\n" + bytes(24), r"cut\.tck is truncated"),
            ("none.trk", b"hello", r"none\.trk is truncated"),
            ("nan.trk", no_numbers, r"streamline 1, point 1: its coordinates are nan"),
            ("none.tck", b"hello\n", r"no \.tck file"),
            ("none.trx", b"PK hello", r"none\.trx as a zip archive"),
        ):
            with self.subTest(name=name), self.assertError(pattern):
                TractogramReader(FileName=self.write(name, content)).UpdatePipeline()
        with self.assertError(r"nowhere\.tck"):
            TractogramReader(FileName=self.path("nowhere.tck")).UpdatePipeline()

    def fibres(self):
        return BundleInitializer(Border="Walls", Side=12, FibreVolumeFraction=0.3, MinimumRadius=0.4, NumberOfBundles=2)

    def many(self, name, count):
        """A file of so many streamlines of three points, in any order of the bytes that the format has."""
        points = numpy.random.default_rng(3).uniform(-70, 70, (count, 3, 3)).astype("<f4")
        if name.endswith(".tck"):
            rows = numpy.full((count, 4, 3), numpy.nan, "<f4")
            rows[:, :3] = points
            header = b"mrtrix tracks\ndatatype: Float32LE\nfile: . 128\nEND\n".ljust(128, b"\0")
            return self.write(name, header + rows.tobytes() + numpy.full(3, numpy.inf, "<f4").tobytes()), points
        streamlines = numpy.empty(count, [("size", "<i4"), ("points", "<f4", (3, 3))])
        streamlines["size"], streamlines["points"] = 3, points + 0.5  # its corner is the origin
        header = bytearray(1000)
        struct.pack_into("<6s3h3f", header, 0, b"TRACK", 9, 9, 9, 1, 1, 1)
        struct.pack_into("<16f", header, 440, *numpy.eye(4).ravel())
        struct.pack_into("<4s", header, 948, b"RAS")
        struct.pack_into("<3i", header, 988, count, 2, 1000)
        return self.write(name, bytes(header) + streamlines.tobytes()), points

    def memory(self, what):
        """In MB: VmRSS now, or VmHWM, the most since it was asked for."""
        with open("/proc/self/status", encoding="ascii") as file:
            return next(int(line.split()[1]) / 1024 for line in file if line.startswith(what))

    def test_many_streamlines_take_the_memory_of_their_data(self):
        for name in ("many.tck", "many.trk"):
            path, points = self.many(name, 1000000)
            reader = TractogramReader(FileName=path, LengthUnit="Millimetre")
            with open("/proc/self/clear_refs", "w", encoding="ascii") as file:
                file.write("5")  # the most is what there is now
            before = self.memory("VmRSS")
            reader.UpdatePipeline()
            taken = self.memory("VmHWM") - before
            data = reader.GetDataInformation().GetMemorySize() / 1024
            self.assertGreater(data, 90)
            self.assertLess(taken, 1.2 * data, name)
            output = reader.GetClientSideObject().GetOutput()
            self.assertEqual(output.GetNumberOfLines(), len(points))
            numpy.testing.assert_allclose(vtk_to_numpy(output.GetPoints().GetData()), points.reshape(-1, 3), atol=1e-4)
            os.remove(path)

    def test_tck_out(self):
        fibres = self.fibres()
        SaveData(self.path("fibres.tck"), proxy=fibres)
        written = nibabel.streamlines.load(self.path("fibres.tck"))
        self.assertEqual(int(written.header["count"]), len(written.streamlines))
        self.assertSameStreamlines(fetch(fibres), [1000 * one for one in written.streamlines], 1e-6)

    def test_without_radii(self):
        """What other programs have made is saved in the other format, and gains no radii by it."""
        wanted = some_streamlines()
        TckFile(Tractogram(wanted, affine_to_rasmm=numpy.eye(4))).save(self.path("some.tck"))
        for name in ("other.trx", "again.tck"):
            SaveData(self.path(name), proxy=OpenDataFile(self.path("some.tck")))
            again = fetch(OpenDataFile(self.path(name)))
            self.assertSameStreamlines(again, wanted, 1e-6, factor=1000.0)
            self.assertIsNone(again.GetPointData().GetArray("Radius"))

    def test_trx_out(self):
        """By zipfile and numpy alone. No file is packed, and each stands where readers that map it into memory look for it."""
        fibres = self.fibres()
        SaveData(self.path("fibres.trx"), proxy=fibres)
        data = fetch(fibres)
        numbers = {}
        with zipfile.ZipFile(self.path("fibres.trx")) as archive, open(self.path("fibres.trx"), "rb") as file:
            self.assertIsNone(archive.testzip())
            header = json.loads(archive.read("header.json"))
            for info in archive.infolist():
                content = archive.read(info)
                self.assertEqual(info.compress_type, zipfile.ZIP_STORED)
                file.seek(info.header_offset + 30 + len(info.filename))
                self.assertEqual(file.read(len(content)), content)
                if info.filename != "header.json":
                    numbers[info.filename] = numpy.frombuffer(content, "<" + numpy.dtype(info.filename.split(".")[-1]).str[1:])
        self.assertEqual((header["NB_VERTICES"], header["NB_STREAMLINES"]), (data.GetNumberOfPoints(), data.GetNumberOfLines()))
        affine = numpy.array(header["VOXEL_TO_RASMM"])
        numpy.testing.assert_allclose(affine @ [-0.5, -0.5, -0.5, 1], [-0.006, -0.006, -0.006, 1], atol=1e-9)
        numpy.testing.assert_allclose(affine @ [11.5, 11.5, 11.5, 1], [0.006, 0.006, 0.006, 1], atol=1e-9)
        self.assertEqual(header["DIMENSIONS"], [12, 12, 12])
        numpy.testing.assert_allclose(
            1000 * numbers["positions.3.float32"].reshape(-1, 3), vtk_to_numpy(data.GetPoints().GetData()), atol=1e-6)
        numpy.testing.assert_array_equal(numbers["offsets.uint64"], vtk_to_numpy(data.GetLines().GetOffsetsArray()))
        numpy.testing.assert_allclose(1000 * numbers["dpv/Radius.float32"], array(data.GetPointData(), "Radius"), rtol=1e-6)
        for bundle in (1, 2):
            members = numpy.flatnonzero(array(data.GetCellData(), "BundleId") == bundle)
            numpy.testing.assert_array_equal(numbers[f"groups/bundle_{bundle:05}.uint32"], members)

    def test_trx_and_back(self):
        fibres = fetch(self.fibres())
        SaveData(self.path("fibres.trx"), proxy=self.fibres())
        again = fetch(OpenDataFile(self.path("fibres.trx")))
        self.assertSameStreamlines(again, lines(fibres), 1e-6)
        numpy.testing.assert_allclose(array(again.GetPointData(), "Radius"), array(fibres.GetPointData(), "Radius"), rtol=1e-6)
        for name in ("FibreId", "BundleId"):
            numpy.testing.assert_array_equal(array(again.GetCellData(), name), array(fibres.GetCellData(), name))
        SaveData(self.path("again.tck"), proxy=OpenDataFile(self.path("fibres.trx")))  # fibres for any stage

    def test_streamlines_read_in_mm_are_saved_where_they_were(self):
        wanted = some_streamlines()
        TckFile(Tractogram(wanted, affine_to_rasmm=numpy.eye(4))).save(self.path("some.tck"))
        read = TractogramReader(FileName=self.path("some.tck"), LengthUnit="Millimetre", Radius=0.5)
        for proxy in (read, Calculator(Input=read, Function="coordsX")):
            for name in ("again.tck", "again.trx"):
                SaveData(self.path(name), proxy=proxy)
                self.assertSameStreamlines(fetch(TractogramReader(FileName=self.path(name), LengthUnit="Millimetre")), wanted, 1e-4)
        numpy.testing.assert_allclose(
            array(fetch(OpenDataFile(self.path("again.trx"))).GetPointData(), "Radius"), 0.5, rtol=1e-6)
        laid = TractFibres(Input=read, Side=6, FibreVolumeFraction=0.5)
        SaveData(self.path("laid.tck"), proxy=laid)
        self.assertSameStreamlines(fetch(TractogramReader(FileName=self.path("laid.tck"))), lines(fetch(laid)), 1e-3)

    def test_a_whole_head_is_saved_as_it_was_read(self):
        """Larger than the domain of a substrate may be, in µm."""
        points = numpy.array([[-90, -120, -130], [0, 0, 0], [90, 110, 100]], "<f4")
        header = b"mrtrix tracks\ndatatype: Float32LE\nfile: . 128\nEND\n".ljust(128, b"\0")
        ends = numpy.array([[numpy.nan] * 3, [numpy.inf] * 3], "<f4")
        reader = TractogramReader(FileName=self.write("head.tck", header + points.tobytes() + ends.tobytes()), Radius=0.5)
        SaveData(self.path("again.trx"), proxy=reader)
        self.assertSameStreamlines(fetch(OpenDataFile(self.path("again.trx"))), [1000.0 * points], 1e-3)

    def test_trx_with_groups(self):
        """Packed, as a folder, and with a streamline in two groups."""
        points = numpy.concatenate(some_streamlines()).astype("f8")
        files = {
            "header.json": json.dumps({"VOXEL_TO_RASMM": numpy.eye(4).tolist(), "DIMENSIONS": [1, 1, 1], "NB_VERTICES": 24,
                                       "NB_STREAMLINES": 3}).encode(),
            "positions.3.float64": points.tobytes(),
            "offsets.uint64": numpy.array([0, 2, 19, 24], "u8").tobytes(),
            "groups/AF.uint32": numpy.array([1], "u4").tobytes(),
            "groups/CST.uint32": numpy.array([0, 1], "u4").tobytes(),
        }
        with zipfile.ZipFile(self.path("packed.trx"), "w", zipfile.ZIP_DEFLATED) as archive:
            for name, content in files.items():
                archive.writestr(name, content)
        os.makedirs(self.path("folder.trx/groups"))
        for name, content in files.items():
            self.write("folder.trx/" + name, content)
        for name in ("packed.trx", "folder.trx"):
            data = fetch(TractogramReader(FileName=self.path(name), LengthUnit="Millimetre"))
            self.assertSameStreamlines(data, some_streamlines(), 1e-12)
            names = data.GetFieldData().GetAbstractArray("BundleName")
            self.assertEqual([names.GetValue(i) for i in range(names.GetNumberOfValues())], ["AF", "CST"])
            numpy.testing.assert_array_equal(array(data.GetCellData(), "BundleId"), [2, 1, 3])
            numpy.testing.assert_array_equal(array(data.GetCellData(), "Group AF"), [0, 1, 0])
            numpy.testing.assert_array_equal(array(data.GetCellData(), "Group CST"), [1, 1, 0])

    def test_other_names_are_refused(self):
        with self.assertError(r"\.tck or \.trx"):
            servermanager.writers.TractogramWriter(Input=self.fibres(), FileName=self.path("fibres.trk")).UpdatePipeline()
        self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    main()
