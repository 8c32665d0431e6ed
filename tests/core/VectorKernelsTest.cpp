// SPDX-License-Identifier: BSD-3-Clause
#include "VectorKernels.h"

#include "NeighbourSearch.h"
#include "RandomBundle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
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

// Guarantee: which boxes of a row of cells overlap does not depend on the vector unit, and is what comparing one by one gives.
TEST(VectorKernels, SameBoxesOnEveryVectorUnit)
{
  constexpr std::size_t count = 101;
  std::vector<std::vector<float>> numbers(6, std::vector<float>(count + 16));
  std::vector<std::int32_t> cells(count + 16);
  std::vector<std::uint64_t> keys(count + 16);
  for (std::size_t m = 0; m < count; ++m)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      numbers[axis][m] = static_cast<float>((m * (7 + 4 * axis)) % 23) - 12.0f;
      numbers[3 + axis][m] = numbers[axis][m] + 4.0f + static_cast<float>(m % 5);
    }
    cells[m] = static_cast<std::int32_t>(m % 3);
    keys[m] = (std::uint64_t(m) << 40) + 17;
  }
  const cactus::BoxColumns columns{ { numbers[0].data(), numbers[1].data(), numbers[2].data() },
    { numbers[3].data(), numbers[4].data(), numbers[5].data() }, cells.data(), keys.data() };
  const cactus::BoxQuery box{ { -3.0f, -20.0f, -4.0f }, { 2.0f, 20.0f, 5.0f }, { -12.0f, -12.0f, -12.0f },
    { 0.25f, 0.01f, 0.125f }, { 2.0f, 0.0f, 2.0f }, 0, 1 };
  for (const auto& [begin, end] : { std::pair<std::size_t, std::size_t>{ 0, count }, { 3, 4 }, { 5, 40 }, { 9, 9 } })
  {
    std::vector<std::uint64_t> expected;
    for (std::size_t m = begin; m < end; ++m)
    {
      bool taken = true;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const float lower = numbers[axis][m];
        taken &= lower <= box.upper[axis] && box.lower[axis] <= numbers[3 + axis][m];
        const float cell = (std::max(lower, box.lower[axis]) - box.origin[axis]) * box.inverseSize[axis];
        const auto index = static_cast<std::int32_t>(std::min(std::max(cell, 0.0f), box.last[axis]));
        taken &= index == (axis == 0 ? cells[m] : axis == 1 ? box.y : box.z);
      }
      if (taken)
      {
        expected.push_back(keys[m]);
      }
    }
    EXPECT_TRUE(end < count || !expected.empty());
    for (const cactus::VectorKernels* kernels : runnable())
    {
      std::vector<std::uint64_t> found(end - begin + 16);
      found.resize(static_cast<std::size_t>(kernels->selectBoxes(columns, begin, end, box, found.data()) - found.data()));
      EXPECT_EQ(found, expected);
    }
  }
}
