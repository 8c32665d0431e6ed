// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "bundle/BundleInitializerOptions.h"
#include "bundle/BundleLayout.h"

#include <Eigen/Core>

#include <vector>

namespace cactus
{

/// How a bundle's fibres lie to its nominal axis.
struct Orientation
{
  double meanAngle = 0.0; ///< degrees, of the fibres to the axis
  double drift = 0.0;     ///< degrees, of the fibres' mean direction to the axis
  /// Per component, sum over sum of magnitudes of the fibres' directions: by how much one sense outweighs the other.
  Eigen::Vector2d bias = Eigen::Vector2d::Zero();
};

/// Precondition: both faces are packed.
Orientation orientationOf(const Bundle& bundle);

/// Places the circles on both faces of bundles that have been laid out, so that none overlap and the fibres between them have the
/// dispersion asked for (see initialiseBundles()). Throws Infeasible where density or dispersion cannot be met, and Cancelled.
void packFaces(std::vector<Bundle>& bundles, const BundleInitializerOptions& options, const Context& context);

} // namespace cactus
