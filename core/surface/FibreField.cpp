// SPDX-License-Identifier: BSD-3-Clause
#include "surface/FibreField.h"

#include "base/Error.h"
#include "base/Parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace cactus
{

namespace
{

/// A sample nearer to a face than this part of a voxel is left out: the cells between them would be too flat.
constexpr double thinnestCell = 0.3;

/// Radii, in voxels, up to which smoothing spares a fibre altogether and from which on it does not.
constexpr double sparedRadius = 2.0;
constexpr double smoothedRadius = 4.0;

/// Up to so many passes each block is smoothed by itself; with more, cubes of so many blocks along each edge are.
constexpr int fewPasses = 8;
constexpr int blocksTogether = 4;

typedef float Four __attribute__((vector_size(16)));

/// From a sample to one of the 26 around it.
struct Direction
{
  int i;
  int j;
  int k;
  int distance; ///< along how many axes
  float length; ///< in voxels
};

/// The nearest ones first.
std::array<Direction, 26> neighbourDirections()
{
  std::array<Direction, 26> directions;
  std::size_t count = 0;
  for (int distance = 1; distance <= 3; ++distance)
  {
    for (int n = 0; n < 27; ++n)
    {
      const Direction d{ n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1, distance, static_cast<float>(std::sqrt(double(distance))) };
      if (std::abs(d.i) + std::abs(d.j) + std::abs(d.k) == distance)
      {
        directions[count++] = d;
      }
    }
  }
  return directions;
}

} // namespace

FibreField::FibreField(const LabelImageView& image, const Domain& domain, bool clipToDomain)
  : Image(image)
{
  const VoxelGrid& grid = image.grid;
  const double h = grid.spacing;
  if (!(h > 0.0) || !std::isfinite(h) || !grid.origin.allFinite() || grid.count[0] < 1 || grid.count[1] < 1 ||
      grid.count[2] < 1 || image.fibreId == nullptr || image.depth == nullptr)
  {
    throw InvalidInput("the label image is empty or has no valid spacing");
  }
  if (!(image.gap >= 0.0) || !std::isfinite(image.gap))
  {
    throw InvalidInput("the gap between the fibres of the label image must be 0 or more");
  }
  const Eigen::Vector3d firstSample = grid.position(grid.lower[0], grid.lower[1], grid.lower[2]);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto a = Eigen::Index(axis);
    const double imageLower = firstSample[a] - 0.5 * h;
    const double imageUpper = imageLower + h * grid.count[axis];
    Box.lower[a] = clipToDomain ? std::max(domain.lower[a], imageLower) : imageLower;
    Box.upper[a] = clipToDomain ? std::min(domain.upper[a], imageUpper) : imageUpper;
    // Where image and domain end together, they may differ by rounding.
    if (clipToDomain && std::abs(imageLower - domain.lower[a]) < 1e-6 * h)
    {
      Box.lower[a] = domain.lower[a];
    }
    if (clipToDomain && std::abs(imageUpper - domain.upper[a]) < 1e-6 * h)
    {
      Box.upper[a] = domain.upper[a];
    }
    const int from = std::max(0, static_cast<int>(std::ceil((Box.lower[a] + thinnestCell * h - firstSample[a]) / h)));
    const int to =
      std::min(grid.count[axis] - 1, static_cast<int>(std::floor((Box.upper[a] - thinnestCell * h - firstSample[a]) / h)));
    if (!(Box.upper[a] > Box.lower[a]) || from > to)
    {
      throw InvalidInput("the label image does not reach into its Domain along axis " + std::to_string(axis) +
                         ": give the image of this domain, or switch ClipToDomain off");
    }
    First[axis] = grid.lower[axis] + from;
    Count[axis] = to - from + 1;
  }
}

NodeLattice FibreField::lattice(double inset) const
{
  const VoxelGrid& grid = this->Image.grid;
  if (!(inset >= 0.0) || inset > 0.25 * grid.spacing)
  {
    throw InvalidInput("the inset of caps must lie between 0 and a quarter of a voxel");
  }
  NodeLattice lattice;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto a = Eigen::Index(axis);
    auto& planes = lattice.planes[axis];
    planes.reserve(std::size_t(this->Count[axis]) + 2);
    planes.push_back(this->Box.lower[a] + inset);
    for (int i = 0; i < this->Count[axis]; ++i)
    {
      planes.push_back(grid.origin[a] + grid.spacing * (this->First[axis] + i));
    }
    planes.push_back(this->Box.upper[a] - inset);
  }
  return lattice;
}

