# SPDX-License-Identifier: BSD-3-Clause
"""The certificate through ParaView, against the mesh oracle, which shares no code with it, on surfaces broken on purpose."""

import os
import random

import numpy as np
from cactus_testing import CactusTestCase, fetch, main, mesh_oracle, produce
from paraview.simple import SubstrateCertificate
from surfaces import EQUIVALENT, SIDES, surfaces, tube, two_tubes, without
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkIntArray
from vtkmodules.vtkCommonDataModel import vtkPolyData


def rows(table):
    names = [table.GetColumnName(column) for column in range(table.GetNumberOfColumns())]
    return [{name: table.GetValueByName(row, name).ToDouble() for name in names} for row in range(table.GetNumberOfRows())]


def copy(part):
    result = vtkPolyData()
    result.DeepCopy(part)
    return result


def move(part, point, by):
    result = copy(part)
    moved = [a + b for a, b in zip(part.GetPoint(point), by)]
    result.GetPoints().SetPoint(point, moved)
    return result


def flipped(part, triangle):
    result = copy(part)
    result.BuildCells()
    result.ReverseCell(triangle)
    return result


def crumpled(part, amount, seed):
    """With every point moved at random."""
    result = copy(part)
    shifts = np.random.default_rng(seed).uniform(-amount, amount, (part.GetNumberOfPoints(), 3))
    for i, shift in enumerate(shifts):
        result.GetPoints().SetPoint(i, [a + b for a, b in zip(part.GetPoint(i), shift)])
    return result


