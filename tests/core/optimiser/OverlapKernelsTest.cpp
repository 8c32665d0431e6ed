// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/OverlapKernels.h"

#include "RandomBundle.h"
#include "optimiser/NeighbourSearch.h"

#include <gtest/gtest.h>

#include <algorithm>

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
      { kernels.evaluateCapsule(capsules.bodies.data(), neighbours, count, capsules.bodies[k], 1.01, 1e-3, flag, result); };
      evaluate(cactus::portableOverlapKernels, true, first);
      for (const cactus::OverlapKernels* kernels : cactus::runnableKernels<cactus::OverlapKernels>())
      {
        for (const bool flag : { tapered, true })
        {
          cactus::CapsuleOverlap result;
          evaluate(*kernels, flag, result);
          // Not by bytes: −0 is 0.
          for (int axis = 0; axis < 3; ++axis)
          {
            ASSERT_EQ(result.gradient0[axis], first.gradient0[axis]);
            ASSERT_EQ(result.gradient1[axis], first.gradient1[axis]);
          }
          ASSERT_EQ(result.radius0, first.radius0);
          ASSERT_EQ(result.radius1, first.radius1);
          ASSERT_EQ(result.stiffness0, first.stiffness0);
          ASSERT_EQ(result.stiffness1, first.stiffness1);
          ASSERT_EQ(result.cost, first.cost);
          ASSERT_EQ(result.penetration, first.penetration);
          ASSERT_EQ(result.overlapping, first.overlapping);
        }
      }
    }
  }
}
