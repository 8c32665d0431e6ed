# SPDX-License-Identifier: BSD-3-Clause
# ctest-timeout: 300
"""CapsuleOptimizer in ParaView: what it hands on, says and keeps."""

from cactus_testing import CactusTestCase, fetch, main
from paraview.simple import BundleInitializer, CapsuleOptimizer, Transform


def number(data, name):
    return data.GetFieldData().GetArray(name).GetValue(0)


def bundle(**properties):
    return BundleInitializer(Side=10, FibreVolumeFraction=0.6, MeanDispersion=8, **properties)


class Optimizer(CactusTestCase):
    def test_no_overlap_is_left_and_the_shape_is_reported(self):
        optimizer = CapsuleOptimizer(Input=bundle(), TrimToDomain=0)
        fibres = fetch(optimizer, 0)
        self.assertEqual(number(fibres, "Converged"), 1)
        self.assertLessEqual(number(fibres, "MaximumPenetration"), 1e-3)
        overlap = fibres.GetPointData().GetArray("Overlap")
        self.assertEqual(overlap.GetNumberOfTuples(), fibres.GetNumberOfPoints())
        self.assertAlmostEqual(overlap.GetRange()[1], number(fibres, "MaximumPenetration"))
        self.assertAlmostEqual(number(fibres, "InitialMeanDispersion"), 8, delta=0.3)
        self.assertAlmostEqual(number(fibres, "MeanDispersion"), number(fibres, "InitialMeanDispersion"), delta=1)
        self.assertGreater(number(fibres, "TangentDispersion"), number(fibres, "InitialTangentDispersion"))
        self.assertEqual(number(fibres, "CrossingAngle"), 0)
        self.assertGreater(number(fibres, "SmallestBendRadius"), 1)
        self.assertGreater(number(fibres, "LengthIncrease"), 0)
        self.assertLess(number(fibres, "LengthIncrease"), 0.2)
        self.assertEqual(fibres.GetFieldData().GetAbstractArray("Provenance").GetNumberOfValues(), 2)

        table = fetch(optimizer, 1)
        names = [table.GetColumnName(i) for i in range(table.GetNumberOfColumns())]
        self.assertEqual(names, ["Iteration", "OverlapCost", "MaximumPenetration", "OverlappingPairs", "CurvatureCost",
                                 "LengthCost", "RadiusCost", "CompactnessCost", "Seconds"])
        last = table.GetNumberOfRows() - 1
        self.assertGreater(last, 10)
        self.assertGreater(table.GetColumnByName("MaximumPenetration").GetValue(0), 0.1)
        self.assertLessEqual(table.GetColumnByName("MaximumPenetration").GetValue(last), 1e-3)
        self.assertEqual(table.GetColumnByName("Iteration").GetValue(last), last)

    def test_several_bundles_in_any_direction(self):
        upright = bundle()
        lying = Transform(Input=bundle(Seed=2))
        lying.Transform.Rotate = [90, 0, 0]
        lying.TransformAllInputVectors = 0
        optimizer = CapsuleOptimizer(Input=[upright, lying])
        fibres = fetch(optimizer, 0)
        self.assertEqual(number(fibres, "Converged"), 1)
        ids = fibres.GetCellData().GetArray("BundleId")
        self.assertEqual({ids.GetValue(i) for i in range(fibres.GetNumberOfCells())}, {1, 2})
        self.assertAlmostEqual(number(fibres, "InitialCrossingAngle"), 90, delta=1)
        self.assertAlmostEqual(number(fibres, "CrossingAngle"), 90, delta=1)

    def test_what_runs_out_of_iterations_says_so_and_keeps_the_best(self):
        source = bundle()
        optimizer = CapsuleOptimizer(Input=source, MaximumIterations=3)
        with self.assertError("overlaps remain: MaximumIterations were used up after 3 iterations"):
            fibres = fetch(optimizer, 0)
        self.assertEqual(number(fibres, "Converged"), 0)
        self.assertGreater(number(fibres, "MaximumPenetration"), 1e-3)
        self.assertGreater(fibres.GetNumberOfCells(), 0)


if __name__ == "__main__":
    main()
