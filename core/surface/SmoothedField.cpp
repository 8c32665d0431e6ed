// SPDX-License-Identifier: BSD-3-Clause
#include "surface/SmoothedField.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <utility>

#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace cactus
{

namespace
{

/// So many blocks in a row along the fibre are smoothed together, since they share the nodes around them; with more than so many
/// passes, which need many of these, cubes of so many along each edge are.
constexpr int blocksTogether = 4;
constexpr int fewPasses = 8;

/// Four floats as they lie in memory.
inline FourFloats fourAt(const float* from)
{
  FourFloats four;
  std::memcpy(&four, from, sizeof(four));
  return four;
}

/// Two floats from each of two places.
inline FourFloats twoAndTwo(const float* first, const float* second)
{
  // As doubles, of which compilers make two loads and nothing else.
  typedef double Pair __attribute__((vector_size(16)));
  double pairs[2];
  std::memcpy(&pairs[0], first, sizeof(double));
  std::memcpy(&pairs[1], second, sizeof(double));
  return reinterpret_cast<FourFloats>(Pair{ pairs[0], pairs[1] });
}

/// By place along an axis whose nodes are `step` apart: two and two nodes next to each other, `other` apart.
inline std::array<FourFloats, 4> rowsAt(const float* corner, std::ptrdiff_t step, std::ptrdiff_t other)
{
  const auto row = [&](std::ptrdiff_t at) { return twoAndTwo(corner + at * step, corner + at * step + other); };
  return { { row(-1), row(0), row(1), row(2) } };
}

inline std::array<FourFloats, 4> transposed(const std::array<FourFloats, 4>& rows)
{
  const FourFloats low01 = { rows[0][0], rows[1][0], rows[0][1], rows[1][1] };
  const FourFloats low23 = { rows[2][0], rows[3][0], rows[2][1], rows[3][1] };
  const FourFloats high01 = { rows[0][2], rows[1][2], rows[0][3], rows[1][3] };
  const FourFloats high23 = { rows[2][2], rows[3][2], rows[2][3], rows[3][3] };
  return { { FourFloats{ low01[0], low01[1], low23[0], low23[1] }, FourFloats{ low01[2], low01[3], low23[2], low23[3] },
    FourFloats{ high01[0], high01[1], high23[0], high23[1] }, FourFloats{ high01[2], high01[3], high23[2], high23[3] } } };
}

inline FourFloats lesser(const FourFloats& x, const FourFloats& y)
{
#ifdef __SSE__
  return _mm_min_ps(x, y); // which compilers do not make of the line below
#else
  return x < y ? x : y;
#endif
}

inline FourFloats larger(const FourFloats& x, const FourFloats& y)
{
#ifdef __SSE__
  return _mm_max_ps(x, y);
#else
  return x > y ? x : y;
#endif
}

/// agreedBend() (see mesh/ContourPoints.h) of four pairs of second differences.
inline FourFloats agreedBends(const FourFloats& first, const FourFloats& second)
{
  const FourFloats zero{};
  return larger(lesser(first, second), zero) + lesser(larger(first, second), zero);
}

/// One pass along one axis, whose nodes are `step` apart in memory. Values at the rim become wrong, and are not used.
void smoothAlong(std::size_t step, std::vector<float>& values, const std::vector<float>& before)
{
  for (std::size_t n = step; n + step < values.size(); ++n)
  {
    values[n] = 0.5f * before[n] + 0.25f * (before[n - step] + before[n + step]);
  }
}

/// Keeps only a part of what a pass has done, which may be another one at each node.
void keepPart(std::size_t step, std::vector<float>& values, const std::vector<float>& before, const std::vector<float>& part)
{
  for (std::size_t n = step; n + step < values.size(); ++n)
  {
    values[n] = (1.0f - part[n]) * before[n] + part[n] * values[n]; // with 1 the very same bits
  }
}

} // namespace

SmoothedField::SmoothedField(
  const FibreField& field, std::int32_t fibre, std::vector<std::uint32_t> blocks, int passes, const ThinFibres* thin)
  : Fibre(fibre)
  , Lattice(field.lattice())
  , Blocks(std::move(blocks))
  , FirstNode(field.firstNode())
  , NodesPerLength(1.0 / field.grid().spacing)
{
  for (const std::vector<Piece>& together : this->layOut(passes > fewPasses))
  {
    this->smooth(field, together, passes, thin);
  }
}

std::vector<std::vector<SmoothedField::Piece>> SmoothedField::layOut(bool inCubes)
{
  std::vector<Index> at;
  Index last{ { 0, 0, 0 } };
  for (const std::uint32_t block : this->Blocks)
  {
    const NodeRange range = nodesOfBlock(this->Lattice, block);
    Index index;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      index[axis] = range.first[axis] / NodeLattice::blockCells;
      this->First[axis] = at.empty() ? index[axis] : std::min(this->First[axis], index[axis]);
      last[axis] = at.empty() ? index[axis] : std::max(last[axis], index[axis]);
    }
    at.push_back(index);
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    this->Count[axis] = at.empty() ? 0 : last[axis] - this->First[axis] + 1;
    this->Cells[axis] = this->Lattice.cells(int(axis));
  }
  this->Places.assign(std::size_t(this->Count[0]) * std::size_t(this->Count[1]) * std::size_t(this->Count[2]), -1);
  const std::size_t longest = std::size_t(std::max_element(this->Count.begin(), this->Count.end()) - this->Count.begin());
  const auto edge = [&](std::size_t axis) { return inCubes || axis == longest ? blocksTogether : 1; };
  std::map<Index, std::vector<Piece>> groups;
  std::ptrdiff_t place = 0;
  for (std::size_t b = 0; b < at.size(); ++b)
  {
    const Piece piece{ nodesOfBlock(this->Lattice, this->Blocks[b]).widened(1), place };
    groups[{ { at[b][0] / edge(0), at[b][1] / edge(1), at[b][2] / edge(2) } }].push_back(piece);
    this->Places[std::size_t(this->placeOf(at[b]))] = place;
    place += std::ptrdiff_t(piece.range.size());
  }
  this->Values.resize(std::size_t(place));
  this->Unsmoothed.resize(std::size_t(place));
  std::vector<std::vector<Piece>> result;
  result.reserve(groups.size());
  for (auto& group : groups)
  {
    result.push_back(std::move(group.second));
  }
  return result;
}

