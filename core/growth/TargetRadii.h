// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Sharing.h"
#include "fibres/Fibres.h"
#include "growth/FibreRadialGrowth.h"

#include <string>
#include <vector>

namespace cactus
{

/// Returns the fibres with capsule radii from which common growth to the target fraction brings every fibre to its target radius:
/// each fills as much of the domain as capsules of that radius would. If all of them together would fill less than the fraction,
/// all final radii are larger by the same amount, but for axons without myelin, which keep their volume, or their share of it
/// where they are the most; if more, smaller by the same factor. Without a target, returns the fibres unchanged.
///
/// It takes a few rounds: grow on a coarse grid, count each fibre's samples, and change all radii of a fibre by a common factor
/// that follows its shortage or excess. Counts are integers, so the result is the same on any number of threads.
///
/// No fibre is cut in two by a neighbour if their capsules did not overlap: a fibre beside a much thinner one is thickened only
/// as far as that one stays in one piece, and gets the rest from growth, like all others.
///
/// Throws InvalidInput (options, fibres), OutOfMemory, Cancelled. Processes that share the work count a part of the samples each,
/// and all get the result.
Fibres aimAtTargetRadii(
  const Fibres& fibres, const FibreRadialGrowthOptions& options, const Context& context = {}, const Sharing& sharing = Sharing());

/// Returns the factors of aimAtTargetRadii(), one per fibre; none without a target.
std::vector<double> factorsForTargetRadii(
  const Fibres& fibres, const FibreRadialGrowthOptions& options, const Context& context = {}, const Sharing& sharing = Sharing());

/// Returns the fibres with their capsule radii multiplied by the factors, within limits::radius; unchanged without factors.
Fibres scaledBy(const std::vector<double>& factors, const Fibres& fibres);

/// Returns a remark if growth will not end at the target radii, because the fibres were made for another fraction than the one
/// they grow to, with the difference; empty if the two agree, or if the fraction they were made for is unknown.
std::string remarkOnTarget(const Fibres& fibres, const FibreRadialGrowthOptions& options);

} // namespace cactus