Eigen::Vector3d FibreField::firstNode() const
{
  const VoxelGrid& grid = this->Image.grid;
  return grid.origin + grid.spacing * Eigen::Vector3d(this->First[0] - 1, this->First[1] - 1, this->First[2] - 1);
}

int FibreField::sampleOf(std::size_t axis, int node) const
{
  return this->First[axis] + std::clamp(node - 1, 0, this->Count[axis] - 1);
}

std::int32_t FibreField::nearest(int i, int j, int k) const
{
  // A neighbour y in direction d and the sample beyond it continue to 2 f(y) - f(y + d) here, exactly where the fibre's surface
  // is flat. The fibre that is here has about the depth of this sample, any other at least a gap less. Straight neighbours tell
  // best, and only where there are none the others are asked.
  const VoxelGrid& grid = this->Image.grid;
  std::int32_t best = 0;
  float bestEstimate = -std::numeric_limits<float>::infinity();
  // Amid the image there is no need to ask what it holds.
  const bool isAmid = this->holds(i - 2, j - 2, k - 2) && this->holds(i + 2, j + 2, k + 2);
  const auto here = std::ptrdiff_t(grid.index(i, j, k));
  const std::ptrdiff_t rows = grid.count[0];
  const std::ptrdiff_t slices = rows * grid.count[1];
  static const std::array<Direction, 26> directions = neighbourDirections();
  int distance = 1;
  for (const Direction& d : directions)
  {
    if (d.distance > distance && best != 0)
    {
      break;
    }
    distance = d.distance;
    if (!isAmid && !this->holds(i + d.i, j + d.j, k + d.k))
    {
      continue;
    }
    const std::ptrdiff_t step = d.i + d.j * rows + d.k * slices;
    const auto next = std::size_t(here + step);
    const std::int32_t id = this->Image.fibreId[next];
    if (id == 0)
    {
      continue;
    }
    float estimate = this->Image.depth[next] - static_cast<float>(grid.spacing) * d.length;
    if (isAmid || this->holds(i + 2 * d.i, j + 2 * d.j, k + 2 * d.k))
    {
      const auto beyond = std::size_t(here + 2 * step);
      if (this->Image.fibreId[beyond] == id)
      {
        estimate = 2.0f * this->Image.depth[next] - this->Image.depth[beyond];
      }
    }
    if (estimate > bestEstimate || (estimate == bestEstimate && id < best))
    {
      bestEstimate = estimate;
      best = id;
    }
  }
  return best;
}

bool FibreField::holds(int i, int j, int k) const
{
  const VoxelGrid& grid = this->Image.grid;
  return i >= grid.lower[0] && j >= grid.lower[1] && k >= grid.lower[2] && i < grid.lower[0] + grid.count[0] &&
         j < grid.lower[1] + grid.count[1] && k < grid.lower[2] + grid.count[2];
}

float FibreField::field(std::int32_t fibre, std::size_t index, int i, int j, int k) const
{
  const std::int32_t id = this->Image.fibreId[index];
  const float depth = this->Image.depth[index];
  const auto gap = static_cast<float>(this->Image.gap);
  if (id == fibre || (id == 0 && (depth <= -0.5f * gap || this->nearest(i, j, k) == fibre)))
  {
    return depth;
  }
  return -(depth + gap);
}

void FibreField::spareThinFibres(const Context& context)
{
  struct Depths
  {
    double sum = 0.0;
    double count = 0.0;
  };
  const VoxelGrid& grid = this->Image.grid;
  std::vector<std::unordered_map<std::int32_t, Depths>> ofSlice(std::size_t(this->Count[2]));
  parallelFor(ofSlice.size(), context,
    [&](std::size_t k)
    {
      for (int j = 0; j < this->Count[1]; ++j)
      {
        const std::size_t row = grid.index(this->First[0], this->First[1] + j, this->First[2] + static_cast<int>(k));
        const std::size_t end = row + std::size_t(this->Count[0]);
        for (std::size_t i = row; i < end;)
        {
          const std::int32_t id = this->Image.fibreId[i];
          Depths run;
          for (; i < end && this->Image.fibreId[i] == id; ++i)
          {
            run.sum += double(this->Image.depth[i]);
            run.count += 1.0;
          }
          if (id != 0)
          {
            Depths& all = ofSlice[k][id];
            all.sum += run.sum;
            all.count += run.count;
          }
        }
      }
    });
  std::map<std::int32_t, Depths> depths;
  for (const auto& slice : ofSlice)
  {
    for (const auto& [id, part] : slice)
    {
      depths[id].sum += part.sum;
      depths[id].count += part.count;
    }
  }
  for (const auto& [id, all] : depths)
  {
    const double radius = 3.0 * all.sum / (all.count * grid.spacing);
    const double part = (radius - sparedRadius) / (smoothedRadius - sparedRadius);
    if (part < 1.0)
    {
      this->Smoothing[id] = static_cast<float>(std::max(part, 0.0));
    }
  }
}

