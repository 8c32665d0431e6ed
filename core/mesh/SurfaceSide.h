// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleTree.h"

#include <Eigen/Core>

namespace cactus
{

/// The position of a point relative to a closed surface.
enum class Side
{
  Outside,
  On,
  Inside
};

/// Counts how often a line from the point to the outside crosses the surface, by exact predicates. `surface` has to be closed.
Side sideOf(const TriangleTree& surface, const Eigen::Vector3d& point);

} // namespace cactus
