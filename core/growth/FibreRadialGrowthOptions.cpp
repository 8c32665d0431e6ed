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
        "Edge of a voxel in µm. At most half the radius of the thinnest fibre is a good choice. If it does not divide the domain "
        "into whole voxels, the nearest size that does is used.")
      .add("TargetFibreVolumeFraction", &Options::targetFibreVolumeFraction, limits::targetFraction,
        "Fraction of the domain that the grown fibres should fill, for instance 0.9. -1: the fraction that the fibres were made "
        "for (GrownFibreVolumeFraction of BundleInitializer); fibres without one, such as those of a file, keep their volume "
        "unless GrowthIterations is above 0. 0: no target; fibres grow by GrowthIterations voxels. Fibres packed for this "
        "fraction end at their TargetRadius, or all larger by the same factor if some left the domain. For more than that all "
        "radii end larger by the same amount (but those of axons without myelin), for less smaller by the same factor. "
        "If the fibres were made for another fraction, a warning names the difference. If the gaps between fibres do not allow "
        "the fraction, they fill as much as they can, and a warning names both.")
      .advise(" (-1: what the fibres were made for; 0: no target)")
      .add("GrowthIterations", &Options::growthIterations, limits::growthIterations,
        "Number of voxels by which an unhindered fibre grows outwards from its capsules. It has an effect only without a target: "
        "if TargetFibreVolumeFraction is 0, or -1 and it is not known what fraction the fibres were made for.")
      .where("TargetFibreVolumeFraction", { -1, 0 })
      .add("MinimumGap", &Options::minimumGap, limits::gap, "Smallest distance in µm between the surfaces of two fibres.")
      .add("SurfaceTolerance", &Options::surfaceTolerance, limits::surfaceTolerance,
        "Room in µm on either side of the gap, within which smoothing and decimation may later move the surfaces.")
      .add("SurfaceRoughness", &Options::surfaceRoughness, limits::surfaceRoughness,
        "Unevenness of the fibres' calibre: the fraction of its radius by which a fibre may be thinner than its capsules before "
        "it grows, at random and smoothly along it. 0: the capsules themselves grow.")
      .add("SeedDensity", &Options::seedDensity, limits::seedDensity,
        "Random points per µm³ of its capsules from which a fibre grows, as in the paper: the fewer, the more uneven its "
        "surface, and the thicker thin fibres end. Cones join the points to the centre line, so that the fibre stays in one "
        "piece. SectionAxisRatio of bundles has no effect on such fibres. 0: fibres grow from their whole capsules.")
      .advise(" (0: capsules)")
      .add("Margin", &Options::margin, limits::imageMargin,
        "Width in µm by which the image extends beyond the domain on every side, rounded up to whole voxels.")
      .add("Seed", &Options::seed, limits::seed,
        "Seed of the directions in which sections of fibres are elongated (SectionAxisRatio of bundles), of the random calibre "
        "that SurfaceRoughness gives the fibres, and of the points of SeedDensity. The same seed gives the same image.");
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
  if (isAsked || fibres.grownFraction > 0.0 || (options.surfaceRoughness == 0.0 && options.seedDensity == 0.0))
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

SeedOptions seedOptions(const Fibres& fibres, const FibreRadialGrowthOptions& options)
{
  return { options.surfaceRoughness, options.seed, targetFraction(fibres, options), options.seedDensity };
}

} // namespace cactus
