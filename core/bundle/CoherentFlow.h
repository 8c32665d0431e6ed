// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Random.h"
#include "bundle/Circles.h"

#include <Eigen/Core>

#include <vector>

namespace cactus
{

/// A steady random flow within a rectangle that keeps areas and lets nothing through the rim: the curl of a Gaussian random
/// stream function that is zero there. Points that it carries along are shifted alike where they are near each other, and are
/// neither crowded nor thinned out.
///
/// The stream function is a sum of sin(mπx/a) sin(nπy/b) with normal coefficients, scaled by exp(−k²ℓ²/8), k being the wave
/// number and ℓ the correlation length: away from the rim its correlation at a distance d is exp(−d²/ℓ²). A length beyond the
/// rectangle's leaves a single eddy.
class CoherentFlow
{
public:
  /// The smallest correlation length, as a share of the rectangle's longer side, that can be resolved.
  static constexpr double smallestLength = 1.0 / 128.0;

  /// Lengths in µm. Throws InvalidInput, naming CorrelationLength, where it is shorter than smallestLength allows.
  CoherentFlow(const Rectangle& frame, double correlationLength, RandomEngine& engine);

  /// Carries all points, which lie in the rectangle, until the mean of atan2(shift, height) over them is `meanAngle` (radians).
  /// Returns false where it never becomes that large, because the flow carries them round and back; points are then those of
  /// the largest mean. Throws Cancelled. Same bits on any number of threads.
  bool carry(std::vector<Eigen::Vector2d>& points, double height, double meanAngle, const Context& context = {}) const;

private:
  Eigen::Vector2d velocity(const Eigen::Vector2d& point, std::vector<double>& work) const;
  void advance(std::vector<Eigen::Vector2d>& points, double time, const Context& context) const;

  Rectangle Frame;
  double Length; ///< correlation length, at most the rectangle's longer side
  Eigen::ArrayXXd Coefficients;
  Eigen::Array2d Wave; ///< π over the sides, 1/µm
};

} // namespace cactus
