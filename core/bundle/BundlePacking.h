// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "bundle/BundleInitializerOptions.h"
#include "bundle/BundleLayout.h"
#include "bundle/StationaryFlow.h"

#include <Eigen/Core>

#include <vector>

namespace cactus
{

/// The orientation of a bundle's fibres relative to its nominal axis.
struct Orientation
{
  double meanAngle = 0.0; ///< degrees, between the fibres and the axis
  double drift = 0.0;     ///< degrees, between the fibres' mean direction and the axis
  /// Per component, the sum of the fibres' directions over the sum of their magnitudes: how much one sense outweighs the other.
  Eigen::Vector2d bias = Eigen::Vector2d::Zero();
};

/// Measures a bundle. Precondition: both faces are packed.
Orientation orientationOf(const Bundle& bundle);

/// Places the circles on both faces of laid-out bundles, so that none overlap and the fibres between them have the requested
/// dispersion (see initialiseBundles()). With a stationary flow, circles are placed in the middle of the bundle instead, and
/// follow it both ways. Throws Infeasible if density or dispersion cannot be met, and Cancelled.
void packFaces(std::vector<Bundle>& bundles, const BundleInitializerOptions& options, const Context& context,
  const StationaryFlow* flow = nullptr);

} // namespace cactus
