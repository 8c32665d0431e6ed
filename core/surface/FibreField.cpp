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

std::vector<int> SampleBox::columnsOf(const NodeRange& range) const
{
  std::vector<int> columns;
  columns.reserve(static_cast<std::size_t>(range.count[0]));
  for (int i = 0; i < range.count[0]; ++i)
  {
    columns.push_back(this->sampleOf(0, range.first[0] + i) - this->first[0]);
  }
  return columns;
}

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
    Samples.first[axis] = grid.lower[axis] + from;
    Samples.count[axis] = to - from + 1;
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
    planes.reserve(std::size_t(this->Samples.count[axis]) + 2);
    planes.push_back(this->Box.lower[a] + inset);
    for (int i = 0; i < this->Samples.count[axis]; ++i)
    {
      planes.push_back(grid.origin[a] + grid.spacing * (this->Samples.first[axis] + i));
    }
    planes.push_back(this->Box.upper[a] - inset);
  }
  return lattice;
}

Eigen::Vector3d FibreField::firstNode() const
{
  const VoxelGrid& grid = this->Image.grid;
  return grid.origin +
         grid.spacing * Eigen::Vector3d(this->Samples.first[0] - 1, this->Samples.first[1] - 1, this->Samples.first[2] - 1);
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

double FibreField::atSample(std::int32_t fibre, int i, int j, int k) const
{
  return this->field(fibre, this->Image.grid.index(i, j, k), i, j, k);
}

std::vector<std::int32_t> FibreField::idsWithin(const NodeRange& range) const
{
  std::vector<std::int32_t> ids;
  std::int32_t last = 0;
  const int i0 = this->Samples.sampleOf(0, range.first[0]);
  const int i1 = this->Samples.sampleOf(0, range.first[0] + range.count[0] - 1);
  for (int k = range.first[2]; k < range.first[2] + range.count[2]; ++k)
  {
    for (int j = range.first[1]; j < range.first[1] + range.count[1]; ++j)
    {
      const std::size_t row = this->Image.grid.index(i0, this->Samples.sampleOf(1, j), this->Samples.sampleOf(2, k));
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
      require(finite, "the label image has a Depth that is not finite (NaN or infinite)");
      require(fits || (!ids.empty() && ids.front() < 0),
        "the label image has a Depth that does not fit its FibreId: Depth must be positive just where FibreId is");
    }
  }
  if (!ids.empty() && ids.front() < 0)
  {
    throw InvalidInput("the label image has a FibreId of " + std::to_string(ids.front()) + ": ids count from 1");
  }
  return ids;
}

std::map<std::int32_t, std::vector<std::uint32_t>> FibreField::findFibres(int reach, const Context& context) const
{
  const NodeLattice all = this->lattice();
  std::vector<std::vector<std::int32_t>> idsOf(all.blockCount());
  parallelFor(
    idsOf.size(), context, [&](std::size_t block) { idsOf[block] = this->idsWithin(nodesOfBlock(all, block).widened(reach)); },
    "looking for fibres", 0.0, 0.05);
  std::map<std::int32_t, std::vector<std::uint32_t>> blocksOf;
  for (std::size_t block = 0; block < idsOf.size(); ++block)
  {
    for (const std::int32_t id : idsOf[block])
    {
      blocksOf[id].push_back(static_cast<std::uint32_t>(block));
    }
  }
  return blocksOf;
}

void FibreField::atNodes(std::int32_t fibre, const NodeRange& range, float* out) const
{
  const std::vector<int> columns = this->Samples.columnsOf(range);
  for (int k = 0; k < range.count[2]; ++k)
  {
    const int z = this->Samples.sampleOf(2, range.first[2] + k);
    for (int j = 0; j < range.count[1]; ++j)
    {
      const int y = this->Samples.sampleOf(1, range.first[1] + j);
      const std::size_t row = this->Image.grid.index(this->Samples.first[0], y, z);
      for (const int column : columns)
      {
        *out++ = this->field(fibre, row + std::size_t(column), this->Samples.first[0] + column, y, z);
      }
    }
  }
}

} // namespace cactus
