# SPDX-License-Identifier: BSD-3-Clause
# ctest-timeout: 600
"""The whole chain through ParaView, on small bundles and crossings, judged by brute force and by the mesh oracle."""

import os

import numpy as np
from cactus_testing import CactusTestCase, fetch, main, mesh_oracle
from paraview.simple import (
    BundleInitializer, CapsuleOptimizer, FibreRadialGrowth, MyelinSurface, OutputPort, SubstrateCertificate, SubstrateStatistics, SubstrateWriter,
)
from vtkmodules.util.numpy_support import vtk_to_numpy


def capsules(data):
    """p, q (ends), r, s (radii at them) and fibre of every capsule."""
    points = vtk_to_numpy(data.GetPoints().GetData())
    radii = vtk_to_numpy(data.GetPointData().GetArray("Radius"))
    offsets = vtk_to_numpy(data.GetLines().GetOffsetsArray())
    ids = vtk_to_numpy(data.GetLines().GetConnectivityArray())
    first = np.setdiff1d(np.arange(len(ids)), offsets[1:] - 1)
    fibre = np.searchsorted(offsets, first, side="right") - 1
    return points[ids[first]], points[ids[first + 1]], radii[ids[first]], radii[ids[first + 1]], fibre


def distance_to_points(x, p, d):
    """Parameter and distance of the point of p + [0, 1] d that is closest to x, row by row."""
    t = np.clip(np.einsum("ij,ij->i", x - p, d) / np.einsum("ij,ij->i", d, d), 0, 1)
    return t, np.linalg.norm(p + t[:, None] * d - x, axis=1)


def largest_penetration(data):
    """Largest D = 1 - d / (rp + rq) over all pairs of capsules of different fibres.

    The distance of two segments is the least of: the four distances of an end to the other segment, and, where both feet of the
    common perpendicular of the two lines lie inside, its length.
    """
    p, q, r, s, fibre = capsules(data)
    d = q - p
    largest = -np.inf
    for k in range(len(p)):
        other = np.nonzero(fibre > fibre[k])[0]
        # Whoever's sphere around does not reach mine cannot touch.
        reach = 0.5 * (np.linalg.norm(d[other], axis=1) + np.linalg.norm(d[k])) + np.maximum(r, s)[other] + max(r[k], s[k])
        other = other[np.linalg.norm(0.5 * (p[other] + q[other]) - 0.5 * (p[k] + q[k]), axis=1) <= reach]
        if len(other) == 0:
            continue
        candidates = []
        one = lambda x: np.broadcast_to(x, (len(other), 3))
        for end, t in ((p[k], 0.0), (q[k], 1.0)):
            u, distance = distance_to_points(one(end), p[other], d[other])
            candidates.append((distance, np.full(len(other), t), u))
        for ends, u in ((p[other], 0.0), (q[other], 1.0)):
            t, distance = distance_to_points(ends, one(p[k]), one(d[k]))
            candidates.append((distance, t, np.full(len(other), u)))
        a, e, b = d[k] @ d[k], np.einsum("ij,ij->i", d[other], d[other]), d[other] @ d[k]
        w = p[k] - p[other]
        c, f = w @ d[k], np.einsum("ij,ij->i", w, d[other])
        with np.errstate(divide="ignore", invalid="ignore"):
            t = (b * f - c * e) / (a * e - b * b)
            u = (a * f - b * c) / (a * e - b * b)
        inside = (t > 0) & (t < 1) & (u > 0) & (u < 1)
        t, u = np.where(inside, t, 0), np.where(inside, u, 0)
        length = np.linalg.norm(w + t[:, None] * d[k] - u[:, None] * d[other], axis=1)
        candidates.append((np.where(inside, length, np.inf), t, u))
        distance, t, u = (np.array(column) for column in zip(*candidates))
        best = np.argmin(distance, axis=0)
        pick = (best, np.arange(len(other)))
        radii = (1 - t[pick]) * r[k] + t[pick] * s[k] + (1 - u[pick]) * r[other] + u[pick] * s[other]
        largest = max(largest, np.max(1 - distance[pick] / radii))
    return largest


def row(proxy, port=0, index=-1):
    table = fetch(proxy, port)
    index = index % table.GetNumberOfRows()
    names = [table.GetColumnName(column) for column in range(table.GetNumberOfColumns())]
    return {name: table.GetValueByName(index, name).ToDouble() for name in names}


