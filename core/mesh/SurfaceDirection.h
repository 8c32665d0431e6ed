// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Domain.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace cactus
{

/// Finds the direction along which a fibre's surface runs on the whole: the principal axis of its tangents. Normals of a tube are
/// across its tangents, so that this is the axis along which their squares, times their areas, sum up to the least. Caps in the
/// faces of the domain do not count.
class SurfaceDirection
{
public:
  /// Adds a triangle by its corners.
  void add(const Domain& domain, const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
  {
    for (Eigen::Index axis = 0; axis < 3; ++axis)
    {
      if (a[axis] == b[axis] && a[axis] == c[axis] && (a[axis] == domain.lower[axis] || a[axis] == domain.upper[axis]))
      {
        return;
      }
    }
    const Eigen::Vector3d normal = (b - a).cross(c - a); // twice the area long
    const double length = normal.norm();
    if (length > 0.0)
    {
      this->Normals += normal * normal.transpose() / length;
    }
  }

  /// Returns the direction, of length 1 and either sense; zero without triangles.
  Eigen::Vector3d direction() const
  {
    if (!(this->Normals.trace() > 0.0))
    {
      return Eigen::Vector3d::Zero();
    }
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(this->Normals).eigenvectors().col(0); // of the least eigenvalue
  }

private:
  Eigen::Matrix3d Normals = Eigen::Matrix3d::Zero();
};

} // namespace cactus
