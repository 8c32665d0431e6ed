// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"
#include "optimiser/FibreShares.h"

#include <cstddef>
#include <vector>

namespace cactus
{

/// How deep the capsules of different fibres penetrate each other.
struct OverlapReport
{
  double largestPenetration = 0.0;  ///< largest D = 1 − d/(rp + rq) (paper, overlapping cost function); 0 without overlap
  std::size_t overlappingPairs = 0; ///< pairs with D above the tolerance
  std::vector<double> perPoint;     ///< largest D of the capsules at each control point; 0 if it touches nothing
};

/// Measures every pair of capsules of different fibres with exact closest points. Tolerance: the D above which a pair counts.
OverlapReport measureOverlap(const Fibres& fibres, double tolerance = 0.0, int threads = 0);

/// Does the same for processes that share the fibres. Collective: `fibres` and the values per control point are this process's
/// own, the other results those of all.
OverlapReport measureOverlap(const Fibres& fibres, const FibreShares& shares, double tolerance, int threads);

} // namespace cactus
