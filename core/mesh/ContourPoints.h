// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/CappedSurface.h"
#include "mesh/NodeLattice.h"
#include "mesh/PointTable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace cactus
{

/// Returns the smaller one of the second differences on either side of an edge, or 0 if they have different signs: across a
/// crease one side does not predict the other.
inline double agreedBend(double a, double b)
{
  return std::max(std::min(a, b), 0.0) + std::min(std::max(a, b), 0.0);
}

/// A node, counted within a block.
using LatticeNode = std::array<int, 3>;

/// Corners of a cell are numbered by bits: 1 for the upper x, 2 for the upper y, 4 for the upper z. A cell is named by corner 0.
inline LatticeNode cornerOfCell(const LatticeNode& cell, int corner)
{
  return { { cell[0] + (corner & 1), cell[1] + ((corner >> 1) & 1), cell[2] + (corner >> 2) } };
}

/// The values of a field at the nodes of a block, starting one node before it on every side.
struct BlockValues
{
  NodeRange range; ///< the nodes of the block itself
  const float* values = nullptr;
  std::array<std::size_t, 3> stride{ { 0, 0, 0 } };

  BlockValues() = default;
  BlockValues(const NodeRange& nodes, const float* field)
    : range(nodes)
    , values(field)
    , stride{ { 1, std::size_t(nodes.count[0] + 2), std::size_t(nodes.count[0] + 2) * std::size_t(nodes.count[1] + 2) } }
  {
  }

  const float* at(const LatticeNode& node) const
  {
    return this->values + std::size_t(node[0] + 1) + this->stride[1] * std::size_t(node[1] + 1) +
           this->stride[2] * std::size_t(node[2] + 1);
  }
};

/// The points of a contour on the edges of a lattice's cells, and those of its caps at nodes. Cells and blocks that share an edge
/// share its point.
class ContourPoints
{
public:
  /// Adds points to `surface`. All arguments have to outlive the object.
  ContourPoints(const NodeLattice& lattice, CappedSurface& surface)
    : Lattice(lattice)
    , Surface(surface)
  {
  }

  /// Continues with another block, in the same layer along z or above it.
  void begin(const BlockValues& block)
  {
    if (block.range.first[2] > this->Block.range.first[2])
    {
      std::swap(this->Shared, this->SharedAbove);
      this->SharedAbove.clear();
    }
    this->Block = block;
    for (const std::size_t local : this->Used)
    {
      this->Local[local] = -1;
    }
    this->Used.clear();
    this->Local.resize(std::max(this->Local.size(), pointsPerNode * block.range.size()), -1);
    for (int one = 0; one < 8; ++one)
    {
      for (const int step : { 0, 1, 2, 4 })
      {
        const std::size_t place = pointsPerNode * this->localIndex(cornerOfCell({ { 0, 0, 0 } }, one & ~step)) +
                                  std::size_t(step == 0 ? 0 : 1 + step / 2);
        this->Places[std::size_t(one)][std::size_t(one ^ step)] = place;
      }
    }
  }

  /// Returns the point where the field is 0 between two corners of a cell, or the corner itself if both are the same.
  std::int32_t between(const LatticeNode& cell, int one, int other)
  {
    const std::int32_t known = this->Local[this->placeOf(cell, one, other)];
    return known >= 0 ? known : this->add(cell, one, other);
  }

  /// Does the same for a point that no cell of the block has requested.
  std::int32_t add(const LatticeNode& cell, int one, int other)
  {
    const std::size_t place = this->placeOf(cell, one, other);
    this->Used.push_back(place);
    std::int32_t& known = this->Local[place];
    const LatticeNode lower = cornerOfCell(cell, one & other);
    const auto direction = place % pointsPerNode;
    bool shared = false; // with a block beside this one
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      shared = shared || (axis + 1 != direction && (lower[axis] == 0 || lower[axis] + 1 == this->Block.range.count[axis]));
    }
    if (!shared)
    {
      return known = this->addPoint(lower, direction, 0);
    }
    std::uint64_t node = 0;
    for (std::size_t axis = 3; axis-- > 0;)
    {
      node = node * std::uint64_t(this->Lattice.nodes(int(axis))) + std::uint64_t(this->Block.range.first[axis] + lower[axis]);
    }
    const bool isAbove = lower[2] + 1 == this->Block.range.count[2];
    std::int32_t& point = (isAbove ? this->SharedAbove : this->Shared)[pointsPerNode * node + direction];
    if (point == PointTable::none)
    {
      point = this->addPoint(lower, direction, this->facesAt(lower, direction));
    }
    return known = point;
  }

private:
  /// Points of a node: the node itself, and one on the edge that leads up from it along each axis.
  static constexpr std::size_t pointsPerNode = 4;

  std::size_t placeOf(const LatticeNode& cell, int one, int other) const
  {
    return pointsPerNode * this->localIndex(cell) + this->Places[std::size_t(one)][std::size_t(other)];
  }

  std::size_t localIndex(const LatticeNode& node) const
  {
    const auto& count = this->Block.range.count;
    return std::size_t(node[0]) + std::size_t(count[0]) * (std::size_t(node[1]) + std::size_t(count[1]) * std::size_t(node[2]));
  }

  /// Returns the faces of the lattice that contain the whole edge, or a node: see CappedSurface.
  int facesAt(const LatticeNode& lower, std::size_t direction) const
  {
    int faces = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const int node = this->Block.range.first[axis] + lower[axis];
      const int ends = (node == 0 ? 1 : 0) | (node == this->Lattice.cells(int(axis)) ? 2 : 0);
      faces |= axis + 1 != direction ? ends << (2 * axis) : 0;
    }
    return faces;
  }

  std::int32_t addPoint(const LatticeNode& lower, std::size_t direction, int faces)
  {
    const auto plane = [&](std::size_t axis, int step)
    { return this->Lattice.planes[axis][std::size_t(this->Block.range.first[axis] + lower[axis] + step)]; };
    Eigen::Vector3d point(plane(0, 0), plane(1, 0), plane(2, 0));
    if (direction > 0)
    {
      const std::size_t axis = direction - 1;
      const double from = plane(axis, 0);
      point[Eigen::Index(axis)] = from + this->crossing(lower, axis) * (plane(axis, 1) - from);
    }
    this->Surface.mesh.points.push_back(point);
    this->Surface.faces.push_back(static_cast<std::uint8_t>(faces));
    return static_cast<std::int32_t>(this->Surface.mesh.points.size() - 1);
  }

  /// Returns the zero of the field on the edge that leads up from a node, as a fraction of the edge.
  double crossing(const LatticeNode& lower, std::size_t axis) const
  {
    const float* first = this->Block.at(lower);
    const std::size_t step = this->Block.stride[axis];
    const float* last = first + step;
    const double a = *first;
    const double b = *last;
    // The nodes before and behind in line. A cell at a face is flat, with the same field on both sides, so it has no second
    // difference.
    const int node = this->Block.range.first[axis] + lower[axis];
    const int end = this->Lattice.nodes(int(axis)) - 1;
    const bool before = node > 1 && node + 1 < end;
    const bool behind = node > 0 && node + 2 < end;
    const double bendBefore = before ? double(*(first - step)) - 2.0 * a + b : 0.0;
    const double bendBehind = behind ? a - 2.0 * b + double(*(last + step)) : 0.0;
    const double bend = !behind ? bendBefore : !before ? bendBehind : agreedBend(bendBefore, bendBehind);
    // a + linear t + bend/2 t², which has exactly one root between the ends, since their signs differ.
    const double linear = b - a - 0.5 * bend;
    const double root = std::sqrt(std::max(0.0, linear * linear - 2.0 * bend * a));
    const double q = -0.5 * (linear + std::copysign(root, linear));
    const double t = linear == 0.0 && root == 0.0 ? 0.5 : a / q;
    if (t > 0.0 && t < 1.0)
    {
      return t;
    }
    const double other = 2.0 * q / bend;
    const bool isBetween = other > 0.0 && other < 1.0; // if not, the field is 0 at one of the ends
    return isBetween ? other : std::abs(a) < std::abs(b) ? 0.0 : 1.0;
  }

  const NodeLattice& Lattice;
  CappedSurface& Surface;
  BlockValues Block;
  std::vector<std::int32_t> Local;                  ///< points of the block, by lower node and direction, or -1
  std::vector<std::size_t> Used;                    ///< indices in Local that are not -1
  std::array<std::array<std::size_t, 8>, 8> Places; ///< in Local, by two corners of the first cell
  PointTable Shared;                                ///< points on planes between blocks of this layer and to that below
  PointTable SharedAbove;                           ///< and on the plane to the layer above
};

} // namespace cactus
