// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Capsules.h"
#include "optimiser/CapsuleOverlap.h"
#include "optimiser/NeighbourSearch.h"
#include "optimiser/OverlapKernels.h"

#include <cstddef>
#include <tuple>
#include <vector>

namespace cactus
{

/// Sums over all capsules, in a fixed order.
struct OverlapTotals
{
  double cost = 0.0;
  double penetration = 0.0;
  std::size_t overlappingPairs = 0;
};

/// Evaluates the overlap cost (paper, overlapping cost function): Σ over pairs of D²·|p0 − p1|·|q0 − q1|·rp·rq for D > 0, with D
/// = margin − d/(rp + rq) and rp, rq interpolated at the closest points. Margin 1 is the paper's form; a slightly larger one lets
/// a descent end strictly apart. The gradient is exact: it includes how the closest points slide if the radius varies along a
/// capsule. Only where two axes meet, at the peak of the cost, it is replaced by that of fibres a little apart, in a direction
/// chosen from their ids; without it they would never part. Each capsule gathers its own part from its neighbours, so the result
/// has the same bits on any number of threads.
OverlapTotals evaluateOverlap(const Capsules& capsules, const NeighbourList& neighbours, double margin, double tolerance,
  int threads, std::vector<CapsuleOverlap>& result);

/// Sums over consecutive capsules, from which the sums over all follow exactly, however the capsules are divided: costs are
/// summed by blocks of capsules, and those outside whole blocks are kept per capsule.
struct OverlapParts
{
  std::vector<double> before; ///< costs of the capsules before the first whole block
  std::vector<double> blocks;
  std::vector<double> after;
  double penetration = 0.0;
  std::size_t overlapping = 0; ///< pairs, counted from this side
};

inline auto membersOf(OverlapParts& parts)
{
  return std::tie(parts.before, parts.blocks, parts.after, parts.penetration, parts.overlapping);
}

bool isAnyTapered(const Capsules& capsules, const CapsuleRange& of);

/// Does the same for the capsules `of` only, whose lists begin with neighbours.offsets[0] and whose results with result[0].
/// `place`: the index of the first of them among the capsules of all processes. `rough` is work space.
OverlapParts evaluateOverlap(const Capsules& capsules, const CapsuleRange& of, std::size_t place, const NeighbourList& neighbours,
  const OverlapTerms& terms, int threads, std::vector<RoughCapsule>& rough, std::vector<CapsuleOverlap>& result);

/// Sums the parts; add those of the first capsules first.
class OverlapSum
{
public:
  void add(const OverlapParts& parts);
  OverlapTotals totals() const;

private:
  void addCapsules(const std::vector<double>& costs);

  OverlapTotals Sum;
  double Block = 0.0; ///< the part of a block that was added
  std::size_t InBlock = 0;
};

} // namespace cactus
