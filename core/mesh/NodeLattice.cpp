// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/NodeLattice.h"

#include <algorithm>

namespace cactus
{

NodeRange nodesOfBlock(const NodeLattice& lattice, std::size_t block)
{
  NodeRange range;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto count = std::size_t(lattice.blocks(axis));
    const int first = NodeLattice::blockCells * static_cast<int>(axis < 2 ? block % count : block);
    block /= count;
    range.first[std::size_t(axis)] = first;
    range.count[std::size_t(axis)] = std::min(NodeLattice::blockCells, lattice.cells(axis) - first) + 1;
  }
  return range;
}

} // namespace cactus
