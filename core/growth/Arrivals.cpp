// SPDX-License-Identifier: BSD-3-Clause
#include "growth/Arrivals.h"

#include "growth/CapsuleField.h"
#include "growth/RankedGrowth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace cactus
{

namespace
{

/// Width of the classes (µm) in which arrivals are counted.
constexpr double growthClass = 0.00025;

/// Returns the layers of a grid that this process counts, in whole blocks of a sweep.
VoxelGrid partOf(const VoxelGrid& grid, const Sharing& sharing)
{
  constexpr int layers = 16;
  const int blocks = (grid.count[2] + layers - 1) / layers;
  const auto startOf = [&](int place)
  { return std::min(grid.count[2], layers * static_cast<int>(std::int64_t(blocks) * place / sharing.size())); };
  VoxelGrid part = grid;
  part.lower[2] += startOf(sharing.place());
  part.count[2] = startOf(sharing.place() + 1) - startOf(sharing.place());
  return part;
}

double largestRadius(const Fibres& fibres)
{
  return *std::max_element(fibres.radii.begin(), fibres.radii.end());
}

} // namespace

Arrivals countArrivals(const Fibres& fibres, const FibreRadialGrowthOptions& options, const VoxelGrid& grid, double reach,
  const Context& context, const Sharing& sharing)
{
  const double first = -largestRadius(fibres) - growthClass;
  const auto classes = std::size_t(std::ceil((reach - first) / growthClass)) + 1;
  Context sweeping = context;
  sweeping.threads = context.threadCount(); // fixed here, because it may change between calls
  std::vector<std::vector<std::uint64_t>> perThread(std::size_t(sweeping.threads), std::vector<std::uint64_t>(classes + 1, 0));
  const auto never = static_cast<int>(classes);
  FieldRelevance relevance;
  relevance.bestReach = reach;
  relevance.secondReach = reach;
  relevance.contrast = options.gap();
  const CapsuleField field(
    fibres, seedOptions(fibres, options), grid.box(), reach + options.gap() + grid.spacing, context.threadCount());
  const auto gap = static_cast<float>(options.gap());
  const RankedGrowth growth(fibres, options, field, reach);
  const bool isUneven = growth.isUneven();
  field.sweep(partOf(grid, sharing), relevance, sweeping, 0.3, 0.5, "finding the growth that reaches the target",
    [&](const FieldCell& cell, int thread)
    {
      // First the class of each sample, without branches; samples that never arrive have their own class.
      std::array<int, FieldCell::size> classOf;
      for (std::size_t n = 0; n < classOf.size(); ++n)
      {
        const double own = -static_cast<double>(cell.best[n]);
        const double arrival = isUneven ? growth.commonFor(cell.rank[n], own) : own;
        const int reached = static_cast<int>((std::min(arrival, reach) - first) / growthClass);
        classOf[n] = (int(arrival < reach) & int(cell.best[n] - cell.second[n] > gap)) != 0 ? reached : never;
      }
      auto& counts = perThread[std::size_t(thread)];
      cell.forEachSample([&](int n) { ++counts[std::size_t(classOf[std::size_t(n)])]; });
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
    }
  }
  sharing.addUp(arrivals.counts);
  arrivals.reachable = std::accumulate(arrivals.counts.begin(), arrivals.counts.end(), std::uint64_t(0));
  return arrivals;
}

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
  return std::numeric_limits<double>::infinity();
}

double growthOfAll(const Arrivals& arrivals)
{
  const auto last = std::find_if(arrivals.counts.rbegin(), arrivals.counts.rend(), [](std::uint64_t count) { return count > 0; });
  return arrivals.first + growthClass * static_cast<double>(arrivals.counts.rend() - last);
}

VoxelGrid sampleGrid(const Domain& domain, double samples)
{
  const Eigen::Vector3d size = domain.size();
  VoxelGrid grid;
  grid.spacing = std::cbrt(domain.volume() / samples);
  for (int axis = 0; axis < 3; ++axis)
  {
    const int count = std::max(1, static_cast<int>(std::round(size[axis] / grid.spacing)));
    grid.count[static_cast<std::size_t>(axis)] = count;
    // Centred: the rest of a side is divided between its two ends.
    grid.origin[axis] = domain.lower[axis] + 0.5 * (size[axis] - (count - 1) * grid.spacing);
  }
  return grid;
}

double roughGrowth(const Fibres& fibres, const FibreRadialGrowthOptions& options, const Context& context, const Sharing& sharing)
{
  Context quiet = context;
  quiet.progress = nullptr;
  const VoxelGrid grid = sampleGrid(fibres.domain, samplesForTarget / 64.0);
  return growthAt(countArrivals(fibres, options, grid, largestGrowth, quiet, sharing), targetFraction(fibres, options));
}

} // namespace cactus
