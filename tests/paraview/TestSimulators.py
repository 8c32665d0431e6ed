# SPDX-License-Identifier: BSD-3-Clause
"""Folders for simulators, read back by lines of numpy that share nothing with the writer: volumes, compartments and units are right."""

import math
import os
import re

import numpy
from cactus_testing import CactusTestCase, main, produce
from paraview.simple import SubstrateWriter
from surfaces import POLYGON, two_tubes

AXONS = {3: (-2, 0.7), 5: (2, 0.9)}
FIBRES = {3: (-2, 1.0), 5: (2, 1.5)}
LENGTH = {"inner": 9.9, "outer": 10}
TUBES = {"inner": AXONS, "outer": FIBRES}


def volume(vertices, faces):
    corners = vertices[faces]
    return numpy.einsum("ij,ij->", corners[:, 0], numpy.cross(corners[:, 1], corners[:, 2])) / 6


def read_ply(path):
    """Vertices and faces of an ASCII PLY file, and its comments."""
    with open(path) as file:
        text = file.read()
    head, body = text.split("end_header\n")
    counts = [int(n) for n in re.findall(r"element (?:vertex|face) (\d+)", head)]
    lines = body.splitlines()
    assert len(lines) == sum(counts)
    vertices = numpy.array([line.split() for line in lines[: counts[0]]], float)
    faces = numpy.array([line.split() for line in lines[counts[0] :]], int)
    assert (faces[:, 0] == 3).all()
    return vertices, faces[:, 1:], re.findall(r"comment (.*)", head)


def depth(points, tubes):
    """How deep each point lies in the nearest tube along z (all that bounds it is its polygon)."""
    sectors = 2 * math.pi / 48
    deepest = numpy.full(len(points), -numpy.inf)
    for x, radius in tubes.values():
        d = points[:, :2] - [x, 0]
        angle = numpy.arctan2(d[:, 1], d[:, 0])
        side = (numpy.floor(angle / sectors) + 0.5) * sectors
        height = numpy.hypot(d[:, 0], d[:, 1]) * numpy.cos(angle - side)
        deepest = numpy.maximum(deepest, radius * math.cos(sectors / 2) - height)
    return deepest


class Simulators(CactusTestCase):
    def write(self, **properties):
        lines, outer, inner = two_tubes(inset=0.05)
        folder = os.path.join(self.folder, "substrate")
        SubstrateWriter(Outer=produce(outer), Inner=produce(inner), Fibres=produce(lines), FolderName=folder,
                        **properties).UpdatePipeline()
        return lambda *names: os.path.join(folder, *names)

    def starts(self, path, unit, shift=(0, 0, 0)):
        """Points in µm, and that each lies where its file says."""
        result = {}
        for name in ("intra", "myelin", "extra"):
            points = numpy.loadtxt(path("start", name + ".txt")) / unit + shift
            inside, within = (
                (depth(points, TUBES[kind]) > -1e-6) & (abs(points[:, 2]) < LENGTH[kind] / 2 + 1e-6) for kind in ("inner", "outer"))
            wanted = {"intra": (True, True), "myelin": (False, True), "extra": (False, False)}[name]
            self.assertTrue((inside == wanted[0]).all() and (within == wanted[1]).all(), name)
            self.assertLessEqual(numpy.abs(points).max(), 5 + 1e-6)
            result[name] = points
        return result

    def test_reference_program(self):
        path = self.write(Format="Reference program", StartPositions=200)
        with open(path("optimized_final.txt")) as file:
            lines = file.read().split("\n")
        self.assertEqual([float(word) for word in lines[:3]], [10, 2, 13])
        names = sorted(os.listdir(path("meshes", "simulations")))
        self.assertEqual(names, [f"strand_0000{n}_{kind}_erode_0.ply" for n in (3, 5) for kind in ("inner", "outer")])
        for n in (3, 5):
            for kind, tubes in TUBES.items():
                vertices, faces, _ = read_ply(path("meshes", "simulations", f"strand_0000{n}_{kind}_erode_0.ply"))
                self.assertAlmostEqual(volume(vertices, faces), LENGTH[kind] * POLYGON * tubes[n][1] ** 2, 4)
        starts = self.starts(path, 1.0)
        self.assertEqual({len(points) for points in starts.values()}, {200})

    def test_camino(self):
        path = self.write(Format="Camino", StartPositions=50)
        for kind, tubes in TUBES.items():
            vertices, faces, comments = read_ply(path(kind + ".ply"))
            self.assertEqual(comments, ["closed surface"])
            self.assertAlmostEqual(1e18 * volume(vertices, faces), LENGTH[kind] * POLYGON * sum(r * r for _, r in tubes.values()), 4)
            numpy.testing.assert_allclose(abs(vertices[:, 2]).max(), LENGTH[kind] / 2e6)
        self.starts(path, 1e-6)

    def test_disimpy(self):
        path = self.write(Format="Disimpy", StartPositions=300)
        boxes = {}
        for kind, tubes in TUBES.items():
            vertices, faces = numpy.load(path(kind + "_vertices.npy")), numpy.load(path(kind + "_faces.npy"))
            self.assertEqual((vertices.dtype, faces.dtype), (numpy.dtype("f8"), numpy.dtype("i8")))
            self.assertAlmostEqual(1e18 * volume(vertices, faces), LENGTH[kind] * POLYGON * sum(r * r for _, r in tubes.values()), 4)
            self.assertEqual(vertices.min(axis=0).tolist(), [0, 0, 0])  # where Disimpy would move them to
            boxes[kind] = vertices.max(axis=0)
        points = {name: numpy.loadtxt(path("start", name + ".txt")) for name in ("intra", "myelin", "extra")}
        for name, kind in (("intra", "inner"), ("myelin", "outer"), ("extra", "outer")):
            tubes = TUBES[kind]
            self.assertTrue((points[name] >= 0).all() and (points[name] <= boxes[kind]).all())
            corner = numpy.array([min(x - r for x, r in tubes.values()), -max(r for _, r in tubes.values()), -LENGTH[kind] / 2])
            inside = depth(1e6 * points[name] + corner, tubes) > -1e-6
            self.assertEqual(set(inside), {name != "extra"}, name)
        self.assertEqual(len(points["intra"]), 300)

    def test_starts_fill_each_compartment_evenly(self):
        path = self.write(StartPositions=20000, Seed=5)
        starts = self.starts(path, 1e-3)
        intra = starts["intra"]
        share = 0.7**2 / (0.7**2 + 0.9**2)
        self.assertAlmostEqual((intra[:, 0] < 0).mean(), share, delta=5 * math.sqrt(share / 20000))
        for points in starts.values():
            self.assertAlmostEqual(points[:, 2].mean(), 0, delta=5 * math.sqrt(100 / 12 / 20000))

    def test_permeability(self):
        path = self.write(Permeability=0.02)
        with open(path("mcdc", "intra_ply_list.txt")) as file:
            self.assertEqual(file.read(), "inner/fibre_00003.ply 1e-3 0.02\ninner/fibre_00005.ply 1e-3 0.02\n")
        with open(path("mcdc", "intra.conf")) as file:
            text = file.read()
        self.assertIn("\nply_file_list_scale_permeability mcdc/intra_ply_list.txt\n", text)
        self.assertIn("\npermeability 0.02\n", text)

    def test_what_a_format_needs(self):
        _, outer, _ = two_tubes()
        with self.assertError(r"Format Reference program .*connect Inner and Fibres"):
            SubstrateWriter(Outer=produce(outer), FolderName=os.path.join(self.folder, "substrate"),
                            Format="Reference program").UpdatePipeline()
        self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    main()
