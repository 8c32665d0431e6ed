// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/VectorUnit.h"
#include "fibres/Capsules.h"
#include "optimiser/CapsuleOverlap.h"

#include <cstddef>
#include <cstdint>

namespace cactus
{

/// The loop over pairs of capsules in which a descent spends most of its time.
struct OverlapKernels
{
  /// Half the cost and the whole gradient of capsule p against bodies[neighbours[0]] … bodies[neighbours[count − 1]], see
  /// evaluateOverlap; the same bits with and without neighbours that do not touch. Of the `known` numbers from neighbours[0] on
  /// those behind the first count are of capsules that come next, and are fetched ahead. `tapered`: whether the radius of any
  /// capsule varies along it; where none does, either value gives the same result, and false gives it sooner.
  void (*evaluateCapsule)(const Capsule* bodies, const std::uint32_t* neighbours, std::size_t count, std::size_t known,
    const Capsule& p, double margin, double tolerance, bool tapered, CapsuleOverlap& result);
};

CACTUS_KERNEL_VERSIONS(OverlapKernels);

} // namespace cactus
