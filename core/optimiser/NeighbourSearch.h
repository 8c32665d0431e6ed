// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Capsules.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cactus
{

/// Lists, for each capsule, the capsules of other fibres whose surfaces come within `reach`: those of capsule k are
/// indices[offsets[k]] … indices[offsets[k + 1] − 1], in increasing order. Each pair appears on both sides.
struct NeighbourList
{
  std::vector<std::size_t> offsets;
  std::vector<std::uint32_t> indices;
};

/// Finds all pairs of capsules of different fibres with distance < rp + rq + reach[p] + reach[q] (µm, one per capsule; radii
/// taken at their larger end). No pair is missed. In single precision, a pair slightly beyond that limit L may be listed too: one
/// whose distance d has d² < L² + 1.2·10⁻⁵ (L² + |p0 − p1|² + |q0 − q1|²), which is a relative 10⁻⁴ for capsules not much longer
/// than L, and more for thin and long ones.
///
/// Cells of fixed size (Turau 1991, as the paper) hold short runs of consecutive capsules of a fibre, which have most of their
/// neighbours in common. A run is entered in every cell that its bounding box touches, so thick and thin fibres can be mixed. For
/// each pair of runs that meet, capsules are compared first by their bounding boxes, then by their bounding balls, then exactly.
/// Gives the same result on any number of threads. Throws OutOfMemory if the pairs do not fit into memory.
void findNeighbours(const Capsules& capsules, const std::vector<float>& reach, int threads, NeighbourList& list);

/// Does the same for the capsules `of` only, which are whole fibres: list.offsets[0] belongs to the first of these.
void findNeighbours(
  const Capsules& capsules, const CapsuleRange& of, const std::vector<float>& reach, int threads, NeighbourList& list);

/// Does the same with distance < rp + rq + reach for all.
void findNeighbours(const Capsules& capsules, double reach, int threads, NeighbourList& list);

} // namespace cactus
