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

/// How far beyond contact a neighbour may be: by `absolute` µm plus `relative` times its own and the capsule's radius.
struct Reach
{
  double absolute = 0.0;
  double relative = 0.0;
};

/// Finds all pairs of capsules of different fibres with distance < (rp + rq)(1 + relative) + absolute (radii taken at their
/// larger end; within a relative 10⁻⁵ of that limit a pair may be listed or not, beyond it never, within it always).
///
/// Cells of fixed size (Turau 1991, as the paper) hold short runs of consecutive capsules of a fibre, which have most of their
/// neighbours in common; a run is entered wherever its bounding box reaches, so that thick and thin fibres can be mixed. Same
/// result on any number of threads.
void findNeighbours(const Capsules& capsules, const Reach& reach, int threads, NeighbourList& list);

} // namespace cactus
