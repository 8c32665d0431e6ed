// SPDX-License-Identifier: BSD-3-Clause
#include "surface/SmoothedField.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
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

/// Edge, in blocks, of the boxes that are smoothed together, since blocks share the nodes around them. It is shorter along the
/// fibre, so that the box around the fibre is narrow, unless many passes need many nodes.
constexpr int blocksTogether = 4;
constexpr int blocksAlongFibre = 2;
constexpr int fewPasses = 8;
/// Nodes beyond those inside a fibre at which the field counts: contours and value() read up to two nodes away from the surface.
constexpr int nodesBeside = 3;
static_assert(nodesBeside + 1 <= NearBlocks::around, "a block is held with a node beyond");
/// The field elsewhere, µm: so low that no other field can compensate it.
constexpr float farOutside = -1e6f;

/// Smooths once along one axis, whose nodes are `step` apart in memory. If `part` is given, it is the fraction of the smoothing
/// that is applied at each node. The first and the last `step` of `size` nodes are left out.
void smoothAlong(std::size_t step, std::size_t size, const float* before, const float* part, float* values)
{
  for (std::size_t n = step; n + step < size; ++n)
  {
    const float whole = 0.5f * before[n] + 0.25f * (before[n - step] + before[n + step]);
    values[n] = part == nullptr ? whole : (1.0f - part[n]) * before[n] + part[n] * whole;
  }
}

/// Loads four floats from memory.
inline FourFloats fourAt(const float* from)
{
  FourFloats four;
  std::memcpy(&four, from, sizeof(four));
  return four;
}

/// Loads two floats from each of two places.
inline FourFloats twoAndTwo(const float* first, const float* second)
{
  // As doubles, which compilers turn into just two loads.
  typedef double Pair __attribute__((vector_size(16)));
  double pairs[2];
  std::memcpy(&pairs[0], first, sizeof(double));
  std::memcpy(&pairs[1], second, sizeof(double));
  return reinterpret_cast<FourFloats>(Pair{ pairs[0], pairs[1] });
}

/// Loads, for four places along an axis whose nodes are `step` apart, two pairs of neighbouring nodes, `other` apart.
inline std::array<FourFloats, 4> rowsAt(const float* corner, std::ptrdiff_t step, std::ptrdiff_t other)
{
  const auto row = [&](std::ptrdiff_t at) { return twoAndTwo(corner + at * step, corner + at * step + other); };
  return { { row(-1), row(0), row(1), row(2) } };
}

inline std::array<FourFloats, 4> transposed(const std::array<FourFloats, 4>& rows)
{
  const FourFloats low01 = __builtin_shufflevector(rows[0], rows[1], 0, 4, 1, 5);
  const FourFloats low23 = __builtin_shufflevector(rows[2], rows[3], 0, 4, 1, 5);
  const FourFloats high01 = __builtin_shufflevector(rows[0], rows[1], 2, 6, 3, 7);
  const FourFloats high23 = __builtin_shufflevector(rows[2], rows[3], 2, 6, 3, 7);
  return { { __builtin_shufflevector(low01, low23, 0, 1, 4, 5), __builtin_shufflevector(low01, low23, 2, 3, 6, 7),
    __builtin_shufflevector(high01, high23, 0, 1, 4, 5), __builtin_shufflevector(high01, high23, 2, 3, 6, 7) } };
}

