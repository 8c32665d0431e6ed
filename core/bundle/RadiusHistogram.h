// SPDX-License-Identifier: BSD-3-Clause
// How thick axons are, as it was published.
#pragma once

#include "base/Random.h"

#include <string>
#include <vector>

namespace cactus
{

/// The histograms that there are, in the order of radiusHistograms().
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

/// How many axons of a tissue have diameters from where to where. All of them are inner diameters (of axons without their myelin)
/// in tissue as it was fixed, whose shrinkage is not made good.
struct RadiusHistogram
{
  std::string name;           ///< tissue and source in a few words
  std::string source;         ///< paper and figure, what was measured there and how it came here
  double begin;               ///< lower end of the first bin, µm of diameter
  double width;               ///< of each bin, µm of diameter
  std::vector<double> shares; ///< of the axons in each bin; they need not add up to 1

  /// Mean of the radius, and of its powers: ⟨rⁿ⟩ in µmⁿ, where every axon has the diameter of the middle of its bin.
  double meanPower(int power) const;
  double meanRadius() const { return this->meanPower(1); }
  double deviation() const;
  /// (⟨r⁶⟩ / ⟨r²⟩)^¼, which decides on the signal of diffusion across axons.
  double effectiveRadius() const;
  /// Lower end of the first bin that has axons, and upper end of the last one, as radii (µm).
  double smallestRadius() const;
  double largestRadius() const;
};

const std::vector<RadiusHistogram>& radiusHistograms();

const RadiusHistogram& radiusHistogram(PublishedRadii which);

/// Their names, as choices.
std::vector<std::string> radiusHistogramNames();

/// An axon's diameter (µm): bins are as likely as their shares, and within a bin all diameters are alike. Takes one number.
double sampleDiameter(const RadiusHistogram& histogram, RandomEngine& engine);

} // namespace cactus
