// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/BundleInitializerOptions.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "base/Limits.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace cactus
{

namespace
{

/// Returns the name of a model whose fibres are laid anywhere in space.
const char* nameAnywhere(DispersionModel model)
{
  return model == DispersionModel::Peaks ? "Peaks" : "Harmonics";
}

} // namespace

const PropertyList<BundleInitializerOptions>& BundleInitializerOptions::properties()
{
  using Options = BundleInitializerOptions;
  static const auto list =
    PropertyList<Options>()
      .add("Side", &Options::side, limits::side,
        "Side of the domain along x and y in µm. The domain is centred on the origin, and a cube if Length is 0.")
      .add("Length", &Options::length, limits::length, "Length of the domain along z in µm; 0: as Side.")
      .add("FibreVolumeFraction", &Options::fibreVolumeFraction, limits::fraction,
        "Fraction of the domain that the fibres fill before growth, from 0 to 1. With walls and one bundle: fraction of the end "
        "faces that the fibres' circles cover. Random circles with a wide spread of radii can be packed to about 0.84. If the "
        "fraction cannot be reached, an error says which one can.")
      .add("GrownFibreVolumeFraction", &Options::grownFibreVolumeFraction, limits::fractionOrNone,
        "Fraction of the domain that the fibres fill once FibreRadialGrowth has grown them; that filter takes it from here. "
        "Fibres start thinner than the radii drawn (TargetRadius), by the square root of FibreVolumeFraction over this, and grow "
        "to these radii. The fractions of several sources in one place add up. 0: fibres start with the radii drawn, and growth "
        "makes them thicker.")
      .include(&Options::radius, RadiusDistributionOptions::properties())
      .include(&Options::calibre, CalibreVariation::properties())
      .include(&Options::unmyelinated, UnmyelinatedAxons::properties())
      .add("Border", &Options::border, { "Cut", "Walls", "Periodic across", "Periodic" },
        "How the fibres meet the sides of the domain. Cut: the domain is cut from the middle of a larger bundle. Fibres run out "
        "through all six faces, and the tissue is as dense beside a face as in the middle. Walls: all fibres of a bundle start "
        "and end within the domain's faces and lie flat along its sides, where they are less dense. Periodic across: a fibre "
        "that leaves through a face across x or y enters again through the opposite one, so that copies of the domain side by "
        "side are one tissue; across z it is cut. Periodic: the same along z, too, so that fibres are endless. Their angles are "
        "then those of undulations, since each fibre is back at its place after Length. Both need one bundle along z.")
      .add("MeanDispersion", &Options::meanDispersion, limits::meanDispersion,
        "Mean angle in degrees between fibres and their bundle's axis. Coherent fibres of a domain that is cut: at any place "
        "along them, without their undulation. All others: between their ends; with walls, about 35 can be reached if fibres "
        "start and end within a cube's faces, and a Margin allows more.")
      .where("DispersionModel", { 0, 1, 2, 4 })
      .add("DispersionModel", &Options::dispersionModel, { "Watson", "Cone", "Coherent", "Harmonics", "Peaks" },
        "Distribution of the fibres' directions. Coherent: neighbouring fibres have similar directions and follow a smooth "
        "random flow that has the same statistics everywhere; angles to the axis have Watson's distribution. The flow preserves "
        "areas: fibres are as dense everywhere as where they were packed, and keep their directions in the optimiser. Watson "
        "(about the axis) and Cone (uniform within a cone about it): straight fibres with independent directions, as in the "
        "paper. Dense fibres then have to wind around each other, and their final tangents are more dispersed than asked for. "
        "Layers of two crossing bundles use Watson instead of Coherent, because they are too thin for a flow. Harmonics: "
        "straight fibres with directions from any distribution (OrientationHarmonics), such as one measured in a voxel, laid "
        "evenly in space. Peaks: the same for any number of bundles with an axis and a share each (OrientationPeaks), whose "
        "directions have Watson's distribution about the axis. Harmonics and Peaks need the border Cut.")
      .add("CorrelationLength", &Options::correlationLength, limits::correlationLength,
        "Lateral distance in µm over which the directions of neighbours are similar in the dispersion model Coherent. It does "
        "not depend on the domain's size, but in a periodic domain is at most a third of Side. With a shorter length, or a "
        "larger "
        "dispersion, fibres wind more. 0, with the border Walls only: four times the fibres' mean shift between the faces.")
      .where("DispersionModel", { 2 })
      .add("Sinuosity", &Options::sinuosity, limits::sinuosity,
        "Mean length of the fibres over the distance of their ends, along one wavelength: they undulate together with their "
        "neighbours. 1: they do not undulate, and only their change of direction makes them longer. Axons of the corpus callosum "
        "have 1.02 to 1.03 (docs/presets.md). If directions alone make fibres more sinuous, a warning says so.")
      .where("Border", { 0, 2, 3 })
      .where("DispersionModel", { 2 })
      .add("UndulationWavelength", &Options::undulationWavelength, limits::undulationWavelength,
        "Wavelength in µm of the undulation along the fibres; single waves differ from it by 15 %. With the border Periodic, the "
        "nearest one of which a whole number fits into Length.")
      .where("Border", { 0, 2, 3 })
      .where("DispersionModel", { 2 })
      .add("NumberOfBundles", &Options::numberOfBundles, limits::bundles,
        "One bundle, or two that cross in the x-z plane, symmetric about z. For more bundles, use DispersionModel Peaks, or "
        "connect several sources to one CapsuleOptimizer, each with its Direction and its share of the volume fractions.")
      .advise("; for more bundles use DispersionModel Peaks, or connect several sources, each with its Direction, to one "
              "CapsuleOptimizer")
      .add("Direction", &Options::direction,
        "Axis of the bundle: x, y and z of a vector of any length. A direction and its opposite are the same. Another one than "
        "z needs the border Cut. Sources with the same Seed and other directions give bundles that are independent.")
      .where("NumberOfBundles", { 1 })
      .where("DispersionModel", { 0, 1, 2 })
      .add(
        "CrossingAngle", &Options::crossingAngle, limits::crossingAngle, "Angle in degrees between the axes of the two bundles.")
      .where("NumberOfBundles", { 2 })
      .add("Mixing", &Options::mixing, { "Interpenetrating", "Layers" },
        "How two bundles share the space. Interpenetrating: each fills the whole domain, and CapsuleOptimizer bends their fibres "
        "around each other, as in the paper. Layers: each has layers of its own, as always with the border Walls. Straight "
        "fibres then never meet those of the other bundle, but hardly leave the plane of their layer.")
      .where("Border", { 0 })
      .where("NumberOfBundles", { 2 })
      .add("CrossingStyle", &Options::crossingStyle, { "Interwoven", "Sheets" },
        "The layers of two bundles: thin ones of random thickness, one or two fibres thick (Interwoven), or a few thick sheets "
        "(Sheets). They alternate along y. Fibres stay in their layer. It counts where bundles lie in layers (see Mixing).")
      .where("NumberOfBundles", { 2 })
      .add("SheetThickness", &Options::sheetThickness, limits::sheetThickness,
        "Minimum thickness in µm of each layer of the crossing style Sheets. A whole number of layers fills the height. 0: a "
        "sixth of the height, or more if the largest radius needs it.")
      .where("CrossingStyle", { 1 })
      .where("NumberOfBundles", { 2 })
      .add("Margin", &Options::margin, limits::bundleMarginOrAsNeeded,
        "Width in µm by which fibres extend beyond each lateral side of the domain; with layers beyond all sides. -1: as "
        "wide as the fibres' slants ask with the border Cut, and 0 with Walls.")
      .where("Border", { 0, 1 })
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
  calibre.validate();
  if (radius.minimum * this->thinning() < limits::radius.lowest)
  {
    throw InvalidInput(
      text("MinimumRadius ", radius.minimum, " µm makes capsules of less than ", limits::radius.lowest, " µm where they fill ",
        fibreVolumeFraction, " to be grown to ", grownFibreVolumeFraction, ": enlarge MinimumRadius or FibreVolumeFraction"));
  }
  if (this->isAnywhere() && (!isCutOut() || numberOfBundles != 1))
  {
    const char* name = nameAnywhere(dispersionModel);
    throw InvalidInput(
      isCutOut() ? text("NumberOfBundles is 2: give 1 with DispersionModel ", name, ", which has the directions of all fibres")
                 : text("DispersionModel ", name, " needs Border Cut: walls bound bundles along z"));
  }
  if (numberOfBundles == 1 && !this->isAnywhere())
  {
    const double norm = direction.norm();
    if (!std::isfinite(norm) || norm < limits::shortestDirection)
    {
      throw InvalidInput(
        "Direction is " + text(direction.x(), ' ', direction.y(), ' ', direction.z()) + ": give a vector, of any length but 0");
    }
    if (!isCutOut() && (direction.x() != 0.0 || direction.y() != 0.0))
    {
      throw InvalidInput("Direction is not along z: use Border Cut, since walls bound bundles along z");
    }
  }
  if (this->isPeriodic())
  {
    this->requirePeriodic();
  }
  if (unmyelinated.any())
  {
    this->requireUnmyelinated();
  }
  if (isStationary(*this) && correlationLength == 0.0)
  {
    throw InvalidInput("CorrelationLength is 0: give a length in µm (8 by default); 0 is for Border Walls");
  }
  spacing.validate();
}

/// Throws unless a periodic domain can hold what is asked for.
void BundleInitializerOptions::requirePeriodic() const
{
  const char* name = border == Border::Periodic ? "Periodic" : "Periodic across";
  const bool isAlongZ = direction.x() == 0.0 && direction.y() == 0.0;
  if (numberOfBundles != 1 || this->isAnywhere() || !isAlongZ)
  {
    const std::string what = numberOfBundles != 1 ? "NumberOfBundles is 2"
                             : this->isAnywhere() ? text("DispersionModel is ", nameAnywhere(dispersionModel))
                                                  : "Direction is not along z";
    throw InvalidInput(text(what, ": use Border Cut, since Border ", name, " needs one bundle along z"));
  }
  if (border == Border::Periodic && dispersionModel != DispersionModel::Coherent && meanDispersion > 0.0)
  {
    throw InvalidInput("DispersionModel makes straight fibres, which do not come back to their places after Length: use Coherent "
                       "with Border Periodic, or Border Periodic across");
  }
  if (side < 4.0 * radius.maximum)
  {
    throw InvalidInput(text("Side ", side, " µm is less than four times MaximumRadius ", radius.maximum, " µm: with Border ",
      name, " a fibre would lie beside its own image. Enlarge Side, or lower MaximumRadius"));
  }
}

/// Throws unless there is a place for axons without myelin.
void BundleInitializerOptions::requireUnmyelinated() const
{
  constexpr double largestShare = 0.95; // of the fibres' volume, since there is a fibre with myelin
  if (this->isLayered())
  {
    throw InvalidInput(text("UnmyelinatedFraction is ", unmyelinated.fraction,
      ": give 0 with bundles in layers, or choose Mixing Interpenetrating with Border Cut"));
  }
  if (this->unmyelinatedShare() > largestShare)
  {
    throw InvalidInput(text("UnmyelinatedFraction is ", unmyelinated.fraction, ": give at most ", largestShare, " of ",
      grownFibreVolumeFraction > 0.0 ? "GrownFibreVolumeFraction " : "FibreVolumeFraction ",
      grownFibreVolumeFraction > 0.0 ? grownFibreVolumeFraction : fibreVolumeFraction));
  }
}

double BundleInitializerOptions::unmyelinatedShare() const
{
  return unmyelinated.fraction / (grownFibreVolumeFraction > 0.0 ? grownFibreVolumeFraction : fibreVolumeFraction);
}

double BundleInitializerOptions::thinning() const
{
  return grownFibreVolumeFraction > 0.0 ? std::sqrt(fibreVolumeFraction / grownFibreVolumeFraction) : 1.0;
}

double BundleInitializerOptions::controlPointSpacing(double fibreRadius) const
{
  // Shorter capsules than thick ones would fold up, see resampleDenseFibres().
  constexpr double shortest = 0.6; // radii
  return std::min(spacing.of(fibreRadius), std::max(longestSpacing(calibre), shortest * fibreRadius));
}

double BundleInitializerOptions::lateralCorrelationLength() const
{
  return this->isPeriodic() ? std::min(correlationLength, side / 3.0) : correlationLength;
}

Domain BundleInitializerOptions::domain() const
{
  const double along = length > 0.0 ? length : side;
  Domain box;
  box.upper = Eigen::Vector3d(0.5 * side, 0.5 * side, 0.5 * along);
  box.lower = -box.upper;
  box.periodic = { { this->isPeriodic(), this->isPeriodic(), border == Border::Periodic } };
  return box;
}

Eigen::Matrix3d turnTo(const Eigen::Vector3d& direction)
{
  if (direction.x() == 0.0 && direction.y() == 0.0)
  {
    return Eigen::Matrix3d::Identity();
  }
  Eigen::Vector3d axis = direction.normalized();
  const Eigen::Index last = axis.z() != 0.0 ? 2 : axis.y() != 0.0 ? 1 : 0;
  axis = (axis[last] < 0.0 ? -axis : axis).array() + 0.0; // no zero is negative, so that equal axes have equal bits
  const double x = axis.x();
  const double y = axis.y();
  const double z = axis.z();
  Eigen::Matrix3d turn;                                   // the smallest rotation of z to the axis
  turn << 1.0 - x * x / (1.0 + z), -x * y / (1.0 + z), x, //
    -x * y / (1.0 + z), 1.0 - y * y / (1.0 + z), y,       //
    -x, -y, z;
  return turn;
}

Eigen::Matrix3d BundleInitializerOptions::turn() const
{
  const bool hasDirection = numberOfBundles == 1 && !this->isAnywhere();
  return hasDirection ? turnTo(direction) : Eigen::Matrix3d::Identity();
}

Eigen::Vector3d BundleInitializerOptions::extent() const
{
  return this->turn().transpose().cwiseAbs() * this->domain().size();
}

Surroundings surroundings(const BundleInitializerOptions& options)
{
  if (options.isAnywhere())
  {
    constexpr double around = 4.0; // µm, for fibres of all directions that part
    return { options.margin < 0.0 ? around : options.margin, 0.0 };
  }
  if (!options.isCutOut())
  {
    return { std::max(options.margin, 0.0), 0.0 };
  }
  constexpr double packed = 2.0; // µm, within which a wall orders the packing
  if (options.isPeriodic())
  {
    return { 0.0, packed + (options.border == Border::Periodic ? options.radius.maximum : 0.0) };
  }
  constexpr double steepest = 2.0; // times the mean angle, which hardly any fibres exceed
  const double half = 0.5 * options.extent().z() + packed;
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
  return options.dispersionModel == DispersionModel::Coherent && !options.isLayered();
}

bool isStationary(const BundleInitializerOptions& options)
{
  return isCoherent(options) && options.isCutOut();
}

} // namespace cactus