inline FourFloats lesser(const FourFloats& x, const FourFloats& y)
{
#ifdef __SSE__
  return _mm_min_ps(x, y); // compilers do not generate this from the line below
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

/// Returns a block's place along each axis.
std::array<int, 3> indexOf(const NodeLattice& lattice, std::size_t block)
{
  const NodeRange range = nodesOfBlock(lattice, block);
  constexpr int size = NodeLattice::blockCells;
  return { { range.first[0] / size, range.first[1] / size, range.first[2] / size } };
}

/// Returns the box of the nodes at which the values of a range are above 0, in a part of it.
NodeRange insideOf(const std::vector<float>& values, const NodeRange& range, const NodeRange& part)
{
  NodeRange inside;
  for (int k = part.first[2]; k < part.first[2] + part.count[2]; ++k)
  {
    for (int j = part.first[1]; j < part.first[1] + part.count[1]; ++j)
    {
      const float* row = values.data() + range.index(part.first[0], j, k);
      int found = 0; // most rows are outside the fibre
      for (int i = 0; i < part.count[0]; ++i)
      {
        found |= int(row[i] > 0.0f);
      }
      if (found != 0)
      {
        const auto isInside = [](float value) { return value > 0.0f; };
        const float* end = row + part.count[0];
        const auto first = int(std::find_if(row, end, isInside) - row);
        const auto behind =
          int(std::find_if(std::make_reverse_iterator(end), std::make_reverse_iterator(row), isInside).base() - row);
        inside = inside.joined({ { { part.first[0] + first, j, k } }, { { behind - first, 1, 1 } } });
      }
    }
  }
  return inside;
}

/// Returns agreedBend() (see mesh/ContourPoints.h) of four pairs of second differences.
inline FourFloats agreedBends(const FourFloats& first, const FourFloats& second)
{
  const FourFloats zero{};
  return larger(lesser(first, second), zero) + lesser(larger(first, second), zero);
}

} // namespace

SmoothedField::SmoothedField(const FibreField& field, std::int32_t fibre, NearBlocks blocks, int passes, const ThinFibres* thin)
  : Fibre(fibre)
  , Lattice(field.lattice())
  , Repeats(field.samples().repeats)
  , Blocks(std::move(blocks.numbers))
  , FirstNode(field.firstNode())
  , NodesPerLength(1.0 / field.grid().spacing)
{
  for (const std::vector<Piece>& together : this->layOut(blocks.inside, passes > fewPasses))
  {
    this->smooth(field, together, passes, thin);
  }
  const auto isLeftOut = [&](std::uint32_t block) { return this->placeOf(indexOf(this->Lattice, block))->values == nullptr; };
  this->Blocks.erase(std::remove_if(this->Blocks.begin(), this->Blocks.end(), isLeftOut), this->Blocks.end());
}

