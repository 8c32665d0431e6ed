// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Sharing.h"
#include "fibres/Fibres.h"
#include "growth/FibreRadialGrowth.h"

namespace cactus
{

/// Returns the growth g (µm, see growFibres), possibly negative, that the options ask for: growthIterations voxels, or the growth
/// with which the fibres fill targetFibreVolumeFraction of the whole domain. The fraction is counted over about eight million
/// sample points spread evenly over the domain, so it depends neither on the voxel size nor on the requested part of the image.
/// Throws InvalidInput (options, fibres); Infeasible, with the largest fraction that can be reached, if a target cannot be
/// reached, or if it needs so much shrinkage that a fibre vanishes; OutOfMemory; Cancelled.
double growthFor(
  const Fibres& fibres, const FibreRadialGrowthOptions& options, const Context& context = {}, const Sharing& sharing = Sharing());

} // namespace cactus
