// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/SearchKernels.h"

#include "RandomBundle.h"
#include "RelativeDistance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

// Guarantee: the columns of capsules near a point have the right content, the padding of the last 16 is far from all of them, and
// neither depends on the vector unit.
TEST(SearchKernels, SameColumnsOnEveryVectorUnit)
{
  const cactus::Capsules capsules = cactus::capsulesOf(randomBundle(23, 5, 12, 5.0, 0.3));
  const double origin[3] = { 1.5, -2.0, 0.25 };
  std::vector<float> reach(capsules.size());
  for (std::size_t k = 0; k < reach.size(); ++k)
  {
    reach[k] = 0.125f * static_cast<float>(k % 5);
  }
  for (const std::size_t count : { 0, 1, 7, 16, 37 })
  {
    std::vector<std::uint32_t> indices;
    for (std::size_t n = 0; n < count; ++n)
    {
      indices.push_back(static_cast<std::uint32_t>((n * 17 + 3) % capsules.size()));
    }
    const std::size_t padded = (count + 15) / 16 * 16;
    std::vector<float> first;
    for (const cactus::SearchKernels* kernels : cactus::runnableKernels<cactus::SearchKernels>())
    {
      std::vector<float> numbers(cactus::NearColumns::count * 64, -1.0f);
      kernels->gatherNear(capsules.bodies.data(), reach.data(), indices.data(), count, origin, { numbers.data(), 64 });
      if (kernels == &cactus::portableSearchKernels)
      {
        first = numbers;
      }
      ASSERT_EQ(numbers, first);
    }
    const auto number = [&](std::size_t column, std::size_t n) { return double(first[column * 64 + n]); };
    for (std::size_t n = 0; n < count; ++n)
    {
      const cactus::Capsule& body = capsules.bodies[indices[n]];
      const double limit = std::max(body.r0, body.r1) + double(reach[indices[n]]);
      double squared = 0.0;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        EXPECT_NEAR(number(axis, n), body.p0[axis] - origin[axis], 1e-6);
        EXPECT_NEAR(number(3 + axis, n), body.p1[axis] - origin[axis], 1e-6);
        EXPECT_NEAR(number(7 + axis, n), 0.5 * (body.p0[axis] + body.p1[axis]) - origin[axis], 1e-6);
        squared += (body.p1[axis] - body.p0[axis]) * (body.p1[axis] - body.p0[axis]);
      }
      EXPECT_NEAR(number(6, n), limit, 1e-6);
      EXPECT_NEAR(number(10, n), limit + 0.5 * std::sqrt(squared), 1e-6);
    }
    for (std::size_t n = count; n < padded; ++n)
    {
      EXPECT_GT(number(7, n) - number(10, n), 1e8);
    }
    EXPECT_EQ(number(0, padded), -1.0);
  }
}

// Guarantee: the selected neighbours do not depend on the vector unit, nor on the number of candidates; those whose exact
// distance is within reach are listed.
TEST(SearchKernels, SameNeighboursOnEveryVectorUnit)
{
  const cactus::Capsules capsules = cactus::capsulesOf(randomBundle(22, 60, 12, 5.0, 0.3));
  const std::vector<float> reach(capsules.size(), 0.2f);
  std::vector<std::uint32_t> indices(capsules.size() + 16);
  std::iota(indices.begin(), indices.end(), 0u);
  const double origin[3] = {};
  constexpr std::size_t stride = 1024;
  std::vector<float> numbers(cactus::NearColumns::count * stride);
  const cactus::NearColumns near{ numbers.data(), stride };
  std::size_t total = 0;
  for (const std::size_t count : { std::size_t(0), std::size_t(5), std::size_t(256), std::size_t(257), capsules.size() })
  {
    cactus::portableSearchKernels.gatherNear(capsules.bodies.data(), reach.data(), indices.data(), count, origin, near);
    for (std::size_t k = 0; k < count; k += 7)
    {
      float p[cactus::NearColumns::count];
      for (std::size_t number = 0; number < cactus::NearColumns::count; ++number)
      {
        p[number] = numbers[number * stride + k];
      }
      std::vector<std::uint32_t> first;
      for (const cactus::SearchKernels* kernels : cactus::runnableKernels<cactus::SearchKernels>())
      {
        std::vector<std::uint32_t> found(count + 16);
        found.resize(
          static_cast<std::size_t>(kernels->selectNeighbours(near, indices.data(), count, p, found.data()) - found.data()));
        if (kernels == &cactus::portableSearchKernels)
        {
          first = found;
        }
        ASSERT_EQ(found, first);
      }
      for (std::uint32_t other = 0; other < count; ++other)
      {
        const double distance = relativeDistance(capsules.bodies[k], capsules.bodies[other], 0.4);
        const bool listed = std::binary_search(first.begin(), first.end(), other);
        const double largest = largestListed(capsules.bodies[k], capsules.bodies[other], 0.4);
        ASSERT_TRUE(listed ? distance < largest : distance > 1.0) << k << " and " << other << " at " << distance;
      }
      total += first.size();
    }
  }
  EXPECT_GT(total, 2 * capsules.size());
}