bool FibreField::smoothingAt(const NodeRange& range, float* out) const
{
  constexpr float outside = 2.0f; // of all fibres
  if (this->Smoothing.empty())
  {
    return false;
  }
  std::vector<float> ofFibre(range.size());
  bool any = false;
  std::size_t n = 0;
  std::int32_t last = 0;
  float part = outside;
  const std::vector<int> columns = this->columnsOf(range);
  for (int k = 0; k < range.count[2]; ++k)
  {
    const int z = this->sampleOf(2, range.first[2] + k);
    for (int j = 0; j < range.count[1]; ++j)
    {
      const std::int32_t* row =
        this->Image.fibreId + this->Image.grid.index(this->First[0], this->sampleOf(1, range.first[1] + j), z);
      for (const int column : columns)
      {
        const std::int32_t id = row[column];
        if (id != last)
        {
          const auto found = this->Smoothing.find(id);
          part = id == 0 ? outside : found == this->Smoothing.end() ? 1.0f : found->second;
          last = id;
          any = any || part < 1.0f;
        }
        ofFibre[n++] = part;
      }
    }
  }
  if (!any)
  {
    return false;
  }
  const std::size_t stride[3] = { 1, std::size_t(range.count[0]), std::size_t(range.count[0]) * std::size_t(range.count[1]) };
  std::transform(ofFibre.begin(), ofFibre.end(), out, [](float own) { return std::min(own, 1.0f); });
  for (n = stride[2]; n + stride[2] < range.size(); ++n)
  {
    // Beside a fibre as in it.
    for (std::size_t axis = 0; axis < 3 && ofFibre[n] == outside; ++axis)
    {
      out[n] = std::min({ out[n], ofFibre[n - stride[axis]], ofFibre[n + stride[axis]] });
    }
  }
  return true;
}

double FibreField::atSample(std::int32_t fibre, int i, int j, int k) const
{
  return this->field(fibre, this->Image.grid.index(i, j, k), i, j, k);
}

std::map<std::int32_t, std::vector<std::uint32_t>> FibreField::findFibres(int reach, const Context& context) const
{
  const NodeLattice all = this->lattice();
  const std::size_t count = all.blockCount();
  std::vector<std::vector<std::int32_t>> idsOf(count);
  parallelFor(
    count, context,
    [&](std::size_t block)
    {
      NodeRange range = nodesOfBlock(all, block);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        range.first[axis] -= reach;
        range.count[axis] += 2 * reach;
      }
      auto& ids = idsOf[block];
      std::int32_t last = 0;
      const int i0 = this->sampleOf(0, range.first[0]);
      const int i1 = this->sampleOf(0, range.first[0] + range.count[0] - 1);
      for (int k = range.first[2]; k < range.first[2] + range.count[2]; ++k)
      {
        for (int j = range.first[1]; j < range.first[1] + range.count[1]; ++j)
        {
          const std::size_t row = this->Image.grid.index(i0, this->sampleOf(1, j), this->sampleOf(2, k));
          bool finite = true;
          bool fits = true;
          for (int i = 0; i <= i1 - i0; ++i)
          {
            const std::int32_t id = this->Image.fibreId[row + std::size_t(i)];
            const float depth = this->Image.depth[row + std::size_t(i)];
            finite = finite && std::isfinite(depth);
            fits = fits && (depth > 0.0f) == (id > 0);
            if (id != last && id != 0)
            {
              const auto place = std::lower_bound(ids.begin(), ids.end(), id);
              if (place == ids.end() || *place != id)
              {
                ids.insert(place, id);
              }
              last = id;
            }
          }
          if (!finite)
          {
            throw InvalidInput("the label image has a Depth that is not finite (NaN or infinite)");
          }
          if (!fits && (ids.empty() || ids.front() >= 0))
          {
            throw InvalidInput(
              "the label image has a Depth that does not fit its FibreId: Depth must be positive just where FibreId is");
          }
        }
      }
      if (!ids.empty() && ids.front() < 0)
      {
        throw InvalidInput("the label image has a FibreId of " + std::to_string(ids.front()) + ": ids count from 1");
      }
    },
    "looking for fibres", 0.0, 0.05);
  std::map<std::int32_t, std::vector<std::uint32_t>> blocksOf;
  for (std::size_t block = 0; block < count; ++block)
  {
    for (const std::int32_t id : idsOf[block])
    {
      blocksOf[id].push_back(static_cast<std::uint32_t>(block));
    }
  }
  return blocksOf;
}

