// SPDX-License-Identifier: BSD-3-Clause
// Guarantees: in a periodic domain no two capsules overlap, images counted; fibres that repeat do so bit for bit; the result does
// not depend on threads or processes.
#include "BundleBetweenWalls.h"
#include "ThreadTeam.h"
#include "base/Error.h"
#include "bundle/BundleInitializer.h"
#include "fibres/PeriodicImages.h"
#include "fibres/SegmentDistance.h"
#include "optimiser/CapsuleOptimizer.h"
#include "optimiser/OverlapReport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <thread>
#include <vector>

using namespace cactus;

namespace
{

Fibres bundle(Border border, double variation = 0.0)
{
  BundleInitializerOptions options = ofPipes();
  options.border = border;
  options.side = 9.0;
  options.radius.maximum = 2.0;
  options.calibre.deviation = variation;
  options.fibreVolumeFraction = 0.6;
  return initialiseBundles(options);
}

/// The largest overlap of capsules, as a part of their radii, by brute force over all pairs and their images nearby.
double largestOverlap(const Fibres& fibres)
{
  double largest = 0.0;
  const double side = fibres.domain.size().x();
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    for (std::size_t g = 0; g < fibres.size(); ++g)
    {
      for (std::size_t i = fibres.offsets[f]; f != g && i + 1 < fibres.offsets[f + 1]; ++i)
      {
        for (std::size_t j = fibres.offsets[g]; j + 1 < fibres.offsets[g + 1]; ++j)
        {
          const Eigen::Vector3d apart = fibres.points[i] - fibres.points[j];
          if (std::abs(apart.z()) > 4.0)
          {
            continue;
          }
          const Eigen::Vector3d shift(std::round(apart.x() / side) * side, std::round(apart.y() / side) * side, 0.0);
          const double distance =
            closestPoints(fibres.points[i] - shift, fibres.points[i + 1] - shift, fibres.points[j], fibres.points[j + 1])
              .distance;
          const double touching = fibres.radii[i] + fibres.radii[j];
          largest = std::max(largest, 1.0 - distance / touching);
        }
      }
    }
  }
  return largest;
}

} // namespace

TEST(PeriodicOptimisation, EndsWithoutOverlapAcrossTheFaces)
{
  for (const Border border : { Border::PeriodicAcross, Border::Periodic })
  {
    Fibres fibres = bundle(border);
    const CapsuleOptimizerOptions options;
    EXPECT_GT(largestOverlap(fibres), 0.05) << "or there is nothing to do";
    const OptimisationResult result = optimise(fibres, options, {});
    EXPECT_EQ(result.reason, StopReason::Converged);
    EXPECT_LE(largestOverlap(fibres), options.overlapTolerance);
    EXPECT_NEAR(std::max(0.0, largestOverlap(fibres)), result.maximumPenetration, 1e-9);
  }
}

TEST(PeriodicOptimisation, FibresStillRepeat)
{
  for (const DescentMethod method : { DescentMethod::Momentum, DescentMethod::Adagrad })
  {
    Fibres fibres = bundle(Border::Periodic, 0.25);
    const std::vector<Eigen::Vector3d> before = fibres.points;
    CapsuleOptimizerOptions options;
    options.method = method;
    options.maximumIterations = 40;
    optimise(fibres, options, {});
    EXPECT_TRUE(fibres.points != before || method == DescentMethod::Adagrad) << "whose first steps are no gain";
    for (std::size_t f = 0; f < fibres.size(); ++f)
    {
      const FibrePeriod period = periodOf(fibres, f);
      const std::size_t begin = fibres.offsets[f];
      const std::size_t middle = begin + (fibres.pointCount(f) - period.points) / 2;
      for (std::size_t i = begin; i + period.points < fibres.offsets[f + 1]; ++i)
      {
        // Control points before the middle period are copies of it, as are those behind.
        const Eigen::Vector3d back = fibres.points[i + period.points] - period.shift;
        const Eigen::Vector3d forth = fibres.points[i] + period.shift;
        EXPECT_TRUE(i < middle ? fibres.points[i] == back : fibres.points[i + period.points] == forth) << f << ' ' << i;
      }
    }
  }
}

TEST(PeriodicOptimisation, SameBitsOnAnyNumberOfThreads)
{
  std::vector<Fibres> results;
  for (const int threads : { 1, 3 })
  {
    results.push_back(bundle(Border::Periodic, 0.25));
    Context context;
    context.threads = threads;
    CapsuleOptimizerOptions options;
    options.maximumIterations = 60;
    optimise(results.back(), options, context);
  }
  EXPECT_EQ(results[0].points, results[1].points);
}

TEST(PeriodicOptimisation, ARestingStateStays)
{
  Fibres fibres = bundle(Border::Periodic);
  optimise(fibres, {}, {});
  const Fibres before = fibres;
  const OptimisationResult again = optimise(fibres, {}, {});
  EXPECT_EQ(again.convergence.size(), 1u);
  EXPECT_EQ(fibres.points, before.points);
}

TEST(PeriodicOptimisation, SeveralProcessesGetTheSame)
{
  CapsuleOptimizerOptions options;
  options.maximumIterations = 60;
  const auto bytesOf = [](const Fibres& fibres)
  { return std::string(reinterpret_cast<const char*>(fibres.points.data()), fibres.points.size() * sizeof(Eigen::Vector3d)); };
  Fibres alone = bundle(Border::PeriodicAcross);
  const std::vector<Eigen::Vector3d> before = alone.points;
  optimise(alone, options, {});
  EXPECT_NE(alone.points, before);
  const auto told = cactus_testing::inTeam(2,
    [&](Team& team) -> std::string
    {
      Fibres fibres = bundle(Border::PeriodicAcross);
      optimise(fibres, options, {}, {}, &team);
      return bytesOf(fibres);
    });
  EXPECT_EQ(told[0], bytesOf(alone));
  EXPECT_EQ(told[1], bytesOf(alone));
  options.checkpointFile = "checkpoint";
  const auto refused = cactus_testing::inTeam(2,
    [&](Team& team) -> std::string
    {
      Fibres fibres = bundle(Border::PeriodicAcross);
      optimise(fibres, options, {}, {}, &team);
      return "done";
    });
  EXPECT_NE(refused[0].find("CheckpointFile cannot be kept for a periodic domain"), std::string::npos) << refused[0];
}
