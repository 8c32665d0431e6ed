# SPDX-License-Identifier: BSD-3-Clause
# ctest-timeout: 600
"""A substrate in a periodic domain: copies side by side are one tissue, for the mesh oracle, a walk and simulators."""

import json
import os

import numpy as np
from cactus_testing import CactusTestCase, fetch, main, mesh_oracle, random_walk
from paraview import servermanager
from paraview.simple import (
    BundleInitializer, CapsuleOptimizer, FibreRadialGrowth, MyelinSurface, OutputPort, SubstrateCertificate, SubstrateStatistics, SubstrateWriter,
    TrivialProducer,
)
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkCleanPolyData, vtkTriangleFilter
from vtkmodules.vtkFiltersSources import vtkCubeSource

SIDE = 8.0


def mesh_of(data):
    """Points, triangles and the fibre of each triangle."""
    points = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
    triangles = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return points, triangles, vtk_to_numpy(data.GetCellData().GetArray("FibreId"))


def row(proxy):
    table = fetch(proxy)
    columns = (table.GetColumn(i) for i in range(table.GetNumberOfColumns()))
    return {column.GetName(): column.GetVariantValue(0).ToDouble() for column in columns}


def write_off(path, points, triangles):
    with open(path, "w", encoding="ascii") as file:
        file.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
        np.savetxt(file, points, fmt="%.17g")
        np.savetxt(file, np.c_[np.full(len(triangles), 3), triangles], fmt="%d")


