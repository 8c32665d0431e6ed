// SPDX-License-Identifier: BSD-3-Clause
#include "growth/FibreRadialGrowthOptions.h"

#include "base/Error.h"
#include "base/Limits.h"

namespace cactus
{

const PropertyList<FibreRadialGrowthOptions>& FibreRadialGrowthOptions::properties()
{
  using Options = FibreRadialGrowthOptions;
  static const auto list =
    PropertyList<Options>()
      .add("VoxelSize", &Options::voxelSize, limits::voxelSize,
        "Edge of a voxel; where it does not divide the domain, the nearest size that does is used")
      .add("TargetFibreVolumeFraction", &Options::targetFibreVolumeFraction, limits::targetFraction,
        "Fraction of the domain that the grown fibres fill, with their radii on target; -1: what the fibres were made for "
        "(GrownFibreVolumeFraction); 0, or where they do not say it: they grow by GrowthIterations")
      .advise(" (-1: what the fibres were made for; 0: no target)")
      .add("GrowthIterations", &Options::growthIterations, limits::growthIterations,
        "How many voxels a fibre grows where nothing is in its way")
      .where("TargetFibreVolumeFraction", { -1, 0 })
      .add("MinimumGap", &Options::minimumGap, limits::gap, "Least distance between the surfaces of two fibres")
      .add("SurfaceTolerance", &Options::surfaceTolerance, limits::surfaceTolerance,
        "Room left on either side of the gap, within which smoothing and decimation may later move surfaces")
      .add("SurfaceRoughness", &Options::surfaceRoughness, limits::surfaceRoughness,
        "Fraction of its radius by which a fibre may fall short of its capsules, at random along it, before it grows")
      .add("Margin", &Options::margin, limits::imageMargin,
        "Width by which the image extends beyond the domain on every side, rounded up to whole voxels")
      .add("Seed", &Options::seed, limits::seed, "Seed of the random calibre that SurfaceRoughness gives the fibres");
  return list;
}

void validate(const FibreRadialGrowthOptions& options)
{
  validateProperties(options);
}

double targetFraction(const Fibres& fibres, const FibreRadialGrowthOptions& options)
{
  if (options.targetFibreVolumeFraction >= 0.0)
  {
    return options.targetFibreVolumeFraction;
  }
  if (fibres.grownFraction > limits::targetFraction.highest)
  {
    throw InvalidInput(text("these fibres were made to fill ", fibres.grownFraction,
      " of the domain, all bundles together, and it holds less than 1: lower the GrownFibreVolumeFraction of each "
      "BundleInitializer to its share, or give TargetFibreVolumeFraction"));
  }
  return fibres.grownFraction;
}

} // namespace cactus
