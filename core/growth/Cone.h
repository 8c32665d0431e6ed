// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace cactus
{

/// The union of the balls whose centre slides from `start` by `length` along `axis` while the radius grows by `slope` per length:
/// a capsule, or a stretch of one.
struct Cone
{
  Eigen::Vector3d start;
  Eigen::Vector3d axis;
  double length;
  double radius; ///< at the start
  double slope;
  double lean; ///< distance along the axis from a point's foot to the centre of its nearest ball, per distance from the axis: m /
               ///< sqrt(1 - m²)
};

/// Returns the cone from p0 to p1; the larger ball alone if it contains the other.
Cone coneBetween(const Eigen::Vector3d& p0, const Eigen::Vector3d& p1, double r0, double r1);

/// Returns the largest radius minus distance to the centre over all balls of the cone.
double coneValue(const Cone& cone, const Eigen::Vector3d& x);

Eigen::AlignedBox3d boundingBox(const Cone& cone);

} // namespace cactus
