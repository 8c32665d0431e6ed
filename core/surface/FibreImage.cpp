// SPDX-License-Identifier: BSD-3-Clause
#include "surface/FibreImage.h"

#include "base/Error.h"
#include "base/Memory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace cactus
{

namespace
{

/// Contours keep off the samples beyond a face by this fraction of a voxel, since a value at the level counts as inside.
constexpr double leastAcross = 1e-4;
/// Bytes per sample: in the image, and while it is contoured.
constexpr double bytesPerSample = 12.0;

/// Returns the number nearest to `value` that is below `level`.
float below(double value, double level)
{
  auto result = static_cast<float>(value);
  while (double(result) >= level)
  {
    result = std::nextafter(std::min(result, static_cast<float>(level)), -std::numeric_limits<float>::infinity());
  }
  return result;
}

/// Returns the nodes of the lattice in the blocks, with one more on every side.
NodeRange rangeOf(const NodeLattice& lattice, const std::vector<std::uint32_t>& blocks)
{
  std::array<int, 3> first{ { 0, 0, 0 } };
  std::array<int, 3> last{ { -1, -1, -1 } };
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    const NodeRange range = nodesOfBlock(lattice, blocks[b]);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const int end = range.first[axis] + range.count[axis] - 1;
      first[axis] = b == 0 ? range.first[axis] : std::min(first[axis], range.first[axis]);
      last[axis] = b == 0 ? end : std::max(last[axis], end);
    }
  }
  NodeRange all;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    all.first[axis] = std::max(0, first[axis] - 1);
    all.count[axis] = std::min(lattice.nodes(static_cast<int>(axis)) - 1, last[axis] + 1) - all.first[axis] + 1;
  }
  return all;
}

/// The layers beyond one face of the box.
struct Face
{
  int layers = 0;      ///< number of layers added there
  double distance = 0; ///< from the outermost sample to the cap, in voxels
};

/// Returns the value beyond the outermost sample, by the distance of the cap: a linear contour through the two values around it
/// crosses `level` at the cap, or slightly before.
float beyond(float inside, const Face& face, int layer, double level, double spacing)
{
  if (double(inside) <= level)
  {
    return inside;
  }
  if (layer + 1 < face.layers)
  {
    return inside;
  }
  const double part = face.distance - (face.layers - 1); // at least a twentieth, see FibreField::lattice(), or in a second layer
  const double across = (double(inside) - level) * std::max((1.0 - part) / part, leastAcross);
  return below(level - std::max(across, 0.1 * leastAcross * spacing), level);
}

using Faces = std::array<std::array<Face, 2>, 3>;

/// Returns the samples among the nodes of a range; nodes on faces of the box are none.
NodeRange samplesOf(const NodeLattice& lattice, const NodeRange& range, double spacing, Faces& faces)
{
  NodeRange samples = range;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto& planes = lattice.planes[axis];
    const auto place = [&](Face& face, double distance)
    {
      face.distance = distance / spacing;
      face.layers = face.distance > 1.0 ? 2 : 1;
    };
    if (range.first[axis] == 0)
    {
      place(faces[axis][0], planes[1] - planes[0]);
      ++samples.first[axis];
      --samples.count[axis];
    }
    if (range.first[axis] + range.count[axis] == lattice.nodes(static_cast<int>(axis)))
    {
      place(faces[axis][1], planes.back() - *(planes.end() - 2));
      --samples.count[axis];
    }
  }
  return samples;
}

/// Returns the value at a place of the image, by the nearest sample, whose value is `inside`.
float valueAt(
  const std::array<int, 3>& at, float inside, const NodeRange& samples, const Faces& faces, double level, double spacing)
{
  float value = inside;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const int before = faces[axis][0].layers - 1 - at[axis]; // 0 in the layer next to the samples
    const int after = at[axis] - faces[axis][0].layers - samples.count[axis];
    if (before >= 0)
    {
      value = std::min(value, beyond(inside, faces[axis][0], before, level, spacing));
    }
    if (after >= 0)
    {
      value = std::min(value, beyond(inside, faces[axis][1], after, level, spacing));
    }
  }
  return value;
}

/// Fills the image, and closes the fibre where no face cuts it off: it ends before, but its field may equal `level` there.
void fill(const std::vector<float>& held, const NodeRange& samples, const Faces& faces, double level, FibreImage& image)
{
  const auto& count = image.grid.count;
  image.values.resize(image.grid.size());
  std::size_t out = 0;
  for (int k = 0; k < count[2]; ++k)
  {
    for (int j = 0; j < count[1]; ++j)
    {
      for (int i = 0; i < count[0]; ++i)
      {
        const std::array<int, 3> at{ { i, j, k } };
        std::array<std::size_t, 3> nearest{};
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          nearest[axis] = std::size_t(std::clamp(at[axis] - faces[axis][0].layers, 0, samples.count[axis] - 1));
        }
        const std::size_t row = nearest[1] + std::size_t(samples.count[1]) * nearest[2];
        const float inside = held[nearest[0] + std::size_t(samples.count[0]) * row];
        const float value = valueAt(at, inside, samples, faces, level, image.grid.spacing);
        const bool isLast = i == 0 || j == 0 || k == 0 || i + 1 == count[0] || j + 1 == count[1] || k + 1 == count[2];
        image.values[out++] = isLast ? below(double(value), level) : value;
      }
    }
  }
}

} // namespace

FibreImage fibreImage(
  const FibreField& field, std::int32_t fibre, const std::vector<std::uint32_t>& blocks, double level, double inset)
{
  require(!blocks.empty(), "the fibre has no voxel in the label image");
  require(std::isfinite(level) && level >= 0.0, "the level of a contour must be a depth of 0 or more");
  const NodeLattice lattice = field.lattice(inset);
  const double spacing = field.grid().spacing;
  Faces faces;
  const NodeRange samples = samplesOf(lattice, rangeOf(lattice, blocks), spacing, faces);

  FibreImage image;
  image.grid.spacing = spacing;
  image.grid.origin = field.grid().origin;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto a = Eigen::Index(axis);
    const int shift = static_cast<int>(std::lround((field.firstNode()[a] - image.grid.origin[a]) / spacing));
    image.grid.lower[axis] = shift + samples.first[axis] - faces[axis][0].layers;
    image.grid.count[axis] = samples.count[axis] + faces[axis][0].layers + faces[axis][1].layers;
  }
  requireMemory(bytesPerSample * double(image.grid.size()),
    text("the field of fibre ", fibre, " needs ", image.grid.count[0], " x ", image.grid.count[1], " x ", image.grid.count[2],
      " samples"),
    "choose a larger VoxelSize in FibreRadialGrowth, fewer fibres at once, or fewer threads");
  std::vector<float> held(samples.size());
  LabelBuffer buffer;
  field.atNodes(fibre, samples, field.samplesFor(samples, buffer), held.data());
  fill(held, samples, faces, level, image);
  return image;
}

} // namespace cactus
