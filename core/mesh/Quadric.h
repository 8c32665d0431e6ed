// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <algorithm>

namespace cactus
{

/// The sum of squared distances to the planes of triangles, weighted by the squares of their areas, as a function of the place
/// (Garland and Heckbert 1997). Lengths in µm.
struct Quadric
{
  double xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0;
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double c = 0.0;

  /// Adds the plane through a point; the length of its normal is the weight's root.
  void addPlane(const Eigen::Vector3d& normal, const Eigen::Vector3d& point)
  {
    const double offset = -normal.dot(point);
    xx += normal[0] * normal[0];
    xy += normal[0] * normal[1];
    xz += normal[0] * normal[2];
    yy += normal[1] * normal[1];
    yz += normal[1] * normal[2];
    zz += normal[2] * normal[2];
    b += offset * normal;
    c += offset * offset;
  }

  Eigen::Vector3d times(const Eigen::Vector3d& p) const
  {
    return { xx * p[0] + xy * p[1] + xz * p[2], xy * p[0] + yy * p[1] + yz * p[2], xz * p[0] + yz * p[1] + zz * p[2] };
  }

  /// Returns the mean squared distance; 0 without planes.
  double error(const Eigen::Vector3d& p) const
  {
    const double weight = xx + yy + zz;
    return weight > 0.0 ? std::max(0.0, (p.dot(this->times(p)) + 2.0 * b.dot(p) + c) / weight) : 0.0;
  }

  /// Returns the place of least error, drawn towards `middle` in directions that the planes do not determine; `middle` itself if
  /// that place is farther than `reach` from it.
  Eigen::Vector3d best(const Eigen::Vector3d& middle, double reach) const
  {
    const double damping = 1e-5 * (xx + yy + zz);
    const double a = xx + damping;
    const double d = yy + damping;
    const double f = zz + damping;
    // Cramer's rule, with the cofactors of the symmetric matrix.
    const Eigen::Vector3d g = this->times(middle) + b;
    const double ca = d * f - yz * yz;
    const double cb = xz * yz - xy * f;
    const double cc = xy * yz - d * xz;
    const double cd = a * f - xz * xz;
    const double ce = xy * xz - a * yz;
    const double cf = a * d - xy * xy;
    const double determinant = a * ca + xy * cb + xz * cc;
    const Eigen::Vector3d step(
      ca * g[0] + cb * g[1] + cc * g[2], cb * g[0] + cd * g[1] + ce * g[2], cc * g[0] + ce * g[1] + cf * g[2]);
    return step.squaredNorm() <= reach * reach * determinant * determinant ? middle - step / determinant : middle;
  }
};

} // namespace cactus
