// SPDX-License-Identifier: BSD-3-Clause
// Guarantees: a coarser copy keeps ends, gives no segment of zero length and leaves out about half; a uniform move of it moves
// all control points alike, and without a move none changes; a run that begins with it continues from wherever it was stopped.
#include "optimiser/CoarseFibres.h"

#include "BundleBetweenWalls.h"
#include "RandomBundle.h"
#include "ScratchPath.h"
#include "bundle/BundleInitializer.h"
#include "optimiser/CapsuleOptimizer.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <cstdio>
#include <vector>

namespace
{

using namespace cactus;

Fibres smallBundle()
{
  BundleBetweenWalls options;
  options.side = 6.0;
  options.meanDispersion = 20.0;
  options.dispersionModel = DispersionModel::Watson;
  return initialiseBundles(options);
}

} // namespace

TEST(CoarseFibres, KeepEndsAndLeaveOutWhatIsStraight)
{
  for (const double bend : { 0.0, 0.3 })
  {
    for (const int points : { 2, 3, 4, 11, 12 })
    {
      const Fibres fine = randomBundle(5, 20, points, 8.0, bend);
      const CoarseFibres fewer(fine);
      const Fibres& coarse = fewer.fibres();
      ASSERT_EQ(coarse.size(), fine.size());
      EXPECT_EQ(coarse.fibreIds, fine.fibreIds);
      for (std::size_t f = 0; f < fine.size(); ++f)
      {
        EXPECT_EQ(coarse.points[coarse.offsets[f]], fine.points[fine.offsets[f]]);
        EXPECT_EQ(coarse.points[coarse.offsets[f + 1] - 1], fine.points[fine.offsets[f + 1] - 1]);
        EXPECT_EQ(coarse.radii[coarse.offsets[f + 1] - 1], fine.radii[fine.offsets[f + 1] - 1]);
        EXPECT_TRUE(bend > 0.0 || coarse.pointCount(f) == fine.pointCount(f) / 2 + 1);
      }
      EXPECT_NO_THROW(validate(coarse));
    }
  }
}

// A fibre that goes back and forth, and one that ends where it begins.
TEST(CoarseFibres, LeaveNoSegmentOfZeroLength)
{
  Fibres fine;
  fine.domain = Domain::cube(10.0);
  fine.addFibre(1, 1, 0.5);
  for (int i = 0; i < 9; ++i)
  {
    fine.addPoint(Eigen::Vector3d(i % 2, 0.0, 0.0), 0.5);
  }
  fine.addFibre(2, 1, 0.5);
  for (int i = 0; i < 4; ++i)
  {
    const double angle = 2.0 * std::acos(-1.0) * (i % 3) / 3.0;
    fine.addPoint(Eigen::Vector3d(std::cos(angle), std::sin(angle), 3.0), 0.5);
  }
  const CoarseFibres fewer(fine);
  EXPECT_NO_THROW(validate(fewer.fibres()));
  EXPECT_EQ(fewer.fibres().points, fine.points);
}

TEST(CoarseFibres, MoveAllControlPointsAlike)
{
  const Fibres fine = randomBundle(6, 20, 12, 8.0, 0.1);
  const CoarseFibres fewer(fine);
  ASSERT_LT(fewer.fibres().points.size(), 0.75 * static_cast<double>(fine.points.size()));
  // Without a move, exact to the last bit.
  EXPECT_EQ(fewer.refine(fewer.fibres().points, fine.points), fine.points);
  const Eigen::Vector3d by(0.3, -0.2, 0.7);
  std::vector<Eigen::Vector3d> moved = fewer.fibres().points;
  for (Eigen::Vector3d& point : moved)
  {
    point += by;
  }
  const std::vector<Eigen::Vector3d> found = fewer.refine(moved, fine.points);
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    EXPECT_LT((found[i] - fine.points[i] - by).norm(), 1e-12);
  }
}

// A quadratic function of the place along a fibre is interpolated exactly between evenly spaced control points.
TEST(CoarseFibres, InterpolateSmoothly)
{
  const Fibres fine = randomBundle(7, 3, 13, 8.0, 0.0);
  const CoarseFibres fewer(fine);
  const auto valueAt = [](std::size_t place) { return Eigen::Vector3d(1.0, double(place), double(place * place)); };
  std::vector<Eigen::Vector3d> values;
  for (std::size_t f = 0; f < fine.size(); ++f)
  {
    for (std::size_t i = 0; i < 13; i += 2)
    {
      values.push_back(valueAt(i));
    }
  }
  const std::vector<Eigen::Vector3d> all = fewer.interpolate(values);
  ASSERT_EQ(all.size(), fine.points.size());
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const std::size_t place = i % 13;
    if (place != 1 && place != 11) // beside an end the slope there is that of the next segment alone
    {
      EXPECT_LT((all[i] - valueAt(place)).norm(), 1e-12) << i;
    }
  }
}

// Guarantee: a run that begins with fewer control points continues with the same bits wherever it is stopped; and its observer
// sees all control points in every iteration.
TEST(CoarseFibres, RunGoesOnWhereverItWasStopped)
{
  const Fibres start = smallBundle();
  Fibres whole = start;
  const OptimisationResult expected = optimise(whole, {}, {});
  ASSERT_EQ(expected.reason, StopReason::Converged);
  CapsuleOptimizerOptions options;
  options.checkpointFile = cactus_testing::scratchPath("cactus-coarse-checkpoint");
  std::remove(options.checkpointFile.c_str());
  options.checkpointInterval = 0.0;
  options.resume = true;
  const int count = static_cast<int>(expected.convergence.size());
  for (int until = 0;; until += 19)
  {
    Fibres part = start;
    options.maximumIterations = until;
    const OptimisationResult result = optimise(part, options, {},
      [&](const ConvergenceRow&, const Fibres& state) { ASSERT_EQ(state.points.size(), start.points.size()); });
    if (until < count - 1)
    {
      ASSERT_EQ(result.reason, StopReason::MaximumIterations);
      continue;
    }
    EXPECT_EQ(part.points, whole.points);
    ASSERT_EQ(result.convergence.size(), expected.convergence.size());
    for (int i = 0; i < count; ++i)
    {
      ASSERT_EQ(result.convergence[i].iteration, i);
      ASSERT_EQ(result.convergence[i].overlapCost, expected.convergence[i].overlapCost);
    }
    break;
  }
  std::remove(options.checkpointFile.c_str());
}
