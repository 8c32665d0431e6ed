# SPDX-License-Identifier: BSD-3-Clause
# ctest-extended
# ctest-needs: display
"""The histograms of SubstrateStatistics in their chart view, without a setting: the radii asked for, outer and inner, as bars over the middles of
their bins, each in its colour."""

import numpy
from cactus_testing import CactusTestCase, fetch, main, pixels
from paraview import simple

COLUMNS = ["InnerRadiusFibres", "OuterRadiusFibres", "TargetRadiusFibres"]


class HistogramChart(CactusTestCase):
    expected = r"fibres are not as asked"  # in so coarse voxels

    def setUp(self):
        super().setUp()
        fibres = simple.OutputPort(simple.CapsuleOptimizer(Input=simple.BundleInitializer(Border="Walls", Side=6)), 0)
        surfaces = simple.MyelinSurface(Input=simple.FibreRadialGrowth(Input=fibres, VoxelSize=0.15))
        self.statistics = simple.SubstrateStatistics(Fibres=simple.OutputPort(surfaces, 0), NumberOfBins=12)
        self.view = simple.CreateView("HistogramChartView", ViewSize=[500, 400])
        self.addCleanup(simple.Delete, self.view)

    def test_shows_the_radii(self):
        shown = simple.Show(simple.OutputPort(self.statistics, 2), self.view)
        self.assertEqual(sorted(shown.SeriesVisibility), COLUMNS)
        self.assertEqual((shown.UseIndexForXAxis, shown.XArrayName), (0, "RadiusMiddle_um"))
        self.assertEqual((self.view.LeftAxisTitle, self.view.BottomAxisTitle), ("fibres", "radius (µm)"))
        table = fetch(self.statistics, 2)
        edges = [[table.GetValueByName(row, name).ToDouble() for name in ("RadiusFrom_um", "RadiusMiddle_um", "RadiusTo_um")] for row in range(12)]
        for low, middle, high in edges:
            self.assertAlmostEqual(middle, (low + high) / 2)

    def test_each_is_drawn_in_its_colour(self):
        shown = simple.Show(simple.OutputPort(self.statistics, 2), self.view)
        image = pixels(self.view)
        for name, place in (("OuterRadiusFibres", 0), ("InnerRadiusFibres", 2)):
            others = [other for other in range(3) if other != place]
            is_its = numpy.all([image[:, :, place] > 1.5 * image[:, :, other] for other in others], axis=0)
            self.assertGreater(numpy.count_nonzero(is_its), 300, name)
            shown.SeriesVisibility = [one for one in COLUMNS if one != name]
            image_without = pixels(self.view)
            is_its = numpy.all([image_without[:, :, place] > 1.5 * image_without[:, :, other] for other in others], axis=0)
            self.assertLess(numpy.count_nonzero(is_its), 60, name)
            shown.SeriesVisibility = COLUMNS

    def test_other_tables_are_shown_as_ever(self):
        shown = simple.Show(simple.OutputPort(self.statistics, 1), self.view, "HistogramChartRepresentation")
        self.assertGreater(len(shown.SeriesVisibility), 3)


if __name__ == "__main__":
    main()
