// SPDX-License-Identifier: BSD-3-Clause
#include "surface/SmoothedField.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace cactus
{

namespace
{

/// Up to so many passes each block is smoothed by itself; with more, cubes of so many blocks along each edge are, since blocks
/// that are smoothed together share the nodes around them, of which many passes need many.
constexpr int fewPasses = 8;
constexpr int blocksTogether = 4;

typedef float Four __attribute__((vector_size(16)));

/// agreedBend() (see mesh/ContourPoints.h) of four pairs of second differences.
inline Four agreedBends(const Four& first, const Four& second)
{
  const Four zero{};
  const Four lower = first < second ? first : second;
  const Four upper = first < second ? second : first;
  return lower > zero ? lower : upper < zero ? upper : zero;
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
  for (const std::vector<Piece>& together : this->layOut(passes > fewPasses ? blocksTogether : 1))
  {
    this->smooth(field, together, passes, thin);
  }
}

std::vector<std::vector<SmoothedField::Piece>> SmoothedField::layOut(int edge)
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
  std::map<Index, std::vector<Piece>> groups;
  std::ptrdiff_t place = 0;
  for (std::size_t b = 0; b < at.size(); ++b)
  {
    const Piece piece{ nodesOfBlock(this->Lattice, this->Blocks[b]).widened(1), place };
    groups[{ { at[b][0] / edge, at[b][1] / edge, at[b][2] / edge } }].push_back(piece);
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
  field.atNodes(this->Fibre, range, buffer.data());
  copyPieces(buffer, range, pieces, this->Unsmoothed);
  std::vector<float> part(thin != nullptr && passes > 0 ? range.size() : 0);
  const bool isUniform = part.empty() || !thin->smoothingAt(range, part.data());
  // Each pass leaves one node less on every side. Strides stay.
  const std::size_t rowLength(range.count[0]);
  std::vector<float> before;
  for (int pass = 0; pass < passes; ++pass)
  {
    for (const std::size_t step : { std::size_t(1), rowLength, rowLength * std::size_t(range.count[1]) })
    {
      before = buffer;
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
  const auto& t = place.t;
  const float weights[3][2] = { { float(1.0 - t[0]), float(t[0]) }, { float(1.0 - t[1]), float(t[1]) },
    { float(1.0 - t[2]), float(t[2]) } };
  Four sum{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    // The four edges of the cell along this axis, with a node before and behind, and their weights.
    const std::size_t one = (axis + 1) % 3;
    const std::size_t other = (axis + 2) % 3;
    const float* line = place.corner;
    const std::ptrdiff_t along = place.stride[axis];
    const std::ptrdiff_t lines[4] = { 0, place.stride[one], place.stride[other], place.stride[one] + place.stride[other] };
    const auto nodes4 = [&](std::ptrdiff_t at)
    {
      const Four v = { line[at + lines[0]], line[at + lines[1]], line[at + lines[2]], line[at + lines[3]] };
      return v;
    };
    const float* a = weights[one];
    const float* b = weights[other];
    const Four weight = { a[0] * b[0], a[1] * b[0], a[0] * b[1], a[1] * b[1] };
    const Four v1 = nodes4(0);
    const Four v2 = nodes4(along);
    if (axis == 0)
    {
      sum += weight * (weights[0][0] * v1 + weights[0][1] * v2);
    }
    const bool before = place.cell[axis] > 1;
    const bool behind = place.cell[axis] + 3 <= this->Cells[axis];
    if (!before && !behind)
    {
      continue;
    }
    const Four first = before ? nodes4(-along) - 2.0f * v1 + v2 : v1 - 2.0f * v2 + nodes4(2 * along);
    const Four second = behind && before ? v1 - 2.0f * v2 + nodes4(2 * along) : first;
    sum -= (0.5f * weights[axis][0] * weights[axis][1]) * (weight * agreedBends(first, second));
  }
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

} // namespace cactus
