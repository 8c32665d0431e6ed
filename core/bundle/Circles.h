// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Domain.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace cactus
{

/// An axis-aligned rectangle (µm).
struct Rectangle
{
  Eigen::Vector2d lower = Eigen::Vector2d::Zero();
  Eigen::Vector2d upper = Eigen::Vector2d::Zero();
  bool repeats = false; ///< whether a circle that leaves it comes in again on the other side; centres may then lie outside

  Eigen::Vector2d size() const { return upper - lower; }
  double area() const { return size().prod(); }
  /// Returns a vector between two centres, or that to the nearest image of the other.
  Eigen::Vector2d shortest(const Eigen::Vector2d& apart) const
  {
    return repeats ? Eigen::Vector2d(apart.binaryExpr(size(), &nearestImage)) : apart;
  }
  /// Returns the image of a centre in the rectangle.
  Eigen::Vector2d inside(const Eigen::Vector2d& centre) const
  {
    return repeats ? Eigen::Vector2d(centre.array() - ((centre - lower).array() / size().array()).floor() * size().array())
                   : centre;
  }
  /// Returns the nearest centre for which the circle is wholly inside; the middle of the rectangle if the circle is too large. A
  /// rectangle that repeats returns any centre.
  Eigen::Vector2d clampCentre(const Eigen::Vector2d& centre, double radius) const
  {
    if (repeats)
    {
      return centre;
    }
    const Eigen::Vector2d margin = (0.5 * size()).cwiseMin(radius);
    return centre.cwiseMax(lower + margin).cwiseMin(upper - margin);
  }
  bool holds(const Eigen::Vector2d& centre, double radius) const
  {
    return ((centre - lower).array() >= radius).all() && ((upper - centre).array() >= radius).all();
  }
};

/// Circles (µm), each confined to one of a few rectangles. Rectangles must not overlap one another.
struct Circles
{
  std::vector<double> radii;
  std::vector<Eigen::Vector2d> centres;
  std::vector<int> frameOf; ///< per circle, the index of its rectangle
  std::vector<Rectangle> frames;

  std::size_t size() const { return radii.size(); }
  const Rectangle& frame(std::size_t circle) const { return frames[static_cast<std::size_t>(frameOf[circle])]; }
  /// Returns the sum of the circles' areas over the sum of the rectangles'.
  double density() const;
};

/// Returns the smallest rectangle that holds all frames, of which there is at least one.
Rectangle boundingRectangle(const std::vector<Rectangle>& frames);

} // namespace cactus
