# SPDX-License-Identifier: BSD-3-Clause
# ctest-extended
# ctest-timeout: 300
"""MyelinSurface with VTK's filters: closed surfaces of the volumes asked for, and whatever is wrong with them is marked."""

import contextlib
import hashlib
import os

import numpy
from cactus_testing import CactusTestCase, fetch, main, mesh_oracle, produce
from paraview.simple import BundleInitializer, FibreRadialGrowth, MyelinSurface, OutputPort, SubstrateCertificate, SubstrateStatistics
from surfaces import fibres as polylines
from vtkmodules.util.numpy_support import vtk_to_numpy

SIDE = 4.0
GAP = 0.02


def column(table, name):
    return vtk_to_numpy(table.GetColumnByName(name))


def value(table, name):
    return column(table, name)[0]


def digest(surface):
    found = hashlib.sha256()
    for port in (0, 1):
        output = fetch(surface, port)
        found.update(vtk_to_numpy(output.GetPoints().GetData()).tobytes())
        found.update(vtk_to_numpy(output.GetPolys().GetConnectivityArray()).tobytes())
    return found.hexdigest()


class VtkMeshingTest(CactusTestCase):
    @classmethod
    def setUpClass(cls):
        fibres = BundleInitializer(Border="Walls", CalibreVariation=0, Side=SIDE, FibreVolumeFraction=0.5, GrownFibreVolumeFraction=0, MeanDispersion=5)
        cls.fibres = fetch(fibres)
        cls.image = fetch(FibreRadialGrowth(Input=fibres, TargetFibreVolumeFraction=0.8, VoxelSize=0.125, MinimumGap=GAP))

    def surfaces(self, **properties):
        return MyelinSurface(Input=produce(self.image), **{"Meshing": "VTK filters", **properties})

    @contextlib.contextmanager
    def told(self, pattern):
        """All that is reported inside is one warning of `pattern`, if any."""
        before, self._messages = self._messages, []
        yield
        messages, self._messages = self._messages, before
        self.assertLessEqual(len(messages), 1)
        for message in messages:
            self.assertRegex(message, pattern)

    def made(self, surface):
        with self.told("fibres are not as asked.*the filters of VTK promise nothing"):
            surface.UpdatePipeline()
        return fetch(surface, 2)

    def judge(self, surface):
        """{names of meshes at fault}, as the oracle says: outer and inner surfaces by themselves, and the pairs that should be apart."""
        for port, name in enumerate(("outer", "inner")):
            output = fetch(surface, port)
            ids = vtk_to_numpy(output.GetCellData().GetArray("FibreId"))
            points = vtk_to_numpy(output.GetPoints().GetData())
            triangles = vtk_to_numpy(output.GetPolys().GetConnectivityArray()).reshape(-1, 3)
            for fibre in numpy.unique(ids):
                own = triangles[ids == fibre]
                used, own = numpy.unique(own, return_inverse=True)
                with open(os.path.join(self.folder, f"{name}{fibre}.off"), "w") as file:
                    file.write(f"OFF\n{len(used)} {own.size // 3} 0\n")
                    file.writelines("%.17g %.17g %.17g\n" % tuple(point) for point in points[used])
                    file.writelines("3 %d %d %d\n" % tuple(triangle) for triangle in own.reshape(-1, 3))
        return mesh_oracle(self.folder, "--gap", str(GAP))

    def at_fault(self, surface):
        found = self.judge(surface)
        fibre_of = lambda name: int("".join(c for c in name if c.isdigit()))
        fibres = {
            fibre_of(mesh["file"])
            for mesh in found["meshes"]
            if not (mesh["closed"] and mesh["manifold"] and mesh["outward"]) or mesh["self_intersecting"]
        }
        within = {}
        for pair in found["pairs"]:
            names = pair["a"], pair["b"]
            kinds = {name[:5] for name in names}
            if kinds == {"outer"}:
                fibres |= {fibre_of(name) for name in names}
            elif len({fibre_of(name) for name in names}) == 1:
                within[fibre_of(names[0])] = pair["relation"]
        return fibres | {fibre for fibre, relation in within.items() if relation == "intersect"}

    def test_surfaces_are_as_asked_and_faults_are_marked(self):
        surface = self.surfaces(GRatio=0.65)
        table = self.made(surface)
        self.assertEqual(set(column(table, "OuterClosed")) | set(column(table, "InnerClosed")), {1})
        as_asked = column(table, "Myelin") == 0
        self.assertGreater(as_asked.mean(), 0.9)
        self.assertLess(numpy.abs(column(table, "GRatio") - 0.65)[as_asked].max(), 0.005)
        # The volumes are those of CACTUS's own surfaces, less the edges that a regular grid bevels at the caps.
        own = fetch(self.surfaces(Meshing="CACTUS", GRatio=0.65), 2)
        for name in ("OuterVolume_um3", "InnerVolume_um3"):
            self.assertAlmostEqual(column(table, name).sum() / column(own, name).sum(), 1.0, delta=0.03)
        self.assertGreater(column(table, "LargestMove_um").min(), 0.0)
        # Nothing is hidden.
        faults = self.at_fault(surface)
        flawed = set(column(table, "FibreId")[column(table, "Flawed") == 1])
        self.assertEqual(flawed, faults)
        self.assertGreater(len(flawed), 0)
        certificate = SubstrateCertificate(Outer=OutputPort(surface, 0), Inner=OutputPort(surface, 1), MinimumGap=GAP)
        with self.assertError("the substrate is not certified"):
            certificate.UpdatePipeline()
        self.assertEqual(value(fetch(certificate), "Certified"), 0)
        statistics = fetch(SubstrateStatistics(Fibres=produce(self.fibres), Outer=OutputPort(surface, 0), Inner=OutputPort(surface, 1)))
        self.assertAlmostEqual(value(statistics, "FVF"), column(table, "OuterVolume_um3").sum() / SIDE**3, places=9)

    def test_threads_do_not_change_a_bit_and_cactus_comes_back(self):
        surface = self.surfaces(Meshing="CACTUS")
        before = digest(surface)
        surface.Meshing = "VTK filters"
        digests = set()
        for threads in (1, 2):
            surface.NumberOfThreads = threads
            self.made(surface)
            digests.add(digest(surface))
        self.assertEqual(len(digests), 1)
        self.assertNotIn(before, digests)
        surface.Meshing = "CACTUS"
        self.assertEqual(digest(surface), before)

    def test_nothing_smoothed_and_nothing_coarsened(self):
        table = self.made(self.surfaces(SincIterations=0, TargetReduction=0))
        self.assertEqual(set(column(table, "OuterClosed")) | set(column(table, "InnerClosed")), {1})
        smoothed = self.made(self.surfaces(TargetReduction=0))
        # Smoothing leaves the triangles of the contours, but for the few that even fans are made of, and decimation takes away what it is asked to.
        numpy.testing.assert_allclose(column(smoothed, "OuterTriangles"), column(table, "OuterTriangles"), rtol=0.005)
        coarse = self.made(self.surfaces(SincIterations=0, TargetReduction=0.8))
        ratio = column(coarse, "OuterTriangles").sum() / column(table, "OuterTriangles").sum()
        self.assertAlmostEqual(ratio, 0.2, delta=0.02)
        # As contoured, fibres do not meet; the field says where they are.
        self.assertLess(column(table, "LargestMove_um").max(), 0.1)

    def test_models(self):
        table = self.made(self.surfaces(GRatioModel="Distributed", GRatio=0.65, GRatioDeviation=0.05))
        as_asked = column(table, "Myelin") == 0
        self.assertGreater(as_asked.mean(), 0.9)
        self.assertLess(numpy.abs(column(table, "GRatio") - column(table, "TargetGRatio"))[as_asked].max(), 0.005)
        self.assertGreater(column(table, "TargetGRatio").std(), 0.02)
        table = self.made(self.surfaces(GRatioModel="LogLinear"))
        self.assertLess(numpy.abs(column(table, "GRatio") - column(table, "TargetGRatio"))[column(table, "Myelin") == 0].max(), 0.005)
        table = self.made(self.surfaces(GRatioModel="TargetAxonVolumeFraction", TargetAxonVolumeFraction=0.35))
        self.assertAlmostEqual(column(table, "InnerVolume_um3").sum() / SIDE**3, 0.35, delta=0.003)

    def test_fibres_may_touch(self):
        growth = FibreRadialGrowth(Input=produce(self.fibres), TargetFibreVolumeFraction=0.7, VoxelSize=0.2, MinimumGap=0, SurfaceTolerance=0)
        table = self.made(MyelinSurface(Input=growth, Meshing="VTK filters"))
        self.assertEqual(set(column(table, "OuterClosed")), {1})

    def test_harsh_settings_give_what_they_can(self):
        for properties in (
            {"TargetReduction": 0.99},
            {"SincIterations": 60, "SincPassBand": 0.001},
            {"SincIterations": 1, "SincPassBand": 0.1},
        ):
            with self.subTest(**properties):
                table = self.made(self.surfaces(**properties))
                self.assertEqual(table.GetNumberOfRows(), self.image.GetFieldData().GetArray("FibreTable.FibreId").GetNumberOfTuples())
                for name in ("OuterVolume_um3", "InnerVolume_um3", "GRatio"):
                    self.assertTrue(numpy.isfinite(column(table, name)).all(), name)

    def test_what_vtk_cannot_smooth_is_an_error(self):
        surface = self.surfaces(SincIterations=3, SincPassBand=0.0001)
        with self.assertError("SincPassBand 0.0001 is too small for SincIterations 3"):
            surface.UpdatePipeline()
        surface.SincPassBand = 0.1
        self.assertGreater(self.made(surface).GetNumberOfRows(), 0)

    def test_coarse_voxels(self):
        for size in (0.5, 1.0, 2.0):
            growth = FibreRadialGrowth(Input=produce(self.fibres), TargetFibreVolumeFraction=0.7, VoxelSize=size)
            for model in ("Constant", "LogLinear"):
                table = self.made(MyelinSurface(Input=growth, Meshing="VTK filters", GRatioModel=model))
                has_outer = column(table, "OuterTriangles") > 0
                self.assertTrue((has_outer == (column(table, "Myelin") != 4)).all())

    def test_fibres_between_all_samples(self):
        thin = polylines({1: (0.05, [(0.01, 0.02, z) for z in (-3.0, 3.0)])}, SIDE)
        growth = FibreRadialGrowth(Input=produce(thin), VoxelSize=0.5, TargetFibreVolumeFraction=0, MinimumGap=0, SurfaceTolerance=0)
        surface = MyelinSurface(Input=growth, Meshing="VTK filters")
        self.assertEqual(list(column(self.made(surface), "Myelin")), [4])


if __name__ == "__main__":
    main()
