// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Properties.h"
#include "fibres/Fibres.h"

#include <cstdint>

namespace cactus
{

/// Parameters of fibre radial growth; lengths in µm.
struct FibreRadialGrowthOptions
{
  /// Edge of a voxel. If it does not divide the domain's sides, the nearest spacing that does is used.
  double voxelSize = 0.1;
  /// Fraction of the domain that the grown fibres fill, in [0, 1), see GrowthTarget.h; 0: grow by `growthIterations` voxels; -1:
  /// the fraction that the fibres were made for.
  double targetFibreVolumeFraction = -1.0;
  /// Growth in voxels without a target.
  int growthIterations = 4;
  /// Least distance between the surfaces of two fibres.
  double minimumGap = 0.02;
  /// Additional room on either side of the gap for later steps that move a surface (smoothing, decimation).
  double surfaceTolerance = 0.0075;
  /// How far, as a fraction of its local radius, a fibre may fall short of its capsules before it grows, in [0, 0.5].
  double surfaceRoughness = 0.1;
  /// Width by which the image extends beyond the domain on every side, rounded up to whole voxels.
  double margin = 0.0;
  std::uint64_t seed = 1;

  static const PropertyList<FibreRadialGrowthOptions>& properties();
  /// Returns the distance that growth keeps between two fibres: minimumGap + 2 surfaceTolerance.
  double gap() const { return minimumGap + 2.0 * surfaceTolerance; }
};

/// Throws InvalidInput, naming the parameter, for a value out of range.
void validate(const FibreRadialGrowthOptions& options);

/// Returns the fraction of the domain that these fibres grow to; 0: they grow by `growthIterations`, as do fibres made for an
/// unknown fraction. Throws InvalidInput if it is more than the domain can hold, such as for bundles in one place that were all
/// made to fill it.
double targetFraction(const Fibres& fibres, const FibreRadialGrowthOptions& options);

} // namespace cactus
