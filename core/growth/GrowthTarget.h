// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Sharing.h"
#include "fibres/Fibres.h"
#include "growth/FibreRadialGrowth.h"

#include <string>

namespace cactus
{

/// How far fibres grow.
struct SolvedGrowth
{
  double growth = 0.0;   ///< µm, see growFibres(); possibly negative
  double fraction = 0.0; ///< of the domain that they fill then, if that is less than the target; otherwise 0
};

/// Returns the growth that the options ask for: growthIterations voxels, or the growth with which the fibres fill
/// targetFibreVolumeFraction of the whole domain, or as much of it as they can. The fraction is counted over about eight million
/// sample points spread evenly over the domain, so it depends neither on the voxel size nor on the requested part of the image.
/// Throws InvalidInput (options, fibres); Infeasible if a target needs so much shrinkage that a fibre vanishes, or if no part of
/// the domain can be reached; OutOfMemory; Cancelled.
SolvedGrowth growthFor(
  const Fibres& fibres, const FibreRadialGrowthOptions& options, const Context& context = {}, const Sharing& sharing = Sharing());

/// Returns a remark with both fractions if the target is not reached; otherwise empty.
std::string remarkOnGrowth(const Fibres& fibres, const FibreRadialGrowthOptions& options, const SolvedGrowth& solved);

} // namespace cactus