// Guarantee: keys are sorted in increasing order, whatever their number and order, on every vector unit.
TEST(SearchKernels, SortsKeys)
{
  for (std::size_t count = 0; count <= 130; ++count)
  {
    std::vector<std::uint32_t> keys(count + 16, 1u);
    for (std::size_t n = 0; n < count; ++n)
    {
      keys[n] = n == 0 ? 0x7fffffffu : static_cast<std::uint32_t>((n * 89) % 131 * 10000019);
    }
    std::vector<std::uint32_t> expected(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(count));
    std::sort(expected.begin(), expected.end());
    for (const cactus::SearchKernels* kernels : cactus::runnableKernels<cactus::SearchKernels>())
    {
      std::vector<std::uint32_t> sorted(count);
      kernels->sortKeys(keys.data(), count, sorted.data());
      ASSERT_EQ(sorted, expected);
    }
  }
}

// Guarantee: the capsules of runs, full ones or not, whose boxes overlap a box do not depend on the vector unit, and equal those
// of a one-by-one comparison.
TEST(SearchKernels, SameCapsulesOfRunsOnEveryVectorUnit)
{
  constexpr std::size_t count = 60;
  std::vector<cactus::BoxBlock> blocks(count);
  std::vector<std::uint32_t> first{ 1000 };
  for (std::size_t run = 0; run < count; ++run)
  {
    const std::size_t length = 1 + run % 8;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      for (std::size_t l = 0; l < 8; ++l)
      {
        const auto lower = static_cast<float>((run * (7 + axis) + 5 * l) % 23) - 12.0f;
        const float infinity = std::numeric_limits<float>::infinity();
        blocks[run].bounds[axis][l] = l < length ? lower : infinity;
        blocks[run].bounds[axis][8 + l] = l < length ? -(lower + 2.0f + static_cast<float>(l % 3)) : infinity;
      }
    }
    first.push_back(first.back() + static_cast<std::uint32_t>(length));
  }
  std::vector<std::uint32_t> runs;
  for (std::uint32_t run = 0; run < count; run += 1 + run % 2)
  {
    runs.push_back(run);
  }
  cactus::BoxQuery box = {};
  const float lower[3] = { -3.0f, -8.0f, -4.0f };
  const float upper[3] = { 5.0f, 6.0f, 5.0f };
  std::copy_n(lower, 3, box.lower);
  std::copy_n(upper, 3, box.upper);
  std::vector<std::uint32_t> expected;
  for (const std::uint32_t run : runs)
  {
    for (std::uint32_t l = 0; l < first[run + 1] - first[run]; ++l)
    {
      bool taken = true;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        taken &= blocks[run].bounds[axis][l] <= upper[axis] && lower[axis] <= -blocks[run].bounds[axis][8 + l];
      }
      if (taken)
      {
        expected.push_back(first[run] + l);
      }
    }
  }
  EXPECT_GT(expected.size(), 10u);
  for (const cactus::SearchKernels* kernels : cactus::runnableKernels<cactus::SearchKernels>())
  {
    std::vector<std::uint32_t> found(8 * runs.size() + 8);
    found.resize(static_cast<std::size_t>(
      kernels->selectFromRuns(blocks.data(), first.data(), runs.data(), runs.size(), box, found.data()) - found.data()));
    EXPECT_EQ(found, expected);
  }
}

// Guarantee: the boxes of a row of cells that overlap, except those to be skipped, do not depend on the vector unit, and equal
// those of a one-by-one comparison.
TEST(SearchKernels, SameBoxesOnEveryVectorUnit)
{
  constexpr std::size_t count = 101;
  std::vector<std::vector<float>> numbers(6, std::vector<float>(count + 16));
  std::vector<std::int32_t> cells(count + 16);
  std::vector<std::uint32_t> keys(count + 16);
  for (std::size_t m = 0; m < count; ++m)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      numbers[axis][m] = static_cast<float>((m * (7 + 4 * axis)) % 23) - 12.0f;
      numbers[3 + axis][m] = numbers[axis][m] + 4.0f + static_cast<float>(m % 5);
    }
    cells[m] = static_cast<std::int32_t>(m % 3);
    keys[m] = static_cast<std::uint32_t>(20000017 * m);
  }
  const cactus::BoxColumns columns{ { numbers[0].data(), numbers[1].data(), numbers[2].data() },
    { numbers[3].data(), numbers[4].data(), numbers[5].data() }, cells.data(), keys.data() };
  const cactus::BoxQuery box{ { -3.0f, -20.0f, -4.0f }, { 2.0f, 20.0f, 5.0f }, { -12.0f, -12.0f, -12.0f },
    { 0.25f, 0.01f, 0.125f }, { 2.0f, 0.0f, 2.0f }, 0, 1, keys[20], keys[30] };
  for (const auto& [begin, end] : { std::pair<std::size_t, std::size_t>{ 0, count }, { 3, 4 }, { 5, 40 }, { 9, 9 } })
  {
    std::vector<std::uint32_t> expected;
    for (std::size_t m = begin; m < end; ++m)
    {
      bool taken = m < 20 || m >= 30;
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
    for (const cactus::SearchKernels* kernels : cactus::runnableKernels<cactus::SearchKernels>())
    {
      std::vector<std::uint32_t> found(end - begin + 16);
      found.resize(static_cast<std::size_t>(kernels->selectBoxes(columns, begin, end, box, found.data()) - found.data()));
      EXPECT_EQ(found, expected);
    }
  }
}
