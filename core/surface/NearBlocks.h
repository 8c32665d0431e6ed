// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/NodeLattice.h"
#include "surface/FibreField.h"
#include "surface/FibreSurvey.h"

#include <cstdint>
#include <vector>

namespace cactus
{

/// Blocks of a field's lattice, and the extent of a fibre in and around each.
struct NearBlocks
{
  /// Search radius around a block's nodes, in nodes.
  static constexpr int around = 4;

  std::vector<std::uint32_t> numbers; ///< increasing
  std::vector<NodeRange> inside;      ///< per block: a box that holds the fibre's samples there; without nodes if there are none
};

/// Returns all blocks that have a node in a fibre's boxes, or at most `reach` away from them. Throws InvalidInput if the lattice
/// has more blocks than 32-bit numbers.
NearBlocks blocksNear(const FibreField& field, const FoundFibre& fibre, int reach);

} // namespace cactus