class TestPeriodic(CactusTestCase):
    def chain(self, border="Periodic", voxel=0.1, **options):
        bundle = BundleInitializer(**{"Side": SIDE, "Border": border, "MeanDispersion": 8, **options})
        fibres = CapsuleOptimizer(Input=bundle)
        return fibres, MyelinSurface(Input=FibreRadialGrowth(Input=fibres, VoxelSize=voxel))

    def test_copies_are_one_tissue(self):
        fibres, surfaces = self.chain()
        data = fetch(fibres)
        self.assertEqual(vtk_to_numpy(data.GetFieldData().GetArray("Periodic")).tolist(), [1, 1, 1])
        self.assertEqual(data.GetFieldData().GetArray("Converged").GetValue(0), 1)
        reached = row(SubstrateStatistics(Fibres=fibres, Outer=OutputPort(surfaces, 0), Inner=OutputPort(surfaces, 1), ExtraAxonalWalkers=50, WalkDistance=6))
        self.assertAlmostEqual(reached["FVF"], 0.9, delta=0.01)
        self.assertAlmostEqual(reached["CapsuleVolumeFraction"], 0.6, delta=0.01)
        self.assertEqual(reached["Fibres"], data.GetNumberOfCells())
        for axis in "XYZ":
            self.assertLess(reached[f"ExtraAxonalDiffusivityRatio{axis}"], 1)
            self.assertGreater(reached[f"ExtraAxonalDiffusivityRatio{axis}"], 0)
        certificate = row(SubstrateCertificate(Outer=OutputPort(surfaces, 0), Inner=OutputPort(surfaces, 1)))
        self.assertEqual(certificate["Certified"], 1)

        # Eight copies, without the caps between them.
        points, triangles, fibre = mesh_of(fetch(surfaces))
        half = SIDE / 2
        folder = os.path.join(self.folder, "copies")
        os.makedirs(folder)
        for one in np.unique(fibre):
            corners = []
            for copy in np.ndindex(2, 2, 2):
                inner_face = np.where(np.array(copy) == 0, half, -half)
                own = triangles[fibre == one]
                is_between = np.any(np.all(points[own] == inner_face, axis=1), axis=1)
                corners.append(points[own[~is_between]] + SIDE * np.array(copy))
            corners = np.concatenate(corners).reshape(-1, 3)
            places, numbers = np.unique(corners, axis=0, return_inverse=True)
            edges = self.on_box_edges(places, numbers.reshape(-1, 3))
            write_off(os.path.join(folder, f"fibre_{one}.off"), places, edges)
        judged = mesh_oracle(folder, "--gap", "0.02")
        self.assertGreater(len(judged["meshes"]), 20)
        for mesh in judged["meshes"]:
            self.assertFalse(mesh["self_intersecting"], mesh["file"])
        self.assertEqual(judged["pairs"], [])

    def test_certificate_measures_across_faces(self):
        """Two cubes, 4.5 apart in the domain and 0.5 across its faces."""
        both = vtkAppendPolyData()
        for fibre, x in ((1, -2.875), (2, 2.625)):
            cube = vtkCubeSource()
            cube.SetCenter(x, 0, 0)
            triangles = vtkTriangleFilter()
            triangles.SetInputConnection(cube.GetOutputPort())
            merged = vtkCleanPolyData()
            merged.SetInputConnection(triangles.GetOutputPort())
            merged.Update()
            surface = merged.GetOutput()
            ids = numpy_to_vtk(np.full(surface.GetNumberOfCells(), fibre), deep=True)
            ids.SetName("FibreId")
            surface.GetCellData().AddArray(ids)
            both.AddInputData(surface)
        both.Update()
        domain = numpy_to_vtk(np.array([-3.5, 3.5] * 3), deep=True)
        domain.SetName("Domain")
        both.GetOutput().GetFieldData().AddArray(domain)
        for periodic, gap in ((None, 4.5), ([0, 0, 0], 4.5), ([1, 1, 0], 0.5)):
            data = vtkPolyData()
            data.DeepCopy(both.GetOutput())
            if periodic is not None:
                flags = numpy_to_vtk(np.array(periodic, dtype=np.uint8), deep=True)
                flags.SetName("Periodic")
                data.GetFieldData().AddArray(flags)
            outer = TrivialProducer()
            outer.GetClientSideObject().SetOutput(data)
            self.assertAlmostEqual(row(SubstrateCertificate(Outer=outer))["SmallestGap_um"], gap, places=9)

    @staticmethod
    def on_box_edges(places, triangles):
        """The triangles of walls: caps of different faces share the edges of the domain, on which each has points of its own."""
        low, high = places.min(axis=0), places.max(axis=0)
        is_on = [places[:, axis] == end[axis] for axis in range(3) for end in (low, high)]
        is_cap = np.any([on[triangles].all(axis=1) for on in is_on], axis=0)
        return triangles[~is_cap]

    def assert_corners(self, folder, *names):
        """MC/DC's boxes of these names are the domain."""
        with open(os.path.join(folder, "mcdc", "extra.conf"), encoding="ascii") as file:
            lines = file.read().splitlines()
        for name in names:
            first = lines.index(f"<{name}>") + 1
            corners = np.array([[float(word) for word in line.split()] for line in lines[first : first + 2]])
            np.testing.assert_allclose(corners, [[-SIDE / 2e3] * 3, [SIDE / 2e3] * 3], rtol=1e-12)

    def test_simulators_are_told(self):
        fibres, surfaces = self.chain()
        folder = os.path.join(self.folder, "substrate")
        SubstrateWriter(Fibres=fibres, Outer=OutputPort(surfaces, 0), Inner=OutputPort(surfaces, 1), FolderName=folder, Format="MC/DC").UpdatePipeline()
        with open(os.path.join(folder, "manifest.json"), encoding="utf-8") as file:
            manifest = json.load(file)
        self.assertEqual(manifest["periodic"], [True, True, True])
        self.assert_corners(folder, "voxels")
        with open(os.path.join(folder, "README.txt"), encoding="utf-8") as file:
            text = file.read()
        self.assertIn("repeats along x, y and z", text)
        self.assertIn("Fewer than 0.1 %", text)
        self.assertIn("Surfaces are open there", text)
        self.assertEqual(manifest["periodic_faces"], "Open")  # as MC/DC needs them
        self.assertTrue(os.path.isfile(os.path.join(folder, "start", "extra.txt")))

        self.expected = "caps of fibres lie there, too"
        folder = os.path.join(self.folder, "capped")
        SubstrateWriter(Outer=OutputPort(surfaces, 0), Inner=OutputPort(surfaces, 1), FolderName=folder, Format="MC/DC", PeriodicFaces="Caps").UpdatePipeline()
        self.assert_corners(folder, "voxels", "spawning_area")
        with open(os.path.join(folder, "README.txt"), encoding="utf-8") as file:
            self.assertIn(self.expected, file.read())

    @staticmethod
    def read_ply(path):
        with open(path, encoding="ascii") as file:
            head, body = file.read().split("end_header\n", 1)
        count = int(head.split("element vertex ")[1].split()[0])
        numbers = np.array(body.split(), float)
        return numbers[: 3 * count].reshape(-1, 3), numbers[3 * count :].reshape(-1, 4)[:, 1:].astype(int)

    def open_tile(self, **options):
        """The folder of an open tile, and its manifest."""
        _, surfaces = self.chain(**options)
        folder = os.path.join(self.folder, "tile")
        writer = SubstrateWriter(Outer=OutputPort(surfaces, 0), Inner=OutputPort(surfaces, 1), FolderName=folder, Format="Surfaces alone", PeriodicFaces="Open")
        writer.UpdatePipeline()
        with open(os.path.join(folder, "manifest.json"), encoding="utf-8") as file:
            manifest = json.load(file)
        self.assertEqual((manifest["periodic_faces"], manifest["certified"]), ("Open", True))
        capped = {(entry["surface"], entry["fibre"]): entry for entry in manifest["files"]}
        for port, surface in enumerate(("outer", "inner")):
            points, triangles, fibre = mesh_of(servermanager.Fetch(surfaces, idx=port))
            low, high = points.min(axis=0), points.max(axis=0)
            axes = [axis for axis in range(3) if manifest["periodic"][axis]]
            is_cap = np.any([(points[triangles, axis] == end[axis]).all(axis=1) for axis in axes for end in (low, high)], axis=0)
            for one in np.unique(fibre):
                self.assertEqual(capped[surface, one]["triangles"], np.count_nonzero(~is_cap & (fibre == one)), (surface, one))
                self.assertGreater(np.count_nonzero(is_cap & (fibre == one)), 0)
        return folder, manifest

    def check_rims(self, points, triangles, name):
        """The open edges lie in the domain's faces, and those of two opposite faces are the same to the bit, the other way round."""
        edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
        senses, uses = np.unique(edges, axis=0, return_counts=True)
        self.assertEqual(uses.max(), 1, name)
        known = set(map(tuple, senses.tolist()))
        open_edges = points[[edge for edge in known if edge[::-1] not in known]]
        in_faces = 0
        for axis in range(3):
            rims = []
            for face in (-SIDE / 2, SIDE / 2):
                rim = open_edges[(open_edges[:, :, axis] == face).all(axis=1)]
                rims.append(np.delete(rim, axis, axis=2))
            in_faces += len(rims[0]) + len(rims[1])
            lower, upper = (sorted(rim.reshape(-1, 4).tolist()) for rim in (rims[0], rims[1][:, ::-1]))
            self.assertEqual(lower, upper, (name, axis))
        self.assertEqual(in_faces, len(open_edges), name)
        return in_faces

    def test_copies_of_an_open_tile_join(self):
        folder, manifest = self.open_tile(voxel=0.08)
        low, high = np.array(manifest["domain"][::2]), np.array(manifest["domain"][1::2]) + SIDE
        rims = 0
        for entry in manifest["files"]:
            points, triangles = self.read_ply(os.path.join(folder, entry["path"]))
            self.assertEqual(len(triangles), entry["triangles"])
            rims += self.check_rims(points, triangles, entry["path"])
            copies = [points[triangles] + SIDE * np.array(copy) for copy in np.ndindex(2, 2, 2)]
            places, numbers = np.unique(np.concatenate(copies).reshape(-1, 3), axis=0, return_inverse=True)
            numbers = numbers.reshape(-1, 3)
            edges = np.sort(np.concatenate([numbers[:, [0, 1]], numbers[:, [1, 2]], numbers[:, [2, 0]]]), axis=1)
            edges, uses = np.unique(edges, axis=0, return_counts=True)
            self.assertLessEqual(uses.max(), 2, entry["path"])
            # An edge with one triangle lies on the outside of all copies.
            ends = places[edges[uses == 1]]
            is_outside = np.any([(ends[:, :, axis] == end[axis]).all(axis=1) for axis in range(3) for end in (low, high)], axis=0)
            self.assertTrue(is_outside.all(), entry["path"])
        self.assertGreater(rims, 4000)

    def test_walkers_go_on_in_an_open_tile(self):
        folder, _ = self.open_tile(CalibreVariation=0)
        # Over three sides along the axons: without walls there the mean of the squares is 2 D t.
        walked = random_walk(folder, walkers=24, steps=14000, step=0.4, repeats=3)
        for compartment in ("inner", "myelin", "outside"):
            self.assertEqual(walked[compartment]["leaked"], 0, compartment)
        free = 14000 * 0.4**2 / 3
        self.assertGreater(free, (3 * SIDE) ** 2)
        self.assertGreater(walked["inner"]["squared_displacement_um2"][2], 0.5 * free)
        self.assertLess(walked["inner"]["squared_displacement_um2"][0], SIDE**2)

    def test_what_cannot_be_is_refused(self):
        for error, options in (
            ("NumberOfBundles is 2: use Border Cut", {"NumberOfBundles": 2}),
            ("Direction is not along z", {"Direction": [0, 1, 1]}),
            ("DispersionModel makes straight fibres", {"DispersionModel": "Watson"}),
            ("less than four times MaximumRadius 3", {"MaximumRadius": 3}),
        ):
            bundle = BundleInitializer(Side=SIDE, Border="Periodic", **options)
            with self.assertError(error):
                bundle.UpdatePipeline()
        fibres, _ = self.chain(FibreVolumeFraction=0.4, GrownFibreVolumeFraction=0.6)
        for error, margin, options in (
            ("leave MinimumAngle at 0", 0, {"MinimumAngle": 10}),
            ("without Margin", 0.5, {}),
            ("leave ClipToDomain on", 0, {"ClipToDomain": 0}),
        ):
            surfaces = MyelinSurface(Input=FibreRadialGrowth(Input=fibres, Margin=margin), **options)
            with self.assertError(error):
                surfaces.UpdatePipeline()


main()
