// SPDX-License-Identifier: BSD-3-Clause
// Set and Get methods of options that several filters have, as their PropertyLists include them.
#pragma once

#include "FilterProperties.h"

/// Properties of RadiusDistributionOptions.
#define CACTUS_RADIUS_DISTRIBUTION_PROPERTIES                                                                                    \
  CACTUS_WHOLE_PROPERTY(RadiusDistribution)                                                                                      \
  CACTUS_NUMBER_PROPERTY(GammaShape)                                                                                             \
  CACTUS_NUMBER_PROPERTY(GammaScale)                                                                                             \
  CACTUS_NUMBER_PROPERTY(LognormalMean)                                                                                          \
  CACTUS_NUMBER_PROPERTY(LognormalDeviation)                                                                                     \
  CACTUS_TEXT_PROPERTY(RadiusTable)                                                                                              \
  CACTUS_FILE_PROPERTY(RadiusTableFile)                                                                                          \
  CACTUS_TEXT_PROPERTY(RadiusTableColumn)                                                                                        \
  CACTUS_NUMBER_PROPERTY(RadiusTableFactor)                                                                                      \
  CACTUS_WHOLE_PROPERTY(RadiusHistogram)                                                                                         \
  CACTUS_NUMBER_PROPERTY(RadiusHistogramFactor)                                                                                  \
  CACTUS_NUMBER_PROPERTY(RadiusHistogramGRatio)                                                                                  \
  CACTUS_NUMBER_PROPERTY(MinimumRadius)                                                                                          \
  CACTUS_NUMBER_PROPERTY(MaximumRadius)

/// Properties of CalibreVariation.
#define CACTUS_CALIBRE_VARIATION_PROPERTIES                                                                                      \
  CACTUS_WHOLE_PROPERTY(CalibreModel)                                                                                            \
  CACTUS_NUMBER_PROPERTY(CalibreVariation)                                                                                       \
  CACTUS_NUMBER_PROPERTY(CalibreCorrelationLength)                                                                               \
  CACTUS_NUMBER_PROPERTY(BeadAmplitude)                                                                                          \
  CACTUS_NUMBER_PROPERTY(BeadSpacing)                                                                                            \
  CACTUS_NUMBER_PROPERTY(BeadSpacingDeviation)                                                                                   \
  CACTUS_NUMBER_PROPERTY(BeadLength)

/// Properties of UnmyelinatedAxons.
#define CACTUS_UNMYELINATED_AXONS_PROPERTIES                                                                                     \
  CACTUS_NUMBER_PROPERTY(UnmyelinatedFraction)                                                                                   \
  CACTUS_NUMBER_PROPERTY(UnmyelinatedRadius)                                                                                     \
  CACTUS_NUMBER_PROPERTY(UnmyelinatedRadiusDeviation)                                                                            \
  CACTUS_WHOLE_PROPERTY(UnmyelinatedCluster)

/// Properties of ControlPointSpacing.
#define CACTUS_CONTROL_POINT_SPACING_PROPERTIES                                                                                  \
  CACTUS_NUMBER_PROPERTY(SpacingFactor)                                                                                          \
  CACTUS_NUMBER_PROPERTY(MinimumSpacing)                                                                                         \
  CACTUS_NUMBER_PROPERTY(MaximumSpacing)

/// Properties of FibreRadialGrowthOptions, without Seed.
#define CACTUS_FIBRE_RADIAL_GROWTH_PROPERTIES                                                                                    \
  CACTUS_NUMBER_PROPERTY(VoxelSize)                                                                                              \
  CACTUS_NUMBER_PROPERTY(TargetFibreVolumeFraction)                                                                              \
  CACTUS_WHOLE_PROPERTY(GrowthIterations)                                                                                        \
  CACTUS_NUMBER_PROPERTY(MinimumGap)                                                                                             \
  CACTUS_NUMBER_PROPERTY(SurfaceTolerance)                                                                                       \
  CACTUS_NUMBER_PROPERTY(SurfaceRoughness)                                                                                       \
  CACTUS_NUMBER_PROPERTY(SeedDensity)                                                                                            \
  CACTUS_NUMBER_PROPERTY(Margin)

/// Properties of MyelinSurfaceOptions, without Seed.
#define CACTUS_MYELIN_SURFACE_PROPERTIES                                                                                         \
  CACTUS_WHOLE_PROPERTY(GRatioModel)                                                                                             \
  CACTUS_NUMBER_PROPERTY(GRatio)                                                                                                 \
  CACTUS_NUMBER_PROPERTY(GRatioDeviation)                                                                                        \
  CACTUS_NUMBER_PROPERTY(TargetAxonVolumeFraction)                                                                               \
  CACTUS_SWITCH_PROPERTY(MyelinFollowsAxon)                                                                                      \
  CACTUS_NUMBER_PROPERTY(SwellingAmplitude)                                                                                      \
  CACTUS_NUMBER_PROPERTY(SwellingSpacing)                                                                                        \
  CACTUS_NUMBER_PROPERTY(SwellingLength)                                                                                         \
  CACTUS_NUMBER_PROPERTY(NodeLength)                                                                                             \
  CACTUS_NUMBER_PROPERTY(InternodeFactor)                                                                                        \
  CACTUS_NUMBER_PROPERTY(ParanodeLength)                                                                                         \
  CACTUS_NUMBER_PROPERTY(NodeConstriction)                                                                                       \
  CACTUS_WHOLE_PROPERTY(NodeSeed)                                                                                                \
  CACTUS_NUMBER_PROPERTY(InternodeLoss)                                                                                          \
  CACTUS_WHOLE_PROPERTY(InternodeOrder)                                                                                          \
  CACTUS_NUMBER_PROPERTY(RemyelinatedFraction)                                                                                   \
  CACTUS_NUMBER_PROPERTY(RemyelinatedGRatio)                                                                                     \
  CACTUS_WHOLE_PROPERTY(SmoothingIterations)                                                                                     \
  CACTUS_NUMBER_PROPERTY(DecimationError)                                                                                        \
  CACTUS_NUMBER_PROPERTY(MinimumAngle)                                                                                           \
  CACTUS_SWITCH_PROPERTY(ClipToDomain)
