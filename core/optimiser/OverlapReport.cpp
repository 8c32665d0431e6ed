// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/OverlapReport.h"

#include "base/Context.h"
#include "fibres/Capsules.h"
#include "optimiser/NeighbourSearch.h"
#include "optimiser/OverlapCost.h"

#include <algorithm>

namespace cactus
{

OverlapReport measureOverlap(const Fibres& fibres, double tolerance, int threads)
{
  Context context;
  context.threads = threads;
  const Capsules capsules = capsulesOf(fibres);
  NeighbourList neighbours;
  findNeighbours(capsules, 0.0, context.threadCount(), neighbours);
  std::vector<CapsuleOverlap> overlaps;
  const OverlapTotals totals = evaluateOverlap(capsules, neighbours, 1.0, tolerance, context.threadCount(), overlaps);
  OverlapReport report;
  report.largestPenetration = totals.penetration;
  report.overlappingPairs = totals.overlappingPairs;
  report.perPoint.assign(fibres.points.size(), 0.0);
  for (std::size_t k = 0; k < capsules.size(); ++k)
  {
    for (const std::size_t i : { std::size_t(capsules.first[k]), std::size_t(capsules.first[k]) + 1 })
    {
      report.perPoint[i] = std::max(report.perPoint[i], overlaps[k].penetration);
    }
  }
  return report;
}

} // namespace cactus
