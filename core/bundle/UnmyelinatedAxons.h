// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Properties.h"
#include "bundle/RadiusDistribution.h"

#include <cstdint>

namespace cactus
{

/// Axons without myelin among the fibres of a bundle. They lie in clusters, as in the corpus callosum.
struct UnmyelinatedAxons
{
  double fraction = 0.0;   ///< volume of these axons over that of the domain, once the bundle is grown, in [0, 0.6]
  double radius = 0.12;    ///< µm, mean
  double deviation = 0.05; ///< µm, standard deviation of the radius
  int cluster = 8;         ///< number of axons in a cluster; 1: none
  /// Number of the first of them where random numbers are drawn by fibre: behind all fibres with myelin.
  static constexpr std::uint64_t firstItem = std::uint64_t(1) << 36;

  static const PropertyList<UnmyelinatedAxons>& properties();
  bool any() const { return fraction > 0.0; }
  /// Returns the distribution of their radii: lognormal, within half and twice the mean.
  RadiusDistributionOptions radii() const;
  /// Returns the same axons with radii multiplied by `factor`.
  UnmyelinatedAxons scaled(double factor) const;
};

} // namespace cactus
