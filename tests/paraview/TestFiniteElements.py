# SPDX-License-Identifier: BSD-3-Clause
# ctest-timeout: 300
"""Folders for SpinDoctor: read line by line as its reader does, and filled with tetrahedra by tetgen, whose compartments have the right volumes."""

import csv
import math
import os
import subprocess

import numpy
from cactus_testing import CactusTestCase, fetch, main, produce
from paraview.simple import (BundleInitializer, CapsuleOptimizer, FibreRadialGrowth, MyelinSurface, OutputPort, SubstrateCertificate,
                             SubstrateStatistics, SubstrateWriter)
from paraview.vtk.util.numpy_support import vtk_to_numpy
from surfaces import POLYGON, surfaces, tube, two_tubes


class Lines:
    """A file one line after the other, as fgetl and sscanf take it."""

    def __init__(self, path):
        with open(path) as file:
            self.lines = iter(file.read().splitlines())

    def skip(self, count):
        for _ in range(count):
            assert next(self.lines)[0] in "#0"

    def numbers(self):
        return [float(word) for word in next(self.lines).split()]


class FiniteElements(CactusTestCase):
    def write(self, **properties):
        folder = os.path.join(self.folder, "substrate")
        SubstrateWriter(FolderName=folder, Format="SpinDoctor", **properties).UpdatePipeline()
        return folder

    def mesh_name(self, folder):
        return os.path.join(folder, "substrate_dir", "substrate_mesh")

    def surfaces_of(self, folder):
        """Points, triangles with their markers, and places with their compartments, where SpinDoctor's read_surfaces expects them."""
        nodes = Lines(self.mesh_name(folder) + ".node")
        nodes.skip(2)
        count = int(nodes.numbers()[0])
        nodes.skip(1)
        points = numpy.array([nodes.numbers()[1:] for _ in range(count)])
        self.assertEqual((points.shape, list(nodes.lines)), ((count, 3), []))
        poly = Lines(self.mesh_name(folder) + ".poly")
        poly.skip(5)
        count = int(poly.numbers()[0])
        poly.skip(1)
        markers, triangles = [], []
        for _ in range(count):
            polygons, holes, marker = poly.numbers()
            corners, *triangle = poly.numbers()
            self.assertEqual((polygons, holes, corners, len(triangle)), (1, 0, 3, 3))
            markers.append(int(marker))
            triangles.append([int(corner) - 1 for corner in triangle])
        poly.skip(3)
        places = [poly.numbers() for _ in range(int(poly.numbers()[0]))]
        self.assertEqual(list(poly.lines), [])
        return points, numpy.array(triangles), numpy.array(markers), places

    def tetrahedra(self, folder):
        """Volumes by compartment, and the boundaries, of what tetgen makes of it, with quality and without a word of complaint."""
        name = self.mesh_name(folder)
        done = subprocess.run(["tetgen", "-d", name + ".poly"], capture_output=True, text=True, check=True)
        self.assertIn("No faces are intersecting", done.stdout)
        done = subprocess.run(["tetgen", "-pqA", name + ".poly"], capture_output=True, text=True, check=True)
        for complaint in ("Warning", "Error", "Failed", "invalid"):
            self.assertNotIn(complaint, done.stdout + done.stderr)
        points = numpy.loadtxt(name + ".1.node", skiprows=1)[:, 1:4]
        elements = numpy.loadtxt(name + ".1.ele", skiprows=1, dtype=int)
        markers = numpy.loadtxt(name + ".1.face", skiprows=1, dtype=int)[:, 4]
        a, b, c, d = (points[elements[:, i] - 1] for i in range(1, 5))
        volumes = numpy.abs(numpy.einsum("ij,ij->i", b - a, numpy.cross(c - a, d - a))) / 6
        return numpy.bincount(elements[:, 5], volumes)[1:], sorted(set(markers))

    def compartments(self, folder):
        with open(os.path.join(folder, "compartments.csv")) as file:
            return list(csv.DictReader(file))

    def test_two_tubes(self):
        _, outer, inner = two_tubes(inset=0.05)
        folder = self.write(Outer=produce(outer), Inner=produce(inner))
        axons = [10 * POLYGON * r * r for r in (0.7, 0.9)]  # up to the faces
        fibres = [10 * POLYGON * r * r for r in (1.0, 1.5)]
        expected = axons + [fibre - axon for fibre, axon in zip(fibres, axons)] + [1000 - sum(fibres)]
        volumes, boundaries = self.tetrahedra(folder)
        numpy.testing.assert_allclose(volumes, expected, rtol=1e-6)
        self.assertEqual(boundaries, list(range(1, 10)))
        rows = self.compartments(folder)
        self.assertEqual([(row["Compartment"], row["Kind"], row["FibreId"]) for row in rows],
                         [("1", "axon", "3"), ("2", "axon", "5"), ("3", "myelin", "3"), ("4", "myelin", "5"), ("5", "extra-axonal", "0")])
        numpy.testing.assert_allclose([float(row["Volume_um3"]) for row in rows], expected, rtol=1e-7)

    def test_boundaries_are_numbered_as_spindoctor_does(self):
        _, outer, inner = two_tubes(inset=0.05)
        points, triangles, markers, places = self.surfaces_of(self.write(Outer=produce(outer), Inner=produce(inner)))
        areas = 0.5 * numpy.linalg.norm(
            numpy.cross(points[triangles[:, 1]] - points[triangles[:, 0]], points[triangles[:, 2]] - points[triangles[:, 0]]), axis=1)
        walls = [10 * 96 * r * math.sin(math.pi / 48) for r in (0.7, 0.9, 1.0, 1.5)]  # in,out and out,ecs
        disks = [2 * POLYGON * r * r for r in (0.7, 0.9, 1.0, 1.5)]
        rest = 600 - disks[2] - disks[3]
        expected = walls + disks[:2] + [disks[2] - disks[0], disks[3] - disks[1], rest]  # in, out and ecs
        numpy.testing.assert_allclose(numpy.bincount(markers, areas)[1:], expected, rtol=1e-7)
        faces = numpy.abs(points[triangles]).max(axis=1).max(axis=1) == 5  # as they lie within it, only what has a point on one
        self.assertTrue(faces[markers > 4].all())
        self.assertEqual([int(place[4]) for place in places], [1, 2, 3, 4, 5])
        for _, x, y, z, compartment, _ in places:
            away = [math.hypot(x - middle, y) for middle in (-2, 2)]
            fibre = int(away[1] < away[0])
            expected = 1 + fibre if away[fibre] < (0.7, 0.9)[fibre] else 3 + fibre if away[fibre] < (1, 1.5)[fibre] else 5
            self.assertEqual((int(compartment), abs(z) < 5), (expected, True))

    def test_a_grown_substrate(self):
        """The tetrahedra of each kind of compartment are what the statistics say, within 0.2 points."""
        bundle = BundleInitializer(Border="Walls", CalibreVariation=0, Side=6, FibreVolumeFraction=0.4, MinimumRadius=0.7, MeanDispersion=8, GrownFibreVolumeFraction=0.5)
        fibres = OutputPort(CapsuleOptimizer(Input=bundle), 0)
        made = MyelinSurface(Input=FibreRadialGrowth(Input=fibres, MinimumGap=0.1, VoxelSize=0.08))
        parts = {"Fibres": fibres, "Outer": OutputPort(made, 0), "Inner": OutputPort(made, 1)}
        folder = self.write(**parts)
        volumes, _ = self.tetrahedra(folder)
        rows = self.compartments(folder)
        numpy.testing.assert_allclose(volumes, [float(row["Volume_um3"]) for row in rows], rtol=1e-5)
        table = fetch(SubstrateStatistics(**parts))
        axons, myelin, all_fibres = (table.GetValueByName(0, name).ToDouble() for name in ("AVF", "MVF", "FVF"))
        for kind, fraction in (("axon", axons), ("myelin", myelin), ("extra-axonal", 1 - all_fibres)):
            part = sum(volume for volume, row in zip(volumes, rows) if row["Kind"] == kind)
            self.assertAlmostEqual(part / 216, fraction, delta=0.002)

    def test_even_triangles(self):
        """With MinimumAngle a grown substrate is certified as ever, and 99 % of its triangles have no smaller angle."""
        bundle = BundleInitializer(Border="Walls", CalibreVariation=0, Side=5, FibreVolumeFraction=0.4, MinimumRadius=0.6, MeanDispersion=10, GrownFibreVolumeFraction=0.5)
        fibres = OutputPort(CapsuleOptimizer(Input=bundle), 0)
        grown = FibreRadialGrowth(Input=fibres, MinimumGap=0.1)
        fractions = []
        for angle in (0, 20):
            made = MyelinSurface(Input=grown, MinimumAngle=angle)
            parts = {"Fibres": fibres, "Outer": OutputPort(made, 0), "Inner": OutputPort(made, 1)}
            verdict = fetch(SubstrateCertificate(**parts))
            self.assertEqual(verdict.GetValueByName(0, "Certified").ToInt(), 1)
            table = fetch(SubstrateStatistics(**parts))
            fractions.append([table.GetValueByName(0, name).ToDouble() for name in ("AVF", "FVF")])
            below = [self.angles(fetch(made, port)) < math.radians(20) for port in (0, 1)]
            below = numpy.concatenate(below).mean()
            self.assertTrue(below < 0.01 if angle else below > 0.5, below)
        numpy.testing.assert_allclose(fractions[1], fractions[0], rtol=0.003)

    def angles(self, surface):
        """The smallest angle of each triangle."""
        points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
        corners = points[vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
        sides = corners - numpy.roll(corners, 1, axis=1)
        unit = sides / numpy.linalg.norm(sides, axis=2, keepdims=True)
        return numpy.arccos(-(unit * numpy.roll(unit, 1, axis=1)).sum(axis=2).clip(-1, 1)).min(axis=1)

    def test_what_spindoctor_would_refuse_is_said(self):
        """A fibre without an axon, and one that ends inside the domain: any other finite elements take it."""
        outer = surfaces({3: tube(-2, 0, 1.0, 10), 5: tube(2, 0, 1.5, 8)}, 0, 10)
        inner = surfaces({3: tube(-2, 0, 0.7, 9.9)}, 1, 10)
        with self.assertError("create_geometry refuses this mesh, since not every one of the 2 fibres has an axon"):
            folder = self.write(Outer=produce(outer), Inner=produce(inner))
        volumes, boundaries = self.tetrahedra(folder)
        areas = [POLYGON * r * r for r in (0.7, 1.0, 1.5)]
        numpy.testing.assert_allclose(
            volumes, [10 * areas[0], 10 * (areas[1] - areas[0]), 8 * areas[2], 1000 - 10 * areas[1] - 8 * areas[2]], rtol=1e-6)
        self.assertEqual(boundaries, [1, 2, 3, 4, 5, 7])  # 6 would be where fibre 5's myelin ends
        with open(os.path.join(folder, "README.txt")) as file:
            self.assertIn("create_geometry refuses", file.read())

    def test_axons_that_do_not_fit_stay_closed(self):
        """A fibre that narrows just before a face, which its axon would leave on the way to it."""
        fibre = tube(0, 0, 1.0, 10)
        for i in range(fibre.GetNumberOfPoints()):
            x, y, z = fibre.GetPoint(i)
            scale = 0.8 if z == 5 else 1
            fibre.GetPoints().SetPoint(i, scale * x, scale * y, z)
        axon = tube(0, 0, 0.83, 9.6)
        with self.assertError(r"axons of 1 fibres \(such as 3\) end just before the faces"):
            folder = self.write(Outer=produce(surfaces({3: fibre}, 0, 10)), Inner=produce(surfaces({3: axon}, 1, 10)))
        volumes, _ = self.tetrahedra(folder)
        self.assertAlmostEqual(volumes[0], 9.8 * POLYGON * 0.83**2, 4)  # the other end reaches its face

    def test_surfaces_beyond_the_domain_are_refused(self):
        outer = surfaces({3: tube(0, 0, 1.0, 12)}, 0, 10)
        with self.assertError("reaches out of the domain: turn on ClipToDomain"):
            self.write(Outer=produce(outer))
        self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    main()