std::vector<std::vector<SmoothedField::Piece>> SmoothedField::layOut(const std::vector<NodeRange>& inside, bool inCubes)
{
  std::vector<Index> at;
  Index last{ { 0, 0, 0 } };
  for (const std::uint32_t block : this->Blocks)
  {
    const Index index = indexOf(this->Lattice, block);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      this->First[axis] = at.empty() ? index[axis] : std::min(this->First[axis], index[axis]);
      last[axis] = at.empty() ? index[axis] : std::max(last[axis], index[axis]);
    }
    at.push_back(index);
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    this->Count[axis] = at.empty() ? 0 : last[axis] - this->First[axis] + 1;
    this->Cells[axis] = this->Lattice.cells(int(axis));
    this->LastSample[axis] = this->Cells[axis] - (this->Repeats[axis] ? 0.5 : 1.0);
    this->LastCell[axis] = std::max(1, this->Cells[axis] - (this->Repeats[axis] ? 1 : 2));
  }
  this->Places.assign(std::size_t(this->Count[0]) * std::size_t(this->Count[1]) * std::size_t(this->Count[2]), BlockPlace());
  const std::size_t longest = std::size_t(std::max_element(this->Count.begin(), this->Count.end()) - this->Count.begin());
  const auto edge = [&](std::size_t axis) { return inCubes || axis != longest ? blocksTogether : blocksAlongFibre; };
  std::map<Index, std::vector<Piece>> groups;
  for (std::size_t b = 0; b < at.size(); ++b)
  {
    BlockPlace& place = this->Places[std::size_t(this->placeOf(at[b]) - this->Places.data())];
    const Piece piece{ nodesOfBlock(this->Lattice, this->Blocks[b]).widened(1), inside[b], &place };
    groups[{ { at[b][0] / edge(0), at[b][1] / edge(1), at[b][2] / edge(2) } }].push_back(piece);
  }
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
  // One node more, since the fraction of a pass at the outermost ones is inaccurate (see ThinFibres::smoothingAt()).
  const int reach = passes > 0 ? passes + 1 : 0;
  NodeRange whole;
  NodeRange inside;
  for (const Piece& piece : pieces)
  {
    whole = whole.joined(piece.range);
    inside = inside.joined(piece.inside);
  }
  // Smooths only beside the fibre.
  const auto besideIn = [](const NodeRange& within, const NodeRange& fibre)
  { return fibre.size() > 0 ? fibre.widened(nodesBeside).within(within) : fibre; };
  const NodeRange atMost = besideIn(whole, inside);
  if (atMost.size() == 0)
  {
    return;
  }
  const NodeRange range = atMost.widened(reach);
  LabelBuffer samples;
  const LabelImageView held = field.samplesFor(range, samples);
  std::vector<float> buffer(range.size());
  std::vector<float> before(range.size());
  std::vector<float> part(range.size());
  field.atNodes(this->Fibre, range, held, buffer.data());
  const std::vector<Piece> near = this->place(pieces, std::min(passes, nodesBeside + 1), buffer, range);
  whole = {};
  for (const Piece& piece : near)
  {
    whole = whole.joined(piece.range);
  }
  // A box around all nodes inside may be wider than the correct values.
  const NodeRange beside = besideIn(whole, insideOf(buffer, range, whole.widened(reach).within(range))).within(atMost);
  copyPieces(buffer, range, beside, near, &BlockPlace::unsmoothed);
  const bool isUniform = thin == nullptr || passes == 0 || !thin->smoothingAt(range, held, part.data());
  // Each pass leaves one node less on every side: values at the rim become wrong, and are not used. Strides stay.
  const std::size_t rowLength(range.count[0]);
  for (int pass = 0; pass < passes; ++pass)
  {
    for (const std::size_t step : { std::size_t(1), rowLength, rowLength * std::size_t(range.count[1]) })
    {
      before.swap(buffer);
      smoothAlong(step, range.size(), before.data(), isUniform ? nullptr : part.data(), buffer.data());
    }
  }
  copyPieces(buffer, range, beside, near, &BlockPlace::values);
}

/// Allocates those that have nodes inside the fibre, or at most `reach` away from one.
std::vector<SmoothedField::Piece> SmoothedField::place(
  const std::vector<Piece>& pieces, int reach, const std::vector<float>& values, const NodeRange& range)
{
  std::vector<Piece> near;
  std::size_t nodes = 0;
  for (const Piece& piece : pieces)
  {
    // A piece has a node more than its block.
    if (insideOf(values, range, piece.range.widened(reach - 1).within(range)).size() > 0)
    {
      nodes += piece.range.size();
      near.push_back(piece);
    }
  }
  // Not initialised: copyPieces() fills it.
  float* room = this->Values.emplace_back(new float[2 * nodes]).get();
  for (const Piece& piece : near)
  {
    const std::size_t size = piece.range.size();
    *piece.place = { room, room + size, { { piece.range.count[0], piece.range.count[0] * piece.range.count[1] } } };
    room += 2 * size;
  }
  return near;
}

void SmoothedField::copyPieces(const std::vector<float>& from, const NodeRange& range, const NodeRange& known,
  const std::vector<Piece>& pieces, float* BlockPlace::*to)
{
  for (const Piece& piece : pieces)
  {
    std::fill_n(piece.place->*to, piece.range.size(), farOutside);
    const NodeRange common = piece.range.within(known);
    if (common.size() == 0)
    {
      continue;
    }
    for (int k = common.first[2]; k < common.first[2] + common.count[2]; ++k)
    {
      for (int j = common.first[1]; j < common.first[1] + common.count[1]; ++j)
      {
        const auto rowIn = [&](const NodeRange& of) { return of.index(common.first[0], j, k); };
        std::copy_n(from.data() + rowIn(range), common.count[0], piece.place->*to + rowIn(piece.range));
      }
    }
  }
}

