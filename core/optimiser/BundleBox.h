// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"

#include <Eigen/Core>

#include <vector>

namespace cactus
{

/// A bundle's cuboid: the box, aligned with the bundle's axis, that its fibres fill.
struct BundleBox
{
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ(); ///< direction of the bundle
  Eigen::Vector3d u = Eigen::Vector3d::UnitX();    ///< first lateral direction
  Eigen::Vector3d v = Eigen::Vector3d::UnitY();    ///< second lateral direction
  double lowerU = 0.0, upperU = 0.0;               ///< µm, limits of the fibres' surfaces along u
  double lowerV = 0.0, upperV = 0.0;
  bool holds = false; ///< whether its confinement does not fade
};

/// Returns the cuboid of each fibre's bundle: laterally the extent of the input fibres, widened if they would fill more than
/// `packingLimit` of it. One lateral direction is the domain axis that is most perpendicular to the bundle.
///
/// In a periodic domain, whose copies confine the fibres, cuboids have no limits.
///
/// Cuts to its bulk, and holds, each of several bundles that is larger than the domain and frays: where bundles part that lie in
/// one place, they would otherwise spread into their thin rims, and leave the domain less dense than it came.
std::vector<BundleBox> bundleBoxes(const Fibres& fibres, double packingLimit);

/// Moves apart the fibres of each bundle that fills more than `packingLimit` of its cuboid, each as a whole and across the
/// bundle's axis, until the bundle fills that much. A descent would get there too, but pressure takes longer to spread the wider
/// the bundle is. In a periodic domain there is nowhere to move to.
void spreadBundles(Fibres& fibres, double packingLimit);

} // namespace cactus
