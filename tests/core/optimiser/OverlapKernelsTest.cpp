// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/OverlapKernels.h"

#include "NearlyParallel.h"
#include "RandomBundle.h"
#include "optimiser/NeighbourSearch.h"
#include "optimiser/OverlapCost.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace
{

void expectSame(const cactus::CapsuleOverlap& result, const cactus::CapsuleOverlap& expected)
{
  // Not by bytes: −0 equals 0.
  for (int axis = 0; axis < 3; ++axis)
  {
    ASSERT_EQ(result.gradient0[axis], expected.gradient0[axis]);
    ASSERT_EQ(result.gradient1[axis], expected.gradient1[axis]);
  }
  ASSERT_EQ(result.radius0, expected.radius0);
  ASSERT_EQ(result.radius1, expected.radius1);
  ASSERT_EQ(result.stiffness0, expected.stiffness0);
  ASSERT_EQ(result.stiffness1, expected.stiffness1);
  ASSERT_EQ(result.cost, expected.cost);
  ASSERT_EQ(result.penetration, expected.penetration);
  ASSERT_EQ(result.overlapping, expected.overlapping);
}

/// Returns the result of some kernels for all capsules.
std::vector<cactus::CapsuleOverlap> evaluate(
  const cactus::OverlapKernels& kernels, const cactus::Capsules& capsules, const cactus::NeighbourList& list, bool tapered)
{
  using Room = cactus::OverlapKernels::Room;
  std::vector<cactus::RoughCapsule> rough(capsules.size());
  kernels.roughen(capsules.bodies.data(), capsules.size(), rough.data());
  const cactus::ListedCapsules listed = { capsules.bodies.data(), rough.data(), 0, list.offsets.data(), list.indices.data(),
    list.indices.size() };
  std::vector<std::uint32_t> touching(Room::touchingFor(list.indices.size()));
  std::vector<cactus::EightDoubles> lanes(Room::lanesFor(list.indices.size()));
  std::vector<cactus::CapsuleOverlap> results(capsules.size());
  for (std::size_t begin = 0; begin < capsules.size(); begin += cactus::OverlapKernels::together)
  {
    const std::size_t end = std::min(begin + cactus::OverlapKernels::together, capsules.size());
    kernels.evaluateCapsules(
      listed, begin, end, { 1.01, 1e-3, tapered }, { touching.data(), lanes.data() }, results.data() + begin);
  }
  return results;
}

} // namespace

// Guarantee: cost and gradient have the same bits on every vector unit, with varying and with constant radii, and whether or not
// the caller knows that they are constant.
TEST(OverlapKernels, SameBitsOnEveryVectorUnit)
{
  for (const bool tapered : { false, true })
  {
    cactus::Fibres fibres = randomBundle(21, 60, 12, 5.0, 0.3);
    if (!tapered)
    {
      std::fill(fibres.radii.begin(), fibres.radii.end(), 0.6);
    }
    const cactus::Capsules capsules = cactus::capsulesOf(fibres);
    cactus::NeighbourList list;
    cactus::findNeighbours(capsules, 0.5, 1, list);
    const std::vector<cactus::CapsuleOverlap> first = evaluate(cactus::portableOverlapKernels, capsules, list, true);
    for (const cactus::OverlapKernels* kernels : cactus::runnableKernels<cactus::OverlapKernels>())
    {
      for (const bool flag : { tapered, true })
      {
        const std::vector<cactus::CapsuleOverlap> results = evaluate(*kernels, capsules, list, flag);
        for (std::size_t k = 0; k < capsules.size(); ++k)
        {
          SCOPED_TRACE(k);
          expectSame(results[k], first[k]);
        }
      }
    }
  }
}

// Guarantee: no touching pair is missed, however nearly parallel or nearly apart.
TEST(OverlapKernels, FindsWhatHardlyTouches)
{
  for (const double distance : { 1.01 - 1e-7, 1.01 + 1e-7 })
  {
    for (const double shift : { 0.0, 90000.0 })
    {
      cactus::Fibres fibres = nearlyParallelPairs(23, 1000, distance);
      for (Eigen::Vector3d& point : fibres.points)
      {
        point[0] += shift;
      }
      const cactus::Capsules capsules = cactus::capsulesOf(fibres);
      cactus::NeighbourList list;
      cactus::findNeighbours(capsules, 1.0, 1, list);
      for (const cactus::OverlapKernels* kernels : cactus::runnableKernels<cactus::OverlapKernels>())
      {
        const std::vector<cactus::CapsuleOverlap> results = evaluate(*kernels, capsules, list, false);
        const auto touching =
          std::count_if(results.begin(), results.end(), [](const cactus::CapsuleOverlap& result) { return result.cost > 0.0; });
        EXPECT_EQ(static_cast<std::size_t>(touching), distance < 1.01 ? capsules.size() : 0) << shift;
      }
    }
  }
}

// Guarantee: a result does not depend on how far lists of neighbours reach, and so not on when neighbours were last searched.
// With some hundred touching neighbours, and with few.
TEST(OverlapKernels, SameBitsWhateverTheReach)
{
  for (const double side : { 5.0, 1.5 })
  {
    const cactus::Capsules capsules = cactus::capsulesOf(randomBundle(22, 60, 12, side, 0.3));
    std::vector<cactus::CapsuleOverlap> near;
    std::vector<cactus::CapsuleOverlap> far;
    for (const bool isFar : { false, true })
    {
      cactus::NeighbourList list;
      cactus::findNeighbours(capsules, isFar ? 1.7 : 0.05, 1, list);
      cactus::evaluateOverlap(capsules, list, 1.01, 1e-3, 2, isFar ? far : near);
    }
    std::size_t most = 0;
    for (std::size_t k = 0; k < capsules.size(); ++k)
    {
      SCOPED_TRACE(k);
      expectSame(far[k], near[k]);
      most = std::max(most, near[k].overlapping);
    }
    EXPECT_EQ(most > 100, side < 2.0) << most;
    EXPECT_GT(most, 1);
  }
}
