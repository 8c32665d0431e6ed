// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <cmath>

namespace cactus
{

/// Signs of determinants, never wrong by rounding: computed in double precision and, if the error bound leaves the sign open,
/// again in exact arithmetic on sums of doubles (Shewchuk 1997, "Adaptive precision floating-point arithmetic and fast robust
/// geometric predicates"). Exact for coordinates that are 0 or between 1e-70 and 1e70 in size, in any unit.

/// Computes orientation() in exact arithmetic only, which is slow.
int exactOrientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d);

/// Returns the sign of det(a − d, b − d, c − d): 1 if a, b, c run clockwise seen from d (d lies on the inner side of an outward
/// triangle), −1 if they run counter-clockwise, and 0 if the four lie in one plane.
inline int orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d)
{
  const double adx = a[0] - d[0];
  const double ady = a[1] - d[1];
  const double adz = a[2] - d[2];
  const double bdx = b[0] - d[0];
  const double bdy = b[1] - d[1];
  const double bdz = b[2] - d[2];
  const double cdx = c[0] - d[0];
  const double cdy = c[1] - d[1];
  const double cdz = c[2] - d[2];
  const double yz = bdy * cdz;
  const double zy = bdz * cdy;
  const double zx = bdz * cdx;
  const double xz = bdx * cdz;
  const double xy = bdx * cdy;
  const double yx = bdy * cdx;
  const double volume = adx * (yz - zy) + ady * (zx - xz) + adz * (xy - yx);
  const double size = std::fabs(adx) * (std::fabs(yz) + std::fabs(zy)) + std::fabs(ady) * (std::fabs(zx) + std::fabs(xz)) +
                      std::fabs(adz) * (std::fabs(xy) + std::fabs(yx));
  constexpr double epsilon = 1.1102230246251565e-16; // half a unit in the last place of 1
  const double bound = (7.0 + 56.0 * epsilon) * epsilon * size;
  if (volume > bound || -volume > bound)
  {
    return volume > 0.0 ? 1 : -1;
  }
  // All terms are 0: in a plane across an axis, as in caps.
  return size == 0.0 ? 0 : exactOrientation(a, b, c, d);
}

/// Returns the sign of the area of a, b, c projected along coordinate axis `dropped` (0, 1, 2): 1 if they run counter-clockwise
/// in the plane of the two axes that follow, −1 if clockwise, 0 if they lie on one line.
int orientationAlong(int dropped, const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

} // namespace cactus
