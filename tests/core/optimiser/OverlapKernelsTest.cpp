// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/OverlapKernels.h"

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
  // Not by bytes: −0 is 0.
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

} // namespace

// Guarantee: cost and gradient have the same bits on every vector unit, with radii that vary and with radii that do not, and
// whether or not the caller knows that they do not.
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
    for (std::size_t k = 0; k < capsules.size(); ++k)
    {
      const std::uint32_t* neighbours = list.indices.data() + list.offsets[k];
      const std::size_t count = list.offsets[k + 1] - list.offsets[k];
      cactus::CapsuleOverlap first;
      const auto evaluate = [&](const cactus::OverlapKernels& kernels, bool flag, cactus::CapsuleOverlap& result)
      {
        kernels.evaluateCapsule(capsules.bodies.data(), neighbours, count, list.indices.size() - list.offsets[k],
          capsules.bodies[k], 1.01, 1e-3, flag, result);
      };
      evaluate(cactus::portableOverlapKernels, true, first);
      for (const cactus::OverlapKernels* kernels : cactus::runnableKernels<cactus::OverlapKernels>())
      {
        for (const bool flag : { tapered, true })
        {
          cactus::CapsuleOverlap result;
          evaluate(*kernels, flag, result);
          expectSame(result, first);
        }
      }
    }
  }
}

// Guarantee: a result does not depend on how far lists of neighbours reach, nor therefore on when neighbours were last searched.
// With some hundred neighbours that touch, and with few.
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
