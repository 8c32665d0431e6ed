// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Random.h"

#include <vector>

namespace cactus
{

/// How the directions of a bundle's fibres are distributed about its axis.
enum class DispersionModel
{
  Watson, ///< independent, from a Watson distribution about the axis: density of directions ∝ exp(κ cos²θ), κ ≥ 0
  Cone,   ///< independent, uniform in the cap of a cone around the axis
  /// similar for neighbours: fibres follow a smooth random flow (see StationaryFlow, and CoherentFlow between walls)
  Coherent,
  Harmonics, ///< independent, from any distribution on the sphere (see HarmonicsDistribution)
  Peaks      ///< independent, of any number of bundles with Watson's distribution about an axis each
};

/// Returns the mean of a quantity of the angle to the axis (radians) over a Watson distribution of concentration κ > 0.
double watsonMean(double kappa, double (*quantity)(double angle));

/// Returns the mean angle to the axis (degrees) of a Watson distribution of concentration κ > 0, and κ for a mean angle above 0
/// and at most 57°.
double watsonMeanAngle(double kappa);
double watsonKappa(double meanAngle);

/// Returns the orientation dispersion index (2/π) arctan(1/κ) (Zhang et al. 2012, NeuroImage 61:1000), and κ for an index.
double odiOfKappa(double kappa);
double kappaOfOdi(double odi);

/// Returns the largest difference between the distribution function of angles to the axis (radians; their mean above 0) and that
/// of the Watson distribution with the same mean.
double distanceToWatson(std::vector<double> angles);

/// Draws angles to an axis from a model, Watson or Cone, with a given mean angle; the azimuth is uniform in both.
class DirectionDistribution
{
public:
  /// Solves for the one parameter of the model. `meanAngle` in degrees, in (0, 45]; throws InvalidInput, naming MeanDispersion
  /// or DispersionModel.
  DirectionDistribution(DispersionModel model, double meanAngle);

  /// Returns κ of the Watson model, or the cone's half opening angle (radians).
  double parameter() const { return Parameter; }
  /// Draws one angle to the axis (radians, in [0, π/2]).
  double sampleAngle(RandomEngine& engine) const;

private:
  DispersionModel Model;
  double Parameter = 0.0;
};

} // namespace cactus
