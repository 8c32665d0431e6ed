// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace cactus
{

/// Returns the outer diameter (µm) of a fibre whose axon has diameter D (µm, positive): its myelin is 0.35 + 0.006 D + 0.024 ln D
/// µm thick (Lee et al. 2019, from electron microscopy of mouse corpus callosum; ln is the natural logarithm). It increases with
/// D.
inline double logLinearOuterDiameter(double axonDiameter)
{
  return axonDiameter + 2.0 * (0.35 + 0.006 * axonDiameter + 0.024 * std::log(axonDiameter));
}

} // namespace cactus
