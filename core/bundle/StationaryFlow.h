// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "bundle/BundleInitializerOptions.h"
#include "bundle/CoherentFlow.h"
#include "bundle/WaveField.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace cactus
{

/// What a StationaryFlow has in the domain.
struct StationaryFlowReport
{
  double meanAngle = 0.0; ///< degrees, of fibres to the axis at any place, without undulation
  double sinuosity = 1.0; ///< mean length of fibres over the distance of their ends, along one wavelength of undulation
  double stretch = 1.0;   ///< mean length of fibres per height along the axis
};

/// A random flow along z that has the same statistics everywhere, for fibres that run alike with their neighbours: nothing of it
/// depends on where the domain ends, and its lateral scale does not depend on the domain's size. Fibres that follow it are as
/// dense everywhere as on the plane where they were packed, since it preserves areas across z.
///
/// It is the sum of two (see WaveField). The direction's has the lateral correlation length ℓ and changes along z over 8 ℓ; its
/// stream function f(ψ) with f' = exp(bψ), b rising with the angle from 10° on, gives the angles nearly Watson's distribution
/// (within 0.05 of it). The undulation's has waves along z of a wavelength ± 15 %, and a lateral correlation length of 6 µm.
///
/// Both are scaled until, in the domain, the mean angle and the sinuosity are those asked for. Where a domain holds few
/// independent places, several flows are drawn, and the first is taken in which the fibres' angles from end to end are Watson's,
/// all azimuths occur alike, and fibres do not wind around the domain's axis; or that which comes nearest.
class StationaryFlow
{
public:
  /// Draws a flow. Throws InvalidInput, naming CorrelationLength, if it is too short for a domain of this size, and Cancelled.
  /// Gives the same bits on any number of threads.
  static StationaryFlow draw(const BundleInitializerOptions& options, const Context& context);

  const StationaryFlowReport& report() const { return this->Reached; }

  /// Returns the paths of points that lie at these places on the plane z = 0, from the plane −height/2 to height/2. Throws
  /// Cancelled. Gives the same bits on any number of threads.
  FlowPaths carry(const std::vector<Eigen::Vector2d>& middle, double height, const Context& context) const;

private:
  /// One flow with the scale of its velocities.
  struct Part
  {
    WaveField field;
    double scale = 0.0;
    double skewness = 0.0; ///< b in f' = exp(bψ)
  };
  struct Planes
  {
    WaveField::Plane direction;
    WaveField::Plane undulation;
  };
  /// Fibres that follow the flow through the domain.
  struct Sample;

  StationaryFlow(const BundleInitializerOptions& options, int attempt);
  Planes planesAt(double z) const;
  Planes planesAt(double z, std::size_t points, const Context& context) const;
  Eigen::Vector2d slope(const Eigen::Vector2d& point, const Planes& planes, WaveField::Work& work) const;
  void scaleToAngle(const BundleInitializerOptions& options);
  Sample followFibres(const BundleInitializerOptions& options, double height, const Context& context) const;
  Sample scaleToSinuosity(const BundleInitializerOptions& options, const Context& context);

  Part Direction;
  Part Undulation;
  double LocalUnevenness = 0.0; ///< of directions at all places, as Sample::unevenness
  StationaryFlowReport Reached;
};

} // namespace cactus
