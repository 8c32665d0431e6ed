// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Domain.h"
#include "mesh/FibreSurfaces.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cactus
{

/// Points (µm) at which walkers start.
struct StartPositions
{
  std::vector<Eigen::Vector3d> intra;  ///< inside an inner surface; inside an outer one if there are no inner ones at all
  std::vector<Eigen::Vector3d> myelin; ///< inside an outer surface and not in or on an inner one
  std::vector<Eigen::Vector3d> extra;  ///< outside all surfaces
};

/// Draws `count` points in each compartment, evenly over its part of the domain, by exact inside tests; none lies on a surface. A
/// missing compartment (myelin without inner surfaces) gets none. Fibres are processed one after the other, and the result does
/// not depend on threads. Throws Infeasible if a compartment fills so little of the domain that not enough points were found in
/// it, and Cancelled.
StartPositions drawStartPositions(const Domain& domain, const FibreSurfaces& outer, const FibreSurfaces& inner, std::size_t count,
  std::uint64_t seed, const Context& context = {});

} // namespace cactus
