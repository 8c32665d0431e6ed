// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/Isosurface.h"

#include "base/Error.h"
#include "mesh/ContourPoints.h"
#include "mesh/PolygonCutting.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace cactus
{

namespace
{

constexpr int cornerCount = 8;
/// Initially reserved number of points: typical for the blocks of a tube of a few blocks.
constexpr std::size_t pointsOfBlock = 64;

/// Returns the corners of a face of a cell, counterclockwise as seen from outside; face 2·axis is the lower one, 2·axis + 1 the
/// upper.
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

/// An edge of a cell, by the corners at its ends.
struct CellEdge
{
  int from;
  int to;

  std::size_t index() const { return std::size_t(3 * (from & to) + (from ^ to) / 2); }
};
constexpr std::size_t edgeCount = 3 * (cornerCount - 1); // some numbers are unused

const std::array<std::array<int, 4>, 6> facesOfCell = allFaces();

/// The edges on which the contour crosses a face, in order around it, of a cell whose corners with a bit in `mask` are positive.
struct FaceCrossings
{
  std::array<CellEdge, 4> edges;
  std::array<bool, 4> enters; ///< from outside to inside, or the reverse
  std::size_t count = 0;

  FaceCrossings(const std::array<int, 4>& corners, int mask)
  {
    for (std::size_t i = 0; i < 4; ++i)
    {
      const int from = corners[i];
      const int to = corners[(i + 1) % 4];
      if (((mask >> from) & 1) != ((mask >> to) & 1))
      {
        enters[count] = ((mask >> to) & 1) != 0;
        edges[count++] = { from, to };
      }
    }
  }
};

/// Returns, as bits, the faces whose positive corners are opposite each other, so that the signs do not determine the contour
/// there.
int ambiguousFaces(int mask)
{
  int ambiguous = 0;
  for (int face = 0; face < 6; ++face)
  {
    ambiguous |= FaceCrossings(facesOfCell[std::size_t(face)], mask).count == 4 ? 1 << face : 0;
  }
  return ambiguous;
}

/// The closed lines in which a contour cuts the faces of a cell: the edges that they cross, one line after the other.
struct CellLoops
{
  std::array<CellEdge, 12> edges;
  std::array<std::uint8_t, 12> ends; ///< per line, where the next one begins
  std::size_t count = 0;             ///< number of lines

  std::size_t allEdges() const { return count > 0 ? ends[count - 1] : 0; }

  /// A bit of `joined` says that the positive corners of an ambiguous face are connected.
  CellLoops(int mask, int joined)
  {
    // Per edge, the next edge of its line. Where a line enters the positive part of one face, it leaves that of another.
    std::array<CellEdge, edgeCount> next;
    std::array<CellEdge, 12> entries;
    std::size_t entryCount = 0;
    for (int face = 0; face < 6; ++face)
    {
      const FaceCrossings crossings(facesOfCell[std::size_t(face)], mask);
      const std::size_t step = ((joined >> face) & 1) != 0 ? crossings.count - 1 : 1;
      for (std::size_t i = 0; i < crossings.count; ++i)
      {
        if (crossings.enters[i])
        {
          // Around the positive corner that follows or, if positives are connected, around the negative one before.
          next[crossings.edges[i].index()] = crossings.edges[(i + step) % crossings.count];
          entries[entryCount++] = crossings.edges[i];
        }
      }
    }
    std::uint32_t done = 0;
    std::size_t edge = 0;
    for (std::size_t e = 0; e < entryCount; ++e)
    {
      const std::size_t first = edge;
      for (CellEdge at = entries[e]; (done & (1u << at.index())) == 0; at = next[at.index()])
      {
        done |= 1u << at.index();
        edges[edge++] = at;
      }
      if (edge > first)
      {
        ends[count++] = static_cast<std::uint8_t>(edge);
      }
    }
  }
};

/// Precomputed data for a set of positive corners.
struct CellCase
{
  int ambiguous;
  CellLoops loops; ///< if no face is ambiguous
  /// The edges of the loops, a bit each, that no earlier cell has, by the axes along which the cell is the block's first.
  std::array<std::uint16_t, cornerCount> fresh{};

  explicit CellCase(int mask)
    : ambiguous(ambiguousFaces(mask))
    , loops(mask, 0)
  {
    for (int first = 0; first < cornerCount; ++first)
    {
      for (std::size_t e = 0; e < this->loops.allEdges(); ++e)
      {
        const CellEdge& edge = this->loops.edges[e];
        const bool isFresh = (edge.from | edge.to | first) == cornerCount - 1;
        this->fresh[std::size_t(first)] |= static_cast<std::uint16_t>(isFresh ? 1 << e : 0);
      }
    }
  }
};

std::vector<CellCase> allCases()
{
  std::vector<CellCase> cases;
  cases.reserve(std::size_t(1) << cornerCount);
  for (int mask = 0; mask < 1 << cornerCount; ++mask)
  {
    cases.emplace_back(mask);
  }
  return cases;
}

/// Returns which of a row's values are positive, a bit each.
std::uint32_t positives(const float* row, int count)
{
  std::uint32_t bits = 0;
  int i = 0;
#ifdef __SSE__
  for (; i + 4 <= count; i += 4) // compilers do not vectorise the loop below like this
  {
    bits |= static_cast<std::uint32_t>(_mm_movemask_ps(_mm_cmpgt_ps(_mm_loadu_ps(row + i), _mm_setzero_ps()))) << i;
  }
#endif
  for (; i < count; ++i)
  {
    bits |= (row[i] > 0.0f ? 1u : 0u) << i;
  }
  return bits;
}

class Contourer
{
public:
  Contourer(const NodeLattice& lattice, std::size_t blocks)
    : Lattice(lattice)
    , Points(lattice, Surface)
  {
    this->Surface.mesh.points.reserve(blocks * pointsOfBlock);
    this->Surface.mesh.triangles.reserve(blocks * 2 * pointsOfBlock);
    const auto& planes = lattice.planes;
    Surface.box = Eigen::AlignedBox3d(Eigen::Vector3d(planes[0].front(), planes[1].front(), planes[2].front()),
      Eigen::Vector3d(planes[0].back(), planes[1].back(), planes[2].back()));
  }

  void addBlock(const NodeRange& range, const float* values)
  {
    this->Block = BlockValues(range, values);
    this->Points.begin(this->Block);
    this->findSigns();
    const auto& n = range.count;
    for (int k = 0; k + 1 < n[2]; ++k)
    {
      for (int j = 0; j + 1 < n[1]; ++j)
      {
        this->addRow(j, k);
      }
    }
  }

  CappedSurface take() { return std::move(this->Surface); }

private:
  /// Records the signs of the block's nodes, a bit each.
  void findSigns()
  {
    const auto& n = this->Block.range.count;
    for (int k = 0; k < n[2]; ++k)
    {
      for (int j = 0; j < n[1]; ++j)
      {
        this->Signs[std::size_t(k)][std::size_t(j)] = positives(this->Block.at({ { 0, j, k } }), n[0]);
      }
    }
  }
  std::uint32_t signs(int j, int k) const { return this->Signs[std::size_t(k)][std::size_t(j)]; }

  /// Returns the faces of the lattice at which a cell of the block ends: bit 2·axis, bit 2·axis + 1.
  int boundary(int axis, int cell) const
  {
    const int at = this->Block.range.first[std::size_t(axis)] + cell;
    return (at == 0 ? 1 << (2 * axis) : 0) | (at + 1 == this->Lattice.cells(axis) ? 2 << (2 * axis) : 0);
  }

  /// Adds the cells along x that begin at row (j, k) of the block.
  void addRow(int j, int k)
  {
    const int count = this->Block.range.count[0] - 1;
    // Bitwise along x: cells with a corner inside, and those with all corners inside.
    const std::uint32_t rows[4] = { this->signs(j, k), this->signs(j + 1, k), this->signs(j, k + 1), this->signs(j + 1, k + 1) };
    const std::uint32_t any = rows[0] | rows[1] | rows[2] | rows[3];
    const std::uint32_t every = rows[0] & rows[1] & rows[2] & rows[3];
    const std::uint32_t cells = (1u << count) - 1u;
    const int sidesOfRow = this->boundary(1, j) | this->boundary(2, k);
    std::uint32_t inside = 0;
    if (sidesOfRow == 0) // otherwise all of them have caps
    {
      inside = every & (every >> 1);
      inside &= ~((this->boundary(0, 0) != 0 ? 1u : 0u) | (this->boundary(0, count - 1) != 0 ? 1u << (count - 1) : 0u));
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

  void addCell(const LatticeNode& cell, int mask, int sides)
  {
    static const std::vector<CellCase> cases = allCases();
    const CellCase& now = cases[std::size_t(mask)];
    int joined = 0;
    for (int face = 0; (now.ambiguous >> face) != 0; ++face)
    {
      const bool isJoined = ((now.ambiguous >> face) & 1) != 0 && this->positivesMeet(cell, facesOfCell[std::size_t(face)], mask);
      joined |= isJoined ? 1 << face : 0;
    }
    for (int face = 0; (sides >> face) != 0; ++face)
    {
      if (((sides >> face) & 1) != 0)
      {
        this->addCaps(cell, facesOfCell[std::size_t(face)], mask, ((joined >> face) & 1) != 0);
      }
    }
    if (now.ambiguous != 0)
    {
      this->addLoops(cell, CellLoops(mask, joined), false);
      return;
    }
    const CellLoops& loops = now.loops;
    const int first = (cell[0] == 0 ? 1 : 0) | (cell[1] == 0 ? 2 : 0) | (cell[2] == 0 ? 4 : 0);
    for (unsigned left = sides == 0 ? now.fresh[std::size_t(first)] : 0; left != 0; left &= left - 1)
    {
      const CellEdge& edge = loops.edges[std::size_t(__builtin_ctz(left))];
      this->Points.add(cell, edge.from, edge.to);
    }
    this->addLoops(cell, loops, true);
  }

  void addLoops(const LatticeNode& cell, const CellLoops& loops, bool isPlain)
  {
    std::size_t edge = 0;
    for (std::size_t loop = 0; loop < loops.count; ++loop)
    {
      PointPolygon polygon;
      for (; edge < loops.ends[loop]; ++edge)
      {
        polygon.add(this->Points.between(cell, loops.edges[edge].from, loops.edges[edge].to));
      }
      isPlain ? cutByDiagonals(polygon, this->Surface.mesh) : cutAroundMiddle(polygon, this->Surface);
    }
  }

  /// Tells, for a face whose positive corners are opposite each other, whether they are connected by the saddle of the bilinear
  /// field.
  bool positivesMeet(const LatticeNode& cell, const std::array<int, 4>& corners, int mask) const
  {
    double positives = 1.0;
    double negatives = 1.0;
    for (const int corner : corners)
    {
      (((mask >> corner) & 1) != 0 ? positives : negatives) *= *this->Block.at(cornerOfCell(cell, corner));
    }
    return positives > negatives;
  }

  /// Adds the part of a face of the box in which the field is positive.
  void addCaps(const LatticeNode& cell, const std::array<int, 4>& corners, int mask, bool isJoined)
  {
    PointPolygon polygon;
    for (std::size_t i = 0; i < 4; ++i)
    {
      const int from = corners[i];
      const int to = corners[(i + 1) % 4];
      const bool isInside = ((mask >> from) & 1) != 0;
      if (isInside)
      {
        polygon.add(this->Points.between(cell, from, from));
      }
      if (isInside != (((mask >> to) & 1) != 0))
      {
        polygon.add(this->Points.between(cell, from, to));
      }
    }
    if (polygon.count == 0)
    {
      return;
    }
    const bool isAmbiguous = polygon.count == 6;
    if (!isAmbiguous || isJoined)
    {
      cutByDiagonals(polygon, this->Surface.mesh);
      return;
    }
    // Two corners: from the crossing before each to the one behind it.
    const std::size_t first = ((mask >> corners[0]) & 1) != 0 ? 5 : 0;
    for (std::size_t corner = 0; corner < 2; ++corner)
    {
      const std::size_t at = first + 3 * corner;
      const auto& all = polygon.corners;
      this->Surface.mesh.triangles.push_back({ { all[at % 6], all[(at + 1) % 6], all[(at + 2) % 6] } });
    }
  }

  const NodeLattice& Lattice;
  CappedSurface Surface;
  ContourPoints Points;
  BlockValues Block;
  std::array<std::array<std::uint32_t, NodeLattice::blockCells + 1>, NodeLattice::blockCells + 1> Signs; ///< see findSigns()
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
  Contourer contourer(lattice, blocks.size());
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
