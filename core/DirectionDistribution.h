// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Random.h"

namespace cactus
{

/// How the angle between a fibre and its bundle's axis is distributed; the azimuth is uniform in both models.
enum class DispersionModel
{
  Watson, ///< Watson distribution about the axis: density of directions ∝ exp(κ cos²θ), κ ≥ 0
  Cone    ///< directions uniform in the cap of a cone around the axis
};

/// Angles to an axis from a model whose mean angle is given.
class DirectionDistribution
{
public:
  /// Solves for the one parameter of the model. `meanAngle` in degrees, in (0, 45]; throws InvalidInput, naming MeanDispersion.
  DirectionDistribution(DispersionModel model, double meanAngle);

  /// κ of the Watson model, half opening angle of the cone (radians) of the other.
  double parameter() const { return Parameter; }
  /// One angle to the axis (radians, in [0, π/2]).
  double sampleAngle(RandomEngine& engine) const;

private:
  DispersionModel Model;
  double Parameter = 0.0;
};

} // namespace cactus
