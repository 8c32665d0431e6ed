// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/OverlapReport.h"

#include "base/Bytes.h"
#include "base/Context.h"
#include "optimiser/NeighbourSearch.h"
#include "optimiser/OverlapCost.h"
#include "optimiser/SharedCapsules.h"

#include <algorithm>
#include <cstdint>
#include <string>

namespace cactus
{

OverlapReport measureOverlap(const Fibres& fibres, double tolerance, int threads)
{
  const Sharing alone;
  return measureOverlap(fibres, FibreShares(fibres, alone), tolerance, threads);
}

OverlapReport measureOverlap(const Fibres& fibres, const FibreShares& shares, double tolerance, int threads)
{
  Context context;
  context.threads = threads;
  SharedCapsules capsules(fibres, shares);
  NeighbourList neighbours;
  const std::vector<float> reach(capsules.own().size(), 0.0f);
  capsules.findNeighbours(fibres, reach, context.threadCount(), neighbours);
  std::vector<CapsuleOverlap> overlaps;
  const OverlapParts parts = capsules.evaluate(neighbours, 1.0, tolerance, context.threadCount(), overlaps);
  OverlapReport report;
  report.perPoint.assign(fibres.points.size(), 0.0);
  for (std::size_t k = 0; k < overlaps.size(); ++k)
  {
    for (const std::size_t i : { capsules.pointOf(k), capsules.pointOf(k) + 1 })
    {
      report.perPoint[i] = std::max(report.perPoint[i], overlaps[k].penetration);
    }
  }
  ByteWriter mine;
  mine(parts.penetration);
  mine(static_cast<std::uint64_t>(parts.overlapping));
  for (const std::string& told : shares.sharing().exchange(mine.bytes()))
  {
    ByteReader get(told);
    report.largestPenetration = std::max(report.largestPenetration, get.get<double>());
    report.overlappingPairs += get.get<std::uint64_t>();
  }
  report.overlappingPairs /= 2;
  return report;
}

} // namespace cactus
