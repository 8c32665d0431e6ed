// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Capsules.h"
#include "optimiser/CapsuleOverlap.h"
#include "optimiser/NeighbourSearch.h"

#include <cstddef>
#include <vector>

namespace cactus
{

/// Sums over all capsules, taken in a fixed order.
struct OverlapTotals
{
  double cost = 0.0;
  double penetration = 0.0;
  std::size_t overlappingPairs = 0;
};

/// Overlap cost (paper, overlapping cost function): Σ over pairs of D²·|p0 − p1|·|q0 − q1|·rp·rq for D > 0, with D = margin −
/// d/(rp + rq) and rp, rq interpolated at the closest points; margin 1 is the paper's form, a little more lets a descent end
/// strictly apart. The gradient is exact: it includes how the closest points slide where the radius varies along a capsule. Only
/// where two axes meet, so that the cost is at its peak, it is instead that of fibres a little apart, in a direction chosen from
/// their ids, without which they would never part. Each capsule gathers its own part from its neighbours, so the result has the
/// same bits on any number of threads.
OverlapTotals evaluateOverlap(const Capsules& capsules, const NeighbourList& neighbours, double margin, double tolerance,
  int threads, std::vector<CapsuleOverlap>& result);

} // namespace cactus
