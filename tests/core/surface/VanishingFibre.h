// SPDX-License-Identifier: BSD-3-Clause
// Voxels four times as wide as the fibres are thick: the rest of one disappears when it is moved.
#pragma once

#include "BundleBetweenWalls.h"
#include "bundle/BundleInitializer.h"
#include "fibres/TrimToDomain.h"
#include "growth/FibreRadialGrowthOptions.h"

namespace example
{

inline cactus::Fibres fibresOfWhichOneGoes()
{
  cactus::BundleBetweenWalls bundle;
  bundle.side = 6.29273;
  bundle.seed = 1097183328;
  bundle.fibreVolumeFraction = 0.518059;
  bundle.grownFibreVolumeFraction = 0.6653;
  bundle.radius.model = cactus::RadiusModel::Lognormal;
  bundle.radius.minimum = 0.113802;
  bundle.radius.maximum = 0.113802;
  bundle.spacing.factor = 2.77719;
  bundle.spacing.minimum = 0.23601;
  bundle.spacing.maximum = 0.7139;
  bundle.calibre.sectionAxisRatio = 1.0;
  bundle.meanDispersion = 0.0;
  return trimToDomain(initialiseBundles(bundle));
}

inline cactus::FibreRadialGrowthOptions growthInWhichOneGoes()
{
  cactus::FibreRadialGrowthOptions growth;
  growth.voxelSize = 0.478582;
  growth.targetFibreVolumeFraction = 0.481987;
  growth.minimumGap = 0.0;
  growth.surfaceTolerance = 0.00797561;
  growth.surfaceRoughness = 0.0246807;
  growth.margin = 0.0929287;
  growth.seed = 16;
  return growth;
}

} // namespace example
