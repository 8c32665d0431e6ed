// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/LengthUnit.h"
#include "base/Properties.h"
#include "bundle/BundleInitializerOptions.h"
#include "bundle/RadiusDistribution.h"

#include <cstdint>

namespace cactus
{

/// The streamlines that fibres may follow.
enum class StreamlineSelection
{
  All,
  Range, ///< by index in the input
  Bundle ///< by BundleId
};

/// The unit of the streamlines' points.
enum class TractUnit
{
  Micrometre,
  Millimetre,
  AsRead ///< the one that TractogramReader was told to give; micrometres for streamlines from elsewhere
};

/// The position of the domain's middle in the tract.
enum class TractMiddle
{
  Tract, ///< at the mean of the points half way along each streamline
  Point  ///< at a given point
};

/// Options of layTractFibres(). Lengths in µm unless they are said to be in the streamlines' unit.
struct TractFibresOptions
{
  StreamlineSelection select = StreamlineSelection::All;
  int first = 1; ///< for StreamlineSelection::Range, from 1
  int last = 1;  ///< the last one, included; a larger number means all that follow
  int bundleId = 1;
  int numberOfStreamlines = 1; ///< of the selected ones, this many nearest to the middle; 0 for all
  TractMiddle middle = TractMiddle::Tract;
  double pointX = 0.0; ///< for TractMiddle::Point, in the streamlines' unit
  double pointY = 0.0;
  double pointZ = 0.0;
  TractUnit lengthUnit = TractUnit::AsRead; ///< unit of the streamlines' points
  double scaleFactor = 1.0;                 ///< length in the substrate over length in the tract
  double side = 30.0;                       ///< of the domain along x and y
  double length = 0.0;                      ///< of the domain along z; 0: side
  /// Fraction of each bundle's cross-section that the fibres' circles cover.
  double fibreVolumeFraction = 0.6;
  /// Fraction of each bundle that growth is to fill later; see BundleInitializerOptions.
  double grownFibreVolumeFraction = 0.9;
  /// Diameter of the bundle around each streamline; 0: a single bundle covers the domain, several are together as large as the
  /// domain.
  double bundleDiameter = 0.0;
  double margin = 0.0;              ///< width by which the fibres extend beyond the domain on all
                                    ///< sides
  RadiusDistributionOptions radius; ///< outer radii of the fibres
  CalibreVariation calibre;         ///< how they vary along a fibre
  UnmyelinatedAxons unmyelinated;   ///< among them
  ControlPointSpacing spacing;
  std::uint64_t seed = 1;

  static const PropertyList<TractFibresOptions>& properties();
  /// Throws InvalidInput, naming the property, unless every value that has an effect is within its range.
  void validate() const;
  /// Returns the straight bundle of the same fibres, whose faces are as wide as the domain with its margin.
  BundleInitializerOptions straightBundle() const;
  /// Returns the box around the origin in which the fibres are asked for.
  Domain domain() const { return this->straightBundle().domain(); }
  /// Returns micrometres in the substrate for one unit of the streamlines.
  double scale() const
  {
    return this->scaleFactor *
           micrometresIn(this->lengthUnit == TractUnit::Millimetre ? LengthUnit::Millimetre : LengthUnit::Micrometre);
  }
};

} // namespace cactus
