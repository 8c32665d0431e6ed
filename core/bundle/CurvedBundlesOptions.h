// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Properties.h"
#include "bundle/BundleInitializerOptions.h"
#include "bundle/RadiusDistribution.h"

#include <cstdint>

namespace cactus
{

/// How bundles run through the domain, in each plane across y alike.
enum class BundleShape
{
  Bend, ///< one bundle around an axis along y
  Fan,  ///< one bundle that enters along z and spreads in x
  Kiss  ///< two bundles along z that bend towards each other and away again
};

/// Options of layCurvedBundles(). Lengths in µm.
struct CurvedBundlesOptions
{
  BundleShape shape = BundleShape::Bend;
  double bendRadius = 30.0;  ///< of the fibre through the middle of the domain, or of the middle of each kissing bundle
  double fanAngle = 30.0;    ///< degrees, between the two edges of the fan where it leaves the domain
  double kissDistance = 0.0; ///< between the middles of the two bundles where they touch; 0: half of the side
  double side = 30.0;        ///< of the domain along x and y
  double length = 0.0;       ///< of the domain along z; 0: side
  /// Fraction of the bundles that the fibres' capsules fill: of a fan, where it enters.
  double fibreVolumeFraction = 0.6;
  /// Fraction of the bundles that growth is to fill later; see BundleInitializerOptions.
  double grownFibreVolumeFraction = 0.9;
  /// Width by which the fibres extend beyond the domain on all sides. Their ends are free, and straighten when fibres are parted.
  double margin = 3.0;
  RadiusDistributionOptions radius; ///< outer radii of the fibres
  CalibreVariation calibre;         ///< how they vary along a fibre
  ControlPointSpacing spacing;
  std::uint64_t seed = 1;

  static const PropertyList<CurvedBundlesOptions>& properties();
  /// Throws InvalidInput, naming the property, unless every value that has an effect is within its range and the innermost fibres
  /// can follow their curve.
  void validate() const;
  /// Returns the straight bundle of the same fibres.
  BundleInitializerOptions straightBundle() const;
  /// Returns the box around the origin in which the fibres are asked for.
  Domain domain() const { return this->straightBundle().domain(); }
  double height() const { return this->length > 0.0 ? this->length : this->side; }
  /// Returns the largest coordinate of a control point in the domain with its margin, along x or y.
  double reach() const { return 0.5 * this->side + this->margin + this->radius.maximum; }
  /// Returns the same along z.
  double reachAlong() const { return 0.5 * this->height() + this->margin + this->radius.maximum; }
  /// Returns the distance of the middles of two kissing bundles, which is how wide each is.
  double kiss() const { return this->kissDistance > 0.0 ? this->kissDistance : 0.5 * this->side; }
  /// Returns the width of a fan where it enters: it is as wide as the domain where it leaves.
  double fanEntry() const;
};

} // namespace cactus
