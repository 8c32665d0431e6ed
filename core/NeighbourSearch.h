// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Capsules.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cactus
{

/// For each capsule the capsules of other fibres whose surfaces come within `reach`: those of capsule k are
/// indices[offsets[k]] … indices[offsets[k + 1] − 1], in increasing order. Each pair appears on both sides.
struct NeighbourList
{
  std::vector<std::size_t> offsets;
  std::vector<std::uint32_t> indices;
};

/// Finds all pairs of capsules of different fibres with distance < rp + rq + reach (µm; radii taken at their larger end, so that
/// the list may hold a few more but misses none), with cells of fixed size (Turau 1991, as the paper) in which a capsule is
/// entered wherever its bounding box reaches, so that thick and thin capsules can be mixed. Same result on any number of threads.
void findNeighbours(const Capsules& capsules, double reach, int threads, NeighbourList& list);

} // namespace cactus
