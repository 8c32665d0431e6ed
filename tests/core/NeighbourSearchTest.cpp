// SPDX-License-Identifier: BSD-3-Clause
#include "NeighbourSearch.h"

#include "RandomBundle.h"
#include "SegmentDistance.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace
{

/// Distance of two capsules over the limit up to which they are neighbours.
double relativeDistance(const cactus::Capsule& p, const cactus::Capsule& q, double reach)
{
  using Eigen::Vector3d;
  const auto pair = cactus::closestPoints(Vector3d::Map(p.p0), Vector3d::Map(p.p1), Vector3d::Map(q.p0), Vector3d::Map(q.p1));
  return pair.distance / (std::max(p.r0, p.r1) + std::max(q.r0, q.r1) + reach);
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
      // Two fibres that are parallel to the last bit.
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
      cactus::NeighbourList list;
      cactus::findNeighbours(capsules, reach, 2, list);
      std::size_t pairs = 0;
      for (std::size_t k = 0; k < capsules.size(); ++k)
      {
        const auto begin = list.indices.begin() + static_cast<std::ptrdiff_t>(list.offsets[k]);
        const auto end = list.indices.begin() + static_cast<std::ptrdiff_t>(list.offsets[k + 1]);
        ASSERT_TRUE(std::is_sorted(begin, end));
        ASSERT_EQ(std::adjacent_find(begin, end), end);
        for (std::size_t other = 0; other < capsules.size(); ++other)
        {
          const bool listed = std::binary_search(begin, end, static_cast<std::uint32_t>(other));
          const double distance =
            relativeDistance(capsules.bodies[k], capsules.bodies[other], double(reach[k]) + double(reach[other]));
          const bool eligible = capsules.fibre[other] != capsules.fibre[k];
          ASSERT_FALSE(eligible && distance < 1.0 && !listed) << k << " misses " << other << " at " << distance;
          ASSERT_FALSE(listed && (!eligible || distance > 1.0 + 1e-4)) << k << " invents " << other << " at " << distance;
          pairs += listed;
        }
      }
      EXPECT_GT(pairs, 1000u);
    }
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
