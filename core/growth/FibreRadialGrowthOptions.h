// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Properties.h"
#include "fibres/Fibres.h"
#include "growth/Calibre.h"

#include <cstdint>

namespace cactus
{

/// Parameters of fibre radial growth; lengths in µm.
struct FibreRadialGrowthOptions
{
  /// Edge of a voxel. If it does not divide the domain's sides, the nearest spacing that does is used.
  double voxelSize = 0.1;
  /// Fraction of the domain that the grown fibres fill, in [0, 1), see GrowthTarget.h; 0: grow by `growthIterations` voxels; -1:
  /// what the fibres were made for. Where these do not say it, see forFibres().
  double targetFibreVolumeFraction = -1.0;
  /// Growth in voxels where no target is given.
  int growthIterations = 0;
  /// Least distance between the surfaces of two fibres.
  double minimumGap = 0.02;
  /// Additional room on either side of the gap for later steps that move a surface (smoothing, decimation).
  double surfaceTolerance = 0.0075;
  /// How far, as a fraction of its local radius, a fibre may fall short of its capsules before it grows, in [0, 0.5].
  double surfaceRoughness = 0.0;
  /// Random points per µm³ of the capsules from which fibres grow; 0: the capsules themselves.
  double seedDensity = 0.0;
  /// Width by which the image extends beyond the domain on every side, rounded up to whole voxels.
  double margin = 0.0;
  std::uint64_t seed = 1;

  static const PropertyList<FibreRadialGrowthOptions>& properties();
  /// Returns the distance that growth keeps between two fibres: minimumGap + 2 surfaceTolerance.
  double gap() const { return minimumGap + 2.0 * surfaceTolerance; }
};

/// Throws InvalidInput, naming the parameter, for a value out of range.
void validate(const FibreRadialGrowthOptions& options);

/// The options with a target for fibres that come from elsewhere, of which it is not known what they were made for: they keep the
/// volume that they come with, unless a target or growth is asked for. Their roughness and the gap between neighbours are then
/// made up for, as they are for bundles. Without a target where the fibres fill too little of the domain to be counted, and where
/// SurfaceRoughness and SeedDensity are 0, with which they are their capsules. Throws InvalidInput where they fill more than the
/// domain holds.
FibreRadialGrowthOptions forFibres(const Fibres& fibres, const FibreRadialGrowthOptions& options);

/// The fraction of the domain that these fibres are to be grown to; 0: they grow by `growthIterations`, as do fibres of which it
/// is not known what they were made for. Throws InvalidInput where it is more than the domain holds, as of bundles in one place
/// that were all made to fill it.
double targetFraction(const Fibres& fibres, const FibreRadialGrowthOptions& options);

/// The options of the fibres' seeds. Throws as targetFraction() does.
SeedOptions seedOptions(const Fibres& fibres, const FibreRadialGrowthOptions& options);

} // namespace cactus
