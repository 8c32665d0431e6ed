// SPDX-License-Identifier: BSD-3-Clause
#include "surface/FibreField.h"

#include "base/Error.h"
#include "base/SinglePrecision.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace cactus
{

namespace
{

/// Computes the field of a fibre at a row of samples, as if samples outside all fibres were nearest to it. Returns whether one of
/// these is above `outside`, so that its nearest fibre has to be determined. See LabelImage.
bool fieldAlong(const std::int32_t* ids, const float* depths, int count, std::int32_t fibre, float gap, float outside, float* out)
{
  int doubtful = 0;
  for (int n = 0; n < count; ++n)
  {
    // Without branches, so that it can be vectorised.
    const int isOutside = int(ids[n] == 0);
    const float other = -(depths[n] + gap);
    out[n] = (int(ids[n] == fibre) | isOutside) != 0 ? depths[n] : other;
    doubtful |= isOutside & int(depths[n] > outside);
  }
  return doubtful != 0;
}

/// A sample nearer to a face than this fraction of a voxel is left out: the cells between them would be too flat.
constexpr double thinnestCell = 0.3;
/// Distance, in voxels, below which the image's face and the domain's count as one.
constexpr double sameFace = 1e-3;

/// Largest distance from a sample at which its field is extrapolated, see FibreField::nearest().
constexpr int farthestNeighbour = 2;
constexpr char noImage[] = "the label image is empty or has no valid spacing";

std::shared_ptr<const LabelSource> inMemory(const LabelImageView& image)
{
  require(image.fibreId != nullptr && image.depth != nullptr, noImage);
  return std::make_shared<LabelImageInMemory>(image);
}

/// The step from a sample to one of the 26 around it.
struct Direction
{
  int i;
  int j;
  int k;
  int distance; ///< number of axes along which it differs
  float length; ///< in voxels
};

/// Returns them with the nearest ones first.
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

SampleRow SampleBox::rowOf(const NodeRange& range) const
{
  SampleRow row;
  row.first = this->sampleOf(0, range.first[0]);
  const int last = this->sampleOf(0, range.first[0] + range.count[0] - 1);
  row.count = last - row.first + 1;
  // Node 1 is the first sample of the box.
  row.before = std::clamp(row.first - this->first[0] + 1 - range.first[0], 0, range.count[0] - 1);
  row.behind = range.count[0] - row.before - row.count;
  return row;
}

FibreField::FibreField(const LabelImageView& image, const Domain& domain, bool clipToDomain)
  : FibreField(inMemory(image), domain, clipToDomain)
{
}

FibreField::FibreField(std::shared_ptr<const LabelSource> image, const Domain& domain, bool clipToDomain)
  : Image(std::move(image))
{
  const VoxelGrid& grid = this->grid();
  const double h = grid.spacing;
  if (!(h > 0.0) || !std::isfinite(h) || !grid.origin.allFinite() || grid.count[0] < 1 || grid.count[1] < 1 || grid.count[2] < 1)
  {
    throw InvalidInput(noImage);
  }
  if (!(this->Image->gap() >= 0.0) || !std::isfinite(this->Image->gap()))
  {
    throw InvalidInput("the gap between the fibres of the label image must be 0 or more");
  }
  this->All = { grid.lower, grid.count };
  const Eigen::Vector3d firstSample = grid.position(grid.lower[0], grid.lower[1], grid.lower[2]);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto a = Eigen::Index(axis);
    const double imageLower = firstSample[a] - 0.5 * h;
    const double imageUpper = imageLower + h * grid.count[axis];
    Box.lower[a] = clipToDomain ? std::max(domain.lower[a], imageLower) : imageLower;
    Box.upper[a] = clipToDomain ? std::min(domain.upper[a], imageUpper) : imageUpper;
    // If image and domain end together, they may differ by rounding, also that of a file with six digits.
    if (clipToDomain && std::abs(imageLower - domain.lower[a]) < sameFace * h)
    {
      Box.lower[a] = domain.lower[a];
    }
    if (clipToDomain && std::abs(imageUpper - domain.upper[a]) < sameFace * h)
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
    Samples.repeats[axis] = Box.periodic[axis] = domain.periodic[axis];
    if (domain.periodic[axis] && (!clipToDomain || Samples.count[axis] != grid.count[axis] || Box.lower[a] != domain.lower[a] ||
                                   Box.upper[a] != domain.upper[a]))
    {
      throw InvalidInput(
        "the Domain is periodic, and the label image has to end with it: give the whole image, without Margin, and "
        "leave ClipToDomain on");
    }
  }
}

std::uint8_t FibreField::heldFaces() const
{
  unsigned held = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    held |= this->Samples.repeats[axis] ? 3U << (2 * axis) : 0U;
  }
  return static_cast<std::uint8_t>(held);
}

