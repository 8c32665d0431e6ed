// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Random.h"

namespace cactus
{

/// How the directions of a bundle's fibres are distributed about its axis.
enum class DispersionModel
{
  Watson, ///< each fibre for itself, from a Watson distribution about the axis: density of directions ∝ exp(κ cos²θ), κ ≥ 0
  Cone,   ///< each fibre for itself, uniform in the cap of a cone around the axis
  Coherent ///< neighbours alike: fibres follow a smooth random flow from face to face (see CoherentFlow)
};

/// Angles to an axis from a model, Watson or Cone, whose mean angle is given; the azimuth is uniform in both.
class DirectionDistribution
{
public:
  /// Solves for the one parameter of the model. `meanAngle` in degrees, in (0, 45]; throws InvalidInput, naming MeanDispersion
  /// or DispersionModel.
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
