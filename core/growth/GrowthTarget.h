// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Sharing.h"
#include "fibres/Fibres.h"
#include "growth/FibreRadialGrowth.h"

namespace cactus
{

/// The growth g (µm, see growFibres) that the options ask for: growthIterations voxels, or what makes the fibres fill
/// targetFibreVolumeFraction of the whole domain, which may be negative. The fraction is counted over about eight million
/// sample points spread evenly over the domain, so it depends neither on the voxel size nor on the part of the image asked for.
/// Throws InvalidInput (options, fibres); Infeasible, with the largest fraction that can be reached, where a target cannot, and
/// where it needs so much shrinkage that a fibre vanishes; OutOfMemory; Cancelled.
double growthFor(
  const Fibres& fibres, const FibreRadialGrowthOptions& options, const Context& context = {}, const Sharing& sharing = Sharing());

} // namespace cactus
