// SPDX-License-Identifier: BSD-3-Clause
#include "base/Constants.h"

#include "base/Random.h"
#include "bundle/CirclePlacement.h"
#include "bundle/CircleRelaxation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace cactus;

namespace
{

Circles randomCircles(double side, double density, double spread, std::uint64_t seed)
{
  Circles circles;
  Rectangle frame;
  frame.upper.setConstant(side);
  circles.frames = { frame };
  RandomEngine engine = randomStream(seed, RandomStage::Packing);
  double area = 0.0;
  while (area < density * frame.area())
  {
    const double radius = 0.4 * std::exp(spread * (uniform(engine) - 0.5));
    area += cactus::pi * radius * radius;
    circles.radii.push_back(radius);
    const double x = side * uniform(engine);
    const double y = side * uniform(engine);
    circles.centres.push_back(frame.clampCentre({ x, y }, radius));
    circles.frameOf.push_back(0);
  }
  return circles;
}

/// Largest relative overlap over all pairs, by brute force.
double largestOverlap(const Circles& circles)
{
  double worst = 0.0;
  for (std::size_t i = 0; i < circles.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      const double distance = (circles.centres[i] - circles.centres[j]).norm();
      worst = std::max(worst, 1.0 - distance / (circles.radii[i] + circles.radii[j]));
    }
  }
  return worst;
}

bool allInside(const Circles& circles)
{
  for (std::size_t i = 0; i < circles.size(); ++i)
  {
    const Rectangle& frame = circles.frame(i);
    if (((circles.centres[i] - frame.lower).array() < circles.radii[i] - 1e-9).any() ||
        ((frame.upper - circles.centres[i]).array() < circles.radii[i] - 1e-9).any())
    {
      return false;
    }
  }
  return true;
}

} // namespace

TEST(CirclePacking, RelaxationPartsAllPairs)
{
  for (const double density : { 0.3, 0.6, 0.78 })
  {
    for (const double spread : { 0.0, 1.0, 3.0 })
    {
      Circles circles = randomCircles(20.0, density, spread, 7);
      ASSERT_GT(largestOverlap(circles), 0.1);
      const Relaxation relaxation = relaxCircles(circles);
      EXPECT_TRUE(relaxation.separated) << density << " " << spread;
      EXPECT_LE(largestOverlap(circles), 1e-9) << density << " " << spread;
      EXPECT_TRUE(allInside(circles)) << density << " " << spread;
    }
  }
}

TEST(CirclePacking, RelaxationLeavesSeparateCirclesAlone)
{
  Circles circles = randomCircles(20.0, 0.6, 1.0, 8);
  ASSERT_TRUE(relaxCircles(circles).separated);
  const auto before = circles.centres;
  EXPECT_EQ(relaxCircles(circles).iterations, 0);
  EXPECT_EQ(circles.centres, before);
}

TEST(CirclePacking, CoincidentCentresComeApart)
{
  Circles circles = randomCircles(20.0, 0.5, 1.0, 9);
  std::fill(circles.centres.begin(), circles.centres.end(), Eigen::Vector2d(3.0, 17.0));
  EXPECT_TRUE(relaxCircles(circles).separated);
  EXPECT_LE(largestOverlap(circles), 1e-9);
  EXPECT_TRUE(allInside(circles));
}

TEST(CirclePacking, JammedCirclesAreReportedWithTheirOverlap)
{
  Circles circles = randomCircles(20.0, 0.97, 1.0, 10);
  const Relaxation relaxation = relaxCircles(circles);
  EXPECT_FALSE(relaxation.separated);
  EXPECT_NEAR(relaxation.largestOverlap, largestOverlap(circles), 1e-12);
  EXPECT_TRUE(allInside(circles));
}

TEST(CirclePacking, SameBitsOnAnyNumberOfThreads)
{
  Circles one = randomCircles(90.0, 0.75, 1.0, 11);
  ASSERT_GT(one.size(), 4096u); // enough that the relaxation does use its threads
  Circles two = one;
  Context context;
  context.threads = 1;
  relaxCircles(one, {}, context);
  context.threads = 2;
  relaxCircles(two, {}, context);
  EXPECT_EQ(one.centres, two.centres);
}

TEST(CirclePacking, PlacementTakesTheFirstFreeProposal)
{
  Circles circles;
  Rectangle frame;
  frame.upper.setConstant(10.0);
  circles.frames = { frame };
  circles.radii = { 1.0, 2.0 }; // the second is placed first
  circles.frameOf = { 0, 0 };
  const Eigen::Vector2d proposals[] = { { 5.0, 5.0 }, { 5.0, 6.5 }, { 5.0, 8.0 }, { 5.0, 9.0 } };
  placeCircles(
    circles, [&](std::size_t, int trial) { return proposals[trial]; }, 4);
  EXPECT_EQ(circles.centres[1], proposals[0]);
  EXPECT_EQ(circles.centres[0], proposals[2]);
  // If no place is free, the one that overlaps least.
  placeCircles(
    circles, [&](std::size_t, int trial) { return proposals[trial]; }, 2);
  EXPECT_EQ(circles.centres[0], proposals[1]);
}
