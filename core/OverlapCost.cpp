// SPDX-License-Identifier: BSD-3-Clause
#include "OverlapCost.h"

#include "VectorKernels.h"

#include <algorithm>
#include <vector>

namespace cactus
{

OverlapTotals evaluateOverlap(const Capsules& capsules, const NeighbourList& neighbours, double margin, double tolerance,
  int threads, std::vector<CapsuleOverlap>& result)
{
  const std::size_t count = capsules.size();
  result.resize(count);
  constexpr std::size_t blockSize = 1024;
  const std::size_t blocks = (count + blockSize - 1) / blockSize;
  std::vector<OverlapTotals> partial(blocks);
  const VectorKernels& kernels = vectorKernels();
  const bool tapered =
    std::any_of(capsules.bodies.begin(), capsules.bodies.end(), [](const Capsule& body) { return body.r0 != body.r1; });
#pragma omp parallel for num_threads(threads) schedule(dynamic, 4)
  for (std::size_t block = 0; block < blocks; ++block)
  {
    OverlapTotals& mine = partial[block];
    const std::size_t end = std::min(count, (block + 1) * blockSize);
    for (std::size_t k = block * blockSize; k < end; ++k)
    {
      kernels.evaluateCapsule(capsules.bodies.data(), neighbours.indices.data() + neighbours.offsets[k],
        neighbours.offsets[k + 1] - neighbours.offsets[k], capsules.bodies[k], margin, tolerance, tapered, result[k]);
      mine.cost += result[k].cost;
      mine.penetration = std::max(mine.penetration, result[k].penetration);
      mine.overlappingPairs += result[k].overlapping;
    }
  }
  OverlapTotals totals;
  for (const OverlapTotals& mine : partial)
  {
    totals.cost += mine.cost;
    totals.penetration = std::max(totals.penetration, mine.penetration);
    totals.overlappingPairs += mine.overlappingPairs;
  }
  totals.overlappingPairs /= 2;
  return totals;
}

} // namespace cactus