void SmoothedField::smooth(const FibreField& field, const std::vector<Piece>& pieces, int passes, const ThinFibres* thin)
{
  // How much of a pass the outermost nodes get is not known right (see ThinFibres::smoothingAt()).
  const int reach = passes > fewPasses ? passes + 1 : passes;
  NodeRange range;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    int first = std::numeric_limits<int>::max();
    int end = std::numeric_limits<int>::min();
    for (const Piece& piece : pieces)
    {
      first = std::min(first, piece.range.first[axis]);
      end = std::max(end, piece.range.first[axis] + piece.range.count[axis]);
    }
    range.first[axis] = first - reach;
    range.count[axis] = end - first + 2 * reach;
  }
  std::vector<float> buffer(range.size());
  thread_local LabelBuffer samples;
  const LabelImageView held = field.samplesFor(range, samples);
  field.atNodes(this->Fibre, range, held, buffer.data());
  copyPieces(buffer, range, pieces, this->Unsmoothed);
  std::vector<float> part(thin != nullptr && passes > 0 ? range.size() : 0);
  const bool isUniform = part.empty() || !thin->smoothingAt(range, held, part.data());
  // Each pass leaves one node less on every side. Strides stay.
  const std::size_t rowLength(range.count[0]);
  std::vector<float> before(range.size());
  for (int pass = 0; pass < passes; ++pass)
  {
    for (const std::size_t step : { std::size_t(1), rowLength, rowLength * std::size_t(range.count[1]) })
    {
      before.swap(buffer);
      smoothAlong(step, buffer, before);
      if (!isUniform)
      {
        keepPart(step, buffer, before, part);
      }
    }
  }
  copyPieces(buffer, range, pieces, this->Values);
}

void SmoothedField::copyPieces(
  const std::vector<float>& from, const NodeRange& range, const std::vector<Piece>& pieces, std::vector<float>& to)
{
  for (const Piece& piece : pieces)
  {
    float* out = to.data() + piece.place;
    for (int k = 0; k < piece.range.count[2]; ++k)
    {
      for (int j = 0; j < piece.range.count[1]; ++j)
      {
        const float* row =
          from.data() + std::size_t(piece.range.first[0] - range.first[0]) +
          std::size_t(range.count[0]) * (std::size_t(piece.range.first[1] - range.first[1] + j) +
                                          std::size_t(range.count[1]) * std::size_t(piece.range.first[2] - range.first[2] + k));
        out = std::copy(row, row + piece.range.count[0], out);
      }
    }
  }
}

std::ptrdiff_t SmoothedField::placeOf(const Index& block) const
{
  std::ptrdiff_t place = 0;
  for (std::size_t axis = 3; axis-- > 0;)
  {
    const int along = block[axis] - this->First[axis];
    if (along < 0 || along >= this->Count[axis])
    {
      return -1;
    }
    place = place * this->Count[axis] + along;
  }
  return place;
}

void SmoothedField::values(double level, double smallest, const NodeRange& around, float* out) const
{
  this->copyBlock(this->Values, level, smallest, around, out);
}

