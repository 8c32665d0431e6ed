// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <array>

namespace cactus
{

/// The box (µm) in which a substrate is asked for and measured.
struct Domain
{
  Eigen::Vector3d lower = Eigen::Vector3d::Constant(-15.0);
  Eigen::Vector3d upper = Eigen::Vector3d::Constant(15.0);
  /// Periodicity per axis. No stage supports a periodic axis yet; each says so with an error.
  std::array<bool, 3> periodic{ { false, false, false } };

  /// The cube [-side/2, side/2]³.
  static Domain cube(double side)
  {
    Domain domain;
    domain.lower.setConstant(-0.5 * side);
    domain.upper.setConstant(0.5 * side);
    return domain;
  }

  Eigen::Vector3d size() const { return upper - lower; }
  double volume() const { return size().prod(); }
  bool isPeriodic() const { return periodic[0] || periodic[1] || periodic[2]; }
  /// Signed distance to the box in the maximum norm: positive inside.
  double depth(const Eigen::Vector3d& p) const { return (p - lower).cwiseMin(upper - p).minCoeff(); }
};

} // namespace cactus
