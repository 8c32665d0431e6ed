// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/VectorUnit.h"

#include <cstddef>
#include <cstdint>

namespace cactus
{

/// The loops that read fields from a label image and smooth them.
struct SmoothingKernels
{
  /// Computes the field of a fibre at a row of samples, as if samples outside all fibres were nearest to it. Returns whether one
  /// of these is above `outside`, so that its nearest fibre has to be determined. See LabelImage.
  bool (*field)(
    const std::int32_t* ids, const float* depths, int count, std::int32_t fibre, float gap, float outside, float* out);

  /// Smooths once along one axis, whose nodes are `step` apart in memory. If `part` is given, it is the fraction of the smoothing
  /// that is applied at each node. The first and the last `step` of `size` nodes are left out.
  void (*smooth)(std::size_t step, std::size_t size, const float* before, const float* part, float* values);
};

CACTUS_KERNEL_VERSIONS(SmoothingKernels);

} // namespace cactus
