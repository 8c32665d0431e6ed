// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <tuple>

namespace cactus
{

/// One row of the convergence table, measured at the start of an iteration.
struct ConvergenceRow
{
  int iteration = 0;
  double overlapCost = 0.0;
  double maximumPenetration = 0.0;
  std::size_t overlappingPairs = 0;
  double curvatureCost = 0.0;
  double lengthCost = 0.0;
  double radiusCost = 0.0;
  double compactnessCost = 0.0;
  double seconds = 0.0;
};

inline auto membersOf(ConvergenceRow& row)
{
  return std::tie(row.iteration, row.overlapCost, row.maximumPenetration, row.overlappingPairs, row.curvatureCost, row.lengthCost,
    row.radiusCost, row.compactnessCost, row.seconds);
}

} // namespace cactus
