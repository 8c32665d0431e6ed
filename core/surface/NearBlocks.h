// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/NodeLattice.h"
#include "surface/FibreField.h"
#include "surface/FibreSurvey.h"

#include <cstdint>
#include <vector>

namespace cactus
{

/// Blocks of a field's lattice, and where in them and around them a fibre is.
struct NearBlocks
{
  /// So far around a block's nodes is looked for the fibre.
  static constexpr int around = 4;

  std::vector<std::uint32_t> numbers; ///< increasing
  std::vector<NodeRange> inside; ///< per block: a box that holds the fibre's samples there; without nodes where there is none
};

/// All blocks that have a node in a fibre's boxes, or at most `reach` away from them. Throws InvalidInput where the lattice has
/// more than their numbers count.
NearBlocks blocksNear(const FibreField& field, const FoundFibre& fibre, int reach);

} // namespace cactus