inline const SmoothedField::BlockPlace* SmoothedField::placeOf(const Index& block) const
{
  std::size_t place = 0;
  for (std::size_t axis = 3; axis-- > 0;)
  {
    const auto along = static_cast<unsigned>(block[axis] - this->First[axis]);
    const auto count = static_cast<unsigned>(this->Count[axis]);
    if (along >= count)
    {
      return nullptr;
    }
    place = place * count + along;
  }
  return &this->Places[place];
}

void SmoothedField::values(double level, double smallest, const NodeRange& around, float* out) const
{
  this->copyBlock(&BlockPlace::values, level, smallest, around, out);
}

void SmoothedField::unsmoothedValues(double smallest, const NodeRange& around, float* out) const
{
  this->copyBlock(&BlockPlace::unsmoothed, 0.0, smallest, around, out);
}

Eigen::Vector3d SmoothedField::sampleAt(const std::array<int, 3>& node) const
{
  Eigen::Vector3d nodes;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const int samples = this->Cells[axis] - 1;
    const int sample = this->Repeats[axis] ? ((node[axis] - 1) % samples + samples) % samples
                                           : std::clamp(node[axis] - 1, 0, std::max(0, samples - 1));
    nodes[Eigen::Index(axis)] = sample + 1.0;
  }
  return this->FirstNode + nodes / this->NodesPerLength;
}

SmoothedField SmoothedField::lowered(const NodeNumbers& by) const
{
  SmoothedField result = *this;
  result.Values.clear();
  for (std::size_t b = 0; b < this->Blocks.size(); ++b)
  {
    BlockPlace& place = result.Places[std::size_t(this->placeOf(indexOf(this->Lattice, this->Blocks[b])) - this->Places.data())];
    const std::size_t size = by[b].size();
    float* room = result.Values.emplace_back(new float[2 * size]).get();
    const auto lower = [&](float*& held, float* to)
    {
      for (std::size_t n = 0; n < size; ++n)
      {
        to[n] = held[n] > farOutside ? held[n] - by[b][n] : held[n];
      }
      held = to;
    };
    lower(place.values, room);
    lower(place.unsmoothed, room + size);
  }
  return result;
}

void SmoothedField::copyBlock(float* BlockPlace::*held, double level, double smallest, const NodeRange& around, float* out) const
{
  Index block;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    block[axis] = (around.first[axis] + 1) / NodeLattice::blockCells;
  }
  const float* in = this->placeOf(block)->*held;
  if (this->Repeats[0])
  {
    std::copy_n(in, around.size(), out);
    this->meanOnFaces(around, out);
    in = out;
  }
  const auto t = static_cast<float>(level);
  const auto least = static_cast<float>(smallest);
  for (std::size_t n = 0; n < around.size(); ++n)
  {
    const float field = in[n] - t;
    const float kept = std::max(std::abs(field), least);
    out[n] = field > 0.0f ? kept : -kept;
  }
}

/// Where samples repeat, gives the nodes on faces, which are half a voxel from samples on both sides, the mean of these.
void SmoothedField::meanOnFaces(const NodeRange& around, float* values) const
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (const int face : { 0, this->Cells[axis] })
    {
      const int inside = face == 0 ? 1 : face - 1;
      const int last = around.first[axis] + around.count[axis] - 1;
      if (!this->Repeats[axis] || face < around.first[axis] || face > last || inside < around.first[axis] || inside > last)
      {
        continue;
      }
      NodeRange plane = around;
      plane.first[axis] = face;
      plane.count[axis] = 1;
      const std::ptrdiff_t step = (inside - face) * (axis == 0    ? 1
                                                      : axis == 1 ? around.count[0]
                                                                  : around.count[0] * around.count[1]);
      for (int k = plane.first[2]; k < plane.first[2] + plane.count[2]; ++k)
      {
        for (int j = plane.first[1]; j < plane.first[1] + plane.count[1]; ++j)
        {
          for (int i = plane.first[0]; i < plane.first[0] + plane.count[0]; ++i)
          {
            float* value = values + around.index(i, j, k);
            *value = 0.5f * (*value + value[step]);
          }
        }
      }
    }
  }
}

