// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <vector>

namespace cactus
{

/// An axis-aligned rectangle (µm).
struct Rectangle
{
  Eigen::Vector2d lower = Eigen::Vector2d::Zero();
  Eigen::Vector2d upper = Eigen::Vector2d::Zero();

  Eigen::Vector2d size() const { return upper - lower; }
  double area() const { return size().prod(); }
  /// Where a circle's centre may be so that the circle is wholly inside; the middle where it is too large for that.
  Eigen::Vector2d clampCentre(const Eigen::Vector2d& centre, double radius) const
  {
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
  /// Sum of the circles' areas over the sum of the rectangles'.
  double density() const;
};

/// Proposes the n-th centre to try for a circle. The centre must keep the circle inside its rectangle.
using CentreProposal = std::function<Eigen::Vector2d(std::size_t circle, int trial)>;

/// Sets all centres: circles are placed largest first (ties by index), each at the first of its proposals that overlaps no circle
/// placed before, or else at the proposal that overlaps least (sum of squared depths). A 2-D grid finds the neighbours.
void placeCircles(Circles& circles, const CentreProposal& propose, int trials);

/// How relaxCircles moves circles and when it gives up.
struct RelaxationOptions
{
  int maximumIterations = 20000;
  /// Radii are taken larger by this fraction while moving, so that the true circles come apart after finitely many steps.
  double clearance = 2e-5;
  /// Given up as jammed once the net forces are this small beside the contact forces.
  double jammedBalance = 1e-4;
};

/// What relaxCircles reached.
struct Relaxation
{
  bool separated = false;      ///< no two circles overlap
  double largestOverlap = 0.0; ///< max 1 − d/(ri + rj) over all pairs, or 0
  int iterations = 0;
};

/// Moves the circles apart until no two overlap, each staying inside its rectangle: harmonic repulsion of overlapping pairs,
/// minimised with FIRE (Bitzek et al., Phys. Rev. Lett. 97, 170201, 2006) on neighbour lists with a skin. Circles that do not
/// overlap at the start stay where they are. Same bits on any number of threads. Where the circles jam or the iterations run out
/// the result says so, and the centres are the last ones. Throws Cancelled.
Relaxation relaxCircles(Circles& circles, const RelaxationOptions& options = {}, const Context& context = {});

} // namespace cactus
