# SPDX-License-Identifier: BSD-3-Clause
"""Folders for simulators, read back by lines of numpy that share nothing with the writer: volumes, compartments and units are right."""

import json
import math
import os
import re

import numpy
from cactus_testing import CactusTestCase, fetch, main, produce
from paraview.simple import SubstrateSampler, SubstrateWriter
from surfaces import POLYGON, surfaces, tube, two_tubes
from vtkmodules.vtkIOImage import vtkMetaImageWriter

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
        path = self.write(Format="Surfaces alone", StartPositions=20000, Seed=5)
        starts = self.starts(path, 1.0)
        intra = starts["intra"]
        share = 0.7**2 / (0.7**2 + 0.9**2)
        self.assertAlmostEqual((intra[:, 0] < 0).mean(), share, delta=5 * math.sqrt(share / 20000))
        for points in starts.values():
            self.assertAlmostEqual(points[:, 2].mean(), 0, delta=5 * math.sqrt(100 / 12 / 20000))

    def test_walkers_of_mcdc_start_in_the_boxes_of_its_configurations(self):
        starts = self.starts(self.write(StartPositions=500), 1e-3)
        for name, half in (("intra", 2.5), ("extra", 1.25)):
            self.assertLessEqual(numpy.abs(starts[name]).max(), half)
            self.assertGreater(numpy.abs(starts[name]).max(), 0.95 * half)

    def test_permeability(self):
        path = self.write(Permeability=0.02)
        with open(path("mcdc", "intra_ply_list.txt")) as file:
            self.assertEqual(file.read(), "inner/fibre_00003.ply 1e-3 0.02\ninner/fibre_00005.ply 1e-3 0.02\n")
        with open(path("mcdc", "intra.conf")) as file:
            text = file.read()
        self.assertIn("\nply_file_list_scale_permeability mcdc/intra_ply_list.txt\n", text)
        self.assertIn("\ndeportation 0\n", text)
        self.assertNotIn("\npermeability ", text)
        self.assertEqual(len(self.starts(path, 1e-3)["intra"]), 1000)

    def test_says_how_many_walkers_leave(self):
        self.usual = None
        with self.assertError(r"100 % of the walkers of mcdc/extra.conf leave the substrate within its 35 ms.*for at most 5 %"):
            path = self.write()
        with open(path("manifest.json")) as file:
            self.assertGreater(json.load(file)["extra_walkers_leaving"], 0.9)

    def read_rms(self, folder):
        """As RMS's main.cu reads it: numbers in their order, whatever the line they are in; voxel (x, y, z) at (x·ny + y)·nz + z."""
        words = {}
        for name in ("simParamInput", "fiber", "diffusivity", "T2", "bval", "bvec"):
            with open(os.path.join(folder, name + ".txt")) as file:
                words[name] = file.read().split()
        step, steps, walkers, gradients, compartments, edge, *count = words["simParamInput"]
        count = [int(n) for n in count]
        labels = numpy.array(words["fiber"], int)
        self.assertEqual(len(labels), math.prod(count))
        self.assertEqual([len(words[name]) for name in ("diffusivity", "T2", "bval", "bvec")],
                         [int(compartments)] * 2 + [int(gradients), 3 * int(gradients)])
        numbers = {name: numpy.array(words[name], float) for name in ("diffusivity", "T2", "bval", "bvec")}
        return labels.reshape(count), float(step), int(steps), int(walkers), float(edge), numbers

    def test_rms(self):
        path = self.write(Format="RMS", VoxelSize=0.125)
        self.assertEqual(sorted(os.listdir(path("outer"))), ["fibre_00003.ply", "fibre_00005.ply"])
        middles = (numpy.arange(80) + 0.5) * 0.125 - 5
        x, y, z = (axis.ravel() for axis in numpy.meshgrid(middles, middles, middles, indexing="ij"))
        place = numpy.column_stack([x, y, z])
        deep = {kind: numpy.minimum(depth(place, tubes), LENGTH[kind] / 2 - abs(z)) for kind, tubes in TUBES.items()}
        half = 0.125 * math.sqrt(3) / 2  # of a voxel's diagonal: beyond it a voxel is wholly in or out
        for compartment, kind, sign in (("intra", "inner", 1), ("extra", "outer", -1)):
            labels, step, steps, walkers, edge, numbers = self.read_rms(path(compartment))
            self.assertEqual((labels.shape, edge, walkers, sorted(set(labels.ravel()))), ((80, 80, 80), 0.125, 1000, [0, 1]))
            wanted = sign * deep[kind] > 0
            sure = abs(deep[kind]) > half
            self.assertTrue(sure.mean() > 0.8 and (labels.ravel()[sure] == wanted[sure]).all())
            volume = 10 * POLYGON * sum(r * r for _, r in TUBES[kind].values())
            volume = volume * LENGTH[kind] / 10 if sign > 0 else 1000 - volume
            self.assertAlmostEqual(labels.sum() * edge**3 / volume, 1, delta=0.02)
            # Steps of at most half a voxel, a multiple of the thousand moments that RMS saves, over MC/DC's 35 ms.
            self.assertEqual(steps % 1000, 0)
            self.assertAlmostEqual(step * steps, 35, places=4)
            self.assertLessEqual(math.sqrt(6 * 2 * step), 0.5 * edge * (1 + 1e-6))
            self.assertEqual(numbers["diffusivity"].tolist(), [0, 2])
            self.assertTrue((numbers["T2"] > 1e6).all())
            self.assertEqual(sorted(set(numbers["bval"])), [1, 2, 3])
            numpy.testing.assert_allclose(numpy.linalg.norm(numbers["bvec"].reshape(-1, 3), axis=1), 1, atol=1e-7)

    def test_raw_file_and_header(self):
        """The lines of docs/simulators.md."""
        _, outer, inner = two_tubes(inset=0.05)
        image = fetch(SubstrateSampler(Outer=produce(outer), Inner=produce(inner), VoxelSize=0.25))
        image.GetPointData().SetActiveScalars("Compartment")
        writer = vtkMetaImageWriter()
        writer.SetInputData(image)
        writer.SetFileName(os.path.join(self.folder, "compartment.mhd"))
        writer.SetRAWFileName(os.path.join(self.folder, "compartment.raw"))
        writer.SetCompression(False)
        writer.Write()
        labels = numpy.fromfile(os.path.join(self.folder, "compartment.raw"), numpy.uint8).reshape(40, 40, 40)
        with open(os.path.join(self.folder, "compartment.mhd")) as file:
            head = dict(line.strip().split(" = ") for line in file)
        self.assertEqual((head["ElementType"], head["DimSize"], head["ElementSpacing"]), ("MET_UCHAR", "40 40 40", "0.25 0.25 0.25"))
        self.assertEqual([float(word) for word in head["Offset"].split()], [-4.875] * 3)
        row = labels[20, 20]  # along x, beside the middles of both fibres
        x = (numpy.arange(40) + 0.5) * 0.25 - 5
        for fibre, (middle, radius) in FIBRES.items():
            self.assertEqual(set(row[abs(x - middle) < AXONS[fibre][1] - 0.25]), {1})
            self.assertEqual(set(row[abs(abs(x - middle) - (radius + AXONS[fibre][1]) / 2) < 0.1]), {2})
        self.assertEqual(row[[0, 20, 39]].tolist(), [0, 0, 0])

    def test_labels_that_rms_could_not_use(self):
        near = {3: tube(-1, 0, 0.9, 9.9), 5: tube(1, 0, 0.9, 9.9)}
        around = {3: tube(-1, 0, 0.95, 10), 5: tube(1, 0, 0.95, 10)}
        folder = os.path.join(self.folder, "substrate")
        for size, why in ((0.3, r"VoxelSize 0.3 µm does not divide the domain's side of 10 µm.* such as 0.294117647"),
                          (1.0, "voxels inside fibres 3 and 5 share a face.* choose a smaller one"),
                          (10.0, "leaves no voxel to the walkers of intra/fiber.txt")):
            with self.assertError(why):
                SubstrateWriter(Outer=produce(surfaces(around, 0, 10)), Inner=produce(surfaces(near, 1, 10)), FolderName=folder, Format="RMS",
                                VoxelSize=size).UpdatePipeline()
            self.assertEqual(os.listdir(self.folder), [])

    def test_gaps_that_rms_would_lose_are_told(self):
        thin = {3: tube(-1, 0, 0.7, 9.9), 5: tube(1, 0, 0.7, 9.9)}
        around = {3: tube(-1, 0, 0.95, 10), 5: tube(1, 0, 0.95, 10)}
        folder = os.path.join(self.folder, "substrate")
        with self.assertError(r"too slow across the fibres: 2 of 2 fibres come nearer to another one than a voxel, 0\.125 µm.* MinimumGap of 0\.125 µm"):
            SubstrateWriter(Outer=produce(surfaces(around, 0, 10)), Inner=produce(surfaces(thin, 1, 10)), FolderName=folder, Format="RMS",
                            VoxelSize=0.125).UpdatePipeline()
        with open(os.path.join(folder, "README.txt")) as file:
            self.assertIn("2 of 2 fibres come nearer", file.read())

    def test_mcmr_simulator(self):
        """By the rules of its reader: a Mesh has vertices and triangles that count from 1, and Walls a direction and two places."""
        path = self.write(Format="MCMRSimulator", StartPositions=50)
        with open(path("geometry.json")) as file:
            outer, inner, *walls = json.load(file)
        for kind, mesh in (("outer", outer), ("inner", inner)):
            self.assertEqual(sorted(mesh), ["triangles", "type", "vertices"])
            vertices, faces = numpy.array(mesh["vertices"]), numpy.array(mesh["triangles"]) - 1
            self.assertEqual((mesh["type"], faces.min(), faces.max()), ("Mesh", 0, len(vertices) - 1))
            self.assertAlmostEqual(volume(vertices, faces), LENGTH[kind] * POLYGON * sum(r * r for _, r in TUBES[kind].values()), 4)
        self.assertEqual([(wall["type"], wall["rotation"].index(1), wall["position"]) for wall in walls],
                         [("Walls", axis, [-4.999, 4.999]) for axis in range(3)])
        self.starts(path, 1.0)

    def test_what_a_format_needs(self):
        _, outer, _ = two_tubes()
        with self.assertError(r"Format Reference program .*connect Inner and Fibres"):
            SubstrateWriter(Outer=produce(outer), FolderName=os.path.join(self.folder, "substrate"),
                            Format="Reference program").UpdatePipeline()
        self.assertEqual(os.listdir(self.folder), [])


if __name__ == "__main__":
    main()
