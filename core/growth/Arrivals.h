// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Sharing.h"
#include "fibres/Fibres.h"
#include "growth/FibreRadialGrowth.h"
#include "growth/LabelImage.h"

#include <cstdint>
#include <vector>

namespace cactus
{

/// Growth beyond this (µm) is not looked for.
constexpr double largestGrowth = 8.0;

/// At how much growth the samples of a grid become part of a fibre: counts by classes of growth.
struct Arrivals
{
  double first = 0.0;                ///< growth at the lower end of the first class
  std::vector<std::uint64_t> counts; ///< samples that become part of a fibre in each class
  std::uint64_t reachable = 0;       ///< sum of counts
  std::uint64_t samples = 0;         ///< all samples
};

/// Counts over `grid`, up to a growth of `reach`. Throws OutOfMemory and Cancelled.
Arrivals countArrivals(const Fibres& fibres, const FibreRadialGrowthOptions& options, const VoxelGrid& grid, double reach,
  const Context& context, const Sharing& sharing = Sharing());

/// The growth at which `target` of the samples lie in a fibre; infinite where the counts end before.
double growthAt(const Arrivals& arrivals, double target);

/// So many samples are counted to find the growth that meets a target.
constexpr double samplesForTarget = 8e6;

/// About `samples` points spread evenly over the domain.
VoxelGrid sampleGrid(const Domain& domain, double samples);

/// The growth at which the target is met over few samples: roughly how far to grow; infinite where it is not met.
double roughGrowth(
  const Fibres& fibres, const FibreRadialGrowthOptions& options, const Context& context, const Sharing& sharing = Sharing());

} // namespace cactus
