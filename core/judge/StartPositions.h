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

/// How many are wanted in each compartment.
struct StartCounts
{
  std::size_t intra = 0;
  std::size_t myelin = 0;
  std::size_t extra = 0;
};

/// Draws `counts` points in the compartments, evenly over their parts of the box, by exact inside tests; none lies on a surface.
/// A compartment that there is not (myelin without inner surfaces) gets none. Fibres are taken one after the other, and the
/// result does not depend on threads. Throws Infeasible where a compartment takes up so little of the box that so many points
/// were not found in it, and Cancelled.
StartPositions drawStartPositions(const Domain& box, const FibreSurfaces& outer, const FibreSurfaces& inner,
  const StartCounts& counts, std::uint64_t seed, const Context& context = {});

} // namespace cactus
