// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/BundleInitializerOptions.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "base/Limits.h"

#include <algorithm>
#include <cmath>

namespace cactus
{

const PropertyList<BundleInitializerOptions>& BundleInitializerOptions::properties()
{
  using Options = BundleInitializerOptions;
  static const auto list =
    PropertyList<Options>()
      .add("Side", &Options::side, limits::side, "Side of the cubic domain in µm. The cube is centred on the origin.")
      .add("FibreVolumeFraction", &Options::fibreVolumeFraction, limits::fraction,
        "Fraction of the cube that the fibres fill before growth, from 0 to 1. With walls and one bundle: fraction of the end "
        "faces that the fibres' circles cover. Random circles with a wide spread of radii can be packed to about 0.84. If the "
        "fraction cannot be reached, an error says which one can.")
      .add("GrownFibreVolumeFraction", &Options::grownFibreVolumeFraction, limits::fractionOrNone,
        "Fraction of the domain that the fibres fill once FibreRadialGrowth has grown them; that filter takes it from here. "
        "Fibres start thinner than the radii drawn (TargetRadius), by the square root of FibreVolumeFraction over this, and grow "
        "to these radii. The fractions of several sources in one place add up. 0: fibres start with the radii drawn, and growth "
        "makes them thicker.")
      .include(&Options::radius, RadiusDistributionOptions::properties())
      .add("Border", &Options::border, { "Cut", "Walls" },
        "How the fibres meet the sides of the domain. Cut: the domain is cut from the middle of a larger bundle. Fibres run out "
        "through all six faces, and the tissue is as dense beside a face as in the middle. Walls: all fibres of a bundle start "
        "and end within the domain's faces and lie flat along its sides, where they are less dense.")
      .add("MeanDispersion", &Options::meanDispersion, limits::meanDispersion,
        "Mean angle in degrees between fibres and their bundle's axis. Coherent fibres of a domain that is cut: at any place "
        "along them, without their undulation. All others: between their ends; with walls, about 35 can be reached if fibres "
        "start and end within a cube's faces, and a Margin allows more.")
      .add("DispersionModel", &Options::dispersionModel, { "Watson", "Cone", "Coherent" },
        "Distribution of the fibres' directions. Coherent: neighbouring fibres have similar directions and follow a smooth "
        "random flow that has the same statistics everywhere; angles to the axis have Watson's distribution. The flow preserves "
        "areas: fibres are as dense everywhere as where they were packed, and keep their directions in the optimiser. Watson "
        "(about the axis) and Cone (uniform within a cone about it): straight fibres with independent directions, as in the "
        "paper. Dense fibres then have to wind around each other, and their final tangents are more dispersed than asked for. "
        "Two crossing bundles use Watson instead of Coherent, because their layers are too thin for a flow.")
      .add("CorrelationLength", &Options::correlationLength, limits::correlationLength,
        "Lateral distance in µm over which the directions of neighbours are similar in the dispersion model Coherent. It does "
        "not depend on the domain's size. With a shorter length, or a larger dispersion, fibres wind more. 0, with the border "
        "Walls only: four times the fibres' mean shift between the faces.")
      .where("DispersionModel", { 2 })
      .where("NumberOfBundles", { 1 })
      .add("Sinuosity", &Options::sinuosity, limits::sinuosity,
        "Mean length of the fibres over the distance of their ends, along one wavelength: they undulate together with their "
        "neighbours. 1: they do not undulate, and only their change of direction makes them longer. Axons of the corpus callosum "
        "have 1.02 to 1.03 (docs/presets.md). If directions alone make fibres more sinuous, a warning says so.")
      .where("Border", { 0 })
      .where("DispersionModel", { 2 })
      .where("NumberOfBundles", { 1 })
      .add("UndulationWavelength", &Options::undulationWavelength, limits::undulationWavelength,
        "Wavelength in µm of the undulation along the fibres; single waves differ from it by 15 %.")
      .where("Border", { 0 })
      .where("DispersionModel", { 2 })
      .where("NumberOfBundles", { 1 })
      .add("NumberOfBundles", &Options::numberOfBundles, limits::bundles,
        "One bundle along z, or two that cross in the x-z plane, symmetric about z. For more bundles or other directions, append "
        "several sources.")
      .advise("; append several sources for more bundles or other directions")
      .add(
        "CrossingAngle", &Options::crossingAngle, limits::crossingAngle, "Angle in degrees between the axes of the two bundles.")
      .where("NumberOfBundles", { 2 })
      .add("CrossingStyle", &Options::crossingStyle, { "Interwoven", "Sheets" },
        "How two bundles share the space: in thin layers of random thickness, one or two fibres thick (Interwoven), or in a few "
        "thick sheets (Sheets). Layers alternate along y. Fibres stay in their layer.")
      .where("NumberOfBundles", { 2 })
      .add("SheetThickness", &Options::sheetThickness, limits::sheetThickness,
        "Minimum thickness in µm of each layer of the crossing style Sheets. A whole number of layers fills the height. 0: a "
        "sixth of the height, or more if the largest radius needs it.")
      .where("CrossingStyle", { 1 })
      .where("NumberOfBundles", { 2 })
      .add("Margin", &Options::margin, limits::bundleMarginOrAsNeeded,
        "Width in µm by which fibres extend beyond each lateral side of the domain; with two bundles beyond all sides. -1: as "
        "wide as the fibres' slants ask with the border Cut, and 0 with Walls.")
      .include(&Options::spacing, ControlPointSpacing::properties())
      .add("Seed", &Options::seed, limits::seed,
        "Seed of all random numbers. The same seed and parameters give the same fibres, bit for bit.");
  return list;
}

void BundleInitializerOptions::validate() const
{
  validateProperties(*this);
  if (grownFibreVolumeFraction != 0.0 && grownFibreVolumeFraction < fibreVolumeFraction)
  {
    throw InvalidInput(text("GrownFibreVolumeFraction is ", grownFibreVolumeFraction, ": give 0 or ", fibreVolumeFraction, " to ",
      limits::fraction.highest, " (no less than FibreVolumeFraction)"));
  }
  radius.validate();
  if (radius.minimum * this->thinning() < limits::radius.lowest)
  {
    throw InvalidInput(
      text("MinimumRadius ", radius.minimum, " µm makes capsules of less than ", limits::radius.lowest, " µm where they fill ",
        fibreVolumeFraction, " to be grown to ", grownFibreVolumeFraction, ": enlarge MinimumRadius or FibreVolumeFraction"));
  }
  if (isStationary(*this) && correlationLength == 0.0)
  {
    throw InvalidInput("CorrelationLength is 0: give a length in µm (8 by default); 0 is for Border Walls");
  }
  spacing.validate();
}

double BundleInitializerOptions::thinning() const
{
  return grownFibreVolumeFraction > 0.0 ? std::sqrt(fibreVolumeFraction / grownFibreVolumeFraction) : 1.0;
}

Surroundings surroundings(const BundleInitializerOptions& options)
{
  if (!options.isCutOut())
  {
    return { std::max(options.margin, 0.0), 0.0 };
  }
  constexpr double packed = 2.0;   // µm, within which a wall orders the packing
  constexpr double steepest = 2.0; // times the mean angle, which hardly any fibres exceed
  const double half = 0.5 * options.side + packed;
  double shift = half * std::tan(std::min(steepest * options.meanDispersion, 60.0) * degree);
  if (isStationary(options))
  {
    // A component of the displacement by undulation has this deviation.
    const double slope = std::sqrt(options.sinuosity - 1.0);
    constexpr double deviations = 3.0;
    shift += deviations * std::min(half * slope, slope * options.undulationWavelength / (2.0 * pi));
  }
  return { options.margin < 0.0 ? packed + shift : options.margin, packed };
}

bool isCoherent(const BundleInitializerOptions& options)
{
  return options.dispersionModel == DispersionModel::Coherent && options.numberOfBundles == 1;
}

bool isStationary(const BundleInitializerOptions& options)
{
  return isCoherent(options) && options.isCutOut();
}

} // namespace cactus
