// SPDX-License-Identifier: BSD-3-Clause
#include "Isosurface.h"

#include "Error.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace cactus
{

namespace
{

/// Corners of a cell are numbered by bits: 1 for the upper x, 2 for the upper y, 4 for the upper z.
constexpr int cornerCount = 8;

/// A tetrahedron of Kuhn's triangulation, with corners ordered so that its determinant is positive, and those of its sides that
/// lie on a face of the cell, wound outward.
struct Tetrahedron
{
  std::array<int, 4> corners;
  int lowerAxis; ///< `lowerSide` lies on the cell's lower face across this axis
  std::array<int, 3> lowerSide;
  int upperAxis; ///< `upperSide` lies on the cell's upper face across this axis
  std::array<int, 3> upperSide;
};

/// The one of the path 0, a, a + b, a + b + c along the axes a, b, c from corner 0 to corner 7.
Tetrahedron tetrahedronOf(int a, int b, int c)
{
  const int v1 = 1 << a;
  const int v2 = v1 | (1 << b);
  const bool even = (b - a + 3) % 3 == 1;
  Tetrahedron t;
  t.lowerAxis = c;
  t.upperAxis = a;
  if (even)
  {
    t.corners = { { 0, v1, v2, 7 } };
    t.lowerSide = { { 0, v2, v1 } };
    t.upperSide = { { v1, v2, 7 } };
  }
  else
  {
    t.corners = { { 0, v2, v1, 7 } };
    t.lowerSide = { { 0, v1, v2 } };
    t.upperSide = { { v2, v1, 7 } };
  }
  return t;
}

std::array<Tetrahedron, 6> allTetrahedra()
{
  return { { tetrahedronOf(0, 1, 2), tetrahedronOf(1, 2, 0), tetrahedronOf(2, 0, 1), tetrahedronOf(0, 2, 1),
    tetrahedronOf(2, 1, 0), tetrahedronOf(1, 0, 2) } };
}

/// For the corners of a tetrahedron that are positive (bit by bit): its corners in an even order, with the odd ones out in front.
struct TetrahedronCase
{
  int positive;             ///< how many
  std::array<int, 4> order; ///< the positive one first; for three, the negative one first; for two, the positive two first
};

constexpr std::array<TetrahedronCase, 16> cases = { {
  { 0, { { 0, 1, 2, 3 } } }, // none
  { 1, { { 0, 1, 2, 3 } } }, // 0
  { 1, { { 1, 0, 3, 2 } } }, // 1
  { 2, { { 0, 1, 2, 3 } } }, // 0 1
  { 1, { { 2, 3, 0, 1 } } }, // 2
  { 2, { { 0, 2, 3, 1 } } }, // 0 2
  { 2, { { 1, 2, 0, 3 } } }, // 1 2
  { 3, { { 3, 2, 1, 0 } } }, // 0 1 2
  { 1, { { 3, 2, 1, 0 } } }, // 3
  { 2, { { 0, 3, 1, 2 } } }, // 0 3
  { 2, { { 1, 3, 2, 0 } } }, // 1 3
  { 3, { { 2, 3, 0, 1 } } }, // 0 1 3
  { 2, { { 2, 3, 0, 1 } } }, // 2 3
  { 3, { { 1, 0, 3, 2 } } }, // 0 2 3
  { 3, { { 0, 1, 2, 3 } } }, // 1 2 3
  { 4, { { 0, 1, 2, 3 } } }, // all
} };

class Contourer
{
public:
  explicit Contourer(const NodeLattice& lattice)
    : Lattice(lattice)
  {
    const auto& planes = lattice.planes;
    Surface.box = Eigen::AlignedBox3d(Eigen::Vector3d(planes[0].front(), planes[1].front(), planes[2].front()),
      Eigen::Vector3d(planes[0].back(), planes[1].back(), planes[2].back()));
  }

  void addBlock(const NodeRange& range, const float* values)
  {
    this->Range = range;
    this->Values = values;
    this->Stride = { { 1, std::size_t(range.count[0] + 2), std::size_t(range.count[0] + 2) * std::size_t(range.count[1] + 2) } };
    for (const std::size_t local : this->Used)
    {
      this->Local[local] = -1;
    }
    this->Used.clear();
    this->Local.resize(std::max(this->Local.size(), cornerCount * range.size()), -1);
    const auto& n = range.count;
    for (int k = 0; k + 1 < n[2]; ++k)
    {
      for (int j = 0; j + 1 < n[1]; ++j)
      {
        const std::size_t row = this->valueIndex({ { 0, j, k } });
        const int edgesOfRow = this->boundary(1, j) | this->boundary(2, k);
        // Per cell, the signs at its lower x are those at the upper x of the one before.
        int upper = this->signs(row);
        for (int i = 0; i + 1 < n[0]; ++i)
        {
          const int lower = upper;
          upper = this->signs(row + std::size_t(i) + 1);
          const int mask = lower | (upper << 1);
          const int sides = edgesOfRow | this->boundary(0, i);
          if (mask == 0 || (mask == 255 && sides == 0))
          {
            continue;
          }
          this->addCell({ { i, j, k } }, mask, sides);
        }
      }
    }
  }

  CappedSurface take() { return std::move(this->Surface); }

private:
  using Corner = std::array<int, 3>; ///< a node, counted within the block

  /// Bits of the positive ones among the four nodes at one x of a cell, spread as the cell's corners of lower x.
  int signs(std::size_t at) const
  {
    const float* v = this->Values + at;
    const std::size_t up = this->Stride[1];
    const std::size_t above = this->Stride[2];
    return (v[0] > 0.0f ? 1 : 0) | (v[up] > 0.0f ? 4 : 0) | (v[above] > 0.0f ? 16 : 0) | (v[up + above] > 0.0f ? 64 : 0);
  }

  /// On which faces of the lattice a cell at this place of the block ends: bit 2·axis, bit 2·axis + 1.
  int boundary(int axis, int cell) const
  {
    const int at = this->Range.first[std::size_t(axis)] + cell;
    return (at == 0 ? 1 << (2 * axis) : 0) | (at + 1 == this->Lattice.cells(axis) ? 2 << (2 * axis) : 0);
  }

  static Corner cornerAt(const Corner& cell, int corner)
  {
    return { { cell[0] + (corner & 1), cell[1] + ((corner >> 1) & 1), cell[2] + (corner >> 2) } };
  }

  std::size_t localIndex(const Corner& node) const
  {
    return std::size_t(node[0]) +
           std::size_t(this->Range.count[0]) * (std::size_t(node[1]) + std::size_t(this->Range.count[1]) * std::size_t(node[2]));
  }

  /// Values begin one node before the block.
  std::size_t valueIndex(const Corner& node) const
  {
    return std::size_t(node[0] + 1) + this->Stride[1] * std::size_t(node[1] + 1) + this->Stride[2] * std::size_t(node[2] + 1);
  }

  void addCell(const Corner& cell, int mask, int sides)
  {
    static const std::array<Tetrahedron, 6> tetrahedra = allTetrahedra();
    for (const Tetrahedron& tetrahedron : tetrahedra)
    {
      const auto& c = tetrahedron.corners;
      const int inside =
        ((mask >> c[0]) & 1) | (((mask >> c[1]) & 1) << 1) | (((mask >> c[2]) & 1) << 2) | (((mask >> c[3]) & 1) << 3);
      if (inside == 0)
      {
        continue;
      }
      this->addTetrahedron(cell, tetrahedron, cases[std::size_t(inside)]);
      if ((sides & (1 << (2 * tetrahedron.lowerAxis))) != 0)
      {
        this->addCap(cell, tetrahedron.lowerSide, mask);
      }
      if ((sides & (2 << (2 * tetrahedron.upperAxis))) != 0)
      {
        this->addCap(cell, tetrahedron.upperSide, mask);
      }
    }
  }

  void addTetrahedron(const Corner& cell, const Tetrahedron& tetrahedron, const TetrahedronCase& kind)
  {
    if (kind.positive == 4)
    {
      return;
    }
    const auto corner = [&](int i) { return tetrahedron.corners[std::size_t(kind.order[std::size_t(i)])]; };
    if (kind.positive == 2)
    {
      this->addQuad(this->edgePoint(cell, corner(0), corner(2)), this->edgePoint(cell, corner(0), corner(3)),
        this->edgePoint(cell, corner(1), corner(3)), this->edgePoint(cell, corner(1), corner(2)));
      return;
    }
    const std::int32_t a = this->edgePoint(cell, corner(0), corner(1));
    const std::int32_t b = this->edgePoint(cell, corner(0), corner(2));
    const std::int32_t c = this->edgePoint(cell, corner(0), corner(3));
    if (kind.positive == 1)
    {
      this->Surface.mesh.triangles.push_back({ { a, b, c } });
    }
    else
    {
      this->Surface.mesh.triangles.push_back({ { a, c, b } });
    }
  }

  /// The part of a boundary triangle in which the field is positive.
  void addCap(const Corner& cell, const std::array<int, 3>& side, int mask)
  {
    std::array<std::int32_t, 4> polygon;
    std::size_t size = 0;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const int from = side[i];
      const int to = side[(i + 1) % 3];
      if ((mask >> from) & 1)
      {
        polygon[size++] = this->edgePoint(cell, from, from);
      }
      if (((mask >> from) & 1) != ((mask >> to) & 1))
      {
        polygon[size++] = this->edgePoint(cell, from, to);
      }
    }
    if (size == 3)
    {
      this->Surface.mesh.triangles.push_back({ { polygon[0], polygon[1], polygon[2] } });
    }
    else if (size == 4)
    {
      this->addQuad(polygon[0], polygon[1], polygon[2], polygon[3]);
    }
  }

  /// A convex, flat quadrilateral, cut along its shorter diagonal.
  void addQuad(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d)
  {
    const auto& p = this->Surface.mesh.points;
    auto& triangles = this->Surface.mesh.triangles;
    const double ac = (p[std::size_t(a)] - p[std::size_t(c)]).squaredNorm();
    const double bd = (p[std::size_t(b)] - p[std::size_t(d)]).squaredNorm();
    if (ac <= bd)
    {
      triangles.push_back({ { a, b, c } });
      triangles.push_back({ { a, c, d } });
    }
    else
    {
      triangles.push_back({ { a, b, d } });
      triangles.push_back({ { b, c, d } });
    }
  }

  /// The point where the field is 0 between two corners of a cell, or the corner where both are one.
  std::int32_t edgePoint(const Corner& cell, int one, int other)
  {
    const int lowerCorner = one & other; // one of the two, by how Kuhn's triangulation is made
    const int direction = one ^ other;
    const Corner lower = cornerAt(cell, lowerCorner);
    const Corner upper = cornerAt(cell, one | other);
    const std::size_t local = cornerCount * this->localIndex(lower) + std::size_t(direction);
    std::int32_t& known = this->Local[local];
    if (known >= 0)
    {
      return known;
    }
    this->Used.push_back(local);
    bool shared = false; // with a block beside this one
    std::uint64_t node = 0;
    for (std::size_t axis = 3; axis-- > 0;)
    {
      shared = shared || (lower[axis] == upper[axis] && (lower[axis] == 0 || lower[axis] + 1 == this->Range.count[axis]));
      node = node * std::uint64_t(this->Lattice.nodes(int(axis))) + std::uint64_t(this->Range.first[axis] + lower[axis]);
    }
    if (!shared)
    {
      return known = this->addPoint(lower, upper);
    }
    const auto entry = this->Shared.emplace(cornerCount * node + std::uint64_t(direction), -1).first;
    if (entry->second < 0)
    {
      entry->second = this->addPoint(lower, upper);
    }
    return known = entry->second;
  }

  std::int32_t addPoint(const Corner& lower, const Corner& upper)
  {
    const double t = this->crossing(lower, upper);
    Eigen::Vector3d point;
    int faces = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const auto& planes = this->Lattice.planes[axis];
      const int first = this->Range.first[axis] + lower[axis];
      const int last = this->Range.first[axis] + upper[axis];
      const double from = planes[std::size_t(first)];
      point[Eigen::Index(axis)] = from + t * (planes[std::size_t(last)] - from);
      if (first == last && first == 0)
      {
        faces |= 1 << (2 * axis);
      }
      if (first == last && std::size_t(last) + 1 == planes.size())
      {
        faces |= 2 << (2 * axis);
      }
    }
    this->Surface.mesh.points.push_back(point);
    this->Surface.faces.push_back(static_cast<std::uint8_t>(faces));
    return static_cast<std::int32_t>(this->Surface.mesh.points.size() - 1);
  }

  /// Where on an edge the field is 0, as a part of it.
  double crossing(const Corner& lower, const Corner& upper) const
  {
    const std::size_t first = this->valueIndex(lower);
    const std::size_t last = this->valueIndex(upper);
    if (first == last)
    {
      return 0.0;
    }
    const double a = this->Values[first];
    const double b = this->Values[last];
    // The nodes before and behind in line. A cell at a face is flat, and the field the same on both sides of it, so the line is
    // followed within the face.
    std::size_t step = 0;
    bool before = true;
    bool behind = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const int node = this->Range.first[axis] + lower[axis];
      const int end = this->Lattice.nodes(int(axis)) - 1;
      if (lower[axis] != upper[axis] && node != 0 && node + 1 != end)
      {
        step += this->Stride[axis];
        before = before && node > 1;
        behind = behind && node + 2 < end;
      }
    }
    if (step == 0)
    {
      before = behind = false;
    }
    const double bendBefore = before ? double(this->Values[first - step]) - 2.0 * a + b : 0.0;
    const double bendBehind = behind ? a - 2.0 * b + double(this->Values[last + step]) : 0.0;
    const double bend = !behind ? bendBefore : !before ? bendBehind : agreedBend(bendBefore, bendBehind);
    // a + linear t + bend/2 t², of which just one root lies between the ends, since their signs differ.
    const double linear = b - a - 0.5 * bend;
    const double root = std::sqrt(std::max(0.0, linear * linear - 2.0 * bend * a));
    const double q = -0.5 * (linear + std::copysign(root, linear));
    const double t = linear == 0.0 && root == 0.0 ? 0.5 : a / q;
    return t > 0.0 && t < 1.0 ? t : 2.0 * q / bend;
  }

  const NodeLattice& Lattice;
  NodeRange Range;
  const float* Values = nullptr;
  std::array<std::size_t, 3> Stride{ { 0, 0, 0 } };       ///< of values
  std::vector<std::int32_t> Local;                        ///< points of the current block, by lower node and direction, or -1
  std::vector<std::size_t> Used;                          ///< which of them are not -1
  std::unordered_map<std::uint64_t, std::int32_t> Shared; ///< points on planes between blocks
  CappedSurface Surface;
};

} // namespace

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

CappedSurface contour(const NodeLattice& lattice, const std::vector<std::uint32_t>& blocks,
  const std::function<void(const NodeRange&, float*)>& values)
{
  for (const auto& planes : lattice.planes)
  {
    if (planes.size() < 2 || !std::is_sorted(planes.begin(), planes.end(), std::less_equal<>()))
    {
      throw InvalidInput("a lattice needs at least two increasing planes per axis");
    }
  }
  if (!blocks.empty() && (!std::is_sorted(blocks.begin(), blocks.end()) || blocks.back() >= lattice.blockCount()))
  {
    throw InvalidInput("blocks to contour must be increasing and lie in the lattice");
  }
  Contourer contourer(lattice);
  std::vector<float> buffer;
  for (const std::uint32_t block : blocks)
  {
    const NodeRange range = nodesOfBlock(lattice, block);
    NodeRange around = range;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      around.first[axis] -= 1;
      around.count[axis] += 2;
    }
    buffer.resize(around.size());
    values(around, buffer.data());
    contourer.addBlock(range, buffer.data());
  }
  return contourer.take();
}

} // namespace cactus
