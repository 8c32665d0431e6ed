// SPDX-License-Identifier: BSD-3-Clause
#include "VectorKernels.h"

#include "NeighbourSearch.h"
#include "RandomBundle.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

namespace
{

/// Those that this machine can run.
std::vector<const cactus::VectorKernels*> runnable()
{
  std::vector<const cactus::VectorKernels*> all{ &cactus::portableKernels };
#if defined(__x86_64__)
  if (__builtin_cpu_supports("x86-64-v3"))
  {
    all.push_back(&cactus::x86V3Kernels);
  }
  if (__builtin_cpu_supports("x86-64-v4"))
  {
    all.push_back(&cactus::x86V4Kernels);
  }
#endif
  return all;
}

} // namespace

// Guarantee: cost and gradient have the same bits on every vector unit, with radii that vary and with radii that do not, and
// whether or not the caller knows that they do not.
TEST(VectorKernels, SameBitsOnEveryVectorUnit)
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
      const auto evaluate = [&](const cactus::VectorKernels& kernels, bool flag, cactus::CapsuleOverlap& result)
      { kernels.evaluateCapsule(capsules.bodies.data(), neighbours, count, capsules.bodies[k], 1.01, 1e-3, flag, result); };
      evaluate(cactus::portableKernels, true, first);
      for (const cactus::VectorKernels* kernels : runnable())
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

// Guarantee: which candidates are neighbours does not depend on the vector unit.
TEST(VectorKernels, SameNeighboursOnEveryVectorUnit)
{
  const cactus::Capsules capsules = cactus::capsulesOf(randomBundle(22, 40, 12, 5.0, 0.3));
  const std::size_t padded = (capsules.size() + 15) / 16 * 16;
  std::vector<std::vector<float>> numbers(7, std::vector<float>(padded, 1e9f));
  std::vector<std::uint32_t> indices(padded);
  for (std::size_t k = 0; k < capsules.size(); ++k)
  {
    const cactus::Capsule& body = capsules.bodies[k];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      numbers[axis][k] = static_cast<float>(body.p0[axis]);
      numbers[3 + axis][k] = static_cast<float>(body.p1[axis]);
    }
    numbers[6][k] = static_cast<float>(body.r0) + 0.2f;
    indices[k] = static_cast<std::uint32_t>(k);
  }
  for (std::size_t k = capsules.size(); k < padded; ++k)
  {
    numbers[3][k] = 1.001e9f;
    numbers[6][k] = 0.0f;
  }
  const float* const columns[7] = { numbers[0].data(), numbers[1].data(), numbers[2].data(), numbers[3].data(), numbers[4].data(),
    numbers[5].data(), numbers[6].data() };
  std::size_t total = 0;
  for (std::size_t k = 0; k < capsules.size(); k += 7)
  {
    float p[7];
    for (std::size_t number = 0; number < 7; ++number)
    {
      p[number] = numbers[number][k];
    }
    std::vector<std::uint32_t> first;
    for (const cactus::VectorKernels* kernels : runnable())
    {
      std::vector<std::uint32_t> found(padded + 16);
      found.resize(static_cast<std::size_t>(
        kernels->selectNeighbours(columns, indices.data(), capsules.size(), p, found.data()) - found.data()));
      if (kernels == &cactus::portableKernels)
      {
        first = found;
      }
      ASSERT_EQ(found, first);
      total += found.size();
    }
  }
  EXPECT_GT(total, capsules.size());
}
