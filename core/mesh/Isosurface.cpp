// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/Isosurface.h"

#include "base/Error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>

namespace cactus
{

namespace
{

/// Corners of a cell are numbered by bits: 1 for the upper x, 2 for the upper y, 4 for the upper z.
constexpr int cornerCount = 8;
/// Points of a node: the node itself, and one on the edge that leads up from it along each axis.
constexpr int pointsPerNode = 4;

/// The corners of a face of a cell, counterclockwise as seen from outside; face 2·axis is the lower one, 2·axis + 1 the upper.
std::array<int, 4> cornersOfFace(int face)
{
  const int axis = face / 2;
  const int b = 1 << ((axis + 1) % 3);
  const int c = 1 << ((axis + 2) % 3);
  if (face % 2 == 0)
  {
    return { { 0, c, b | c, b } };
  }
  const int a = 1 << axis;
  return { { a, a | b, a | b | c, a | c } };
}

std::array<std::array<int, 4>, 6> allFaces()
{
  return { { cornersOfFace(0), cornersOfFace(1), cornersOfFace(2), cornersOfFace(3), cornersOfFace(4), cornersOfFace(5) } };
}

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
    this->Local.resize(std::max(this->Local.size(), pointsPerNode * range.size()), -1);
    const auto& n = range.count;
    this->findSigns();
    for (int k = 0; k + 1 < n[2]; ++k)
    {
      for (int j = 0; j + 1 < n[1]; ++j)
      {
        // Bit by bit along x: cells with a corner inside, and those with all of them inside.
        const std::uint32_t rows[4] = { this->signs(j, k), this->signs(j + 1, k), this->signs(j, k + 1),
          this->signs(j + 1, k + 1) };
        const std::uint32_t any = rows[0] | rows[1] | rows[2] | rows[3];
        const std::uint32_t every = rows[0] & rows[1] & rows[2] & rows[3];
        const std::uint32_t cells = (1u << (n[0] - 1)) - 1u;
        const int sidesOfRow = this->boundary(1, j) | this->boundary(2, k);
        std::uint32_t inside = every & (every >> 1);
        if (sidesOfRow != 0)
        {
          inside = 0; // these have caps
        }
        else
        {
          inside &= ~((this->boundary(0, 0) != 0 ? 1u : 0u) | (this->boundary(0, n[0] - 2) != 0 ? 1u << (n[0] - 2) : 0u));
        }
        for (std::uint32_t left = (any | (any >> 1)) & ~inside & cells; left != 0; left &= left - 1)
        {
          const int i = __builtin_ctz(left);
          int mask = 0;
          for (int row = 0; row < 4; ++row)
          {
            mask |= static_cast<int>((rows[row] >> i) & 3u) << (2 * row);
          }
          this->addCell({ { i, j, k } }, mask, sidesOfRow | this->boundary(0, i));
        }
      }
    }
  }

  CappedSurface take() { return std::move(this->Surface); }

private:
  using Corner = std::array<int, 3>; ///< a node, counted within the block

  /// An edge of a cell, by the corners at its ends.
  struct Edge
  {
    int from;
    int to;

    std::size_t index() const { return std::size_t(3 * (from & to) + (from ^ to) / 2); }
  };
  static constexpr std::size_t edgeCount = 3 * (cornerCount - 1); // some numbers stand for none

