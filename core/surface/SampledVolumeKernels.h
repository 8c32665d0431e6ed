// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/VectorUnit.h"

#include <cstddef>

namespace cactus
{

/// Sums over samples in lanes: by the index modulo `lanes`.
struct SampledSums
{
  static constexpr int lanes = 16;

  float volume[lanes];
  float slope[lanes];
  float bend[lanes];
};

/// The loop in which SampledVolume searches for a level.
struct SampledVolumeKernels
{
  /// Sums the volume of the samples' boxes above a level, and its derivatives; see SampledVolume::measureAt(). `count` is a
  /// multiple of the lanes.
  void (*sum)(const float* depths, const float* volumes, std::size_t count, float level, float perWidth, SampledSums& sums);
};

CACTUS_KERNEL_VERSIONS(SampledVolumeKernels);

} // namespace cactus
