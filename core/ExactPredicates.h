// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace cactus
{

/// Signs of determinants, never wrong by rounding: computed in double precision, and where the bound of its error leaves the sign
/// open, once more in exact arithmetic on sums of doubles (Shewchuk 1997, "Adaptive precision floating-point arithmetic and fast
/// robust geometric predicates"). Exact for coordinates that are 0 or between 1e-70 and 1e70 in size, in any unit.

/// Sign of det(a − d, b − d, c − d): 1 where a, b, c run clockwise seen from d (d lies on the inner side of an outward triangle),
/// −1 where they run counter-clockwise, and 0 where the four lie in one plane.
int orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d);

/// Sign of the area of a, b, c projected along coordinate axis `dropped` (0, 1, 2): 1 where they run counter-clockwise in the
/// plane of the two axes that follow, −1 where clockwise, 0 where they lie on one line.
int orientationAlong(int dropped, const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

} // namespace cactus
