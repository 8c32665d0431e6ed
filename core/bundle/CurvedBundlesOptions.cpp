// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/CurvedBundlesOptions.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "base/Limits.h"

#include <algorithm>
#include <cmath>

namespace cactus
{

namespace
{

constexpr Range bendRange{ 0.1, 1e6, " µm" };
constexpr Range fanRange{ 0.1, 90.0, "°" };
/// Smallest width of a fan where it enters, over that where it leaves; in a cube one of 90° has 0.17.
constexpr double narrowestEntry = 0.1;
constexpr Range kissRange{ 0.1, 1e5, " µm", 0.0 };

/// Returns the smallest radius (µm) with which a guide curve (see guideCurve()) in the domain with its margin bends; not positive
/// where a curve would lie beyond its axis.
double sharpestBend(const CurvedBundlesOptions& options)
{
  const double edge = 0.5 * options.fanEntry();
  switch (options.shape)
  {
  case BundleShape::Fan:
    return options.height() / std::sin(0.5 * options.fanAngle * degree) - std::max(0.0, options.reach() - edge);
  case BundleShape::Kiss:
    return options.bendRadius + 0.5 * options.kiss() - std::min(options.kiss(), options.reach());
  default:
    return options.bendRadius - options.reach();
  }
}

} // namespace

const PropertyList<CurvedBundlesOptions>& CurvedBundlesOptions::properties()
{
  using Options = CurvedBundlesOptions;
  static const auto list =
    PropertyList<Options>()
      .add("Shape", &Options::shape, { "Bend", "Fan", "Kiss" },
        "How fibres run; at every y alike. Bend: one bundle along z bends around an axis along y, at x = BendRadius. Fan: one "
        "bundle enters along z at the lowest z and spreads along x up to the highest. Kiss: two bundles come along z, touch in "
        "the middle of the domain and bend away from each other again.")
      .add("BendRadius", &Options::bendRadius, bendRange,
        "Radius in µm of the bend of the fibre through the middle of the domain, or of the middle of each kissing bundle. Fibres "
        "nearer to the bend's axis bend more sharply, those farther away less. The smallest radius of a bend is half of Side, "
        "Margin and three times MaximumRadius together, and that of a kiss usually half of KissDistance and twice MaximumRadius; "
        "an error says which radius can be had.")
      .where("Shape", { 0, 2 })
      .add("FanAngle", &Options::fanAngle, fanRange,
        "Angle in degrees between the two edges of the fan where it leaves the domain. It enters with all fibres along z, and so "
        "narrow that it is as wide as the domain where it leaves: Side - 2 Length tan(FanAngle / 4). Fibres beside it run along "
        "with its edges.")
      .where("Shape", { 1 })
      .add("KissDistance", &Options::kissDistance, kissRange,
        "Distance in µm between the middles of the two bundles where they touch, which is also how thick each of them is along "
        "x. "
        "0: half of Side, which fills the domain there.")
      .where("Shape", { 2 })
      .add("Side", &Options::side, limits::side,
        "Side of the domain along x and y in µm. The domain is centred on the origin, and a cube if Length is 0.")
      .add("Length", &Options::length, limits::length, "Length of the domain along z in µm; 0: as Side.")
      .add("FibreVolumeFraction", &Options::fibreVolumeFraction, limits::fraction,
        "Fraction of the bundles that the fibres' capsules fill, from 0 to 1: of a fan, where it enters. Random fibres with a "
        "wide "
        "spread of radii can be packed to about 0.84. If the fraction cannot be reached, an error says which one can.")
      .add("GrownFibreVolumeFraction", &Options::grownFibreVolumeFraction, limits::fractionOrNone,
        "Fraction of the bundles that the fibres fill once FibreRadialGrowth has grown them; that filter takes it from here, in "
        "proportion to what the bundles fill of the domain. Fibres start thinner than the radii drawn (TargetRadius), by the "
        "square root of FibreVolumeFraction over this, and grow to these radii. 0: fibres start with the radii drawn, and growth "
        "makes them thicker.")
      .add("Margin", &Options::margin, limits::bundleMargin,
        "Width in µm by which fibres extend beyond all sides of the domain. CapsuleOptimizer straightens them a little towards "
        "their ends, which are then outside.")
      .include(&Options::radius, RadiusDistributionOptions::properties())
      .include(&Options::calibre, CalibreVariation::properties())
      .include(&Options::spacing, ControlPointSpacing::properties())
      .add("Seed", &Options::seed, limits::seed,
        "Seed of all random numbers. The same seed and parameters give the same fibres, bit for bit.");
  return list;
}

double CurvedBundlesOptions::fanEntry() const
{
  return side * (1.0 - 2.0 * (height() / side) * std::tan(0.25 * fanAngle * degree));
}

void CurvedBundlesOptions::validate() const
{
  validateProperties(*this);
  this->straightBundle().validate();
  if (shape == BundleShape::Fan && fanEntry() < narrowestEntry * side)
  {
    const double widest = std::atan(0.5 * (1.0 - narrowestEntry) * side / height()) / (0.25 * degree);
    throw InvalidInput(text("FanAngle ", fanAngle, "° is too wide for a domain of Length ", height(),
      " µm, where the fan would have no width where it enters: give at most ", widest, "°, or enlarge Side"));
  }
  const double sharpest = sharpestBend(*this);
  const double least = 2.0 * radius.maximum;
  if (sharpest >= least)
  {
    return;
  }
  if (shape == BundleShape::Fan)
  {
    throw InvalidInput(text("Margin ", margin, " µm is too wide for a fan of ", fanAngle,
      "°: its outermost fibres would bend with ", sharpest, " µm. Lower Margin or FanAngle"));
  }
  throw InvalidInput(text("BendRadius ", bendRadius, " µm is too sharp here: give ", bendRadius + least - sharpest,
    " µm or more, so that the innermost fibres can follow, or lower Side, Margin, KissDistance or MaximumRadius"));
}

BundleInitializerOptions CurvedBundlesOptions::straightBundle() const
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
  straight.meanDispersion = 0.0;
  straight.spacing = spacing;
  straight.seed = seed;
  return straight;
}

} // namespace cactus
