// SPDX-License-Identifier: BSD-3-Clause
// Published histograms of axon diameters.
#pragma once

#include "base/Random.h"

#include <string>
#include <vector>

namespace cactus
{

/// The available histograms, in the order of radiusHistograms().
enum class PublishedRadii
{
  HumanGenu,
  HumanAnteriorBody,
  HumanMidBody,
  HumanPosteriorBody,
  HumanSplenium,
  HumanPrefrontal,
  HumanMotor,
  HumanParietal,
  HumanVisual,
  MouseGenu
};

/// The numbers of axons by diameter in a tissue. All are inner diameters (of axons without their myelin) in fixed tissue, not
/// corrected for shrinkage.
struct RadiusHistogram
{
  std::string name;           ///< tissue and source in a few words
  std::string source;         ///< paper and figure, the quantity measured, and how the numbers were obtained
  double begin;               ///< lower end of the first bin, µm of diameter
  double width;               ///< width of each bin, µm of diameter
  std::vector<double> shares; ///< fraction of the axons in each bin; the sum need not be 1

  /// Returns ⟨rⁿ⟩ in µmⁿ, where every axon has the diameter of the middle of its bin.
  double meanPower(int power) const;
  double meanRadius() const { return this->meanPower(1); }
  double deviation() const;
  /// Returns (⟨r⁶⟩ / ⟨r²⟩)^¼, which determines the diffusion signal across axons.
  double effectiveRadius() const;
  /// Returns the lower end of the first non-empty bin, or the upper end of the last one, as a radius (µm).
  double smallestRadius() const;
  double largestRadius() const;
};

const std::vector<RadiusHistogram>& radiusHistograms();

const RadiusHistogram& radiusHistogram(PublishedRadii which);

/// Returns their names, as choices.
std::vector<std::string> radiusHistogramNames();

/// Draws an axon's diameter (µm): bins are as likely as their shares, and diameters are uniform within a bin. Uses one number of
/// the engine.
double sampleDiameter(const RadiusHistogram& histogram, RandomEngine& engine);

} // namespace cactus