def triangles_per_area(data):
    """Triangles per µm² of a surface."""
    points = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
    corners = points[vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
    areas = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    return len(areas) / areas.sum()


def enclosed_volume(data):
    """Volume that each fibre's triangles enclose, by the divergence theorem."""
    points = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
    corners = points[vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
    parts = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    return np.bincount(vtk_to_numpy(data.GetCellData().GetArray("FibreId")), weights=parts)


class ChainTest(CactusTestCase):
    def run_chain(self, side, fraction, most_triangles, largest_aspect=100, directions=((0, 0, 1),), **bundle):
        sources = [BundleInitializer(Side=side, Seed=3, GrownFibreVolumeFraction=0, Direction=way, **bundle) for way in directions]
        optimised = CapsuleOptimizer(Input=sources)
        data = fetch(optimised)
        self.assertEqual(data.GetFieldData().GetArray("Converged").GetValue(0), 1)
        # Guarantee 1, by brute force.
        worst = largest_penetration(data)
        self.assertLessEqual(worst, 1e-3 + 1e-9)
        # The table speaks of all fibres, the output of those that are left after trimming.
        self.assertLessEqual(worst, row(optimised, 1)["MaximumPenetration"] + 1e-9)
        overlap = vtk_to_numpy(data.GetPointData().GetArray("Overlap"))
        self.assertLessEqual(worst, overlap.max() + 1e-9)

        fibres = OutputPort(optimised, 0)
        grown = FibreRadialGrowth(Input=fibres, TargetFibreVolumeFraction=fraction)
        surfaces = MyelinSurface(Input=grown, GRatio=0.7)
        outer, inner = fetch(surfaces, 0), fetch(surfaces, 1)
        # A fibre that only grazes the domain may be too thin in it to hold an axon, which the filter tells.
        self._messages = [message for message in self._messages if "too thin in the image to hold an axon" not in message]
        # Every fibre with a capsule that reaches well into the domain has its surface.
        ids = vtk_to_numpy(data.GetCellData().GetArray("FibreId"))
        p, q, r, s, fibre = capsules(data)
        centre = 0.5 * (p + q)
        half = 0.5 * np.array([side, side, bundle.get("Length") or side])
        inside = np.all(np.abs(centre) < half - 0.2, axis=1)
        expected = set(ids[np.unique(fibre[inside])])
        present = set(vtk_to_numpy(outer.GetCellData().GetArray("FibreId")))
        self.assertLessEqual(expected, present)
        self.assertLessEqual(present, set(ids))

        # Economical: triangles per µm² of the outer and of the inner surfaces.
        self.assertLessEqual(triangles_per_area(outer), most_triangles[0])
        self.assertLessEqual(triangles_per_area(inner), most_triangles[1])
        # And none of them a sliver.
        certificate = row(SubstrateCertificate(Outer=OutputPort(surfaces, 0), Inner=OutputPort(surfaces, 1)))
        self.assertEqual(certificate["Certified"], 1)
        self.assertLess(certificate["LargestAspect"], largest_aspect)
        self.assertLess(certificate["LargestSquaredEdgeRatio"], 1000)
        self.assertGreater(certificate["SmallestFeature_um"], 0.0005)

        # Guarantee 3: fractions of the meshes, measured here once more.
        volume = side**2 * (bundle.get("Length") or side)
        outer_volume, inner_volume = enclosed_volume(outer), enclosed_volume(inner)
        fvf, avf = outer_volume.sum() / volume, inner_volume.sum() / volume
        self.assertAlmostEqual(fvf, fraction, delta=0.005)
        self.assertAlmostEqual(np.sqrt(avf / fvf), 0.7, delta=0.005)
        told = fetch(surfaces, 2).GetFieldData()
        self.assertAlmostEqual(told.GetArray("FVF").GetValue(0), fvf, places=9)
        self.assertAlmostEqual(told.GetArray("AVF").GetValue(0), avf, places=9)
        statistics = SubstrateStatistics(Fibres=fibres, Outer=OutputPort(surfaces, 0), Inner=OutputPort(surfaces, 1))
        reached = row(statistics)
        self.assertAlmostEqual(reached["FVF"], fvf, places=9)
        self.assertAlmostEqual(reached["AVF"], avf, places=9)
        self.assertEqual(reached["OuterOpen"] + reached["InnerOpen"], 0)
        self.assertAlmostEqual(reached["LargestPenetration"], max(worst, 0), places=6)

        # Guarantee 2, by exact predicates on what a simulator is given.
        folder = os.path.join(self.folder, "substrate")
        SubstrateWriter(Fibres=fibres, Outer=OutputPort(surfaces, 0), Inner=OutputPort(surfaces, 1), FolderName=folder).UpdatePipeline()
        judged = mesh_oracle(folder, "--gap", "0.02")
        for mesh in judged["meshes"]:
            for quality in ("closed", "manifold", "outward"):
                self.assertTrue(mesh[quality], f"{mesh['file']} is not {quality}")
            self.assertFalse(mesh["self_intersecting"], mesh["file"])
        # The only pairs that meet or come near are an axon and its own myelin's outside, which holds it.
        for pair in judged["pairs"]:
            self.assertIn(pair["relation"], ("a_in_b", "b_in_a"), pair)
            self.assertEqual(os.path.basename(pair["a"]), os.path.basename(pair["b"]), pair)
        axons = set(vtk_to_numpy(inner.GetCellData().GetArray("FibreId")))
        self.assertEqual(len(judged["pairs"]), len(axons))
        return data, reached

    def test_single_bundle(self):
        data, reached = self.run_chain(12, 0.9, most_triangles=(10, 12.5), MeanDispersion=10, Border="Walls", CorrelationLength=0, CalibreVariation=0)
        self.assertGreater(data.GetNumberOfCells(), 30)
        self.assertAlmostEqual(reached["MeanDispersion_deg"], 10, delta=1)

    def test_bundle_that_is_cut(self):
        # Bent walls of varying calibre, and the rims of fibres that a face cuts lengthwise, take more triangles.
        data, reached = self.run_chain(8, 0.9, most_triangles=(22, 28), largest_aspect=150)
        self.assertGreater(data.GetNumberOfCells(), 30)
        self.assertGreater(reached["OuterClosed"], 30)

    def test_three_bundles_in_a_long_domain(self):
        """Three bundles at right angles, each in the whole domain: as many fibres of each, along the axes asked for."""
        directions = np.eye(3)
        data, reached = self.run_chain(
            10, 0.8, most_triangles=(40, 48), largest_aspect=150, directions=directions, FibreVolumeFraction=0.15, MaximumRadius=1, Length=12
        )
        self.assertEqual(vtk_to_numpy(data.GetFieldData().GetArray("Domain")).ravel().tolist(), [-5, 5, -5, 5, -6, 6])
        p, q, r, _, fibre = capsules(data)
        bundle = vtk_to_numpy(data.GetCellData().GetArray("BundleId"))[fibre]
        steps = q - p
        lengths = np.linalg.norm(steps, axis=1)
        for number, way in enumerate(directions, start=1):
            mine = bundle == number
            tensor = (steps[mine].T / lengths[mine]) @ steps[mine]
            _, axes = np.linalg.eigh(tensor)
            self.assertLess(np.degrees(np.arccos(abs(axes[:, 2] @ way))), 6)
            share = (r[mine] ** 2 * lengths[mine]).sum() / (r**2 * lengths).sum()
            self.assertAlmostEqual(share, 1 / 3, delta=0.07)

    def test_crossing(self):
        data, _ = self.run_chain(
            12, 0.7, most_triangles=(13, 15.5), NumberOfBundles=2, CrossingAngle=60, MeanDispersion=3, FibreVolumeFraction=0.5, Border="Walls", CalibreVariation=0
        )
        points = vtk_to_numpy(data.GetPoints().GetData())
        offsets = vtk_to_numpy(data.GetLines().GetOffsetsArray())
        ids = vtk_to_numpy(data.GetLines().GetConnectivityArray())
        bundle = vtk_to_numpy(data.GetCellData().GetArray("BundleId"))
        chords = points[ids[offsets[1:] - 1]] - points[ids[offsets[:-1]]]
        axes = []
        for which in (1, 2):
            mine = chords[bundle == which]
            axes.append((mine / np.linalg.norm(mine, axis=1)[:, None]).sum(axis=0))
        cosine = axes[0] @ axes[1] / np.linalg.norm(axes[0]) / np.linalg.norm(axes[1])
        self.assertAlmostEqual(np.degrees(np.arccos(cosine)), 60, delta=2)


if __name__ == "__main__":
    main()
