// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/LengthUnit.h"
#include "base/Properties.h"
#include "bundle/BundleInitializerOptions.h"
#include "bundle/RadiusDistribution.h"

#include <cstdint>

namespace cactus
{

/// Among which streamlines those are looked for that fibres follow.
enum class StreamlineSelection
{
  All,
  Range, ///< by their places in the input
  Bundle ///< by BundleId
};

/// Where in the tract the middle of the domain lies.
enum class TractMiddle
{
  Tract, ///< at the mean of the points half way along each streamline
  Point  ///< at a given point
};

/// What layTractFibres() is to make. Lengths in µm but for those that are said to be in the streamlines' unit.
struct TractFibresOptions
{
  StreamlineSelection select = StreamlineSelection::All;
  int first = 1; ///< of StreamlineSelection::Range, counted from 1
  int last = 1;  ///< the same, included; beyond the last one for all that follow
  int bundleId = 1;
  int numberOfStreamlines = 1; ///< of those selected, the nearest to the middle, that fibres follow; 0 for all
  TractMiddle middle = TractMiddle::Tract;
  double pointX = 0.0; ///< of TractMiddle::Point, in the streamlines' unit
  double pointY = 0.0;
  double pointZ = 0.0;
  LengthUnit lengthUnit = LengthUnit::Micrometre; ///< of the streamlines' points
  double scaleFactor = 1.0;                       ///< a length in the substrate over the same length in the tract
  double side = 30.0;                             ///< side of the cubic domain [-side/2, side/2]³
  /// Part of each bundle's cross-section that the fibres' circles cover.
  double fibreVolumeFraction = 0.7;
  /// Part of each bundle that growth is to fill later; see BundleInitializerOptions.
  double grownFibreVolumeFraction = 0.9;
  /// Of the bundle around each streamline; 0: a single bundle covers the domain, several are together as large as the domain.
  double bundleDiameter = 0.0;
  double margin = 0.0;                                             ///< by which the fibres extend beyond the domain on all sides
  RadiusDistributionOptions radius;                                ///< of the fibres' outer radii
  double spacingFactor = BundleInitializerOptions().spacingFactor; ///< as in BundleInitializerOptions, like those that follow
  double minimumSpacing = BundleInitializerOptions().minimumSpacing;
  double maximumSpacing = BundleInitializerOptions().maximumSpacing;
  std::uint64_t seed = 1;

  static const PropertyList<TractFibresOptions>& properties();
  /// Throws InvalidInput, naming the property, unless every value that has an effect is within its range.
  void validate() const;
  /// The straight bundle of the same fibres, whose faces are as wide as the domain with its margin.
  BundleInitializerOptions straightBundle() const;
  /// Micrometres in the substrate for one unit of the streamlines.
  double scale() const { return this->scaleFactor * micrometresIn(this->lengthUnit); }
};

} // namespace cactus
