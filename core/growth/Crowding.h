// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"
#include "growth/FibreRadialGrowth.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cactus
{

/// Bounds of the fibres' thickness factors, relative to their initial values.
struct FactorBounds
{
  double thickening; ///< at most larger by this factor
  double thinning;   ///< at most smaller by this factor
};

/// A thick fibre beside a thin one. With any factors on their radii, the thin one is in one piece if thick factor · radius <=
/// room + thin factor · core.
///
/// On the centre line of the thin fibre its own field is at least (1 - ρ) c times its radius there, and that of the thick one at
/// most its radius, times its reach, minus the distance of the centre lines (c and reach: see SectionShape). The condition
/// requires the first to exceed the second by the gap plus half the initial radius, so that a depth of a quarter of it remains.
struct Crowding
{
  std::uint32_t thick;
  std::uint32_t thin;
  double radius;
  double room;
  double core;
};

/// Finds all pairs of fibres of which one could sever the other for some factors within `bounds` of those `wished`; ordered by
/// thick and thin fibre. Throws OutOfMemory.
std::vector<Crowding> findCrowding(const Fibres& fibres, const FibreRadialGrowthOptions& options,
  const std::vector<double>& wished, const FactorBounds& bounds, int threads);

/// Returns the largest factor of fibre `thick` for which all thin ones beside it, at their present factors, stay in one piece;
/// infinite if there are none.
double largestFactor(const std::vector<Crowding>& crowding, std::size_t thick, const std::vector<double>& factors);

} // namespace cactus
