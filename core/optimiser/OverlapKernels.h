// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/VectorUnit.h"
#include "fibres/Capsules.h"
#include "optimiser/CapsuleOverlap.h"

#include <cstddef>
#include <cstdint>

namespace cactus
{

/// A capsule in single precision, of which two fit into a cache line: enough to tell which ones are too far apart to touch.
struct alignas(32) RoughCapsule
{
  float p0[3];
  float r0;
  float p1[3];
  float r1;
};

/// Capsules with lists of neighbours: bodies[first + k] has those from neighbours[offsets[k]] to before neighbours[offsets[k +
/// 1]].
struct ListedCapsules
{
  const Capsule* bodies;
  const RoughCapsule* rough; ///< the same ones
  std::size_t first;
  const std::size_t* offsets;
  const std::uint32_t* neighbours;
  std::size_t neighbourCount; ///< of all lists
};

/// How pairs are evaluated, see evaluateOverlap.
struct OverlapTerms
{
  double margin = 1.0;
  double tolerance = 0.0;
  /// Whether the radius of any capsule varies along it; where none does, either value gives the same result, and false gives it
  /// sooner.
  bool tapered = true;
};

/// Aligned as vectors like it best.
struct alignas(64) EightDoubles
{
  double numbers[8];
};

/// The loop over pairs of capsules in which a descent spends most of its time.
struct OverlapKernels
{
  /// Capsules that evaluateCapsules takes at once, at most: little enough for what it keeps of them to stay in the nearest cache.
  static constexpr std::size_t together = 32;

  /// What evaluateCapsules works with, for lists that hold so many neighbours.
  struct Room
  {
    /// All that is in it is the number of some body.
    std::uint32_t* touching;
    EightDoubles* lanes;
    static constexpr std::size_t touchingFor(std::size_t neighbours) { return neighbours + 16; }
    static constexpr std::size_t lanesFor(std::size_t neighbours) { return 14 * (neighbours / 8 + together); }
  };

  void (*roughen)(const Capsule* bodies, std::size_t count, RoughCapsule* rough);

  /// Half the cost and the whole gradient of the capsules with the lists begin … end − 1, see evaluateOverlap; the same bits
  /// with and without neighbours that do not touch.
  void (*evaluateCapsules)(const ListedCapsules& capsules, std::size_t begin, std::size_t end, const OverlapTerms& terms,
    const Room& room, CapsuleOverlap* results);
};

CACTUS_KERNEL_VERSIONS(OverlapKernels);

} // namespace cactus