void SmoothedField::unsmoothedValues(double smallest, const NodeRange& around, float* out) const
{
  this->copyBlock(this->Unsmoothed, 0.0, smallest, around, out);
}

void SmoothedField::copyBlock(
  const std::vector<float>& held, double level, double smallest, const NodeRange& around, float* out) const
{
  Index block;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    block[axis] = (around.first[axis] + 1) / NodeLattice::blockCells;
  }
  const float* in = held.data() + this->Places[std::size_t(this->placeOf(block))];
  const auto t = static_cast<float>(level);
  const auto least = static_cast<float>(smallest);
  for (std::size_t n = 0; n < around.size(); ++n)
  {
    const float field = in[n] - t;
    out[n] = field > 0.0f ? std::max(field, least) : std::min(field, -least);
  }
}

inline SmoothedField::Place SmoothedField::placeAt(const Eigen::Vector3d& at) const
{
  const Eigen::Vector3d nodes = (at - this->FirstNode) * this->NodesPerLength;
  Place place;
  Index block;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const int last = this->Cells[axis] - 1; // the last node that is a sample
    const double inside = std::clamp(nodes[Eigen::Index(axis)], 1.0, double(last));
    place.cell[axis] = std::min(static_cast<int>(inside), std::max(1, last - 1));
    place.t[axis] = inside - place.cell[axis];
    block[axis] = place.cell[axis] / NodeLattice::blockCells;
  }
  const std::ptrdiff_t index = this->placeOf(block);
  place.corner = nullptr;
  if (index < 0 || this->Places[std::size_t(index)] < 0)
  {
    return place;
  }
  std::ptrdiff_t step = 1;
  place.corner = this->Values.data() + this->Places[std::size_t(index)];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const int first = block[axis] * NodeLattice::blockCells;
    place.stride[axis] = step;
    place.corner += step * (place.cell[axis] - first + 1);
    step *= std::min(NodeLattice::blockCells, this->Cells[axis] - first) + 3;
  }
  return place;
}

double SmoothedField::value(const Eigen::Vector3d& at) const
{
  const Place place = this->placeAt(at);
  if (place.corner == nullptr)
  {
    return -std::numeric_limits<double>::infinity();
  }
  const float* corner = place.corner;
  const std::ptrdiff_t y = place.stride[1];
  const std::ptrdiff_t z = place.stride[2];
  const auto& t = place.t;
  const float a[2] = { float(1.0 - t[0]), float(t[0]) };
  const float b[2] = { float(1.0 - t[1]), float(t[1]) };
  const float c[2] = { float(1.0 - t[2]), float(t[2]) };
  // Of the cell's four edges along an axis, the nodes before them, at their ends, and behind them. Memory holds what is beyond
  // the samples, too.
  std::array<FourFloats, 4> along =
    transposed({ { fourAt(corner - 1), fourAt(corner - 1 + y), fourAt(corner - 1 + z), fourAt(corner - 1 + y + z) } });
  const FourFloats weightX = FourFloats{ b[0], b[1], b[0], b[1] } * FourFloats{ c[0], c[0], c[1], c[1] };
  FourFloats sum = weightX * (a[0] * along[1] + a[1] * along[2]);
  sum -= (0.5f * a[0] * a[1]) * (weightX * this->bends(along, place.cell[0], 0));
  const FourFloats weightY = FourFloats{ a[0], a[1], a[0], a[1] } * FourFloats{ c[0], c[0], c[1], c[1] };
  along = rowsAt(corner, y, z);
  const FourFloats part = (0.5f * b[0] * b[1]) * (weightY * this->bends(along, place.cell[1], 1));
  sum -= FourFloats{ part[0], part[2], part[1], part[3] };
  const FourFloats weightZ = FourFloats{ a[0], a[1], a[0], a[1] } * FourFloats{ b[0], b[0], b[1], b[1] };
  along = rowsAt(corner, z, y);
  sum -= (0.5f * c[0] * c[1]) * (weightZ * this->bends(along, place.cell[2], 2));
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/// The bends along the edges of a cell, of which one side alone tells where samples end, and 0 where they end on both.
inline FourFloats SmoothedField::bends(const std::array<FourFloats, 4>& along, int cell, std::size_t axis) const
{
  const FourFloats before = along[0] - 2.0f * along[1] + along[2];
  const FourFloats behind = along[1] - 2.0f * along[2] + along[3];
  const bool isFirst = cell <= 1;
  const bool isLast = cell + 3 > this->Cells[axis];
  if (isFirst || isLast)
  {
    return isFirst && isLast ? FourFloats{} : isFirst ? behind : before;
  }
  return agreedBends(before, behind);
}

} // namespace cactus
