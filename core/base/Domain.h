// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace cactus
{

/// Returns the shortest of the ways (µm) to the images of a place that repeats after a period.
inline double nearestImage(double way, double period)
{
  return way - period * std::round(way / period);
}

/// The box (µm) in which a substrate is asked for and measured.
struct Domain
{
  Eigen::Vector3d lower = Eigen::Vector3d::Constant(-15.0);
  Eigen::Vector3d upper = Eigen::Vector3d::Constant(15.0);
  /// Periodicity per axis: what leaves through a periodic face enters through the opposite one. None, x and y, or all.
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
  /// Returns the shifts (µm) to the images of the box that touch it, one of each two opposite ones; none if it is not periodic.
  std::vector<Eigen::Vector3d> shiftsToImages() const
  {
    std::vector<Eigen::Vector3d> shifts;
    const auto most = [this](std::size_t axis) { return periodic[axis] ? 1 : 0; };
    for (int z = 0; z <= most(2); ++z)
    {
      for (int y = z > 0 ? -most(1) : 0; y <= most(1); ++y)
      {
        for (int x = z > 0 || y > 0 ? -most(0) : 1; x <= most(0); ++x)
        {
          shifts.emplace_back(x * size()[0], y * size()[1], z * size()[2]);
        }
      }
    }
    return shifts;
  }
  /// Returns the box in which a fibre along z is measured once: without limits along x and y if these are periodic, since the
  /// fibre goes on through their faces.
  Domain unrolled() const
  {
    Domain all = *this;
    for (Eigen::Index axis = 0; axis < 2; ++axis)
    {
      if (periodic[static_cast<std::size_t>(axis)])
      {
        constexpr double everywhere = 1e9;
        all.lower[axis] = -everywhere;
        all.upper[axis] = everywhere;
      }
    }
    return all;
  }
  /// Returns the image of a point that lies between the faces across x and y, if these are periodic; else the point.
  Eigen::Vector3d inside(const Eigen::Vector3d& point) const
  {
    Eigen::Vector3d image = point;
    for (Eigen::Index axis = 0; axis < 2; ++axis)
    {
      if (periodic[static_cast<std::size_t>(axis)])
      {
        image[axis] -= size()[axis] * std::floor((point[axis] - lower[axis]) / size()[axis]);
      }
    }
    return image;
  }
  /// Returns the shortest way to any image of the place that lies this way, along x and y if these are periodic.
  Eigen::Vector3d nearest(const Eigen::Vector3d& way) const
  {
    Eigen::Vector3d shortest = way;
    for (Eigen::Index axis = 0; axis < 2; ++axis)
    {
      shortest[axis] = periodic[static_cast<std::size_t>(axis)] ? nearestImage(way[axis], size()[axis]) : way[axis];
    }
    return shortest;
  }
  /// Returns the part of the segment from p to q that lies in the box grown by `margin` (µm) on all sides, as fractions of its
  /// length; the second is below the first if no part does.
  std::array<double, 2> clip(const Eigen::Vector3d& p, const Eigen::Vector3d& q, double margin = 0.0) const
  {
    std::array<double, 2> part{ { 0.0, 1.0 } };
    for (Eigen::Index axis = 0; axis < 3; ++axis)
    {
      const double toLower = lower[axis] - margin - p[axis];
      const double toUpper = upper[axis] + margin - p[axis];
      const double along = q[axis] - p[axis];
      if (along != 0.0)
      {
        part[0] = std::max(part[0], std::min(toLower / along, toUpper / along));
        part[1] = std::min(part[1], std::max(toLower / along, toUpper / along));
      }
      else if (toLower > 0.0 || toUpper < 0.0)
      {
        return { { 1.0, 0.0 } };
      }
    }
    return part;
  }
  /// Signed distance to the box in the maximum norm: positive inside.
  double depth(const Eigen::Vector3d& p) const { return (p - lower).cwiseMin(upper - p).minCoeff(); }
};

} // namespace cactus
