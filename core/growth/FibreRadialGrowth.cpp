// SPDX-License-Identifier: BSD-3-Clause
#include "growth/FibreRadialGrowth.h"

#include "base/Error.h"
#include "base/Limits.h"
#include "base/Memory.h"
#include "growth/GrownField.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cactus
{

VoxelGrid growthGrid(const Domain& domain, const FibreRadialGrowthOptions& options)
{
  validate(options);
  validate(domain);
  const Eigen::Vector3d size = domain.size();
  if (options.voxelSize > size.minCoeff())
  {
    throw InvalidInput(text("VoxelSize ", options.voxelSize, " is larger than the domain, whose smallest side is ",
      size.minCoeff(), " µm: choose a smaller VoxelSize"));
  }
  const double most = 0.25 * std::numeric_limits<int>::max();
  if (size.maxCoeff() * 1.1 + 2.0 * options.margin > most * options.voxelSize)
  {
    throw InvalidInput(text("VoxelSize ", options.voxelSize, " divides the domain's ", size.maxCoeff(),
      " µm into more voxels than can be counted: choose a larger VoxelSize"));
  }
  // Candidates in the order of their distance from the requested spacing; a cube takes the first.
  const double ideal = size[0] / options.voxelSize;
  const double nearest = std::max(1.0, std::round(ideal));
  const int tries = static_cast<int>(std::min(20000.0, 0.1 * ideal + 1.0));
  for (int n = 0; n <= 2 * tries; ++n)
  {
    const int step = (n + 1) / 2;
    const double count = nearest + (n % 2 == 1 ? step : -step);
    if (count < 1.0 || (n > 0 && std::abs(size[0] / count - options.voxelSize) > 0.1 * options.voxelSize))
    {
      continue;
    }
    const double spacing = size[0] / count;
    const Eigen::Array3d counts = (size / spacing).array().round();
    if ((counts < 1.0).any() || ((size / spacing).array() - counts).abs().maxCoeff() > std::min(1e-3, 1e-6 * counts.maxCoeff()))
    {
      continue;
    }
    const double margin = std::ceil(options.margin / spacing - 1e-9);
    VoxelGrid grid;
    grid.spacing = spacing;
    grid.origin = domain.lower.array() + (0.5 - margin) * spacing;
    for (int axis = 0; axis < 3; ++axis)
    {
      grid.count[std::size_t(axis)] = static_cast<int>(counts[axis] + 2.0 * margin);
    }
    return grid;
  }
  throw InvalidInput(text("no cubic voxel near VoxelSize ", options.voxelSize, " divides the domain's sides ", size[0], ", ",
    size[1], " and ", size[2], " µm: choose a VoxelSize of which each is a whole multiple, or change the field data Domain"));
}

namespace
{

VoxelGrid checkedPart(const Fibres& fibres, const FibreRadialGrowthOptions& options, double growth, const VoxelGrid& part)
{
  validate(fibres);
  const VoxelGrid whole = growthGrid(fibres.domain, options);
  require(std::isfinite(growth), "the growth must be a finite number of µm");
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    require(part.count[axis] > 0 && part.lower[axis] >= 0 && part.count[axis] <= whole.count[axis] - part.lower[axis],
      "the extent to grow fibres in is empty or reaches outside the whole image");
  }
  VoxelGrid grid = whole;
  grid.lower = part.lower;
  grid.count = part.count;
  return grid;
}

} // namespace

void growFibres(const Fibres& fibres, const FibreRadialGrowthOptions& options, double growth, const VoxelGrid& part,
  std::int32_t* fibreId, float* depth, const Context& context)
{
  const GrownField field(fibres, options, growth, checkedPart(fibres, options, growth, part), context.threadCount());
  const double from = targetFraction(fibres, options) > 0.0 ? 0.5 : 0.0;
  field.seeds().sweep(field.grid(), field.relevance(), context, from, 1.0, "growing fibres",
    [&](const FieldCell& cell, int) { field.enter(cell, field.grid(), fibreId, depth); });
}

LabelImage growFibres(
  const Fibres& fibres, const FibreRadialGrowthOptions& options, double growth, const VoxelGrid& part, const Context& context)
{
  LabelImage image;
  image.grid = growthGrid(fibres.domain, options);
  image.grid.lower = part.lower;
  image.grid.count = part.count;
  requireMemory(8.0 * double(part.count[0]) * double(part.count[1]) * double(part.count[2]),
    text("VoxelSize ", options.voxelSize, " makes a grid of ", part.count[0], " x ", part.count[1], " x ", part.count[2],
      " voxels, which"),
    "choose a larger VoxelSize or ask for a smaller extent");
  image.fibreId.resize(image.grid.size());
  image.depth.resize(image.grid.size());
  growFibres(fibres, options, growth, image.grid, image.fibreId.data(), image.depth.data(), context);
  return image;
}

} // namespace cactus
