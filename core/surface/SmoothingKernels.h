// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/VectorUnit.h"

#include <cstddef>
#include <cstdint>

namespace cactus
{

/// The loops in which fields are read from a label image and smoothed.
struct SmoothingKernels
{
  /// The field of a fibre at a row of samples, as if those outside all fibres were nearest to it; whether one of these is nearer
  /// than `outside`, so that this is to be asked. See LabelImage.
  bool (*field)(
    const std::int32_t* ids, const float* depths, int count, std::int32_t fibre, float gap, float outside, float* out);

  /// One pass of smoothing along one axis, whose nodes are `step` apart in memory, of which `part` is kept, where given, which
  /// may be another one at each node. The first and the last `step` of `size` nodes are left out.
  void (*smooth)(std::size_t step, std::size_t size, const float* before, const float* part, float* values);
};

CACTUS_KERNEL_VERSIONS(SmoothingKernels);

} // namespace cactus
