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

/// Growth beyond this (µm) is not considered.
constexpr double largestGrowth = 8.0;

/// A histogram of the growth at which the samples of a grid become part of a fibre.
struct Arrivals
{
  double first = 0.0;                ///< growth at the lower end of the first class
  std::vector<std::uint64_t> counts; ///< samples that become part of a fibre in each class
  std::uint64_t reachable = 0;       ///< sum of counts
  std::uint64_t samples = 0;         ///< all samples
};

/// Counts the samples of `grid`, up to a growth of `reach`. Throws OutOfMemory and Cancelled.
Arrivals countArrivals(const Fibres& fibres, const FibreRadialGrowthOptions& options, const VoxelGrid& grid, double reach,
  const Context& context, const Sharing& sharing = Sharing());

/// Returns the growth at which `target` of the samples lie in a fibre; infinite if the counts end before.
double growthAt(const Arrivals& arrivals, double target);

/// Returns the growth at which all samples that can be reached lie in a fibre. There has to be one.
double growthOfAll(const Arrivals& arrivals);

/// Number of samples that are counted to find the growth that meets a target.
constexpr double samplesForTarget = 8e6;

/// Returns a grid of about `samples` points spread evenly over the domain.
VoxelGrid sampleGrid(const Domain& domain, double samples);

/// Returns the growth at which few samples meet the target, as a rough estimate; infinite if they do not.
double roughGrowth(
  const Fibres& fibres, const FibreRadialGrowthOptions& options, const Context& context, const Sharing& sharing = Sharing());

} // namespace cactus
