// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/TractFibresOptions.h"

#include "base/Error.h"
#include "base/Limits.h"

namespace cactus
{

const PropertyList<TractFibresOptions>& TractFibresOptions::properties()
{
  using Options = TractFibresOptions;
  static const auto list =
    PropertyList<Options>()
      .add("Select", &Options::select, { "All", "Range", "Bundle" }, "Streamlines that fibres may follow")
      .add("FirstStreamline", &Options::first, limits::id, "First streamline of the range, counted from 1")
      .where("Select", { 1 })
      .add("LastStreamline", &Options::last, limits::id, "Last streamline of the range, included")
      .where("Select", { 1 })
      .add("BundleId", &Options::bundleId, limits::id, "Bundle whose streamlines are used")
      .where("Select", { 2 })
      .add("NumberOfStreamlines", &Options::numberOfStreamlines, limits::streamlines,
        "Number of streamlines that fibres follow, those nearest to the middle; 0: all that enter the domain")
      .add("Middle", &Options::middle, { "Tract", "Point" },
        "Middle of the domain: the place on a streamline nearest to the middle of the tract, or to a point")
      .add("PointX", &Options::pointX, limits::streamlineCoordinate, "Coordinate of the point, in the unit of the streamlines")
      .where("Middle", { 1 })
      .add("PointY", &Options::pointY, limits::streamlineCoordinate, "Coordinate of the point, in the unit of the streamlines")
      .where("Middle", { 1 })
      .add("PointZ", &Options::pointZ, limits::streamlineCoordinate, "Coordinate of the point, in the unit of the streamlines")
      .where("Middle", { 1 })
      .add("LengthUnit", &Options::lengthUnit, { "Micrometre", "Millimetre" }, "Unit of the streamlines' points")
      .add("ScaleFactor", &Options::scaleFactor, limits::scaleFactor,
        "Length in the substrate over the same length in the tract; 1: true size, 0.001 turns 1 mm into 1 µm")
      .add("Side", &Options::side, limits::side, "Side of the cubic domain, which is centred on the origin")
      .add("FibreVolumeFraction", &Options::fibreVolumeFraction, limits::fraction,
        "Fraction of a bundle's cross-section that the fibres' circles cover")
      .add("GrownFibreVolumeFraction", &Options::grownFibreVolumeFraction, limits::fractionOrNone,
        "Fraction of the bundles that FibreRadialGrowth will fill: fibres start thinner than their target radii and grow to "
        "them; 0: they start with their target radii")
      .add("BundleDiameter", &Options::bundleDiameter, limits::bundleDiameter,
        "Diameter of the bundle around each streamline; 0: one bundle covers the domain, several are together as large as the "
        "domain")
      .add("Margin", &Options::margin, limits::bundleMargin, "Width by which fibres extend beyond the domain on all sides")
      .include(&Options::radius, RadiusDistributionOptions::properties())
      .add("SpacingFactor", &Options::spacingFactor, limits::spacingFactor,
        "Distance between a fibre's control points as a multiple of its radius, within the two limits below")
      .add("MinimumSpacing", &Options::minimumSpacing, limits::spacing, "Smallest distance between control points")
      .add("MaximumSpacing", &Options::maximumSpacing, limits::spacing, "Largest distance between control points")
      .add("Seed", &Options::seed, limits::seed, "Seed of all random numbers: the same seed gives the same fibres");
  return list;
}

void TractFibresOptions::validate() const
{
  validateProperties(*this);
  if (select == StreamlineSelection::Range && first > last)
  {
    throw InvalidInput(text("FirstStreamline ", first, " is beyond LastStreamline ", last, ": exchange them"));
  }
  this->straightBundle().validate();
}

BundleInitializerOptions TractFibresOptions::straightBundle() const
{
  BundleInitializerOptions straight;
  straight.side = side;
  straight.margin = margin;
  straight.fibreVolumeFraction = fibreVolumeFraction;
  straight.grownFibreVolumeFraction = grownFibreVolumeFraction;
  straight.radius = radius;
  straight.meanDispersion = 0.0;
  straight.spacingFactor = spacingFactor;
  straight.minimumSpacing = minimumSpacing;
  straight.maximumSpacing = maximumSpacing;
  straight.seed = seed;
  return straight;
}

} // namespace cactus
