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
      .add("Side", &Options::side, limits::side, "Side of the cubic domain, which is centred on the origin")
      .add("FibreVolumeFraction", &Options::fibreVolumeFraction, limits::fraction,
        "Fraction of the domain that the fibres fill before growth; with walls and one bundle, fraction of the end faces that "
        "their circles cover")
      .add("GrownFibreVolumeFraction", &Options::grownFibreVolumeFraction, limits::fractionOrNone,
        "Fraction of the domain that FibreRadialGrowth will fill: fibres start thinner than their target radii and grow to them; "
        "0: they start with their target radii")
      .include(&Options::radius, RadiusDistributionOptions::properties())
      .add("Border", &Options::border, { "Cut", "Walls" },
        "How fibres meet the sides of the domain: it is cut from a larger bundle, or its sides are walls that keep all fibres inside")
      .add("MeanDispersion", &Options::meanDispersion, limits::meanDispersion,
        "Mean angle between fibres and their bundle's axis: anywhere along Coherent fibres (undulation left out), or from end to "
        "end")
      .add("DispersionModel", &Options::dispersionModel, { "Watson", "Cone", "Coherent" },
        "Distribution of the fibres' directions: independent of each other, about the axis (Watson) or uniform within a cone "
        "(Cone), or similar for neighbours (Coherent; two bundles use Watson instead)")
      .add("CorrelationLength", &Options::correlationLength, limits::correlationLength,
        "Lateral distance over which the directions of neighbours are similar; 0, with walls only: four times the fibres' mean "
        "shift between the faces")
      .where("DispersionModel", { 2 })
      .where("NumberOfBundles", { 1 })
      .add("Sinuosity", &Options::sinuosity, limits::sinuosity,
        "Mean length of fibres over the distance of their ends, along two wavelengths; 1: they do not undulate")
      .where("Border", { 0 })
      .where("DispersionModel", { 2 })
      .where("NumberOfBundles", { 1 })
      .add("UndulationWavelength", &Options::undulationWavelength, limits::undulationWavelength,
        "Wavelength of the undulation along the fibres")
      .where("Border", { 0 })
      .where("DispersionModel", { 2 })
      .where("NumberOfBundles", { 1 })
      .add("NumberOfBundles", &Options::numberOfBundles, limits::bundles,
        "One bundle along z, or two that cross in the x-z plane, symmetric about z")
      .advise("; append several sources for more bundles or other directions")
      .add("CrossingAngle", &Options::crossingAngle, limits::crossingAngle, "Angle between the axes of two bundles")
      .where("NumberOfBundles", { 2 })
      .add("CrossingStyle", &Options::crossingStyle, { "Interwoven", "Sheets" },
        "How two bundles share the space: in thin layers of random thickness, or in few thick sheets")
      .where("NumberOfBundles", { 2 })
      .add("SheetThickness", &Options::sheetThickness, limits::sheetThickness,
        "Smallest thickness of each sheet; 0: a sixth of the height, or what the largest radius needs")
      .where("CrossingStyle", { 1 })
      .where("NumberOfBundles", { 2 })
      .add("Margin", &Options::margin, limits::bundleMarginOrAsNeeded,
        "Width by which fibres extend beyond each lateral side of the domain; with two bundles beyond all sides; -1: as wide as "
        "needed, 0 with walls")
      .add("SpacingFactor", &Options::spacingFactor, limits::spacingFactor,
        "Distance between a fibre's control points as a multiple of its radius, within the two limits below")
      .add("MinimumSpacing", &Options::minimumSpacing, limits::spacing, "Smallest distance between control points")
      .add("MaximumSpacing", &Options::maximumSpacing, limits::spacing, "Largest distance between control points")
      .add("Seed", &Options::seed, limits::seed, "Seed of all random numbers: the same seed gives the same fibres");
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
  if (minimumSpacing > maximumSpacing)
  {
    throw InvalidInput(text("MaximumSpacing ", maximumSpacing, " is below MinimumSpacing ", minimumSpacing, ": exchange them"));
  }
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
