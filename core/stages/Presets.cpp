// SPDX-License-Identifier: BSD-3-Clause
#include "stages/Presets.h"

#include "base/Error.h"
#include "base/MyelinThickness.h"
#include "base/Numbers.h"
#include "stages/Stages.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace cactus
{

namespace
{

constexpr char bundle[] = "BundleInitializer";
constexpr char growth[] = "FibreRadialGrowth";
constexpr char myelin[] = "MyelinSurface";

const std::string paper = "Villarreal-Haro et al. 2023, ";
/// Γ(2.64, 0.184) µm, interpreted as inner radii of the genu; divided by the g-ratio of 0.7 they are outer ones
/// (docs/presets.md).
constexpr double genuShape = 2.64;
constexpr double genuScale = 0.263;
const std::string genuSource = "radii: Γ(2.64, 0.184) µm over g, with the mean of the diameters in the human genu of Aboitiz et "
                               "al. 1992 (Brain Res 598:143); ";

/// The fraction to which the densest substrates are grown, and the tolerance that leaves room for it (docs/surfaces.md).
constexpr double densest = 0.955;
constexpr double densestTolerance = 0.0065;

/// Returns a preset with all values of one bundle: if the user changes any of them, the preset no longer holds.
Preset tutorial()
{
  return { "Tutorial bundle", "One bundle of 10°, grown to 90 %, with a g-ratio of 0.7",
    "Γ(2.4, 0.25) µm and 10° of the tutorial of the paper's program; the rest are this plugin's defaults",
    { { bundle, "RadiusDistribution", std::int64_t(0) }, { bundle, "GammaShape", 2.4 }, { bundle, "GammaScale", 0.25 },
      { bundle, "MinimumRadius", 0.2 }, { bundle, "MaximumRadius", 2.0 }, { bundle, "FibreVolumeFraction", 0.6 },
      { bundle, "GrownFibreVolumeFraction", 0.9 }, { bundle, "MeanDispersion", 10.0 },
      { bundle, "DispersionModel", static_cast<std::int64_t>(DispersionModel::Coherent) },
      { bundle, "NumberOfBundles", std::int64_t(1) }, { growth, "TargetFibreVolumeFraction", -1.0 },
      { growth, "MinimumGap", 0.02 }, { myelin, "GRatioModel", static_cast<std::int64_t>(GRatioModel::Constant) },
      { myelin, "GRatio", 0.7 } } };
}

Preset callosum(const std::string& state, const std::string& meaning, const std::string& source, std::vector<PresetValue> values)
{
  for (const PresetValue& value : { PresetValue{ bundle, "MeanDispersion", 10.0 }, PresetValue{ bundle, "GammaShape", genuShape },
         PresetValue{ bundle, "GammaScale", genuScale } })
  {
    values.insert(values.begin(), value);
  }
  return { "Corpus callosum, " + state, "One bundle of 10° with radii of the genu, " + meaning, genuSource + source,
    std::move(values) };
}

/// Living tissue between association cortices, of whose axons about a quarter has no myelin.
Preset callosumWithBareAxons()
{
  return callosum("with unmyelinated axons", "which fills 80 %, about a quarter of its axons without myelin, in clusters",
    "axons without myelin: 6 to 30 % by region in the macaque, LaMantia and Rakic 1990 (J Comp Neurol 291:520), mostly below "
    "0.25 µm across, Swadlow et al. 1980 (Arch Neurol 37:114)",
    { { bundle, "GrownFibreVolumeFraction", 0.8 }, { bundle, "UnmyelinatedFraction", 0.008 } });
}

Preset crossing(double angle, const std::string& reached)
{
  const std::string degrees = text(angle);
  return { "Crossing at " + degrees + " degrees",
    "Two bundles of 5° each that interpenetrate and cross at " + degrees + "°, as dense as possible",
    paper + "Table 1, where " + reached + " % are reached",
    { { bundle, "NumberOfBundles", std::int64_t(2) }, { bundle, "CrossingAngle", angle },
      { bundle, "GrownFibreVolumeFraction", 0.0 }, { growth, "TargetFibreVolumeFraction", densest },
      { growth, "SurfaceTolerance", densestTolerance } } };
}

/// Returns a row of the paper's table of histological targets, by its volume fractions of axons and of fibres; `packed` is the
/// fibres' fraction before growth.
Preset histology(const std::string& row, double axons, double fibres, double packed)
{
  return { "Histological target " + row,
    text("One bundle with ", 100.0 * axons, " % of axons and ", 100.0 * (fibres - axons), " % of myelin"),
    paper + "Table 2 " + row + ", after Stikov et al. 2015 (NeuroImage 118:397)",
    { { bundle, "FibreVolumeFraction", packed }, { bundle, "GrownFibreVolumeFraction", fibres },
      { myelin, "GRatioModel", static_cast<std::int64_t>(GRatioModel::TargetAxonVolumeFraction) },
      { myelin, "TargetAxonVolumeFraction", axons } } };
}

/// Returns one bundle of a tissue's axons with published radii, and with the myelin from which outer radii are computed.
Preset publishedRadii(PublishedRadii which)
{
  const RadiusHistogram& histogram = radiusHistogram(which);
  const bool isRelation = which == PublishedRadii::MouseGenu; // the relation of these very axons
  const double gRatio = isRelation ? 0.0 : 0.7;
  const double widest = 2.0 * histogram.largestRadius();
  const double largest = 0.5 * (isRelation ? logLinearOuterDiameter(widest) : widest / gRatio);
  const auto rounded = [](double value) { return std::round(100.0 * value) / 100.0; };
  // Of the very axons of the mouse; where nothing is known, the default's, which is that of human axons (docs/presets.md).
  const double variation = isRelation ? 0.285 : CalibreVariation().deviation;
  // Final sections then have the 0.755 of these axons, whose myelin is thicker than the property reckons with.
  const double axisRatio = isRelation ? 0.79 : CalibreVariation().sectionAxisRatio;
  return { histogram.name,
    text("One bundle with axons of ", rounded(histogram.meanRadius()), " ± ", rounded(histogram.deviation()),
      " µm inner radius, as published"),
    histogram.source,
    { { bundle, "RadiusDistribution", static_cast<std::int64_t>(RadiusModel::Histogram) },
      { bundle, "RadiusHistogram", static_cast<std::int64_t>(which) }, { bundle, "RadiusHistogramGRatio", gRatio },
      { bundle, "CalibreVariation", variation }, { bundle, "SectionAxisRatio", axisRatio },
      { bundle, "MaximumRadius", std::ceil(10.0 * largest) / 10.0 },
      { myelin, "GRatioModel", static_cast<std::int64_t>(isRelation ? GRatioModel::LogLinear : GRatioModel::Constant) } } };
}

/// Adds those with published radii. State files know presets by their positions: what comes later goes to the end.
std::vector<Preset> withLaterOnes(std::vector<Preset> presets)
{
  for (std::size_t i = 0; i < radiusHistograms().size(); ++i)
  {
    const auto which = static_cast<PublishedRadii>(i);
    presets.push_back(publishedRadii(which));
    if (which == PublishedRadii::MouseGenu)
    {
      presets.push_back(callosumWithBareAxons());
    }
  }
  return presets;
}

/// Returns the stages of the chain that a stage stands for.
std::vector<std::string> partsOf(const std::string& stage)
{
  return stage == "SubstrateProduction" ? std::vector<std::string>{ growth, myelin } : std::vector<std::string>{ stage };
}

PropertyValue defaultOf(const std::string& stage, const std::string& property)
{
  for (const StageDescription& described : describeStages())
  {
    for (const PropertyState& state : described.properties)
    {
      if (described.name == stage && state.facts->name == property)
      {
        return state.value;
      }
    }
  }
  throw std::logic_error("a preset sets " + stage + "." + property + ", which there is not");
}

} // namespace

const std::vector<Preset>& presets()
{
  static const std::vector<Preset> all = withLaterOnes({ tutorial(),
    callosum("EM-like",
      "a dense bundle whose fibres fill 95 %, with gaps of 20 nm, as in electron micrographs of fixed tissue; living tissue has "
      "wider gaps",
      "5 % at most between cells, 15 to 20 nm wide, in micrographs of cortex: Arch Neurol 15:633 (1966); more before "
      "fixation: Korogod et al. 2015 (eLife 4:e05793)",
      { { bundle, "GrownFibreVolumeFraction", densest }, { growth, "SurfaceTolerance", densestTolerance } }),
    callosum("in-vivo-like", "which fills 80 %, with gaps of 40 nm at least, as in living tissue",
      "20 % between cells: Syková and Nicholson 2008 (Physiol Rev 88:1277), 38 to 64 nm wide: Thorne and Nicholson 2006 (PNAS "
      "103:5567)",
      { { bundle, "GrownFibreVolumeFraction", 0.8 }, { growth, "MinimumGap", 0.04 } }),
    crossing(60.0, "93.5"), crossing(90.0, "92.2"), histology("a", 0.25, 0.60, 0.54), histology("b", 0.25, 0.68, 0.6),
    histology("c", 0.31, 0.75, 0.6), histology("d", 0.39, 0.76, 0.6) });
  return all;
}

const Preset& presetNamed(const std::string& name)
{
  std::string names;
  for (const Preset& preset : presets())
  {
    if (preset.name == name)
    {
      return preset;
    }
    names += (names.empty() ? "\"" : ", \"") + preset.name + '"';
  }
  throw InvalidInput("there is no preset " + excerpt('"' + name + '"') + ": use " + names);
}

std::vector<std::pair<std::string, PropertyValue>> presetValues(const Preset& preset, const std::string& stage)
{
  std::vector<std::pair<std::string, PropertyValue>> values;
  for (const std::string& part : partsOf(stage))
  {
    for (const Preset& other : presets())
    {
      for (const PresetValue& one : other.values)
      {
        const bool isKnown =
          std::any_of(values.begin(), values.end(), [&](const auto& known) { return known.first == one.property; });
        if (one.stage == part && !isKnown)
        {
          values.emplace_back(one.property, defaultOf(stage, one.property));
        }
      }
    }
    for (const PresetValue& own : preset.values)
    {
      const auto place =
        std::find_if(values.begin(), values.end(), [&](const auto& known) { return known.first == own.property; });
      if (own.stage == part && place != values.end())
      {
        place->second = own.value;
      }
    }
  }
  return values;
}

} // namespace cactus
