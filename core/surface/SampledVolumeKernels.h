// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/VectorUnit.h"

#include <cstddef>

namespace cactus
{

/// Sums over samples, each in lanes: the samples whose place leaves the same rest by `lanes`.
struct SampledSums
{
  static constexpr int lanes = 16;

  float volume[lanes];
  float slope[lanes];
  float bend[lanes];
};

/// The loop in which SampledVolume looks for a level.
struct SampledVolumeKernels
{
  /// What the boxes of samples hold above a level, and how that changes with it; see SampledVolume::measureAt(). `count` is a
  /// multiple of the lanes.
  void (*sum)(const float* depths, const float* volumes, std::size_t count, float level, float perWidth, SampledSums& sums);
};

CACTUS_KERNEL_VERSIONS(SampledVolumeKernels);

} // namespace cactus
