// SPDX-License-Identifier: BSD-3-Clause
#include "fibres/FibreOrder.h"

#include "RandomBundle.h"
#include "optimiser/CapsuleOptimizer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

namespace
{

using cactus::Fibres;

/// Mean distance between the first control points of fibres that follow each other.
double meanStride(const Fibres& fibres)
{
  double sum = 0.0;
  for (std::size_t f = 1; f < fibres.size(); ++f)
  {
    sum += (fibres.points[fibres.offsets[f]] - fibres.points[fibres.offsets[f - 1]]).norm();
  }
  return sum / static_cast<double>(fibres.size() - 1);
}

/// The fibres in any other order.
Fibres shuffled(const Fibres& fibres, unsigned seed)
{
  std::vector<std::size_t> order(fibres.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::shuffle(order.begin(), order.end(), std::mt19937(seed));
  Fibres result;
  result.domain = fibres.domain;
  for (const std::size_t f : order)
  {
    result.addFibre(fibres.fibreIds[f], fibres.bundleIds[f], fibres.targetRadii[f]);
    for (std::size_t i = fibres.offsets[f]; i < fibres.offsets[f + 1]; ++i)
    {
      result.addPoint(fibres.points[i], fibres.radii[i]);
    }
  }
  return result;
}

} // namespace

// Guarantee: every fibre is there once, unchanged, and values per control point return to their original places.
TEST(FibreOrder, KeepsEveryFibreAndFindsBack)
{
  Fibres fibres = randomBundle(5, 60, 7, 20.0, 0.2);
  fibres.addFibre(61, 2, 0.3); // of another length
  fibres.addPoint(Eigen::Vector3d(1, 2, 3), 0.3);
  fibres.addPoint(Eigen::Vector3d(2, 2, 3), 0.4);
  fibres = shuffled(fibres, 1);
  const cactus::FibreOrder order(fibres);
  const Fibres ordered = order.ordered(fibres);
  ASSERT_EQ(ordered.size(), fibres.size());
  for (std::size_t f = 0; f < ordered.size(); ++f)
  {
    const auto found = std::find(fibres.fibreIds.begin(), fibres.fibreIds.end(), ordered.fibreIds[f]);
    ASSERT_NE(found, fibres.fibreIds.end());
    const auto g = static_cast<std::size_t>(found - fibres.fibreIds.begin());
    EXPECT_EQ(ordered.bundleIds[f], fibres.bundleIds[g]);
    EXPECT_EQ(ordered.targetRadii[f], fibres.targetRadii[g]);
    ASSERT_EQ(ordered.pointCount(f), fibres.pointCount(g));
    for (std::size_t i = 0; i < ordered.pointCount(f); ++i)
    {
      EXPECT_EQ(ordered.points[ordered.offsets[f] + i], fibres.points[fibres.offsets[g] + i]);
    }
  }
  std::vector<Eigen::Vector3d> points;
  std::vector<double> radii;
  order.restore(ordered.points, points);
  order.restore(ordered.radii, radii);
  EXPECT_EQ(points, fibres.points);
  EXPECT_EQ(radii, fibres.radii);
}

// Guarantee: consecutive fibres are near each other. For 2,500 parallel fibres in a square, a fiftieth of its side is the least
// possible.
TEST(FibreOrder, PutsNeighboursTogether)
{
  Fibres fibres;
  fibres.domain = cactus::Domain::cube(1.0);
  for (int f = 0; f < 2500; ++f)
  {
    fibres.addFibre(f + 1, 1, 0.01);
    for (const double z : { -0.5, 0.5 })
    {
      fibres.addPoint(Eigen::Vector3d((f % 50) / 50.0, (f / 50) / 50.0, z), 0.01);
    }
  }
  fibres = shuffled(fibres, 2);
  EXPECT_GT(meanStride(fibres), 0.5);
  EXPECT_LT(meanStride(cactus::FibreOrder(fibres).ordered(fibres)), 0.04);
}

// Guarantee: fibres in another order are optimised to the same bits, and are returned in their input order.
TEST(FibreOrder, ResultDoesNotDependOnTheOrderOfTheFibres)
{
  cactus::CapsuleOptimizerOptions options;
  options.maximumIterations = 60;
  const Fibres original = randomBundle(13, 150, 20, 10.0, 0.0);
  Fibres one = original;
  Fibres other = shuffled(original, 3);
  const Fibres given = other;
  const auto first = cactus::optimise(one, options, cactus::Context());
  const auto second = cactus::optimise(other, options, cactus::Context());
  EXPECT_EQ(other.fibreIds, given.fibreIds);
  EXPECT_EQ(other.offsets, given.offsets);
  EXPECT_EQ(first.convergence.back().overlapCost, second.convergence.back().overlapCost);
  for (std::size_t f = 0; f < one.size(); ++f)
  {
    const auto place = std::find(other.fibreIds.begin(), other.fibreIds.end(), one.fibreIds[f]) - other.fibreIds.begin();
    for (std::size_t i = 0; i < one.pointCount(f); ++i)
    {
      const std::size_t here = one.offsets[f] + i;
      const std::size_t there = other.offsets[static_cast<std::size_t>(place)] + i;
      ASSERT_EQ(one.points[here], other.points[there]);
      ASSERT_EQ(one.radii[here], other.radii[there]);
      ASSERT_EQ(first.overlap[here], second.overlap[there]);
    }
  }
}
