// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace cactus
{

/// A box cut into cells by planes across each axis. Its nodes are where three planes meet; the outermost planes are its faces.
struct NodeLattice
{
  /// Edge of a block, in cells. Work on a lattice goes block by block, and skips empty blocks.
  static constexpr int blockCells = 16;

  std::array<std::vector<double>, 3> planes; ///< µm, increasing, at least two per axis

  int nodes(int axis) const { return static_cast<int>(this->planes[std::size_t(axis)].size()); }
  int cells(int axis) const { return this->nodes(axis) - 1; }
  int blocks(int axis) const { return (this->cells(axis) + blockCells - 1) / blockCells; }
  std::size_t blockCount() const
  {
    return std::size_t(this->blocks(0)) * std::size_t(this->blocks(1)) * std::size_t(this->blocks(2));
  }
};

/// A box of nodes, the first and how many per axis; values on it are stored x fastest.
struct NodeRange
{
  std::array<int, 3> first{ { 0, 0, 0 } };
  std::array<int, 3> count{ { 0, 0, 0 } };

  std::size_t size() const { return std::size_t(count[0]) * std::size_t(count[1]) * std::size_t(count[2]); }
  /// Returns the index of a node's value.
  std::ptrdiff_t index(int i, int j, int k) const
  {
    return std::ptrdiff_t(i - first[0]) +
           std::ptrdiff_t(count[0]) * (std::ptrdiff_t(j - first[1]) + std::ptrdiff_t(count[1]) * std::ptrdiff_t(k - first[2]));
  }
  /// Returns the range with this many more nodes on every side.
  NodeRange widened(int nodes) const
  {
    return { { { first[0] - nodes, first[1] - nodes, first[2] - nodes } },
      { { count[0] + 2 * nodes, count[1] + 2 * nodes, count[2] + 2 * nodes } } };
  }
  /// Returns the intersection with another range; without nodes if it is empty.
  NodeRange within(const NodeRange& other) const
  {
    NodeRange common;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      common.first[axis] = std::max(first[axis], other.first[axis]);
      const int end = std::min(first[axis] + count[axis], other.first[axis] + other.count[axis]);
      common.count[axis] = std::max(0, end - common.first[axis]);
    }
    return common;
  }
  /// Returns the smallest range that contains both.
  NodeRange joined(const NodeRange& other) const
  {
    if (this->size() == 0 || other.size() == 0)
    {
      return this->size() == 0 ? other : *this;
    }
    NodeRange both;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      both.first[axis] = std::min(first[axis], other.first[axis]);
      both.count[axis] = std::max(first[axis] + count[axis], other.first[axis] + other.count[axis]) - both.first[axis];
    }
    return both;
  }
};

/// Returns the nodes of the cells of block number `block` (x fastest): at most blockCells + 1 per axis.
NodeRange nodesOfBlock(const NodeLattice& lattice, std::size_t block);

} // namespace cactus
