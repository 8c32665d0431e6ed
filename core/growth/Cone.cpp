// SPDX-License-Identifier: BSD-3-Clause
#include "growth/Cone.h"

#include <algorithm>
#include <cmath>

namespace cactus
{

Cone coneBetween(const Eigen::Vector3d& p0, const Eigen::Vector3d& p1, double r0, double r1)
{
  Cone c;
  const Eigen::Vector3d d = p1 - p0;
  c.length = d.norm();
  c.axis = d / c.length;
  c.slope = (r1 - r0) / c.length;
  if (std::abs(c.slope) > 1.0 - 1e-6)
  {
    c.start = r0 < r1 ? p1 : p0;
    c.radius = std::max(r0, r1);
    c.length = 0.0;
    c.slope = 0.0;
    c.lean = 0.0;
    return c;
  }
  c.start = p0;
  c.radius = r0;
  c.lean = c.slope / std::sqrt(1.0 - c.slope * c.slope);
  return c;
}

double coneValue(const Cone& cone, const Eigen::Vector3d& x)
{
  const Eigen::Vector3d d = x - cone.start;
  const double foot = d.dot(cone.axis);
  const double distance2 = (d - foot * cone.axis).squaredNorm();
  const double along = std::min(std::max(foot + cone.lean * std::sqrt(distance2), 0.0), cone.length);
  const double rest = along - foot;
  return cone.radius + cone.slope * along - std::sqrt(distance2 + rest * rest);
}

Eigen::AlignedBox3d boundingBox(const Cone& cone)
{
  Eigen::AlignedBox3d box;
  const Eigen::Vector3d end = cone.start + cone.length * cone.axis;
  const double endRadius = cone.radius + cone.slope * cone.length;
  box.extend((cone.start.array() - cone.radius).matrix()).extend((cone.start.array() + cone.radius).matrix());
  box.extend((end.array() - endRadius).matrix()).extend((end.array() + endRadius).matrix());
  return box;
}

} // namespace cactus
