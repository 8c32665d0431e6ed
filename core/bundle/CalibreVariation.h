// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Properties.h"
#include "bundle/Beads.h"

namespace cactus
{

/// The kinds of variation.
enum class CalibreModel
{
  Lognormal = 0, ///< swellings and necks of all sizes
  Beads = 1      ///< swellings of one size, with the same radius in between
};

/// How a fibre's radius varies along it. Lognormal: the logarithm of the axon's (inner) radius is a stationary Gaussian process
/// with Matérn-3/2 correlation (1 + √3 d/ℓ) exp(-√3 d/ℓ) at a distance d along the fibre, as measured in human white matter (Lee
/// et al. 2023; mouse: Lee et al. 2019). The myelin's thickness is the same along a fibre, so that the outer radius is
///
///     r(s) = R N (1 - g + g exp(σ z(s)))
///
/// with z the process of variance 1, g the g-ratio (gRatio, if given, or 0.7, or that of RadiusHistogramGRatio where radii are
/// those of axons), R the fibre's radius, and N so that the mean of r² is R². Beads: 1 + a b(s) takes the place of exp(σ z(s)),
/// see BeadShape.
struct CalibreVariation
{
  CalibreModel model = CalibreModel::Lognormal;
  /// Mean over the fibres of the deviation σ of the logarithm of the inner radius, in [0, 0.5]. It falls with a fibre's radius as
  /// R^-0.3. 0: fibres are as thick everywhere.
  double deviation = 0.25;
  /// µm, ℓ of the final surfaces: z has 0.8 of it, since later stages smooth it.
  double correlationLength = 1.3;
  /// How much larger than its mean an axon's radius is in a bead, as a fraction of that mean, on final surfaces.
  double beadAmplitude = 0.6;
  BeadShape beads;
  /// Mean axis ratio of the axons' sections on final surfaces, in [0.7, 1]. 1: growth alone shapes them.
  double sectionAxisRatio = 0.85;
  double gRatio = 0.0; ///< of fibres with myelin; 0: the stage that makes surfaces says it

  static const PropertyList<CalibreVariation>& properties();
  /// Throws InvalidInput for beads that are too near to each other. Precondition: validateProperties().
  void validate() const;
  bool varies() const { return this->model == CalibreModel::Lognormal ? this->deviation > 0.0 : this->beadAmplitude > 0.0; }
};

/// Returns the largest distance (µm) of control points that resolves the variation; infinite without one.
double longestSpacing(const CalibreVariation& variation);

} // namespace cactus
