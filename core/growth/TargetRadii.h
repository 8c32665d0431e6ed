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
/// each fills as much of the domain as capsules of that radius would. If all of them together would fill somewhat less than the
/// fraction that they were made for (Fibres::grownFraction), all final radii are larger by the same factor; if less than the
/// target still, larger by the same amount. Axons without myelin then keep their volume, or their share of it where they are the
/// most. If they would fill more than the target, all are smaller by the same factor. Without a target, returns the fibres
/// unchanged.
///
/// It takes a few rounds: grow on a coarse grid, count each fibre's samples, and change the radii of a fibre by a factor that
/// follows its shortage or excess. Counts are integers, so the result is the same on any number of threads.
///
/// No fibre is cut in two by a neighbour if their capsules did not overlap: beside a much thinner fibre, one is thickened only as
/// far as that one stays in one piece, and gets the rest elsewhere and from growth, like all others.
///
/// Throws InvalidInput (options, fibres), OutOfMemory, Cancelled. Processes that share the work count a part of the samples each,
/// and all get the result.
Fibres aimAtTargetRadii(
  const Fibres& fibres, const FibreRadialGrowthOptions& options, const Context& context = {}, const Sharing& sharing = Sharing());

/// Returns the factors of aimAtTargetRadii(), one per control point; none without a target.
std::vector<double> factorsForTargetRadii(
  const Fibres& fibres, const FibreRadialGrowthOptions& options, const Context& context = {}, const Sharing& sharing = Sharing());

/// Returns the fibres with the radii of their control points multiplied by the factors, within limits::radius; unchanged without
/// factors. Throws InvalidInput if there are others than one per control point.
Fibres scaledBy(const std::vector<double>& factors, const Fibres& fibres);

/// Returns a remark if growth will not end at the target radii, because the fibres were made for another fraction than the one
/// they grow to, with the difference; empty if the two agree, or if the fraction they were made for is unknown.
std::string remarkOnTarget(const Fibres& fibres, const FibreRadialGrowthOptions& options);

} // namespace cactus