  /// Writes down which nodes of the block are positive, a bit each.
  void findSigns()
  {
    const auto& n = this->Range.count;
    for (int k = 0; k < n[2]; ++k)
    {
      for (int j = 0; j < n[1]; ++j)
      {
        const float* row = this->Values + this->valueIndex({ { 0, j, k } });
        std::uint32_t bits = 0;
        for (int i = 0; i < n[0]; ++i)
        {
          bits |= (row[i] > 0.0f ? 1u : 0u) << i;
        }
        this->Signs[std::size_t(k)][std::size_t(j)] = bits;
      }
    }
  }
  std::uint32_t signs(int j, int k) const { return this->Signs[std::size_t(k)][std::size_t(j)]; }

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
    // By edge: a loop of the surface goes on from there to this one. An edge on which it enters the positive part of one face is
    // one on which it leaves that of another.
    std::array<Edge, edgeCount> next;
    std::array<Edge, 12> entries;
    std::size_t entryCount = 0;
    bool isPlain = true;
    for (int face = 0; face < 6; ++face)
    {
      static const std::array<std::array<int, 4>, 6> faces = allFaces();
      const std::array<int, 4>& corners = faces[std::size_t(face)];
      // Crossings around the face, from outside to inside or the other way round.
      std::array<Edge, 4> crossings;
      std::array<bool, 4> enters;
      std::size_t count = 0;
      for (std::size_t i = 0; i < 4; ++i)
      {
        const int from = corners[i];
        const int to = corners[(i + 1) % 4];
        if (((mask >> from) & 1) != ((mask >> to) & 1))
        {
          enters[count] = ((mask >> to) & 1) != 0;
          crossings[count++] = { from, to };
        }
      }
      const bool isJoined = count == 4 && this->positivesMeet(cell, corners, mask);
      isPlain = isPlain && count < 4;
      for (std::size_t i = 0; i < count; ++i)
      {
        if (enters[i])
        {
          // Around the positive corner that follows or, where positives meet, around the negative one before.
          next[crossings[i].index()] = crossings[(i + (isJoined ? count - 1 : 1)) % count];
          entries[entryCount++] = crossings[i];
        }
      }
      if (((sides >> face) & 1) != 0)
      {
        this->addCaps(cell, corners, mask, isJoined);
      }
    }
    std::uint32_t done = 0;
    for (std::size_t e = 0; e < entryCount; ++e)
    {
      this->Polygon.clear();
      for (Edge at = entries[e]; (done & (1u << at.index())) == 0; at = next[at.index()])
      {
        done |= 1u << at.index();
        this->Polygon.push_back(this->edgePoint(cell, at.from, at.to));
      }
      if (!this->Polygon.empty())
      {
        isPlain ? this->addPolygon() : this->addFan();
      }
    }
  }

  /// Of a face whose positive corners are opposite each other: whether they hang together, as the saddle of the bilinear field
  /// says.
  bool positivesMeet(const Corner& cell, const std::array<int, 4>& corners, int mask) const
  {
    double positives = 1.0;
    double negatives = 1.0;
    for (const int corner : corners)
    {
      (((mask >> corner) & 1) != 0 ? positives : negatives) *= this->Values[this->valueIndex(cornerAt(cell, corner))];
    }
    return positives > negatives;
  }

  /// The part of a face of the box in which the field is positive.
  void addCaps(const Corner& cell, const std::array<int, 4>& corners, int mask, bool isJoined)
  {
    this->Polygon.clear();
    for (std::size_t i = 0; i < 4; ++i)
    {
      const int from = corners[i];
      const int to = corners[(i + 1) % 4];
      const bool isInside = ((mask >> from) & 1) != 0;
      if (isInside)
      {
        this->Polygon.push_back(this->edgePoint(cell, from, from));
      }
      if (isInside != (((mask >> to) & 1) != 0))
      {
        this->Polygon.push_back(this->edgePoint(cell, from, to));
      }
    }
    if (this->Polygon.empty())
    {
      return;
    }
    const bool isAmbiguous = this->Polygon.size() == 6;
    if (!isAmbiguous || isJoined)
    {
      this->addPolygon();
      return;
    }
    // Two corners: from the crossing before each to the one behind.
    const std::vector<std::int32_t> all = this->Polygon;
    const std::size_t first = ((mask >> corners[0]) & 1) != 0 ? 5 : 0;
    for (std::size_t corner = 0; corner < 2; ++corner)
    {
      const std::size_t at = first + 3 * corner;
      this->Polygon = { all[at % 6], all[(at + 1) % 6], all[(at + 2) % 6] };
      this->addPolygon();
    }
  }

  /// Cuts what Polygon holds into triangles between its corners, by the shortest diagonals.
  void addPolygon()
  {
    const auto& points = this->Surface.mesh.points;
    std::vector<std::int32_t>& p = this->Polygon;
    while (p.size() > 3)
    {
      std::size_t best = 0;
      double shortest = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < p.size(); ++i)
      {
        const std::int32_t before = p[(i + p.size() - 1) % p.size()];
        const std::int32_t behind = p[(i + 1) % p.size()];
        const double length = (points[std::size_t(before)] - points[std::size_t(behind)]).squaredNorm();
        if (length < shortest)
        {
          shortest = length;
          best = i;
        }
      }
      this->Surface.mesh.triangles.push_back({ { p[(best + p.size() - 1) % p.size()], p[best], p[(best + 1) % p.size()] } });
      p.erase(p.begin() + std::ptrdiff_t(best));
    }
    this->Surface.mesh.triangles.push_back({ { p[0], p[1], p[2] } });
  }

  /// Cuts what Polygon holds into triangles around a point in its middle.
  void addFan()
  {
    std::vector<std::int32_t>& p = this->Polygon;
    if (p.size() == 3)
    {
      this->addPolygon();
      return;
    }
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const std::int32_t point : p)
    {
      middle += this->Surface.mesh.points[std::size_t(point)];
    }
    const auto centre = static_cast<std::int32_t>(this->Surface.mesh.points.size());
    this->Surface.mesh.points.push_back(middle / double(p.size()));
    this->Surface.faces.push_back(0);
    for (std::size_t i = 0; i < p.size(); ++i)
    {
      this->Surface.mesh.triangles.push_back({ { centre, p[i], p[(i + 1) % p.size()] } });
    }
  }

  /// The point where the field is 0 between two corners of a cell, or the corner where both are one.
  std::int32_t edgePoint(const Corner& cell, int one, int other)
  {
    const int lowerCorner = one & other;
    const int direction = one == other ? 0 : 1 + (one ^ other) / 2;
    const Corner lower = cornerAt(cell, lowerCorner);
    const Corner upper = cornerAt(cell, one | other);
    const std::size_t local = pointsPerNode * this->localIndex(lower) + std::size_t(direction);
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
    const auto entry = this->Shared.emplace(pointsPerNode * node + std::uint64_t(direction), -1).first;
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
    // The nodes before and behind in line. A cell at a face is flat, and the field the same on both sides of it: nothing bends
    // there.
    const std::size_t axis = lower[0] != upper[0] ? 0 : lower[1] != upper[1] ? 1 : 2;
    const std::size_t step = this->Stride[axis];
    const int node = this->Range.first[axis] + lower[axis];
    const int end = this->Lattice.nodes(int(axis)) - 1;
    const bool before = node > 1 && node + 1 < end;
    const bool behind = node > 0 && node + 2 < end;
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
  std::array<std::size_t, 3> Stride{ { 0, 0, 0 } };                                                      ///< of values
  std::array<std::array<std::uint32_t, NodeLattice::blockCells + 1>, NodeLattice::blockCells + 1> Signs; ///< see findSigns()
  std::vector<std::int32_t> Local;                        ///< points of the current block, by lower node and direction, or -1
  std::vector<std::size_t> Used;                          ///< which of them are not -1
  std::unordered_map<std::uint64_t, std::int32_t> Shared; ///< points on planes between blocks
  std::vector<std::int32_t> Polygon;                      ///< that is being cut into triangles
  CappedSurface Surface;
};

} // namespace

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
    const NodeRange around = range.widened(1);
    buffer.resize(around.size());
    values(around, buffer.data());
    contourer.addBlock(range, buffer.data());
  }
  return contourer.take();
}

} // namespace cactus
