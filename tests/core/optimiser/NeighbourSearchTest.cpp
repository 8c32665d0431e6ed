// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/NeighbourSearch.h"

#include "NearlyParallel.h"
#include "RandomBundle.h"
#include "RelativeDistance.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace
{

/// Compares the list with all pairs, and returns their number.
std::size_t expectAllPairs(const cactus::Capsules& capsules, const std::vector<float>& reach, int threads = 2)
{
  cactus::NeighbourList list;
  cactus::findNeighbours(capsules, reach, threads, list);
  std::size_t pairs = 0;
  std::size_t wrong = 0;
  for (std::size_t k = 0; k < capsules.size(); ++k)
  {
    const auto begin = list.indices.begin() + static_cast<std::ptrdiff_t>(list.offsets[k]);
    const auto end = list.indices.begin() + static_cast<std::ptrdiff_t>(list.offsets[k + 1]);
    EXPECT_TRUE(std::is_sorted(begin, end));
    EXPECT_EQ(std::adjacent_find(begin, end), end);
    for (std::size_t other = 0; other < capsules.size(); ++other)
    {
      const bool listed = std::binary_search(begin, end, static_cast<std::uint32_t>(other));
      const double both = double(reach[k]) + double(reach[other]);
      const double distance = relativeDistance(capsules.bodies[k], capsules.bodies[other], both);
      const bool eligible = capsules.fibre[other] != capsules.fibre[k];
      wrong += eligible && distance < 1.0 && !listed;
      wrong += listed && (!eligible || distance > largestListed(capsules.bodies[k], capsules.bodies[other], both));
      pairs += listed;
    }
  }
  EXPECT_EQ(wrong, 0u);
  return pairs;
}

} // namespace

// Guarantee: the search misses no pair and invents none, for thick and thin, long and short, parallel and skew capsules mixed,
// any reach, and far from the origin.
TEST(NeighbourSearch, FindsWhatAllPairsFind)
{
  for (const float scale : { 0.0f, 0.1f, 1.0f })
  {
    for (const double bend : { 0.0, 0.3 })
    {
      cactus::Fibres fibres = randomBundle(3, 40, 12, 6.0, bend);
      fibres.radii[17] = 3.0;
      fibres.points[40] += Eigen::Vector3d(2.0, -3.0, 0.0);
      for (auto& point : fibres.points)
      {
        point += Eigen::Vector3d(250.0, -250.0, 100.0);
      }
      // Two fibres that are exactly parallel.
      for (std::size_t i = 0; i < 12; ++i)
      {
        fibres.points[12 + i] = fibres.points[i] + Eigen::Vector3d(0.5, 0.0, 0.0);
      }
      const cactus::Capsules capsules = cactus::capsulesOf(fibres);
      std::vector<float> reach(capsules.size());
      for (std::size_t k = 0; k < reach.size(); ++k)
      {
        reach[k] = 0.5f * scale * static_cast<float>(1 + k % 3);
      }
      EXPECT_GT(expectAllPairs(capsules, reach), 1000u);
    }
  }
}

// Guarantee: the same for a fibre that is a hundred times thicker than those around it, whose runs meet hundreds of others, all
// of them far from the origin and some with a single capsule.
TEST(NeighbourSearch, FindsWhatSurroundsAThickFibre)
{
  cactus::Fibres fibres = randomBundle(5, 160, 10, 12.0, 0.2);
  for (std::size_t i = 0; i < fibres.radii.size(); ++i)
  {
    fibres.radii[i] = i < 10 ? 5.0 : 0.05;
    fibres.points[i] += Eigen::Vector3d(-3000.0, 2000.0, 1000.0);
  }
  for (int f = 0; f < 5; ++f)
  {
    const Eigen::Vector3d from = fibres.points[std::size_t(15 + f)] + Eigen::Vector3d(0.1, 0.0, 0.0);
    fibres.addFibre(1000 + f, 1, 0.05);
    fibres.addPoint(from, 0.05);
    fibres.addPoint(from + Eigen::Vector3d(0.0, 0.3, 4.0), 0.2);
  }
  const cactus::Capsules capsules = cactus::capsulesOf(fibres);
  EXPECT_GT(expectAllPairs(capsules, std::vector<float>(capsules.size(), 0.01f)), 4000u);
}

// Guarantee: the same for thin and long capsules, whose distance is least accurate in single precision.
TEST(NeighbourSearch, FindsThinAndLongOnes)
{
  for (const double radius : { 0.05, 0.005 })
  {
    cactus::Fibres fibres = randomBundle(9, 300, 3, 6.0, 0.3);
    std::fill(fibres.radii.begin(), fibres.radii.end(), radius);
    const cactus::Capsules capsules = cactus::capsulesOf(fibres);
    EXPECT_GT(expectAllPairs(capsules, std::vector<float>(capsules.size(), 0.0f)), 40u);
  }
}

// Guarantee: the same for nearly parallel capsules, whose closest points are arbitrary in single precision.
TEST(NeighbourSearch, FindsNearlyParallelOnes)
{
  const cactus::Capsules capsules = cactus::capsulesOf(nearlyParallelPairs(10, 1000, 1.0 - 1e-6));
  EXPECT_EQ(expectAllPairs(capsules, std::vector<float>(capsules.size(), 0.0f)), capsules.size());
}

// Guarantee: no pairs within a single fibre, and none without fibres.
TEST(NeighbourSearch, FindsNothingAmongOneFibre)
{
  cactus::NeighbourList list;
  cactus::findNeighbours(cactus::capsulesOf(randomBundle(6, 20, 12, 4.0, 0.2)), 0.5, 2, list);
  EXPECT_FALSE(list.indices.empty());
  for (const int fibres : { 1, 0 })
  {
    const cactus::Capsules capsules = cactus::capsulesOf(randomBundle(6, fibres, 40, 4.0, 0.2));
    cactus::findNeighbours(capsules, 10.0, 2, list);
    EXPECT_EQ(list.offsets, std::vector<std::size_t>(capsules.size() + 1));
    EXPECT_TRUE(list.indices.empty());
  }
}

// Guarantee: the result does not depend on the number of threads.
TEST(NeighbourSearch, SameOnAnyNumberOfThreads)
{
  const cactus::Capsules capsules = cactus::capsulesOf(randomBundle(4, 300, 30, 12.0, 0.2));
  cactus::NeighbourList one;
  cactus::findNeighbours(capsules, 0.2, 1, one);
  for (const int threads : { 2, 3, 4 })
  {
    cactus::NeighbourList many;
    cactus::findNeighbours(capsules, 0.2, threads, many);
    EXPECT_EQ(one.offsets, many.offsets);
    EXPECT_EQ(one.indices, many.indices);
  }
}
