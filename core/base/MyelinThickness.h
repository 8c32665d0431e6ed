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

/// Limits of a model's g-ratios: values outside are clamped (LogLinear) or drawn again (Distributed).
constexpr double smallestGRatio = 0.3;
constexpr double largestGRatio = 0.95;

/// Returns the g-ratio of a fibre of outer diameter `outerDiameter` (µm) by the myelin thickness for its axon.
///
/// The relation leaves almost no axon in thin fibres (at 1 µm g is 0.35), for which it was not measured: the result is at least
/// smallestGRatio. It is at most largestGRatio, which is exceeded from 30 µm. Throws InvalidInput unless the diameter is positive
/// and finite.
double logLinearGRatio(double outerDiameter);

} // namespace cactus