NodeLattice FibreField::lattice(double inset) const
{
  const VoxelGrid& grid = this->grid();
  if (!(inset >= 0.0) || inset > 0.25 * grid.spacing)
  {
    throw InvalidInput("the inset of caps must lie between 0 and a quarter of a voxel");
  }
  const auto moved = [&](double face, double by) { return inset > 0.0 ? inSinglePrecision(face + by) : face; };
  NodeLattice lattice;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto a = Eigen::Index(axis);
    auto& planes = lattice.planes[axis];
    planes.reserve(std::size_t(this->Samples.count[axis]) + 2);
    planes.push_back(moved(this->Box.lower[a], inset));
    for (int i = 0; i < this->Samples.count[axis]; ++i)
    {
      planes.push_back(grid.origin[a] + grid.spacing * (this->Samples.first[axis] + i));
    }
    planes.push_back(moved(this->Box.upper[a], -inset));
  }
  return lattice;
}

Eigen::Vector3d FibreField::firstNode() const
{
  const VoxelGrid& grid = this->grid();
  return grid.origin +
         grid.spacing * Eigen::Vector3d(this->Samples.first[0] - 1, this->Samples.first[1] - 1, this->Samples.first[2] - 1);
}

inline bool FibreField::holds(int i, int j, int k) const
{
  const auto isIn = [&](std::size_t axis, int sample)
  { return unsigned(sample - this->All.first[axis]) < unsigned(this->All.count[axis]) || this->Samples.repeats[axis]; };
  return isIn(0, i) && isIn(1, j) && isIn(2, k);
}

