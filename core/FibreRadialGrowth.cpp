// SPDX-License-Identifier: BSD-3-Clause
#include "FibreRadialGrowth.h"

#include "CapsuleField.h"
#include "Error.h"
#include "Memory.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace cactus
{

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double bandInVoxels = 4.0;
constexpr double samplesForFraction = 8e6;
/// Width of the classes (µm) in which arrival times are counted.
constexpr double growthClass = 0.00025;
/// Growth beyond this (µm) is not looked for.
constexpr double largestGrowth = 8.0;

template <typename... Parts>
std::string text(const Parts&... parts)
{
  std::ostringstream out;
  out << std::setprecision(4);
  (out << ... << parts);
  return out.str();
}

void require(bool good, const char* message)
{
  if (!good)
  {
    throw InvalidInput(message);
  }
}

bool within(double value, double lower, double upper)
{
  return std::isfinite(value) && value >= lower && value <= upper;
}

double largestRadius(const Fibres& fibres)
{
  return *std::max_element(fibres.radii.begin(), fibres.radii.end());
}

/// Box of the samples that a grid holds.
Eigen::AlignedBox3d sampleBox(const VoxelGrid& grid)
{
  Eigen::AlignedBox3d box(grid.position(grid.lower[0], grid.lower[1], grid.lower[2]));
  box.extend(
    grid.position(grid.lower[0] + grid.count[0] - 1, grid.lower[1] + grid.count[1] - 1, grid.lower[2] + grid.count[2] - 1));
  return box;
}

/// Of all samples: how many fibres reach only after some growth, by classes of that growth.
struct Arrivals
{
  double first = 0.0;                ///< growth at the lower end of the first class
  std::vector<std::uint64_t> counts; ///< samples that become part of a fibre in each class
  std::uint64_t reachable = 0;       ///< sum of counts
  std::uint64_t samples = 0;         ///< all samples
};

/// Counts over `grid` the growth at which each sample becomes part of a fibre, up to `reach`.
Arrivals countArrivals(
  const Fibres& fibres, const FibreRadialGrowthOptions& options, const VoxelGrid& grid, double reach, const Context& context)
{
  const double first = -largestRadius(fibres) - growthClass;
  const auto classes = std::size_t(std::ceil((reach - first) / growthClass)) + 1;
  const int threads = context.threadCount();
  std::vector<std::vector<std::uint64_t>> perThread(std::size_t(threads), std::vector<std::uint64_t>(classes, 0));
  FieldRelevance relevance;
  relevance.bestReach = reach;
  relevance.secondReach = reach;
  relevance.contrast = options.gap();
  const CapsuleField field(
    fibres, { options.surfaceRoughness, options.seed }, sampleBox(grid), reach + options.gap() + grid.spacing);
  const auto gap = static_cast<float>(options.gap());
  field.sweep(grid, relevance, context, 0.0, 0.5, "finding the growth that reaches the target",
    [&](const FieldCell& cell, int thread)
    {
      auto& counts = perThread[std::size_t(thread)];
      for (int k = cell.begin[2]; k < cell.end[2]; ++k)
      {
        for (int j = cell.begin[1]; j < cell.end[1]; ++j)
        {
          const int row = FieldCell::sizeX * (j + FieldCell::sizeY * k);
          for (int i = row + cell.begin[0]; i < row + cell.end[0]; ++i)
          {
            const double arrival = -static_cast<double>(cell.best[i]);
            if (arrival < reach && cell.best[i] - cell.second[i] > gap)
            {
              ++counts[std::size_t((arrival - first) / growthClass)];
            }
          }
        }
      }
    });
  Arrivals arrivals;
  arrivals.first = first;
  arrivals.samples = grid.size();
  arrivals.counts.assign(classes, 0);
  for (const auto& counts : perThread)
  {
    for (std::size_t c = 0; c < classes; ++c)
    {
      arrivals.counts[c] += counts[c];
      arrivals.reachable += counts[c];
    }
  }
  return arrivals;
}

/// The growth at which `target` of the samples lie in a fibre; infinite where the counts end before.
double growthAt(const Arrivals& arrivals, double target)
{
  const double needed = target * static_cast<double>(arrivals.samples);
  double before = 0.0;
  for (std::size_t c = 0; c < arrivals.counts.size(); ++c)
  {
    const auto count = static_cast<double>(arrivals.counts[c]);
    if (count > 0.0 && before + count >= needed)
    {
      return arrivals.first + growthClass * (static_cast<double>(c) + (needed - before) / count);
    }
    before += count;
  }
  return infinity;
}

/// About `samples` points spread evenly over the domain.
VoxelGrid sampleGrid(const Domain& domain, double samples)
{
  const Eigen::Vector3d size = domain.size();
  VoxelGrid grid;
  grid.spacing = std::cbrt(domain.volume() / samples);
  for (int axis = 0; axis < 3; ++axis)
  {
    const int count = std::max(1, static_cast<int>(std::round(size[axis] / grid.spacing)));
    grid.count[static_cast<std::size_t>(axis)] = count;
    // Centred: what a side leaves over is shared by its two ends.
    grid.origin[axis] = domain.lower[axis] + 0.5 * (size[axis] - (count - 1) * grid.spacing);
  }
  return grid;
}

/// Where growth goes for a fraction: the fibres with capsules of their target radii, on average along each; none where they have
/// these already.
std::optional<Fibres> atTargetRadii(const Fibres& fibres, const FibreRadialGrowthOptions& options)
{
  std::optional<Fibres> result;
  for (std::size_t f = 0; f < fibres.size() && options.targetFibreVolumeFraction > 0.0; ++f)
  {
    const std::size_t begin = fibres.offsets[f];
    const std::size_t end = fibres.offsets[f + 1];
    double sum = 0.0;
    for (std::size_t p = begin; p < end; ++p)
    {
      sum += fibres.radii[p];
    }
    const double factor = fibres.targetRadii[f] * static_cast<double>(end - begin) / sum;
    if (std::abs(factor - 1.0) < 1e-6)
    {
      continue;
    }
    if (!result)
    {
      result = fibres;
    }
    for (std::size_t p = begin; p < end; ++p)
    {
      result->radii[p] *= factor;
    }
  }
  return result;
}

} // namespace