class Certificate(CactusTestCase):
    def setUp(self):
        super().setUp()
        self.fibres, self.outer, self.inner = two_tubes(inset=0.1)

    def certify(self, outer, inner=None, **properties):
        if inner is not None:
            properties["Inner"] = produce(inner)
        certificate = SubstrateCertificate(Outer=produce(outer), **properties)
        return rows(fetch(certificate))[0], rows(fetch(certificate, 1))

    def test_sound_substrate(self):
        whole, fibres = self.certify(self.outer, self.inner, Fibres=produce(self.fibres))
        self.assertEqual(whole["Certified"], 1)
        self.assertEqual((whole["OuterSurfaces"], whole["InnerSurfaces"]), (2, 2))
        self.assertAlmostEqual(whole["SmallestGap_um"], 1.5, places=6)
        self.assertEqual((whole["SmallestGapFibreA"], whole["SmallestGapFibreB"]), (3, 5))
        self.assertEqual([fibre["FibreId"] for fibre in fibres], [3, 5])
        for fibre, outer, inner in zip(fibres, (1.0, 1.5), (0.7, 0.9)):
            self.assertAlmostEqual(fibre["OuterRadius_um"], outer * EQUIVALENT, places=5)
            self.assertAlmostEqual(fibre["InnerRadius_um"], inner * EQUIVALENT, places=5)
            self.assertAlmostEqual(fibre["SmallestMyelin_um"], (outer - inner) * np.cos(np.pi / SIDES), places=5)

    def test_says_why_not(self):
        with self.assertError(r"not certified: fibres 3 and 5 come as near as 1\.5"):
            whole, _ = self.certify(self.outer, self.inner, MinimumGap=1.6)
        self.assertEqual(whole["Certified"], 0)
        with self.assertError(r"not certified: 2 inner surfaces leave their outer ones \(fibre 3 first\)"):
            self.certify(self.outer, two_tubes()[2])  # caps in one plane

    def test_is_read_line_by_line_from_the_verdict_on(self):
        """ParaView's spreadsheets sort columns by name, so what they show has rows."""

        def lines(outer, **inputs):
            table = fetch(SubstrateCertificate(Outer=produce(outer), **inputs), 2)
            return [(table.GetValueByName(row, "Finding").ToString(), table.GetValueByName(row, "Value").ToString()) for row in range(table.GetNumberOfRows())]

        read = lines(self.outer, Inner=produce(self.inner))
        self.assertEqual(read[:2], [("Verdict", "certified"), ("Certified", "1")])
        whole, _ = self.certify(self.outer, self.inner)
        self.assertEqual([name for name, _ in read[1:]], list(whole))
        self.assertEqual(dict(read)["SmallestGap_um"], "1.5")
        self.assertEqual(dict(read)["OuterSurfaces"], "2")
        alone = lines(self.outer)
        self.assertEqual(alone[0][1], "certified for its outer surfaces alone, as there are no inner ones")
        self.assertEqual(dict(alone)["AVF"], "-")
        with self.assertError("not certified"):
            self.assertRegex(lines(self.outer, Inner=produce(self.inner), MinimumGap=1.6)[0][1], r"^not certified: fibres 3 and 5 come as near as 1\.5")

    def test_triangles_in_any_order(self):
        """Surfaces may be mixed with each other in the array of cells."""
        expected, expected_fibres = self.certify(self.outer, self.inner)
        mixed = []
        for data in (self.outer, self.inner):
            data = copy(data)
            order = np.random.default_rng(1).permutation(data.GetNumberOfCells())
            cell_data = data.GetCellData()
            columns = [vtk_to_numpy(cell_data.GetArray(i)) for i in range(cell_data.GetNumberOfArrays())]
            for values in columns + [vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)]:
                values[:] = values[order]
            mixed.append(data)
        self.assertGreater(np.count_nonzero(np.diff(vtk_to_numpy(mixed[0].GetCellData().GetArray("FibreId")))), 100)
        whole, fibres = self.certify(*mixed)
        for one, other in zip([expected] + expected_fibres, [whole] + fibres):
            for name in one:
                np.testing.assert_allclose(other[name], one[name], rtol=1e-12, err_msg=name)

    def write(self, data):
        """One PLY file for each fibre."""
        points = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
        triangles = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
        ids = vtk_to_numpy(data.GetCellData().GetArray("FibreId"))
        for fibre in np.unique(ids):
            used, corners = np.unique(triangles[ids == fibre], return_inverse=True)
            corners = corners.reshape(-1, 3)
            with open(os.path.join(self.folder, f"{fibre:02}.ply"), "w") as file:
                file.write("ply\nformat ascii 1.0\n")
                file.write(f"element vertex {len(used)}\nproperty double x\nproperty double y\nproperty double z\n")
                file.write(f"element face {len(corners)}\nproperty list uchar int vertex_indices\nend_header\n")
                file.writelines("%.17g %.17g %.17g\n" % tuple(point) for point in points[used])
                file.writelines("3 %d %d %d\n" % tuple(triangle) for triangle in corners)

    def compare(self, parts):
        """The certificate of the outer surfaces {id: vtkPolyData} against what the oracle says of them."""
        data = surfaces({fibre: copy(part) for fibre, part in parts.items()}, 0, 10)
        self.write(data)
        judged = mesh_oracle(self.folder, "--gap", "3")
        before = list(self._messages)
        whole, fibres = self.certify(data, MinimumGap=0)
        self._messages = before  # whether it is certified is compared below
        meshes = {int(mesh["file"][:2]): mesh for mesh in judged["meshes"]}
        for row in fibres:
            mesh = meshes[row["FibreId"]]
            sound = mesh["closed"] and mesh["manifold"] and mesh["outward"]
            self.assertEqual(bool(row["OuterSound"]), sound, mesh)
            if mesh["manifold"]:  # else the oracle does not look
                self.assertEqual(row["OuterSelfIntersections"] > 0, mesh["self_intersecting"], mesh)
            near = [pair for pair in judged["pairs"] if mesh["file"] in (pair["a"], pair["b"])]
            gaps = [pair["distance"] for pair in near if pair["distance"] is not None]
            if gaps:
                self.assertAlmostEqual(row["SmallestGap_um"], min(gaps), places=9)
        relations = [pair["relation"] for pair in judged["pairs"]]
        self.assertEqual(whole["OuterPairsMeeting"], relations.count("intersect"))
        self.assertEqual(whole["OuterPairsNested"], sum(relation.endswith(("in_a", "in_b")) for relation in relations))
        judged_sound = all(mesh["closed"] and mesh["manifold"] and mesh["outward"] and not mesh["self_intersecting"] for mesh in judged["meshes"])
        self.assertEqual(bool(whole["Certified"]), judged_sound and set(relations) <= {"near"})
        return whole

    def test_oracle_agrees(self):
        one, other = tube(-2, 0, 1, 9), tube(1, 0, 1.5, 9)
        self.assertEqual(self.compare({1: one, 2: other})["Certified"], 1)
        broken = {
            "hole": {1: without(one, [50]), 2: other},
            "flipped triangle": {1: one, 2: flipped(other, 77)},
            "moved point": {1: move(one, 5 * SIDES, (-2.2, 0.1, 0.03)), 2: other},
            "overlapping by 1e-6": {1: one, 2: tube(0.5 - 1e-6, 0, 1.5, 9)},
            "touching along a line": {1: one, 2: tube(0.5, 0, 1.5, 9)},
            "point that touches": {1: move(one, 5 * SIDES, (0.5, 0, 0)), 2: other},
            "point that pierces": {1: move(one, 5 * SIDES, (0.6, 0, 0)), 2: other},
            "caps in one plane": {1: one, 2: tube(-1.5, 0, 1.5, 9)},
            "nested": {1: one, 2: tube(-2, 0, 0.5, 8)},
            "nested, caps in one plane": {1: one, 2: tube(-2, 0, 0.5, 9)},
            "through both caps": {1: one, 2: tube(-2, 0, 0.5, 9.5)},
        }
        for name, parts in broken.items():
            with self.subTest(name):
                self.assertEqual(self.compare(parts)["Certified"], 0)

    def test_oracle_agrees_on_crumpled_surfaces(self):
        random.seed(4)
        verdicts = []
        for seed in range(12):
            with self.subTest(seed=seed):
                amount = 0.02 + 0.03 * (seed % 4)
                parts = {
                    fibre: crumpled(tube(random.uniform(-3, 3), random.uniform(-3, 3), 0.8, 9), amount, 10 * seed + fibre)
                    for fibre in range(1, 5)
                }
                verdicts.append(self.compare(parts))
        self.assertTrue(any(verdict["SelfIntersecting"] == 0 for verdict in verdicts))
        self.assertTrue(any(verdict["SelfIntersecting"] > 0 for verdict in verdicts))
        self.assertTrue(any(verdict["OuterPairsMeeting"] > 0 for verdict in verdicts))

    def test_fibres_without_surfaces(self):
        one = surfaces({3: tube(-2, 0, 1.0, 10)}, 0, 10)
        with self.assertError(r"not certified: 1 of 2 fibres have no outer surface \(fibre 5 first\)"):
            whole, fibres = self.certify(one, Fibres=produce(self.fibres))
        self.assertEqual([whole[name] for name in ("Certified", "Fibres", "WithoutOuter", "WithoutInner")], [0, 2, 1, 1])
        self.assertEqual([(row["FibreId"], row["HasOuter"], row["HasInner"]) for row in fibres], [(3, 1, 0), (5, 0, 0)])
        # The surfaces may say so themselves; then nothing else has to be connected.
        self.assertEqual(self.certify(surfaces({3: tube(-2, 0, 1.0, 10)}, 0, 10))[0]["Certified"], 1)
        wanted = vtkIntArray()
        wanted.SetName("WantedFibres")
        for fibre in (3, 7, 8):
            wanted.InsertNextValue(fibre)
        one.GetFieldData().AddArray(wanted)
        with self.assertError(r"not certified: 2 of 3 fibres have no outer surface \(fibre 7 first\)"):
            self.certify(one)

    def test_myelin_thinner_than_promised(self):
        gap = vtkDoubleArray()
        gap.SetName("MinimumGap")
        gap.InsertNextValue(0.4)
        self.inner.GetFieldData().AddArray(gap)
        with self.assertError(r"not certified: 1 fibres have myelin thinner than the 0\.4"):
            whole, _ = self.certify(self.outer, self.inner)
        self.assertEqual(whole["ThinMyelin"], 1)

    def test_gap_as_promised(self):
        """Asked by default of surfaces that say what they keep; the others must not meet."""
        self.assertEqual(self.certify(self.outer)[0]["MinimumGap_um"], 0)
        gap = vtkDoubleArray()
        gap.SetName("MinimumGap")
        gap.InsertNextValue(1.6)
        self.outer.GetFieldData().AddArray(gap)
        with self.assertError(r"not certified: fibres 3 and 5 come as near as 1\.5.*less than MinimumGap 1\.6"):
            self.assertEqual(self.certify(self.outer)[0]["MinimumGap_um"], 1.6)
        self.assertEqual(self.certify(self.outer, MinimumGap=1.4)[0]["Certified"], 1)

    def test_surfaces_that_were_not_clipped(self):
        with self.assertError(r"reach 0\.5\d* µm out of the domain.*ClipToDomain"):
            whole, _ = self.certify(surfaces({3: tube(-2, 0, 1, 11)}, 0, 10))
        self.assertEqual(whole["Certified"], 1)
        self.assertTrue(np.isnan(whole["FVF"]))
        self.assertAlmostEqual(whole["Reach_um"], 0.5)

    def test_damaged_surfaces_get_a_verdict_or_one_error(self):
        def spoilt(spoil):
            data = copy(self.outer)
            spoil(data)
            return data

        def corner(triangle, value):
            return lambda data: data.GetPolys().GetConnectivityArray().SetComponent(3 * triangle, 0, value)

        def use_twice(data):
            corners = data.GetPolys().GetConnectivityArray()
            corners.SetComponent(30, 0, corners.GetComponent(31, 0))

        def keep_one(data):
            data.BuildCells()
            for cell in range(1, data.GetNumberOfCells()):
                data.DeleteCell(cell)
            data.RemoveDeletedCells()

        for spoil, message in (
            (lambda data: data.GetPoints().SetPoint(7, float("nan"), 0, 0), r"fibre 3.*not finite"),
            (lambda data: data.GetPoints().SetPoint(7, float("inf"), 0, 0), r"fibre 3.*not finite"),
            (lambda data: data.GetPoints().SetPoint(7, 1e38, 0, 0), r"fibre 3.*1e\+38 µm from 0"),
            (lambda data: data.GetPoints().SetPoint(7, *data.GetPoint(8)), r"not certified"),
            (use_twice, r"not certified: 1 surfaces are not closed"),
            (keep_one, r"not certified: 1 surfaces are not closed"),
            (corner(5, 10**6), r"Outer.*points that do not exist"),
            (corner(5, -3), r"Outer.*points that do not exist"),
        ):
            with self.assertError(message):
                SubstrateCertificate(Outer=produce(spoilt(spoil))).UpdatePipeline()
        for name, value in (
            ("MinimumGap", float("nan")),
            ("MinimumGap", float("inf")),
            ("MinimumGap", -0.5),
            ("MinimumGap", 1e300),
            ("CutSpacing", 1e-9),
            ("CutSpacing", 1e300),
        ):
            certificate = SubstrateCertificate(Outer=produce(self.outer))
            with self.assertError(name):
                certificate.SMProxy.GetProperty(name).SetElement(0, value)
                certificate.SMProxy.UpdateVTKObjects()
                certificate.UpdatePipeline()

    def test_wrong_inputs(self):
        with self.assertError(r"Outer holds inner surfaces"):
            SubstrateCertificate(Outer=produce(self.inner)).UpdatePipeline()
        with self.assertError(r"another Domain"):
            other = surfaces({3: tube(-2, 0, 0.5, 9)}, 1, 12)
            SubstrateCertificate(Outer=produce(self.outer), Inner=produce(other)).UpdatePipeline()
        with self.assertError(r"no surfaces to certify"):
            empty = vtkPolyData()
            empty.GetFieldData().ShallowCopy(self.outer.GetFieldData())
            SubstrateCertificate(Outer=produce(empty)).UpdatePipeline()


if __name__ == "__main__":
    main()
