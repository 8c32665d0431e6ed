// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Random.h"
#include "bundle/Circles.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace cactus
{

/// The paths of points that a flow has carried.
struct FlowPaths
{
  std::vector<std::vector<Eigen::Vector2d>> places; ///< all points at evenly spaced times, from the first to the last (µm)
  bool isFarEnough = false;                         ///< whether the requested mean angle was reached

  /// Returns a point's position at a fraction of the time minus that on the straight line between its ends (µm), by cubics
  /// through its places (Catmull and Rom 1974). Zero if there are no places, and at both ends.
  Eigen::Vector2d bend(std::size_t point, double share) const;
};

/// A steady random flow within a rectangle that preserves areas and does not cross the rim: the curl of a Gaussian random stream
/// function that is zero there. Nearby points are shifted alike, and are neither crowded nor thinned out.
///
/// The stream function is a sum of sin(mπx/a) sin(nπy/b) with normal coefficients, scaled by exp(−k²ℓ²/8), k being the wave
/// number and ℓ the correlation length: away from the rim its correlation at a distance d is exp(−d²/ℓ²). A length beyond the
/// rectangle's leaves a single eddy.
class CoherentFlow
{
public:
  /// The smallest correlation length, as a share of the rectangle's longer side, that can be resolved.
  static constexpr double smallestLength = 1.0 / 128.0;

  /// Draws the flow. Lengths in µm. Throws InvalidInput, naming CorrelationLength, if it is shorter than smallestLength allows.
  CoherentFlow(const Rectangle& frame, double correlationLength, RandomEngine& engine);

  /// Carries all points, which lie in the rectangle, until the mean of atan2(shift, height) over them is `meanAngle` (radians).
  /// If the mean never becomes that large, because the flow carries the points round and back, they stop where it is largest, and
  /// isFarEnough is false. Throws Cancelled. Gives the same bits on any number of threads.
  FlowPaths carry(const std::vector<Eigen::Vector2d>& points, double height, double meanAngle, const Context& context = {}) const;

private:
  Eigen::Vector2d velocity(const Eigen::Vector2d& point, std::vector<double>& work) const;
  double stepTime() const;
  /// Returns the time after which the mean angle is `meanAngle`, or largest.
  double timeTo(
    const std::vector<Eigen::Vector2d>& start, double height, double meanAngle, bool& isFarEnough, const Context& context) const;
  void advance(std::vector<Eigen::Vector2d>& points, double time, const Context& context) const;

  Rectangle Frame;
  double Length; ///< correlation length, at most the rectangle's longer side
  Eigen::ArrayXXd Coefficients;
  Eigen::Array2d Wave; ///< π over the sides, 1/µm
};

} // namespace cactus