void validate(const FibreRadialGrowthOptions& options)
{
  require(std::isfinite(options.voxelSize) && options.voxelSize > 0.0, "VoxelSize must be a positive number of µm");
  require(std::isfinite(options.targetFibreVolumeFraction) && options.targetFibreVolumeFraction >= 0.0 &&
            options.targetFibreVolumeFraction < 1.0,
    "TargetFibreVolumeFraction must be at least 0 (no target) and less than 1");
  require(options.growthIterations >= 0, "GrowthIterations must not be negative");
  require(within(options.minimumGap, 0.0, 1e6), "MinimumGap must be a number of µm, 0 or more");
  require(within(options.surfaceTolerance, 0.0, 1e6), "SurfaceTolerance must be a number of µm, 0 or more");
  require(within(options.surfaceRoughness, 0.0, 0.5), "SurfaceRoughness must be between 0 and 0.5");
  require(within(options.margin, 0.0, 1e6), "Margin must be a number of µm, 0 or more");
}

VoxelGrid growthGrid(const Domain& domain, const FibreRadialGrowthOptions& options)
{
  validate(options);
  require(!domain.isPeriodic(), "FibreRadialGrowth does not support a periodic Domain: clear its periodic axes");
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

double growthFor(const Fibres& capsules, const FibreRadialGrowthOptions& options, const Context& context)
{
  validate(capsules);
  const std::optional<Fibres> thickened = atTargetRadii(capsules, options);
  const Fibres& fibres = thickened ? *thickened : capsules;
  const VoxelGrid whole = growthGrid(fibres.domain, options);
  const double target = options.targetFibreVolumeFraction;
  if (target <= 0.0)
  {
    return options.growthIterations * whole.spacing;
  }

  // Few samples tell roughly how far to grow: the less far the many have to look, the faster.
  Context quiet = context;
  quiet.progress = nullptr;
  const Arrivals rough =
    countArrivals(fibres, options, sampleGrid(fibres.domain, samplesForFraction / 64.0), largestGrowth, quiet);
  double reach = std::min(growthAt(rough, target) + 0.1, largestGrowth);
  Arrivals arrivals = countArrivals(fibres, options, sampleGrid(fibres.domain, samplesForFraction), reach, context);
  while (!(growthAt(arrivals, target) < infinity) && reach < largestGrowth)
  {
    reach = std::min(reach + 2.0, largestGrowth);
    arrivals = countArrivals(fibres, options, sampleGrid(fibres.domain, samplesForFraction), reach, context);
  }
  const double growth = growthAt(arrivals, target);
  if (!(growth < infinity))
  {
    throw Infeasible(text("TargetFibreVolumeFraction ", target, " cannot be reached: growth fills at most ",
      static_cast<double>(arrivals.reachable) / static_cast<double>(arrivals.samples), " of the domain with MinimumGap ",
      options.minimumGap, " and SurfaceTolerance ", options.surfaceTolerance,
      " µm. Ask for less, make the gap smaller, or start from more fibres"));
  }
  // The shrunk chain of a fibre is all that is sure to be there along the whole of it.
  const auto thinnest = std::min_element(fibres.radii.begin(), fibres.radii.end());
  if (growth <= -*thinnest * (1.0 - options.surfaceRoughness))
  {
    const auto point = static_cast<std::size_t>(thinnest - fibres.radii.begin());
    const auto next = std::upper_bound(fibres.offsets.begin(), fibres.offsets.end(), point);
    const auto fibre = static_cast<std::size_t>(next - fibres.offsets.begin()) - 1;
    throw Infeasible(text("TargetFibreVolumeFraction ", target, " needs all fibres shrunk by ", -growth,
      " µm, which severs fibre ", fibres.fibreIds[fibre], " of radius ", *thinnest,
      " µm: ask for more, choose a smaller SurfaceRoughness, or start from fewer fibres"));
  }
  return growth;
}

void growFibres(const Fibres& capsules, const FibreRadialGrowthOptions& options, double growth, const VoxelGrid& part,
  std::int32_t* fibreId, float* depth, const Context& context)
{
  validate(capsules);
  const std::optional<Fibres> thickened = atTargetRadii(capsules, options);
  const Fibres& fibres = thickened ? *thickened : capsules;
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
  const CapsuleField field(fibres, { options.surfaceRoughness, options.seed }, sampleBox(grid), std::max(reach, 0.0));
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
