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
      .add("Select", &Options::select, { "All", "Range", "Bundle" },
        "Streamlines that fibres may follow: all, a range of them, or those of one BundleId (a group of a .trx).")
      .add("FirstStreamline", &Options::first, limits::id, "First streamline of the range, counted from 1.")
      .where("Select", { 1 })
      .add("LastStreamline", &Options::last, limits::id,
        "Last streamline of the range, included. A number beyond the last one takes all that follow the first.")
      .where("Select", { 1 })
      .add("BundleId", &Options::bundleId, limits::id, "Bundle whose streamlines are taken.")
      .where("Select", { 2 })
      .add("NumberOfStreamlines", &Options::numberOfStreamlines, limits::streamlines,
        "Number of streamlines that fibres follow: those nearest to the middle of the domain. 0: all that enter the domain.")
      .add("Middle", &Options::middle, { "Tract", "Point" },
        "Middle of the domain: the place on a streamline that is nearest to the mean of the streamlines' midpoints (Tract), or "
        "nearest to a given point (Point).")
      .add("PointX", &Options::pointX, limits::streamlineCoordinate, "The point's x in the unit of the streamlines.")
      .where("Middle", { 1 })
      .add("PointY", &Options::pointY, limits::streamlineCoordinate, "The point's y in the unit of the streamlines.")
      .where("Middle", { 1 })
      .add("PointZ", &Options::pointZ, limits::streamlineCoordinate, "The point's z in the unit of the streamlines.")
      .where("Middle", { 1 })
      .add("LengthUnit", &Options::lengthUnit, { "Micrometre", "Millimetre", "As read" },
        "Unit of the streamlines' points. As read: the one that TractogramReader was told to give; micrometres for streamlines "
        "from elsewhere.")
      .add("ScaleFactor", &Options::scaleFactor, limits::scaleFactor,
        "Length in the substrate over the same length in the tract. 1: true size, at which most tracts are almost straight. "
        "0.001: 1 mm of the tract becomes 1 µm, so that a substrate shows how the tract bends.")
      .add("Side", &Options::side, limits::side,
        "Side of the domain along x and y in µm. The domain is centred on the origin, and a cube if Length is 0.")
      .add("Length", &Options::length, limits::length, "Length of the domain along z in µm; 0: as Side.")
      .add("FibreVolumeFraction", &Options::fibreVolumeFraction, limits::fraction,
        "Fraction of a bundle's cross-section that the fibres' circles cover, from 0 to 1. Random circles with a wide spread of "
        "radii can be packed to about 0.84. If the fraction cannot be reached, an error says which one can.")
      .add("GrownFibreVolumeFraction", &Options::grownFibreVolumeFraction, limits::fractionOrNone,
        "Fraction of the bundles that the fibres fill once FibreRadialGrowth has grown them; that filter takes it from here, in "
        "proportion to what the bundles fill of the domain. Fibres start thinner than the radii drawn (TargetRadius), by the "
        "square root of FibreVolumeFraction over this, and grow to these radii. 0: fibres start with the radii drawn, and growth "
        "makes them thicker.")
      .add("BundleDiameter", &Options::bundleDiameter, limits::bundleDiameter,
        "Diameter in µm of the bundle around each streamline. 0: the bundle of one streamline covers the whole domain; the "
        "bundles of several streamlines are together as large as the domain. A bundle cannot bend more sharply than its radius, "
        "so thin bundles follow their streamlines more closely.")
      .add("Margin", &Options::margin, limits::bundleMargin, "Width in µm by which fibres extend beyond all sides of the domain.")
      .include(&Options::radius, RadiusDistributionOptions::properties())
      .include(&Options::calibre, CalibreVariation::properties())
      .include(&Options::unmyelinated, UnmyelinatedAxons::properties())
      .include(&Options::spacing, ControlPointSpacing::properties())
      .add("Seed", &Options::seed, limits::seed,
        "Seed of all random numbers. The same seed and parameters give the same fibres, bit for bit.");
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
  straight.length = length;
  straight.border = Border::Walls;
  straight.margin = margin;
  straight.fibreVolumeFraction = fibreVolumeFraction;
  straight.grownFibreVolumeFraction = grownFibreVolumeFraction;
  straight.radius = radius;
  straight.calibre = calibre;
  straight.unmyelinated = unmyelinated;
  straight.meanDispersion = 0.0;
  straight.spacing = spacing;
  straight.seed = seed;
  return straight;
}

} // namespace cactus
