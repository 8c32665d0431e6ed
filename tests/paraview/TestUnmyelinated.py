# SPDX-License-Identifier: BSD-3-Clause
"""Axons without myelin: asked for, made, certified, counted and written; and the twins that Lesion makes."""

import filecmp
import json
import os

import numpy
from cactus_testing import CactusTestCase, fetch, main, produce
from paraview.simple import (BundleInitializer, CapsuleOptimizer, ExtractSurface, FibreRadialGrowth, Lesion, MyelinSurface, OutputPort,
                             SubstrateCertificate, SubstrateStatistics, SubstrateWriter, Threshold)
from surfaces import two_tubes
from vtkmodules.util.numpy_support import vtk_to_numpy


def column(table, name):
    return vtk_to_numpy(table.GetColumnByName(name))


def value(table, name):
    return column(table, name)[0]


def surface_of(data, fibre):
    """(points, triangles) of one fibre."""
    triangles = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    chosen = triangles[vtk_to_numpy(data.GetCellData().GetArray("FibreId")) == fibre]
    used, renumbered = numpy.unique(chosen, return_inverse=True)
    return vtk_to_numpy(data.GetPoints().GetData())[used], renumbered.reshape(-1, 3)


class Unmyelinated(CactusTestCase):
    expected = r"fibres are not as asked"

    def chain(self, **properties):
        bundle = BundleInitializer(Side=8, MeanDispersion=3, MaximumRadius=1, FibreVolumeFraction=0.7, GrownFibreVolumeFraction=0.8, CalibreVariation=0, **properties)
        fibres = OutputPort(CapsuleOptimizer(Input=bundle), 0)
        return fibres, MyelinSurface(Input=FibreRadialGrowth(Input=fibres, VoxelSize=0.08))

    def test_they_fill_what_is_asked_for_and_count_as_axons(self):
        fibres, surfaces = self.chain(UnmyelinatedFraction=0.1, UnmyelinatedRadius=0.2)
        table = fetch(surfaces, 2)
        bare = column(table, "TargetGRatio") == 1
        there = column(table, "OuterTriangles") > 0
        self.assertGreater((bare & there).sum(), 10)
        self.assertTrue((column(table, "GRatio")[bare & there] == 1).all())
        self.assertTrue((column(table, "Myelin")[bare & there] == 0).all())
        outer, inner = fetch(surfaces, 0), fetch(surfaces, 1)
        for fibre in column(table, "FibreId")[bare & there][:5]:
            for one, other in zip(surface_of(outer, fibre), surface_of(inner, fibre)):
                numpy.testing.assert_array_equal(one, other)
        given = {"Fibres": fibres, "Outer": OutputPort(surfaces, 0), "Inner": OutputPort(surfaces, 1)}
        certificate = fetch(SubstrateCertificate(**given), 0)
        self.assertEqual(value(certificate, "Certified"), 1)
        self.assertEqual(value(certificate, "Unmyelinated"), (bare & there).sum())
        whole = fetch(SubstrateStatistics(**given), 0)
        self.assertAlmostEqual(value(whole, "UnmyelinatedFraction"), 0.1, delta=0.006)
        self.assertAlmostEqual(value(whole, "AxonalWaterFraction"), value(whole, "AVF") / (1 - value(whole, "MVF")), 12)
        folder = os.path.join(self.folder, "written")
        SubstrateWriter(FolderName=folder, **given).UpdatePipeline()
        with open(os.path.join(folder, "manifest.json"), encoding="utf-8") as file:
            self.assertEqual(json.load(file)["unmyelinated_fibres"], (bare & there).sum())

    def fibre_values(self, surfaces, port=0):
        """Radius, g-ratio and colour of each fibre, from its triangles."""
        cells = fetch(surfaces, port).GetCellData()
        ids, *columns = (vtk_to_numpy(cells.GetArray(name)) for name in ("FibreId", "Radius", "GRatio", "Direction"))
        fibres, first = numpy.unique(ids, return_index=True)
        return dict(zip(fibres, numpy.column_stack(columns)[first]))

    def test_a_lesion_is_a_twin(self):
        fibres, surfaces = self.chain()
        healthy = {"Outer": OutputPort(surfaces, 0), "Inner": OutputPort(surfaces, 1), "Fibres": fibres}
        lesion = Lesion(AxonLoss=0.2, MyelinLoss=0.5, **healthy)
        ill = {"Outer": OutputPort(lesion, 0), "Inner": OutputPort(lesion, 1), "Fibres": OutputPort(lesion, 2)}
        certificate = fetch(SubstrateCertificate(**ill), 0)
        self.assertEqual(value(certificate, "Certified"), 1)
        self.assertGreater(value(certificate, "Unmyelinated"), 5)
        # Cell data are those of MyelinSurface, but of axons that have lost their myelin.
        wanted, found = self.fibre_values(surfaces), self.fibre_values(lesion)
        self.assertLess(set(found), set(wanted))
        lost = [fibre for fibre in found if found[fibre][1] == 1 and wanted[fibre][1] < 1]
        self.assertGreater(len(lost), 5)
        for fibre in found:
            if fibre not in lost:
                numpy.testing.assert_allclose(found[fibre], wanted[fibre], rtol=2e-3, err_msg=str(fibre))
        folders = {}
        for name, given in (("healthy", healthy), ("ill", ill)):
            folders[name] = os.path.join(self.folder, name)
            SubstrateWriter(FolderName=folders[name], Format="Surfaces alone", **given).UpdatePipeline()
        same, bare, gone = 0, 0, 0
        for file in sorted(os.listdir(os.path.join(folders["healthy"], "outer"))):
            path = lambda name, kind: os.path.join(folders[name], kind, file)
            if not os.path.exists(path("ill", "outer")):
                gone += 1
                continue
            same += filecmp.cmp(path("healthy", "outer"), path("ill", "outer"), shallow=False)
            if os.path.exists(path("ill", "inner")):
                self.assertTrue(filecmp.cmp(path("healthy", "inner"), path("ill", "inner"), shallow=False))
                with open(path("ill", "outer"), encoding="utf-8") as outer, open(path("ill", "inner"), encoding="utf-8") as inner:
                    bare += [line for line in outer if not line.startswith("comment")] == [line for line in inner if not line.startswith("comment")]
        self.assertEqual(bare, value(certificate, "Unmyelinated"))
        self.assertGreater(same, 5)
        self.assertGreater(gone, 5)
        before, after = (fetch(SubstrateStatistics(**given), 0) for given in (healthy, ill))
        self.assertLess(value(after, "MVF"), value(before, "MVF"))
        self.assertGreater(value(after, "UnmyelinatedFraction"), 0)
        self.assertEqual(value(before, "UnmyelinatedFraction"), 0)

    def test_an_inner_surface_without_an_outer_one_stays(self):
        _, outer, inner = two_tubes()
        outer = Threshold(Input=produce(outer), Scalars=["CELLS", "FibreId"], LowerThreshold=3, UpperThreshold=3)
        lesion = Lesion(Outer=ExtractSurface(Input=outer), Inner=produce(inner))
        values = self.fibre_values(lesion, 1)
        self.assertEqual(sorted(values), [3, 5])
        self.assertTrue(numpy.isnan(values[5][1]))

    def test_a_bad_value_is_named_and_the_next_good_one_is_used(self):
        _, surfaces = self.chain()
        lesion = Lesion(Outer=OutputPort(surfaces, 0), AxonLoss=2)
        with self.assertError(r"AxonLoss is 2: give 0 to 0\.95"):
            self.assertEqual(fetch(lesion, 0).GetNumberOfCells(), 0)
        lesion.AxonLoss = 0.5
        self.assertGreater(fetch(lesion, 0).GetNumberOfCells(), 0)


if __name__ == "__main__":
    main()