inline SmoothedField::CellPlace SmoothedField::placeAt(const Eigen::Vector3d& at) const
{
  constexpr int blockCells = NodeLattice::blockCells;
  static_assert((blockCells & (blockCells - 1)) == 0);
  CellPlace place{};
  Index block;
  std::array<float, 3> t;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto a = Eigen::Index(axis);
    const double node = (at[a] - this->FirstNode[a]) * this->NodesPerLength;
    const double inside = std::max(std::min(node, this->LastSample[axis]), this->Repeats[axis] ? 0.5 : 1.0);
    place.cell[axis] = std::min(static_cast<int>(inside), this->LastCell[axis]);
    t[axis] = static_cast<float>(inside - place.cell[axis]);
    block[axis] = static_cast<int>(static_cast<unsigned>(place.cell[axis]) / blockCells);
  }
  place.t = FourFloats{ t[0], t[1], t[2], 0.0f };
  const BlockPlace* held = this->placeOf(block);
  if (held != nullptr && held->values != nullptr)
  {
    const auto nodeOf = [&](std::size_t axis) { return std::ptrdiff_t(place.cell[axis] & (blockCells - 1)) + 1; };
    place.stride = held->stride;
    place.corner = held->values + nodeOf(0) + nodeOf(1) * held->stride[0] + nodeOf(2) * held->stride[1];
  }
  return place;
}

double SmoothedField::value(const Eigen::Vector3d& at) const
{
  const CellPlace place = this->placeAt(at);
  if (place.corner == nullptr)
  {
    return -std::numeric_limits<double>::infinity();
  }
  const float* corner = place.corner;
  const std::ptrdiff_t y = place.stride[0];
  const std::ptrdiff_t z = place.stride[1];
  const FourFloats t = place.t;
  const FourFloats u = 1.0f - t;
  const FourFloats half = 0.5f * u * t;
  // The weights of both ends of the cell along each axis, alternating or doubled, and from them those of its edges.
  const FourFloats endsXY = __builtin_shufflevector(u, t, 0, 4, 1, 5);
  const FourFloats endsZ = __builtin_shufflevector(u, t, 2, 2, 6, 6);
  const FourFloats endsX = __builtin_shufflevector(endsXY, endsXY, 0, 1, 0, 1);
  const FourFloats weightX = __builtin_shufflevector(endsXY, endsXY, 2, 3, 2, 3) * endsZ;
  const FourFloats weightY = endsX * endsZ;
  const FourFloats weightZ = endsX * __builtin_shufflevector(endsXY, endsXY, 2, 2, 3, 3);
  // For the cell's four edges along an axis, the nodes before them, at their ends, and behind them. Memory extends beyond the
  // samples.
  std::array<FourFloats, 4> along =
    transposed({ { fourAt(corner - 1), fourAt(corner - 1 + y), fourAt(corner - 1 + z), fourAt(corner - 1 + y + z) } });
  FourFloats sum = weightX * (u[0] * along[1] + t[0] * along[2] - half[0] * this->bends(along, place.cell[0], 0));
  along = rowsAt(corner, y, z);
  sum -= half[1] * (weightY * this->bends(along, place.cell[1], 1));
  along = rowsAt(corner, z, y);
  sum -= half[2] * (weightZ * this->bends(along, place.cell[2], 2));
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/// Returns the bends along the edges of a cell: from one side only where samples end, and 0 where they end on both.
inline FourFloats SmoothedField::bends(const std::array<FourFloats, 4>& along, int cell, std::size_t axis) const
{
  const FourFloats before = along[0] - 2.0f * along[1] + along[2];
  const FourFloats behind = along[1] - 2.0f * along[2] + along[3];
  const bool isFirst = cell <= 1 && !this->Repeats[axis];
  const bool isLast = cell + 3 > this->Cells[axis] && !this->Repeats[axis];
  if (isFirst || isLast)
  {
    return isFirst && isLast ? FourFloats{} : isFirst ? behind : before;
  }
  return agreedBends(before, behind);
}

} // namespace cactus
