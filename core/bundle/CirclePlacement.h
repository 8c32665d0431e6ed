// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bundle/Circles.h"

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <vector>

namespace cactus
{

/// Proposes the n-th centre to try for a circle. The centre must keep the circle inside its rectangle.
using CentreProposal = std::function<Eigen::Vector2d(std::size_t circle, int trial)>;

/// Returns the circles by radius, the largest first; equal ones by index.
std::vector<std::size_t> largestFirst(const std::vector<double>& radii);

/// Sets all centres: circles are placed largest first, each at the first of its proposals that overlaps no circle
/// placed before, or else at the proposal that overlaps least (sum of squared depths). A 2-D grid finds the neighbours.
void placeCircles(Circles& circles, const CentreProposal& propose, int trials);

} // namespace cactus
