# SPDX-License-Identifier: BSD-3-Clause
# ctest-extended
# ctest-needs: display
"""The optimiser's convergence in its chart view, without a setting: two columns on logarithmic axes with titles, both drawn."""

import numpy
from cactus_testing import CactusTestCase, fetch, main, pixels
from paraview import simple
from vtkmodules.vtkChartsCore import vtkAxis


COLUMNS = {"MaximumPenetration", "OverlappingPairs"}


class ConvergenceChart(CactusTestCase):
    def setUp(self):
        super().setUp()
        self.optimizer = simple.CapsuleOptimizer(Input=simple.BundleInitializer(Border="Walls", Side=8, MeanDispersion=10))
        self.view = simple.CreateView("ConvergenceChartView", ViewSize=[500, 400])
        self.addCleanup(simple.Delete, self.view)

    def test_shows_what_is_left_of_overlap(self):
        shown = simple.Show(simple.OutputPort(self.optimizer, 1), self.view)
        self.assertEqual(set(shown.SeriesVisibility), COLUMNS)
        self.assertEqual((shown.UseIndexForXAxis, shown.XArrayName), (0, "Iteration"))
        simple.Render(self.view)
        chart = self.view.GetClientSideObject().GetChart()
        for place, title in ((vtkAxis.LEFT, "penetration"), (vtkAxis.RIGHT, "pairs")):
            axis = chart.GetAxis(place)
            self.assertTrue(axis.GetLogScaleActive())
            self.assertIn(title, axis.GetTitle())
        self.assertIn("iteration", chart.GetAxis(vtkAxis.BOTTOM).GetTitle())
        table = fetch(self.optimizer, 1)
        for name, place in (("MaximumPenetration", vtkAxis.LEFT), ("OverlappingPairs", vtkAxis.RIGHT)):
            first = table.GetValueByName(0, name).ToDouble()
            axis = chart.GetAxis(place)
            self.assertLessEqual(axis.GetUnscaledMinimum(), first)
            self.assertGreaterEqual(axis.GetUnscaledMaximum(), first)
        self.assertGreater(chart.GetAxis(vtkAxis.RIGHT).GetUnscaledMaximum(), 5.7e7)  # what 500 µm begin with

    def test_stays_logarithmic_when_its_ranges_are_reset(self):
        """The window does so for the first data that a view shows. They end at no overlapping pairs, which have no logarithm."""
        simple.Show(simple.OutputPort(self.optimizer, 1), self.view)
        self.view.SMProxy.ResetDisplay()
        simple.Render(self.view)
        table = fetch(self.optimizer, 1)
        self.assertEqual(table.GetValueByName(table.GetNumberOfRows() - 1, "OverlappingPairs").ToDouble(), 0)
        chart = self.view.GetClientSideObject().GetChart()
        for place in (vtkAxis.LEFT, vtkAxis.RIGHT):
            axis = chart.GetAxis(place)
            self.assertTrue(axis.GetLogScaleActive())
            self.assertGreater(axis.GetUnscaledMinimum(), 0)

    def test_each_curve_is_drawn(self):
        shown = simple.Show(simple.OutputPort(self.optimizer, 1), self.view)
        both = pixels(self.view)
        for name in COLUMNS:
            shown.SeriesVisibility = sorted(COLUMNS - {name})
            differing = numpy.count_nonzero(numpy.max(abs(pixels(self.view) - both), axis=2) > 30)
            self.assertGreater(differing, 200, name)

    def test_other_tables_are_shown_as_ever(self):
        statistics = simple.SubstrateStatistics(Fibres=simple.OutputPort(self.optimizer, 0))
        shown = simple.Show(simple.OutputPort(statistics, 2), self.view, "ConvergenceChartRepresentation")
        self.assertGreater(len(shown.SeriesVisibility), 2)


if __name__ == "__main__":
    main()
