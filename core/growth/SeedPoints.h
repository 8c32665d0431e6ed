// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Random.h"
#include "fibres/Fibres.h"
#include "growth/Calibre.h"

#include <Eigen/Core>

#include <cstddef>

namespace cactus
{

/// The random points in one segment of a fibre's capsules from which the fibre grows, uniform across and along it (paper, "FRG
/// description": "randomly placing seed points within all capsule fibres"). So that the fibre is in one piece, the seed is a thin
/// chain of capsules on the centre line, and a ball at each point, joined to the chain by a cone. All lie within the capsules.
///
/// As many as the density makes of the whole volume, they lie between the chain and where their balls touch the capsules' walls.
/// Random numbers depend on seed, fibre id and the segment's number alone.
class SeedPoints
{
public:
  /// Radii of the chain and of the balls, as fractions of the capsules'.
  static constexpr double core = 0.25;
  static constexpr double tip = 0.15;

  /// segment: number of its first control point in the fibre. None without a density.
  SeedPoints(const SeedOptions& options, const Fibres& fibres, std::size_t fibre, std::size_t segment);

  std::size_t size() const { return this->Size; }

  /// Where a point lies.
  struct Place
  {
    double along;           ///< of its foot on the centre line, as a fraction of the segment
    Eigen::Vector3d across; ///< from the foot to the point, as a fraction of the capsule's radius: core to 1 - tip
  };
  /// Returns the place of the next one of size() points. tangent: unit vector along the segment.
  Place next(const Eigen::Vector3d& tangent);

private:
  RandomEngine Engine;
  double FirstRadius;
  double LastRadius;
  std::size_t Size = 0;
};

} // namespace cactus
