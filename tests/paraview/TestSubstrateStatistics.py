# SPDX-License-Identifier: BSD-3-Clause
"""The statistics of two straight tubes are those of the formulas, and what cannot be measured is said."""

import math

from cactus_testing import CactusTestCase, fetch, main, produce
from paraview.simple import GroupDatasets, SubstrateStatistics
from surfaces import EQUIVALENT, POLYGON, SIDES, fibres, set_domain, surfaces, tube, two_tubes
from vtkmodules.vtkCommonDataModel import vtkPolyData

# Perimeter over area of the polygon in the unit circle, which the tubes have in place of a circle.
SURFACE_TO_VOLUME = 2 * SIDES * math.sin(math.pi / SIDES) / POLYGON


def columns(table):
    return {
        table.GetColumnName(i): [table.GetValue(row, i).ToDouble() for row in range(table.GetNumberOfRows())]
        for i in range(table.GetNumberOfColumns())
    }


class Statistics(CactusTestCase):
    def setUp(self):
        super().setUp()
        self.fibres, self.outer, self.inner = two_tubes()

    def measure(self, **properties):
        inputs = {"Fibres": produce(self.fibres), "Outer": produce(self.outer), "Inner": produce(self.inner)}
        inputs.update(properties)
        return SubstrateStatistics(**inputs)

    def test_whole(self):
        row = {name: values[0] for name, values in columns(fetch(self.measure())).items()}
        self.assertEqual(row["Fibres"], 2)
        self.assertAlmostEqual(row["FVF"], POLYGON * 3.25 * 10 / 1000, places=6)
        self.assertAlmostEqual(row["AVF"], POLYGON * 1.30 * 10 / 1000, places=6)
        self.assertAlmostEqual(row["MVF"], row["FVF"] - row["AVF"], places=12)
        self.assertAlmostEqual(row["AggregateGRatio"], math.sqrt(0.4), places=5)
        self.assertAlmostEqual(row["CapsuleVolumeFraction"], math.pi * 3.25 * 10 / 1000, places=9)
        self.assertAlmostEqual(row["MeanOuterRadius_um"], 1.25 * EQUIVALENT, places=5)
        self.assertAlmostEqual(row["MeanInnerRadius_um"], 0.8 * EQUIVALENT, places=5)
        self.assertAlmostEqual(row["MeanDispersion_deg"], 0)
        self.assertEqual(row["LargestPenetration"], 0)
        self.assertEqual([row[n] for n in ("OuterClosed", "OuterOpen", "InnerClosed", "InnerOpen")], [2, 0, 2, 0])
        self.assertEqual(row["Triangles"], self.outer.GetNumberOfCells() + self.inner.GetNumberOfCells())

    def test_summary_is_read_line_by_line(self):
        """What the window shows: the columns of the whole as rows, in their order, and "-" for what there is not."""

        def lines(statistics):
            table = fetch(statistics, 4)
            return [(table.GetValueByName(row, "Quantity").ToString(), table.GetValueByName(row, "Value").ToString()) for row in range(table.GetNumberOfRows())]

        whole = fetch(self.measure())
        read = lines(self.measure())
        self.assertEqual([name for name, _ in read], [whole.GetColumnName(i) for i in range(whole.GetNumberOfColumns())])
        for name, value in read:
            exact = whole.GetValueByName(0, name).ToDouble()
            self.assertEqual(value, "-" if math.isnan(exact) else f"{exact:.6g}", name)
        self.assertEqual(dict(read)["Fibres"], "2")
        self.assertEqual(dict(read)["ExtraAxonalDiffusivityRatioX"], "-")
        alone = dict(lines(SubstrateStatistics(Fibres=produce(self.fibres), Outer=produce(self.outer))))
        self.assertEqual(alone["MeanInnerRadius_um"], "-")
        self.assertEqual(alone["FVF"], dict(read)["FVF"])

    def test_per_fibre(self):
        table = columns(fetch(self.measure(), 1))
        self.assertEqual(table["FibreId"], [3, 5])
        self.assertEqual(table["BundleId"], [2, 2])
        self.assertEqual(table["TargetRadius_um"], [1.0, 1.5])
        for value, wanted in zip(table["OuterVolume_um3"], (10 * POLYGON, 22.5 * POLYGON)):
            self.assertAlmostEqual(value, wanted, places=4)
        self.assertLess(max(table["GRatioDeviation"]), 1e-5)
        for value, wanted in zip(table["GRatio"], (0.7, 0.6)):
            self.assertAlmostEqual(value, wanted, places=5)
        self.assertEqual(table["OuterClosed"], [1, 1])
        self.assertEqual(table["OuterComponents"], [1, 1])
        self.assertEqual(table["OuterCuts"], [10, 10])
        for value in table["Length_um"]:
            self.assertAlmostEqual(value, 10)

    def test_histograms(self):
        table = columns(fetch(self.measure(NumberOfBins=3), 2))
        self.assertEqual(table["RadiusFrom_um"], [0, 0.5, 1.0])
        self.assertEqual(table["RadiusTo_um"], [0.5, 1.0, 1.5])
        self.assertEqual(table["TargetRadiusFibres"], [0, 0, 2])
        self.assertEqual(table["InnerRadiusFibres"], [0, 2, 0])
        self.assertEqual(sum(table["GRatioFibres"]), 2)

    def test_a_fibre_that_only_grazes_the_domain_is_in_no_mean_or_histogram(self):
        along = [z - 6 for z in range(13)]
        lines = fibres({3: (1.0, [(-2, 0, z) for z in along]), 4: (2.0, [(5.5, 0, z) for z in along])}, 10)
        outer = surfaces({3: tube(-2, 0, 1.0, 10), 4: tube(4.5, 0, 0.5, 10)}, 0, 10)  # what there is of it in the domain
        statistics = SubstrateStatistics(Fibres=produce(lines), Outer=produce(outer))
        table = columns(fetch(statistics, 1))
        self.assertEqual((table["Length_um"][1], table["OuterCuts"][1]), (0, 0))
        self.assertTrue(0.5 < table["OuterRadius_um"][1] < 2)
        self.assertEqual(columns(fetch(statistics))["MeanTargetRadius_um"], [1.0])
        self.assertEqual(sum(columns(fetch(statistics, 2))["OuterRadiusFibres"]), 1)

    def test_what_diffusion_reads(self):
        row = {name: values[0] for name, values in columns(fetch(self.measure())).items()}
        self.assertAlmostEqual(row["MeanSinuosity"], 1)
        self.assertAlmostEqual(row["MeanUndulation_um"], 0)
        self.assertAlmostEqual(row["MeanInnerAxisRatio"], 1, places=5)
        self.assertAlmostEqual(row["MeanOuterCalibreVariation"], 0, places=5)
        self.assertAlmostEqual(row["MeanAxonAreaFluctuation_um"], 0, places=5)
        effective = ((0.7**6 + 0.9**6) / (0.7**2 + 0.9**2)) ** 0.25 * EQUIVALENT
        self.assertAlmostEqual(row["EffectiveRadius_um"], effective, places=5)
        self.assertAlmostEqual(row["MiddleEffectiveRadius_um"], effective, places=5)
        intra = SURFACE_TO_VOLUME * (0.7 + 0.9) / (0.7**2 + 0.9**2)
        self.assertAlmostEqual(row["IntraAxonalSurfaceToVolume_um-1"], intra, places=5)
        wall = SURFACE_TO_VOLUME * POLYGON * (1.0 + 1.5) * 10
        self.assertAlmostEqual(row["ExtraAxonalSurfaceToVolume_um-1"], wall / (1000 - POLYGON * 3.25 * 10), places=5)
        table = columns(fetch(self.measure(), 1))
        for i, radius in enumerate((0.7, 0.9)):
            self.assertAlmostEqual(table["Sinuosity"][i], 1)
            self.assertAlmostEqual(table["OuterAxisRatio"][i], 1, places=5)
            self.assertAlmostEqual(table["MeanInverseAxonArea_um-2"][i], 1 / (POLYGON * radius**2), places=4)
            self.assertAlmostEqual(table["AxonAreaVariance"][i], 0, places=6)
            self.assertAlmostEqual(table["AxonDiffusivityRatio"][i], 1, places=6)
            self.assertAlmostEqual(table["EffectiveRadius_um"][i], radius * EQUIVALENT, places=5)
            self.assertAlmostEqual(table["AxonSurfaceToVolume_um-1"][i], SURFACE_TO_VOLUME / radius, places=4)

    def test_profiles(self):
        table = columns(fetch(self.measure(), 3))
        names = ["FibreId", "ArcLength_um", "OuterDiameter_um", "InnerDiameter_um", "OuterCircularity", "InnerCircularity", "OuterAxisRatio", "InnerAxisRatio", "MyelinThickness_um", "GRatio"]
        self.assertEqual(list(table), names)
        self.assertEqual(table["FibreId"], [3] * 10 + [5] * 10)
        # The centre lines begin 1 µm before the domain.
        self.assertEqual(table["ArcLength_um"], 2 * [i + 1.5 for i in range(10)])
        for name, wanted in (("OuterDiameter_um", (2.0, 3.0)), ("InnerDiameter_um", (1.4, 1.8)), ("MyelinThickness_um", (0.3, 0.6))):
            for i, value in enumerate(table[name]):
                self.assertAlmostEqual(value, wanted[i // 10] * EQUIVALENT, places=5)
        for i, value in enumerate(table["GRatio"]):
            self.assertAlmostEqual(value, (0.7, 0.6)[i // 10], places=5)
        self.assertEqual(len(columns(fetch(self.measure(CutSpacing=0.5), 3))["FibreId"]), 40)
        alone = fetch(SubstrateStatistics(Fibres=produce(self.fibres)), 3)
        self.assertEqual((alone.GetNumberOfRows(), alone.GetNumberOfColumns()), (0, len(names)))

    def test_blocks_are_measured_as_one(self):
        """Every port, bit for bit, but for the bundles: each block has its own."""
        along = [z - 6 for z in range(13)]
        lines = {3: (1.0, [(-2, 0, z) for z in along]), 5: (1.5, [(2, 0, z) for z in along])}

        def grouped(parts):
            return GroupDatasets(Input=[produce(part) for part in parts])

        blocks = SubstrateStatistics(
            Fibres=grouped(fibres({i: lines[i]}, 10) for i in lines),
            Outer=grouped(surfaces({i: tube(x, 0, radius, 10)}, 0, 10) for i, x, radius in ((5, 2, 1.5), (3, -2, 1.0))),
            Inner=grouped(surfaces({i: tube(x, 0, radius, 10)}, 1, 10) for i, x, radius in ((3, -2, 0.7), (5, 2, 0.9))))
        for port in range(4):
            found, wanted = columns(fetch(blocks, port)), columns(fetch(self.measure(), port))
            self.assertEqual(found.pop("BundleId", None), [2, 4] if port == 1 else None)
            for of_bundles in ("BundleId", "LocalSpread_deg"):
                found.pop(of_bundles, None)
                wanted.pop(of_bundles, None)
            self.assertEqual(repr(found), repr(wanted), port)  # in which NaN is NaN
            self.assertGreater(len(next(iter(found.values()))), 0)

    def test_fibres_alone(self):
        row = {name: values[0] for name, values in columns(fetch(SubstrateStatistics(Fibres=produce(self.fibres)))).items()}
        self.assertTrue(math.isnan(row["FVF"]) and math.isnan(row["AggregateGRatio"]))
        self.assertAlmostEqual(row["MeanTargetRadius_um"], 1.25)

    def test_fibre_without_inner_surface(self):
        one = surfaces({5: tube(2, 0, 0.9, 10)}, 1, 10)
        table = columns(fetch(self.measure(Inner=produce(one)), 1))
        self.assertTrue(math.isnan(table["GRatio"][0]) and math.isnan(table["InnerRadius_um"][0]))
        self.assertEqual(table["InnerTriangles"][0], 0)
        self.assertAlmostEqual(table["GRatio"][1], 0.6, places=5)

    def test_empty_surfaces_fill_nothing(self):
        empty = vtkPolyData()
        set_domain(empty, 10)
        statistics = self.measure(Outer=produce(empty), Inner=produce(empty))
        row = {name: values[0] for name, values in columns(fetch(statistics)).items()}
        self.assertEqual([row[name] for name in ("FVF", "AVF", "MVF", "AggregateGRatio")], [0, 0, 0, 0])

    def test_walkers_outside(self):
        """Two tubes that fill a third of the domain: along them nothing is in the way, across them something is."""
        row = {name: values[0] for name, values in columns(fetch(self.measure())).items()}
        self.assertTrue(all(math.isnan(row[f"ExtraAxonalDiffusivity{kind}{axis}"]) for kind in ("Ratio", "Error") for axis in "XYZ"))
        row = {name: values[0] for name, values in columns(fetch(self.measure(ExtraAxonalWalkers=1000, WalkDistance=8, WalkStep=0.2))).items()}
        ratio, error = ([row[f"ExtraAxonalDiffusivity{kind}{axis}"] for axis in "XYZ"] for kind in ("Ratio", "Error"))
        self.assertAlmostEqual(ratio[2], 1.0, delta=3.5 * error[2])
        for axis in (0, 1):
            self.assertLess(error[axis], 0.1)
            self.assertLess(ratio[axis], 1.0 - 1.5 * error[axis])
            self.assertGreater(ratio[axis], 0.5)
        with self.assertError("ExtraAxonalWalkers is -1"):
            self.measure(ExtraAxonalWalkers=-1).UpdatePipeline()
        with self.assertError("WalkStep 0.001 µm makes walks of"):
            self.measure(ExtraAxonalWalkers=10, WalkDistance=1000, WalkStep=0.001).UpdatePipeline()

    def test_bounds(self):
        for name, value in (("CutSpacing", 1e-9), ("CutSpacing", 1e300), ("NumberOfBins", 0), ("NumberOfBins", 2**31 - 1)):
            statistics = self.measure()
            with self.assertError(name):
                statistics.SMProxy.GetProperty(name).SetElement(0, value)
                statistics.SMProxy.UpdateVTKObjects()
                statistics.UpdatePipeline()

    def test_surface_that_was_not_clipped(self):
        tall = surfaces({3: tube(-2, 0, 1, 11)}, 0, 10)
        with self.assertError(r"outer surface of fibre 3 reaches 0\.5.*ClipToDomain"):
            self.measure(Outer=produce(tall)).UpdatePipeline()

    def test_open_surface_is_told(self):
        part = tube(-2, 0, 1, 10)
        part.BuildCells()
        part.DeleteCell(0)
        part.RemoveDeletedCells()
        with self.assertError(r"1 outer and 0 inner surfaces are not closed"):
            statistics = self.measure(Outer=produce(surfaces({3: part, 5: tube(2, 0, 1.5, 10)}, 0, 10)))
            row = columns(fetch(statistics))
        self.assertEqual((row["OuterClosed"], row["OuterOpen"]), ([1], [1]))

    def test_wrong_inputs(self):
        with self.assertError(r"Outer holds inner surfaces"):
            self.measure(Outer=produce(self.inner)).UpdatePipeline()
        with self.assertError(r"fibre 4, which Fibres does not hold"):
            self.measure(Outer=produce(surfaces({4: tube(-2, 0, 1, 10)}, 0, 10))).UpdatePipeline()
        with self.assertError(r"Fibre.*Radius|no fibres|not polylines"):
            self.measure(Fibres=produce(self.outer)).UpdatePipeline()
        with self.assertError(r"no cell data FibreId"):
            bare = tube(-2, 0, 1, 10)
            self.measure(Outer=produce(bare)).UpdatePipeline()
        with self.assertError(r"another Domain"):
            other = surfaces({3: tube(-2, 0, 1, 10)}, 0, 10)
            set_domain(other, 12)
            self.measure(Outer=produce(other)).UpdatePipeline()


if __name__ == "__main__":
    main()
