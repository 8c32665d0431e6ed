// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: fields, their smoothing and the sums of SampledVolume have the same bits on every vector unit, even if they do not
// fill a vector, and nothing is written beyond them.
#include "surface/SmoothingKernels.h"
#include "surface/SampledVolumeKernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace
{

using namespace cactus;

constexpr float untouched = -77.0f;

std::vector<float> randomFloats(std::size_t count, float lower, float upper, unsigned seed)
{
  std::mt19937 engine(seed);
  std::uniform_real_distribution<float> uniform(lower, upper);
  std::vector<float> numbers(count);
  std::generate(numbers.begin(), numbers.end(), [&] { return uniform(engine); });
  return numbers;
}

std::vector<std::int32_t> randomIds(std::size_t count, unsigned seed)
{
  std::mt19937 engine(seed);
  std::vector<std::int32_t> ids(count);
  std::generate(ids.begin(), ids.end(), [&] { return static_cast<std::int32_t>(engine() % 4); });
  return ids;
}

TEST(SmoothingKernels, FieldIsThatOfTheLabelImage)
{
  for (const SmoothingKernels* kernels : runnableKernels<SmoothingKernels>())
  {
    for (std::size_t count = 1; count < 70; ++count)
    {
      const std::vector<std::int32_t> ids = randomIds(count, unsigned(count));
      const std::vector<float> depths = randomFloats(count, -1.0f, count % 3 == 0 ? -0.1f : 1.0f, unsigned(count));
      std::vector<float> field(count + 1, untouched);
      const bool isDoubtful = kernels->field(ids.data(), depths.data(), int(count), 2, 0.05f, -0.025f, field.data());
      bool expected = false;
      for (std::size_t n = 0; n < count; ++n)
      {
        const float depth = depths[n];
        EXPECT_EQ(field[n], ids[n] == 2 || ids[n] == 0 ? depth : -(depth + 0.05f));
        expected = expected || (ids[n] == 0 && depth > -0.025f);
      }
      EXPECT_EQ(isDoubtful, expected);
      EXPECT_EQ(field[count], untouched);
    }
  }
}

TEST(SmoothingKernels, SmoothInPartAndWhole)
{
  for (const SmoothingKernels* kernels : runnableKernels<SmoothingKernels>())
  {
    for (const std::size_t step : { 1, 5, 30 })
    {
      for (std::size_t size = 2 * step + 1; size < 2 * step + 40; ++size)
      {
        const std::vector<float> before = randomFloats(size, -1.0f, 1.0f, unsigned(size));
        const std::vector<float> part = randomFloats(size, 0.0f, 1.0f, unsigned(size + step));
        for (const bool isInPart : { false, true })
        {
          std::vector<float> values(size, untouched);
          kernels->smooth(step, size, before.data(), isInPart ? part.data() : nullptr, values.data());
          for (std::size_t n = 0; n < size; ++n)
          {
            const bool isRim = n < step || n + step >= size;
            const float whole = isRim ? 0.0f : 0.5f * before[n] + 0.25f * (before[n - step] + before[n + step]);
            const float kept = isInPart ? (1.0f - part[n]) * before[n] + part[n] * whole : whole;
            EXPECT_EQ(values[n], isRim ? untouched : kept);
          }
        }
      }
    }
  }
}

TEST(SampledVolumeKernels, SameBitsOnEveryVectorUnit)
{
  for (std::size_t count = SampledSums::lanes; count <= 20 * SampledSums::lanes; count += SampledSums::lanes)
  {
    const std::vector<float> depths = randomFloats(count, -0.2f, 0.5f, unsigned(count));
    const std::vector<float> volumes = randomFloats(count, 0.0f, 1e-3f, unsigned(count) + 1);
    SampledSums first;
    portableSampledVolumeKernels.sum(depths.data(), volumes.data(), count, 0.07f, 10.0f, first);
    EXPECT_GT(*std::max_element(first.volume, first.volume + SampledSums::lanes), 0.0f);
    for (const SampledVolumeKernels* kernels : runnableKernels<SampledVolumeKernels>())
    {
      SampledSums sums;
      kernels->sum(depths.data(), volumes.data(), count, 0.07f, 10.0f, sums);
      for (int lane = 0; lane < SampledSums::lanes; ++lane)
      {
        ASSERT_EQ(sums.volume[lane], first.volume[lane]);
        ASSERT_EQ(sums.slope[lane], first.slope[lane]);
        ASSERT_EQ(sums.bend[lane], first.bend[lane]);
      }
    }
  }
}

} // namespace
