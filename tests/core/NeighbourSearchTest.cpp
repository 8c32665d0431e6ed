// SPDX-License-Identifier: BSD-3-Clause
#include "NeighbourSearch.h"

#include "RandomBundle.h"
#include "SegmentDistance.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace
{

std::vector<std::uint32_t> allPairs(const cactus::Capsules& capsules, std::size_t k, double reach)
{
  using Eigen::Vector3d;
  std::vector<std::uint32_t> found;
  const cactus::Capsule& p = capsules.bodies[k];
  for (std::size_t other = 0; other < capsules.size(); ++other)
  {
    const cactus::Capsule& q = capsules.bodies[other];
    if (capsules.fibre[other] != capsules.fibre[k] &&
        cactus::closestPoints(Vector3d::Map(p.p0), Vector3d::Map(p.p1), Vector3d::Map(q.p0), Vector3d::Map(q.p1)).distance <
          std::max(p.r0, p.r1) + std::max(q.r0, q.r1) + reach)
    {
      found.push_back(static_cast<std::uint32_t>(other));
    }
  }
  return found;
}

} // namespace

// Guarantee: the search misses no pair and invents none, for thick and thin capsules mixed and any reach.
TEST(NeighbourSearch, FindsWhatAllPairsFind)
{
  for (const double reach : { 0.0, 0.1, 1.0 })
  {
    cactus::Fibres fibres = randomBundle(3, 40, 12, 6.0, 0.3);
    fibres.radii[17] = 3.0;
    const cactus::Capsules capsules = cactus::capsulesOf(fibres);
    cactus::NeighbourList list;
    cactus::findNeighbours(capsules, reach, 2, list);
    std::size_t pairs = 0;
    for (std::size_t k = 0; k < capsules.size(); ++k)
    {
      const std::vector<std::uint32_t> mine(list.indices.begin() + static_cast<std::ptrdiff_t>(list.offsets[k]),
        list.indices.begin() + static_cast<std::ptrdiff_t>(list.offsets[k + 1]));
      ASSERT_EQ(mine, allPairs(capsules, k, reach)) << "capsule " << k << ", reach " << reach;
      pairs += mine.size();
    }
    EXPECT_GT(pairs, 1000u);
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
