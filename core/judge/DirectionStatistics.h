// SPDX-License-Identifier: BSD-3-Clause
// The directions of fibres by the measures that diffusion imaging uses.
#pragma once

#include "fibres/Fibres.h"
#include "judge/FibreProfile.h"

#include <vector>

namespace cactus
{

/// The directions of fibres' centre lines inside the domain, about the axis of each fibre's bundle: the principal axis of the
/// bundle's directions. NaN where there are too few.
struct DirectionStatistics
{
  double p2 = 0.0;             ///< ⟨P2(cos θ)⟩ = ⟨3 cos²θ - 1⟩ / 2 over lengths of fibres: 1 parallel, 0 isotropic
  double p2ByAxonVolume = 0.0; ///< the same over volumes of axons, as water inside sees it
  /// Concentration of the Watson distribution with the same ⟨cos²θ⟩, its estimate of maximum likelihood (Mardia and Jupp 2000,
  /// Directional Statistics, section 10.3).
  double kappa = 0.0;
  double odi = 0.0;         ///< orientation dispersion index, (2/π) arctan(1/κ) (Zhang et al. 2012, NeuroImage 61:1000)
  double localSpread = 0.0; ///< degrees, mean angle between two fibres of a bundle whose middles are at most 10 µm apart
  /// How far a bundle is one twisted rope: the sum of r × t along its axis over the sum of |r| |t|, with r and t the place and
  /// the direction across the axis, over all places of its fibres. ±1: a rope; a mean over bundles by their numbers of places.
  double twist = 0.0;
  /// Larger over smaller mean square of directions across the axis, along their principal axes, over all places: 1 if all
  /// azimuths are alike. Mean as above.
  double azimuthRatio = 0.0;
  /// Angular correlation coefficient of the axons' directions by volume with those that the fibres were made for
  /// (Fibres::orientationHarmonics; Anderson 2005, Magn Reson Med 54:1194), over degrees from 2 to 8 at most: 1 if they are as
  /// asked for. NaN where none were, or all directions alike.
  double angularCorrelation = 0.0;
};

/// The concentration κ of the Watson distribution (density ∝ exp(κ cos²θ)) with this mean of cos²θ: 0 up to a third, at most
/// 1e14.
double watsonConcentration(double meanSquaredCosine);

/// The cross-sections of a fibre's axon.
struct AxonSections
{
  const std::vector<FibreCut>* cuts = nullptr; ///< see cutsAlongFibre()
  double radius = 0.0;                         ///< µm, where there is no cut; NaN without an axon
};

/// Measures the directions at every `spacing` (µm) along each centre line, at the places of placesAlongFibre(). `axons` has one
/// entry per fibre.
DirectionStatistics measureDirections(const Fibres& fibres, const std::vector<AxonSections>& axons, double spacing);

} // namespace cactus
