// SPDX-License-Identifier: BSD-3-Clause
#include "growth/FibreRadialGrowthOptions.h"

#include "base/Error.h"
#include "base/Limits.h"
#include "growth/VolumeInDomain.h"

namespace cactus
{

namespace
{

/// Less of the domain holds too few samples (see growthFor) for a volume that is right to some per cent.
constexpr double leastCountedFraction = 1e-4;

} // namespace

const PropertyList<FibreRadialGrowthOptions>& FibreRadialGrowthOptions::properties()
{
  using Options = FibreRadialGrowthOptions;
  static const auto list =
    PropertyList<Options>()
      .add("VoxelSize", &Options::voxelSize, limits::voxelSize,
        "Edge of a voxel; if it does not divide the domain, the nearest size that does is used")
      .add("TargetFibreVolumeFraction", &Options::targetFibreVolumeFraction, limits::targetFraction,
        "Fraction of the domain that the grown fibres should fill, with their radii on target; -1: the fraction that the fibres "
        "were made for (GrownFibreVolumeFraction) or, if that is unknown and GrowthIterations is 0, the fraction that they fill "
        "in the input; 0: no target, they grow by GrowthIterations")
      .advise(" (-1: what the fibres were made for; 0: no target)")
      .add("GrowthIterations", &Options::growthIterations, limits::growthIterations,
        "Number of voxels by which an unhindered fibre grows if there is no target")
      .where("TargetFibreVolumeFraction", { -1, 0 })
      .add("MinimumGap", &Options::minimumGap, limits::gap, "Smallest distance between the surfaces of two fibres")
      .add("SurfaceTolerance", &Options::surfaceTolerance, limits::surfaceTolerance,
        "Room on either side of the gap, within which smoothing and decimation may later move surfaces")
      .add("SurfaceRoughness", &Options::surfaceRoughness, limits::surfaceRoughness,
        "Fraction of its radius by which a fibre may be thinner than its capsules before it grows, at random along it")
      .add("Margin", &Options::margin, limits::imageMargin,
        "Width by which the image extends beyond the domain on every side, rounded up to whole voxels")
      .add("Seed", &Options::seed, limits::seed, "Seed of the random calibre that SurfaceRoughness gives the fibres");
  return list;
}

void validate(const FibreRadialGrowthOptions& options)
{
  validateProperties(options);
}

FibreRadialGrowthOptions forFibres(const Fibres& fibres, const FibreRadialGrowthOptions& options)
{
  FibreRadialGrowthOptions own = options;
  const bool isAsked = options.targetFibreVolumeFraction >= 0.0 || options.growthIterations > 0;
  if (isAsked || fibres.grownFraction > 0.0 || options.surfaceRoughness == 0.0)
  {
    return own;
  }
  double volume = 0.0;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    volume += volumeInDomain(fibres, f, 1.0);
  }
  const double fraction = volume / fibres.domain.volume();
  if (fraction > limits::targetFraction.highest)
  {
    throw InvalidInput(text("the fibres fill ", fraction,
      " of the domain as they come, overlaps counted twice, and it holds less than 1: part them by CapsuleOptimizer, give "
      "TargetFibreVolumeFraction, or set it to 0 for growth by GrowthIterations"));
  }
  own.targetFibreVolumeFraction = fraction >= leastCountedFraction ? fraction : 0.0;
  return own;
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
