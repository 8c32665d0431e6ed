// SPDX-License-Identifier: BSD-3-Clause
#include "surface/MyelinSurfaceOptions.h"

#include "base/Error.h"
#include "base/Limits.h"
#include "fibres/Fibres.h"
#include "growth/FibreRadialGrowthOptions.h"

namespace cactus
{

namespace
{

/// Angles of triangles; 0 means any. Equilateral ones have 60°, and some have little above 25° wherever edge lengths change.
constexpr Range smallestAngles{ 5.0, 25.0, "°", 0.0 };

} // namespace

const PropertyList<MyelinSurfaceOptions>& MyelinSurfaceOptions::properties()
{
  using Options = MyelinSurfaceOptions;
  static const auto list =
    PropertyList<Options>()
      .add("GRatioModel", &Options::model, { "Constant", "LogLinear", "Distributed", "TargetAxonVolumeFraction" },
        "Model of the myelin's thickness: one g-ratio for all fibres, a thickness by the axon's diameter (Lee 2019), a g-ratio "
        "drawn for each fibre, or one g-ratio by the fraction that the axons fill")
      .add("GRatio", &Options::gRatio, limits::gRatio,
        "Diameter of the axon over that of the fibre, or its mean (Distributed, from 0.3 to 0.95)")
      .where("GRatioModel", { 0, 2 })
      .add("GRatioDeviation", &Options::gRatioDeviation, limits::gRatioDeviation, "Standard deviation of the g-ratio over fibres")
      .where("GRatioModel", { 2 })
      .add("TargetAxonVolumeFraction", &Options::targetAxonVolumeFraction, limits::fractionOrNone,
        "Fraction of the domain that the axons should fill")
      .where("GRatioModel", { 3 })
      .add("SmoothingIterations", &Options::smoothingIterations, limits::smoothingIterations,
        "Number of times that a fibre's depth is averaged over neighbouring voxels before its surface is contoured")
      .advise("; more would blur fibres of few voxels away")
      .add("DecimationError", &Options::decimationError, limits::surfaceTolerance,
        "Distance by which coarsening may move a surface (an aim, not a strict bound); 0 keeps all triangles")
      .add("MinimumAngle", &Options::minimumAngle, smallestAngles,
        "Smallest angle of nearly all triangles, for finite elements; 0: no smallest angle, and as few triangles as possible")
      .add("ClipToDomain", &Options::clipToDomain,
        "Cut fibres off at the faces of the domain, and close them; if off, they reach to the end of the image")
      .add("Seed", &Options::seed, limits::seed, "Seed of the fibres' g-ratios if GRatioModel is Distributed");
  return list;
}

void validate(const MyelinSurfaceOptions& options)
{
  validateProperties(options);
  if (options.model == GRatioModel::Distributed)
  {
    distributedGRatio(options.gRatio, options.gRatioDeviation, 0, 1);
  }
  if (options.minimumAngle > 0.0 && options.decimationError == 0.0)
  {
    throw InvalidInput("MinimumAngle moves surfaces by up to DecimationError, which is 0: give it 0.005 µm, say");
  }
  if (options.model == GRatioModel::TargetAxonVolumeFraction && options.targetAxonVolumeFraction == 0.0)
  {
    throw InvalidInput(text("TargetAxonVolumeFraction is 0: give ", limits::fraction.lowest, " to ", limits::fraction.highest,
      " where GRatioModel is TargetAxonVolumeFraction"));
  }
}

LabelImageFacts labelImageFacts(const Fibres& fibres, const FibreRadialGrowthOptions& growth)
{
  LabelImageFacts facts;
  facts.domain = fibres.domain;
  facts.minimumGap = growth.minimumGap;
  facts.surfaceTolerance = growth.surfaceTolerance;
  facts.fibreIds = fibres.fibreIds;
  facts.bundleIds = fibres.bundleIds;
  facts.targetRadii = fibres.targetRadii;
  facts.columns = fibres.columns;
  return facts;
}

void requireDecimationRoom(const MyelinSurfaceOptions& options, double surfaceTolerance)
{
  if (options.decimationError > surfaceTolerance * (1.0 + 1e-9))
  {
    throw InvalidInput(text("DecimationError ", options.decimationError, " is more than the room of ", surfaceTolerance,
      " µm that growth left for moving surfaces: choose a smaller one, or raise SurfaceTolerance in FibreRadialGrowth"));
  }
}

} // namespace cactus
