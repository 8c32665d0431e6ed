// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Capsules.h"

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

/// Finds all pairs of capsules of different fibres with distance < rp + rq + reach[p] + reach[q] (µm, one per capsule; radii
/// taken at their larger end). Nothing is missed. In single precision, a pair a little beyond that limit L may be listed too: one
/// whose distance d has d² < L² + 1.2·10⁻⁵ (L² + |p0 − p1|² + |q0 − q1|²), which for capsules not much longer than L is a
/// relative 10⁻⁴, and more for thin and long ones.
///
/// Cells of fixed size (Turau 1991, as the paper) hold short runs of consecutive capsules of a fibre, which have most of their
/// neighbours in common; a run is entered wherever its bounding box reaches, so that thick and thin fibres can be mixed. Of the
/// runs that meet a run, those capsules are compared with each of its own whose bounding boxes meet its; and of these, those
/// exactly whose bounding balls meet. Same result on any number of threads. Throws OutOfMemory where the pairs do not fit.
void findNeighbours(const Capsules& capsules, const std::vector<float>& reach, int threads, NeighbourList& list);

/// The same for the capsules `of` alone, whole fibres: list.offsets[0] belongs to the first of these.
void findNeighbours(
  const Capsules& capsules, const CapsuleRange& of, const std::vector<float>& reach, int threads, NeighbourList& list);

/// The same with distance < rp + rq + reach for all.
void findNeighbours(const Capsules& capsules, double reach, int threads, NeighbourList& list);

} // namespace cactus
