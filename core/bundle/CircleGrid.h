// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bundle/Circles.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace cactus
{

/// A grid of square cells over a rectangle that finds the circles near a point.
struct CircleGrid
{
  CircleGrid(const Rectangle& bounds, double wantedCell, std::size_t circles)
    : origin(bounds.lower)
  {
    // Avoids many more cells than circles, however small the circles are beside the rectangle.
    const double least = std::sqrt(bounds.area() / (4.0 * static_cast<double>(circles) + 16.0));
    cell = std::max(wantedCell, least);
    for (int axis = 0; axis < 2; ++axis)
    {
      count[axis] = std::max(1, static_cast<int>(std::ceil(bounds.size()[axis] / cell)));
    }
  }
  int coordinate(double value, int axis) const
  {
    return std::clamp(static_cast<int>(std::floor((value - origin[axis]) / cell)), 0, count[axis] - 1);
  }
  std::size_t index(int x, int y) const
  {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(count[0]) + static_cast<std::size_t>(x);
  }
  std::size_t index(const Eigen::Vector2d& p) const { return index(coordinate(p.x(), 0), coordinate(p.y(), 1)); }
  std::size_t size() const { return static_cast<std::size_t>(count[0]) * static_cast<std::size_t>(count[1]); }
  /// Calls visit(cell index) for the cells that a square of half side `reach` around p touches, in a fixed order.
  template <typename Visit>
  void around(const Eigen::Vector2d& p, double reach, Visit&& visit) const
  {
    const int x1 = coordinate(p.x() + reach, 0);
    const int y1 = coordinate(p.y() + reach, 1);
    for (int y = coordinate(p.y() - reach, 1); y <= y1; ++y)
    {
      for (int x = coordinate(p.x() - reach, 0); x <= x1; ++x)
      {
        visit(index(x, y));
      }
    }
  }

  Eigen::Vector2d origin;
  double cell;
  std::array<int, 2> count{ { 1, 1 } };
};

} // namespace cactus
