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

/// The fibres with capsules of other radii, from which common growth to the target fraction ends with every fibre at its target
/// radius: each fills as much of the domain as capsules of that radius would. Where all of them together would fill less than the
/// fraction, their radii are to end larger by the same amount; where more, smaller by the same factor. Without a target, the
/// fibres as they are.
///
/// Found by a few rounds: grow on a coarse grid, count each fibre's samples, and change all radii of a fibre by a common factor
/// that follows its shortage or excess. From the counts of whole samples the result is the same on any number of threads.
///
/// Of fibres whose capsules did not overlap none is cut in two by a neighbour: a fibre beside a much thinner one is not thickened
/// beyond what leaves that one whole, and gets the rest from growth, like all others.
///
/// Throws InvalidInput (options, fibres), OutOfMemory, Cancelled.
/// Processes that share it count a part of the samples each, and all get the result.
Fibres aimAtTargetRadii(
  const Fibres& fibres, const FibreRadialGrowthOptions& options, const Context& context = {}, const Sharing& sharing = Sharing());

/// How aimAtTargetRadii() finds them: per fibre the factor on its radii; none without a target.
std::vector<double> factorsForTargetRadii(
  const Fibres& fibres, const FibreRadialGrowthOptions& options, const Context& context = {}, const Sharing& sharing = Sharing());

/// The fibres with capsules of radii so many times as large, within limits::radius; as they are where there are no factors.
Fibres scaledBy(const std::vector<double>& factors, const Fibres& fibres);

/// What is to be said where growth will not end at the target radii because the fibres were made for another fraction than the
/// one that they are grown to, with the difference; empty where the two agree, and where it is not known what they were made for.
std::string remarkOnTarget(const Fibres& fibres, const FibreRadialGrowthOptions& options);

} // namespace cactus
