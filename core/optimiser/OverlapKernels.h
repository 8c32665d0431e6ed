// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/VectorUnit.h"
#include "fibres/Capsules.h"
#include "optimiser/CapsuleOverlap.h"

#include <cstddef>
#include <cstdint>

namespace cactus
{

/// A capsule in single precision, two of which fit into a cache line: enough to tell which ones are too far apart to touch.
struct alignas(32) RoughCapsule
{
  float p0[3];
  float r0;
  float p1[3];
  float r1;
};

/// Capsules with lists of neighbours: those of bodies[first + k] are neighbours[offsets[k]] … neighbours[offsets[k + 1] − 1].
struct ListedCapsules
{
  const Capsule* bodies;
  const RoughCapsule* rough; ///< the same capsules
  std::size_t first;
  const std::size_t* offsets;
  const std::uint32_t* neighbours;
  std::size_t neighbourCount; ///< total of all lists
};

/// How pairs are evaluated, see evaluateOverlap.
struct OverlapTerms
{
  double margin = 1.0;
  double tolerance = 0.0;
  /// Whether the radius of any capsule varies along it; if none does, both values give the same result, and false is faster.
  bool tapered = true;
};

/// A 64-byte aligned vector of doubles.
struct alignas(64) EightDoubles
{
  double numbers[8];
};

/// The loop over pairs of capsules in which a descent spends most of its time.
struct OverlapKernels
{
  /// Largest number of capsules that evaluateCapsules processes at once, so that its data on them stay in the first-level cache.
  static constexpr std::size_t together = 32;

  /// Work space of evaluateCapsules, for lists with that many neighbours in total.
  struct Room
  {
    /// Every entry is a valid index of bodies.
    std::uint32_t* touching;
    EightDoubles* lanes;
    static constexpr std::size_t touchingFor(std::size_t neighbours) { return neighbours + 16; }
    static constexpr std::size_t lanesFor(std::size_t neighbours) { return 14 * (neighbours / 8 + together); }
  };

  void (*roughen)(const Capsule* bodies, std::size_t count, RoughCapsule* rough);

  /// Computes half the cost and the whole gradient of the capsules with the lists begin … end − 1, see evaluateOverlap;
  /// neighbours that do not touch change no bit.
  void (*evaluateCapsules)(const ListedCapsules& capsules, std::size_t begin, std::size_t end, const OverlapTerms& terms,
    const Room& room, CapsuleOverlap* results);
};

CACTUS_KERNEL_VERSIONS(OverlapKernels);

} // namespace cactus
