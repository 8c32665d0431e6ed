// SPDX-License-Identifier: BSD-3-Clause
#include "growth/FibreRadialGrowth.h"

#include "base/Error.h"
#include "base/Limits.h"
#include "base/Memory.h"
#include "growth/CapsuleField.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace cactus
{

namespace
{

constexpr double bandInVoxels = 4.0;

double largestRadius(const Fibres& fibres)
{
  return *std::max_element(fibres.radii.begin(), fibres.radii.end());
}

} // namespace

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
  // Candidates in the order of their distance from the spacing asked for; a cube takes the first.
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
    if ((counts < 1.0).any() || ((size / spacing).array() - counts).abs().maxCoeff() > 1e-6 * counts.maxCoeff())
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

void growFibres(const Fibres& fibres, const FibreRadialGrowthOptions& options, double growth, const VoxelGrid& part,
  std::int32_t* fibreId, float* depth, const Context& context)
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

  const double halfGap = 0.5 * options.gap();
  const double band = std::max(bandInVoxels * grid.spacing, halfGap);
  FieldRelevance relevance;
  relevance.bestReach = growth + band;
  relevance.secondReach = growth + halfGap;
  relevance.sumReach = 2.0 * (growth + halfGap);
  const double reach = std::max(relevance.bestReach, largestRadius(fibres) + relevance.sumReach) + 2.0 * grid.spacing;
  const CapsuleField field(fibres, { options.surfaceRoughness, options.seed }, grid.box(), std::max(reach, 0.0));
  std::vector<std::int32_t> idOfRank(field.size());
  for (std::size_t rank = 0; rank < idOfRank.size(); ++rank)
  {
    idOfRank[rank] = fibres.fibreIds[field.fibre(static_cast<int>(rank))];
  }

  const auto g = static_cast<float>(growth);
  const auto w = static_cast<float>(halfGap);
  const auto lowest = static_cast<float>(-band);
  const double from = options.targetFibreVolumeFraction > 0.0 ? 0.5 : 0.0;
  field.sweep(grid, relevance, context, from, 1.0, "growing fibres",
    [&](const FieldCell& cell, int)
    {
      for (int k = cell.begin[2]; k < cell.end[2]; ++k)
      {
        for (int j = cell.begin[1]; j < cell.end[1]; ++j)
        {
          const int row = FieldCell::sizeX * (j + FieldCell::sizeY * k);
          const std::size_t out = grid.index(cell.lower[0] + cell.begin[0], cell.lower[1] + j, cell.lower[2] + k);
          std::int32_t* ids = fibreId + out;
          float* depths = depth + out;
          for (int i = cell.begin[0]; i < cell.end[0]; ++i, ++ids, ++depths)
          {
            const float best = cell.best[row + i];
            const float f = std::min(best + g, 0.5f * (best - cell.second[row + i]) - w);
            const bool inside = f > 0.0f;
            *ids = inside ? idOfRank[static_cast<std::size_t>(cell.rank[row + i])] : 0;
            *depths = inside ? f : std::max(f, lowest);
          }
        }
      }
    });
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
