// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"
#include "growth/FibreRadialGrowth.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cactus
{

/// Bounds of the factors by which fibres are thickened, relative to those that one starts from.
struct FactorBounds
{
  double thickening; ///< at most larger by this factor
  double thinning;   ///< at most smaller by this factor
};

/// A thick fibre beside a thin one. Once the radii of either have changed by its factor, the thin one is whole where
/// thick factor · radius <= room + thin factor · core.
///
/// On the centre line of the thin fibre its own field is at least (1 - ρ) times its radius there, and that of the thick one at
/// most the latter's radius less the distance of the centre lines. Asked for is that the first is larger by the gap and half the
/// radius that came, so that a depth of a quarter of it is left.
struct Crowding
{
  std::uint32_t thick;
  std::uint32_t thin;
  double radius;
  double room;
  double core;
};

/// All pairs of fibres of which one could sever the other however the factors change from those `wished`, within the bounds;
/// ordered by thick and thin fibre. Throws OutOfMemory.
std::vector<Crowding> findCrowding(const Fibres& fibres, const FibreRadialGrowthOptions& options,
  const std::vector<double>& wished, const FactorBounds& bounds, int threads);

/// The largest factor of fibre `thick` with which all thin ones beside it, at their present factors, are whole; infinite where
/// there are none.
double largestFactor(const std::vector<Crowding>& crowding, std::size_t thick, const std::vector<double>& factors);

} // namespace cactus