std::int32_t FibreField::nearest(const LabelImageView& held, int i, int j, int k) const
{
  // A neighbour y in direction d and the sample beyond it extrapolate to 2 f(y) - f(y + d) here, exactly if the fibre's surface
  // is flat. The nearest fibre has about the depth of this sample, any other at least a gap less. Straight neighbours are most
  // accurate; the others are used only if there are none.
  const VoxelGrid& grid = held.grid;
  std::int32_t best = 0;
  float bestEstimate = -std::numeric_limits<float>::infinity();
  // Inside the image, bounds need not be checked.
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
    const std::int32_t id = held.fibreId[next];
    if (id == 0)
    {
      continue;
    }
    float estimate = held.depth[next] - static_cast<float>(grid.spacing) * d.length;
    if (isAmid || this->holds(i + 2 * d.i, j + 2 * d.j, k + 2 * d.k))
    {
      const auto beyond = std::size_t(here + 2 * step);
      if (held.fibreId[beyond] == id)
      {
        estimate = 2.0f * held.depth[next] - held.depth[beyond];
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

/// Tells whether nearest() is that fibre.
bool FibreField::isNearest(const LabelImageView& held, std::int32_t fibre, int i, int j, int k) const
{
  if (this->holds(i - 1, j - 1, k - 1) && this->holds(i + 1, j + 1, k + 1))
  {
    // If straight neighbours are all of one kind, they decide.
    const std::int32_t* here = held.fibreId + held.grid.index(i, j, k);
    const std::ptrdiff_t rows = held.grid.count[0];
    const std::ptrdiff_t slices = rows * held.grid.count[1];
    int isBeside = 0;
    int isBesideAnother = 0;
    for (const std::int32_t id : { here[-1], here[1], here[-rows], here[rows], here[-slices], here[slices] })
    {
      isBeside |= int(id == fibre);
      isBesideAnother |= int(id != fibre) & int(id != 0);
    }
    if (isBeside != isBesideAnother)
    {
      return isBeside != 0;
    }
  }
  return this->nearest(held, i, j, k) == fibre;
}

float FibreField::field(const LabelImageView& held, std::int32_t fibre, std::size_t index, int i, int j, int k) const
{
  const std::int32_t id = held.fibreId[index];
  const float depth = held.depth[index];
  const auto gap = static_cast<float>(held.gap);
  if (id == fibre || (id == 0 && (depth <= -0.5f * gap || this->isNearest(held, fibre, i, j, k))))
  {
    return depth;
  }
  return -(depth + gap);
}

LabelImageView FibreField::samplesAround(const SampleRange& range, int more, LabelBuffer& buffer) const
{
  const VoxelGrid& grid = this->grid();
  SampleRange wider;
  bool isBeyond = false;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    wider.first[axis] = range.first[axis] - more;
    int end = range.first[axis] + range.count[axis] + more;
    if (!this->Samples.repeats[axis])
    {
      wider.first[axis] = std::max(grid.lower[axis], wider.first[axis]);
      end = std::min(grid.lower[axis] + grid.count[axis], end);
    }
    wider.count[axis] = end - wider.first[axis];
    isBeyond = isBeyond || wider.first[axis] < grid.lower[axis] || end > grid.lower[axis] + grid.count[axis];
  }
  return isBeyond ? this->repeated(wider, buffer) : this->Image->samples(wider, buffer);
}

/// Copies samples of which some lie beyond periodic faces, part by part.
LabelImageView FibreField::repeated(const SampleRange& range, LabelBuffer& buffer) const
{
  const VoxelGrid& grid = this->grid();
  LabelImageView all;
  all.gap = this->Image->gap();
  all.grid = grid;
  all.grid.lower = range.first;
  all.grid.count = range.count;
  buffer.fibreId.resize(all.grid.size());
  buffer.depth.resize(all.grid.size());
  all.fibreId = buffer.fibreId.data();
  all.depth = buffer.depth.data();
  // A part's first sample, by axis, and what of the image it is.
  struct Part
  {
    int at;
    int sample;
    int count;
  };
  std::array<std::vector<Part>, 3> parts;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const int lower = grid.lower[axis];
    const int count = grid.count[axis];
    const int end = range.first[axis] + range.count[axis];
    for (int at = range.first[axis]; at < end;)
    {
      const int into = ((at - lower) % count + count) % count;
      const int length = std::min(count - into, end - at);
      parts[axis].push_back({ at, lower + into, length });
      at += length;
    }
  }
  LabelBuffer own;
  for (const Part& z : parts[2])
  {
    for (const Part& y : parts[1])
    {
      for (const Part& x : parts[0])
      {
        const LabelImageView part =
          this->Image->samples({ { { x.sample, y.sample, z.sample } }, { { x.count, y.count, z.count } } }, own);
        for (int k = 0; k < z.count; ++k)
        {
          for (int j = 0; j < y.count; ++j)
          {
            const std::size_t from = part.grid.index(x.sample, y.sample + j, z.sample + k);
            const std::size_t to = all.grid.index(x.at, y.at + j, z.at + k);
            std::copy_n(part.fibreId + from, x.count, buffer.fibreId.data() + to);
            std::copy_n(part.depth + from, x.count, buffer.depth.data() + to);
          }
        }
      }
    }
  }
  return all;
}

LabelImageView FibreField::samplesAt(const NodeRange& range, int more, LabelBuffer& buffer) const
{
  SampleRange samples;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    samples.first[axis] = this->Samples.sampleOf(axis, range.first[axis]);
    samples.count[axis] = this->Samples.sampleOf(axis, range.first[axis] + range.count[axis] - 1) - samples.first[axis] + 1;
  }
  return this->samplesAround(samples, more, buffer);
}

LabelImageView FibreField::samplesFor(const NodeRange& range, LabelBuffer& buffer) const
{
  return this->samplesAt(range, farthestNeighbour, buffer);
}

void FibreField::atNodes(std::int32_t fibre, const NodeRange& range, const LabelImageView& held, float* out) const
{
  const SampleRow row = this->Samples.rowOf(range);
  const auto gap = static_cast<float>(held.gap);
  const float outside = -0.5f * gap;
  for (int k = 0; k < range.count[2]; ++k)
  {
    const int z = this->Samples.sampleOf(2, range.first[2] + k);
    for (int j = 0; j < range.count[1]; ++j, out += row.nodes())
    {
      const int y = this->Samples.sampleOf(1, range.first[1] + j);
      const std::size_t first = held.grid.index(row.first, y, z);
      const std::int32_t* ids = held.fibreId + first;
      const float* depths = held.depth + first;
      float* values = out + row.before;
      // Most samples are clearly in a fibre or outside all.
      const bool isDoubtful = fieldAlong(ids, depths, row.count, fibre, gap, outside, values);
      for (int i = 0; isDoubtful && i < row.count; ++i)
      {
        if (ids[i] == 0 && depths[i] > outside && !this->isNearest(held, fibre, row.first + i, y, z))
        {
          values[i] = -(depths[i] + gap);
        }
      }
      row.fillRim(out);
    }
  }
}

} // namespace cactus