std::vector<int> FibreField::columnsOf(const NodeRange& range) const
{
  std::vector<int> columns;
  columns.reserve(static_cast<std::size_t>(range.count[0]));
  for (int i = 0; i < range.count[0]; ++i)
  {
    columns.push_back(this->sampleOf(0, range.first[0] + i) - this->First[0]);
  }
  return columns;
}

void FibreField::atNodes(std::int32_t fibre, const NodeRange& range, float* out) const
{
  const std::vector<int> columns = this->columnsOf(range);
  for (int k = 0; k < range.count[2]; ++k)
  {
    const int z = this->sampleOf(2, range.first[2] + k);
    for (int j = 0; j < range.count[1]; ++j)
    {
      const int y = this->sampleOf(1, range.first[1] + j);
      const std::size_t row = this->Image.grid.index(this->First[0], y, z);
      for (const int column : columns)
      {
        *out++ = this->field(fibre, row + std::size_t(column), this->First[0] + column, y, z);
      }
    }
  }
}

SmoothedField::SmoothedField(const FibreField& field, std::int32_t fibre, std::vector<std::uint32_t> blocks, int passes)
  : Fibre(fibre)
  , Lattice(field.lattice())
  , Blocks(std::move(blocks))
  , FirstNode(field.firstNode())
  , NodesPerLength(1.0 / field.image().grid.spacing)
{
  std::vector<Index> at;
  Index last{ { 0, 0, 0 } };
  std::size_t size = 0;
  for (const std::uint32_t block : Blocks)
  {
    const NodeRange range = nodesOfBlock(Lattice, block);
    size += std::size_t(range.count[0] + 2) * std::size_t(range.count[1] + 2) * std::size_t(range.count[2] + 2);
    Index index;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      index[axis] = range.first[axis] / NodeLattice::blockCells;
      First[axis] = at.empty() ? index[axis] : std::min(First[axis], index[axis]);
      last[axis] = at.empty() ? index[axis] : std::max(last[axis], index[axis]);
    }
    at.push_back(index);
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    Count[axis] = at.empty() ? 0 : last[axis] - First[axis] + 1;
    Cells[axis] = Lattice.cells(int(axis));
  }
  Places.assign(std::size_t(Count[0]) * std::size_t(Count[1]) * std::size_t(Count[2]), -1);
  Values.resize(size);
  Unsmoothed.resize(size);
  // Blocks that are smoothed together share the nodes around them, which many passes need many of.
  const int edge = passes > fewPasses ? blocksTogether : 1;
  std::map<Index, std::vector<Piece>> groups;
  std::ptrdiff_t place = 0;
  for (std::size_t b = 0; b < Blocks.size(); ++b)
  {
    Piece piece{ nodesOfBlock(Lattice, Blocks[b]), place };
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      piece.range.first[axis] -= 1;
      piece.range.count[axis] += 2;
    }
    groups[{ { at[b][0] / edge, at[b][1] / edge, at[b][2] / edge } }].push_back(piece);
    Places[std::size_t(placeOf(at[b]))] = place;
    place += std::ptrdiff_t(piece.range.size());
  }
  for (const auto& group : groups)
  {
    this->smooth(field, fibre, group.second, passes);
  }
}

