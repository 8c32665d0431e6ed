# SPDX-License-Identifier: BSD-3-Clause
"""Who connects MyelinSurface's outer surfaces alone has the whole substrate judged and written."""

import filecmp
import json
import os

from cactus_testing import UNPARTED, CactusTestCase, fetch, main
from paraview import simple


def table(proxy, port=0):
    columns = fetch(proxy, port)
    names = [columns.GetColumnName(i) for i in range(columns.GetNumberOfColumns())]
    return [[str(columns.GetValueByName(row, name)) for name in names] for row in range(columns.GetNumberOfRows())]


def files(folder):
    return sorted(os.path.relpath(os.path.join(place, name), folder) for place, _, names in os.walk(folder) for name in names)


class WholeSubstrate(CactusTestCase):
    expected = UNPARTED

    def setUp(self):
        super().setUp()
        self.fibres = simple.BundleInitializer(Border="Walls", Side=5, FibreVolumeFraction=0.5, GrownFibreVolumeFraction=0.6, SectionAxisRatio=1)
        grown = simple.FibreRadialGrowth(Input=self.fibres, VoxelSize=0.2)
        surfaces = simple.MyelinSurface(Input=grown)
        self.outer, self.inner = simple.OutputPort(surfaces, 0), simple.OutputPort(surfaces, 1)
        self.all = {"Outer": self.outer, "Inner": self.inner, "Fibres": self.fibres}

    def test_certificate(self):
        whole = simple.SubstrateCertificate(**self.all)
        alone = simple.SubstrateCertificate(Outer=self.outer)
        for port in (0, 1):
            self.assertEqual(table(alone, port), table(whole, port))
        verdict = fetch(alone)
        self.assertEqual(verdict.GetColumnName(0), "Certified")
        self.assertEqual(verdict.GetValueByName(0, "Certified").ToInt(), 1)
        self.assertEqual(verdict.GetValueByName(0, "InnerJudged").ToInt(), 1)

    def test_statistics(self):
        whole = simple.SubstrateStatistics(**self.all)
        alone = simple.SubstrateStatistics(Fibres=self.outer)
        for port in range(4):
            self.assertEqual(table(alone, port), table(whole, port))
        self.assertAlmostEqual(fetch(alone).GetValueByName(0, "FVF").ToDouble(), 0.6, delta=0.02)

    def test_statistics_of_other_surfaces_need_their_fibres(self):
        for surfaces in (self.inner, simple.Transform(Input=self.outer)):
            with self.assertError(r"not polylines.*not the surfaces"):
                simple.SubstrateStatistics(Fibres=surfaces).UpdatePipeline()

    def test_writer(self):
        for name, inputs in (("whole", self.all), ("alone", {"Outer": self.outer})):
            simple.SubstrateWriter(FolderName=os.path.join(self.folder, name), **inputs).UpdatePipeline()
        whole, alone = os.path.join(self.folder, "whole"), os.path.join(self.folder, "alone")
        self.assertEqual(files(alone), files(whole))
        self.assertTrue(any(name.startswith("inner") for name in files(alone)))
        different = [name for name in files(whole) if not filecmp.cmp(os.path.join(whole, name), os.path.join(alone, name), shallow=False)]
        self.assertEqual(different, ["manifest.json"])  # which tells of the connections

    def test_fibres_are_those_that_have_grown(self):
        """Whatever state the optimiser before them was asked for since."""
        optimizer = simple.CapsuleOptimizer(Input=self.fibres, KeepHistory=1, HistoryInterval=10)
        surfaces = simple.MyelinSurface(Input=simple.FibreRadialGrowth(Input=simple.OutputPort(optimizer, 0), VoxelSize=0.2))
        before, after = os.path.join(self.folder, "before"), os.path.join(self.folder, "after")
        simple.SubstrateWriter(Outer=simple.OutputPort(surfaces, 0), FolderName=before).UpdatePipeline()
        optimizer.UpdatePipeline(0)
        simple.SubstrateWriter(Outer=simple.OutputPort(surfaces, 0), FolderName=after).UpdatePipeline()
        self.assertTrue(filecmp.cmp(os.path.join(before, "fibres.strands"), os.path.join(after, "fibres.strands"), shallow=False))

    def test_save_data(self):
        """As by File > Save Data: the same folder as the filter's."""
        saved, written = os.path.join(self.folder, "saved.substrate"), os.path.join(self.folder, "written")
        simple.SaveData(saved, proxy=self.outer)
        simple.SubstrateWriter(Outer=self.outer, FolderName=written).UpdatePipeline()
        self.assertEqual(files(saved), files(written))
        self.assertTrue(any(name.startswith("inner") for name in files(saved)))
        different = [name for name in files(saved) if not filecmp.cmp(os.path.join(saved, name), os.path.join(written, name), shallow=False)]
        self.assertLessEqual(set(different), {"manifest.json", "README.txt"})
        fibres = os.path.join(self.folder, "fibres.substrate")
        # There is no such format for fibres. Python falls over it in ParaView itself, 5.11 in another way than 5.13.
        with self.assertError("No matching writer found"), self.assertRaises(Exception):
            simple.SaveData(fibres, proxy=self.fibres)
        self.assertFalse(os.path.exists(fibres))

    def test_other_outer_surfaces_are_judged_alone(self):
        through = simple.Transform(Input=self.outer)
        certificate = fetch(simple.SubstrateCertificate(Outer=through))
        judged = [certificate.GetValueByName(0, name).ToInt() for name in ("Certified", "OuterJudged", "InnerJudged")]
        self.assertEqual(judged, [1, 1, 0])
        folder = os.path.join(self.folder, "outer")
        without = simple.PassArrays(Input=through, CellDataArrays=["FibreId", "BundleId", "Surface"], FieldDataArrays=["Domain"])
        simple.SubstrateWriter(Outer=without, FolderName=folder).UpdatePipeline()
        with open(os.path.join(folder, "README.txt")) as file:
            self.assertIn("without inner surfaces", file.readline())
        with open(os.path.join(folder, "manifest.json")) as file:
            self.assertEqual(json.load(file)["judged"], ["outer"])

    def test_axons_without_their_surfaces_are_refused(self):
        """Surfaces that come through another filter or a file record that their fibres have axons."""
        through, inner = simple.Transform(Input=self.outer), simple.Transform(Input=self.inner)
        folder = os.path.join(self.folder, "whole")
        for refused in (simple.SubstrateWriter(Outer=through, FolderName=folder), simple.SubstrateStatistics(Outer=through, Fibres=self.fibres),
                        simple.SubstrateSampler(Outer=through), simple.Lesion(Outer=through, MyelinLoss=0.3), simple.HistologyMask(Outer=through)):
            with self.assertError(r"Outer has fibre \d+ with an axon.*connect as Inner"):
                refused.UpdatePipeline()
        self.assertFalse(os.path.exists(folder))
        part = simple.Threshold(Input=inner, Scalars=["CELLS", "FibreId"], LowerThreshold=2, UpperThreshold=1e9)
        with self.assertError(r"Outer has fibre 1 with an axon.*Inner does not have its surface"):
            simple.SubstrateWriter(Outer=through, Inner=simple.ExtractSurface(Input=part), FolderName=folder).UpdatePipeline()
        simple.SubstrateWriter(Outer=through, Inner=inner, FolderName=folder).UpdatePipeline()
        self.assertTrue(any(name.startswith("inner") for name in files(folder)))


if __name__ == "__main__":
    main()
