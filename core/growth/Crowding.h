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

/// A capsule of a thick fibre beside one of a thin fibre. With any factors on their radii, the thin one is in one piece there if
/// thick factor <= room + thin factor · core.
///
/// On the centre line of the thin fibre its own field is at least (1 - ρ) c times its radius there, and that of the thick one at
/// most its radius, times its reach, minus the distance of the centre lines (c and reach: see SectionShape). The condition
/// requires the first to exceed the second by the gap plus 0.75 of the initial radius, so that a depth of half of that remains.
struct Crowding
{
  std::uint32_t thickPoint; ///< the first of the capsule's two control points
  std::uint32_t thinPoint;
  float room; ///< this and core: in radii of the thick one
  float core;
};

/// Finds all pairs of capsules of which one could sever the other's fibre for some factors within `bounds` of those `wished` (per
/// fibre); in the order of thick points. Throws OutOfMemory.
std::vector<Crowding> findCrowding(const Fibres& fibres, const FibreRadialGrowthOptions& options,
  const std::vector<double>& wished, const FactorBounds& bounds, int threads);

/// Lowers the factors (of all, per control point) of the capsules that begin at the control points [first, last), but not below
/// `least`, where thin fibres beside them would not stay in one piece at their present factors.
void limitFactors(
  const std::vector<Crowding>& crowding, std::size_t first, std::size_t last, double least, std::vector<double>& factors);

} // namespace cactus