void SmoothedField::smooth(const FibreField& field, std::int32_t fibre, const std::vector<Piece>& pieces, int passes)
{
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
    // How much of a pass the outermost nodes get is not known right (see smoothingAt()).
    const int reach = passes > fewPasses ? passes + 1 : passes;
    range.first[axis] = first - reach;
    range.count[axis] = end - first + 2 * reach;
  }
  std::vector<float> buffer(range.size());
  std::vector<float> before;
  std::vector<float> part;
  field.atNodes(fibre, range, buffer.data());
  // Each pass leaves one node less on every side. Strides stay.
  const std::array<std::size_t, 3> stride{ { 1, std::size_t(range.count[0]),
    std::size_t(range.count[0]) * std::size_t(range.count[1]) } };
  const std::size_t all = range.size();
  const auto keep = [&](std::vector<float>& held)
  {
    for (const Piece& piece : pieces)
    {
      float* out = held.data() + piece.place;
      for (int k = 0; k < piece.range.count[2]; ++k)
      {
        for (int j = 0; j < piece.range.count[1]; ++j)
        {
          const float* row = buffer.data() + std::size_t(piece.range.first[0] - range.first[0]) +
                             stride[1] * std::size_t(piece.range.first[1] - range.first[1] + j) +
                             stride[2] * std::size_t(piece.range.first[2] - range.first[2] + k);
          out = std::copy(row, row + piece.range.count[0], out);
        }
      }
    }
  };
  keep(this->Unsmoothed);
  const bool isUniform = passes == 0 || !field.smoothingAt(range, (part.resize(range.size()), part.data()));
  for (int pass = 0; pass < passes; ++pass)
  {
    for (const std::size_t step : stride)
    {
      // Values at the rim become wrong, and are not used.
      before = buffer;
      for (std::size_t n = step; n + step < all; ++n)
      {
        buffer[n] = 0.5f * before[n] + 0.25f * (before[n - step] + before[n + step]);
      }
      for (std::size_t n = step; !isUniform && n + step < all; ++n)
      {
        buffer[n] = (1.0f - part[n]) * before[n] + part[n] * buffer[n]; // with 1 the very same bits
      }
    }
  }
  keep(this->Values);
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

double SmoothedField::value(const Eigen::Vector3d& at) const
{
  // The cell between samples that holds the point, or the nearest one, and how far into it the point lies.
  const Eigen::Vector3d nodes = (at - this->FirstNode) * this->NodesPerLength;
  Index cell;
  Index block;
  std::array<double, 3> t;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const int last = this->Cells[axis] - 1; // the last node that is a sample
    const double inside = std::clamp(nodes[Eigen::Index(axis)], 1.0, double(last));
    cell[axis] = std::min(static_cast<int>(inside), std::max(1, last - 1));
    t[axis] = inside - cell[axis];
    block[axis] = cell[axis] / NodeLattice::blockCells;
  }
  const std::ptrdiff_t place = this->placeOf(block);
  if (place < 0 || this->Places[std::size_t(place)] < 0)
  {
    return -std::numeric_limits<double>::infinity();
  }
  std::array<std::ptrdiff_t, 3> stride;
  std::ptrdiff_t step = 1;
  const float* corner = this->Values.data() + this->Places[std::size_t(place)];
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const int first = block[axis] * NodeLattice::blockCells;
    stride[axis] = step;
    corner += step * (cell[axis] - first + 1);
    step *= std::min(NodeLattice::blockCells, this->Cells[axis] - first) + 3;
  }
  const float weights[3][2] = { { float(1.0 - t[0]), float(t[0]) }, { float(1.0 - t[1]), float(t[1]) },
    { float(1.0 - t[2]), float(t[2]) } };
  Four sum{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    // The four edges of the cell along this axis, with a node before and behind, and their weights.
    const std::size_t one = (axis + 1) % 3;
    const std::size_t other = (axis + 2) % 3;
    const float* line = corner;
    const std::ptrdiff_t along = stride[axis];
    const std::ptrdiff_t lines[4] = { 0, stride[one], stride[other], stride[one] + stride[other] };
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
    const bool before = cell[axis] > 1;
    const bool behind = cell[axis] + 3 <= this->Cells[axis];
    if (!before && !behind)
    {
      continue;
    }
    const Four first = before ? nodes4(-along) - 2.0f * v1 + v2 : v1 - 2.0f * v2 + nodes4(2 * along);
    const Four second = behind && before ? v1 - 2.0f * v2 + nodes4(2 * along) : first;
    const Four zero{};
    const Four lower = first < second ? first : second;
    const Four upper = first < second ? second : first;
    const Four bend = lower > zero ? lower : upper < zero ? upper : zero; // agreedBend()
    sum -= (0.5f * weights[axis][0] * weights[axis][1]) * (weight * bend);
  }
  return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

} // namespace cactus
