// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace cactus
{

/// Cuts a polygon, whose corners go round counter-clockwise, into the triangles of its constrained Delaunay triangulation (see
/// PlaneTriangulation), counter-clockwise, too, by the numbers of their corners. Returns none where the polygon crosses or
/// touches itself, and of less than three corners.
std::vector<std::array<std::int32_t, 3>> trianglesOf(const std::vector<Eigen::Vector2d>& polygon);

} // namespace cactus
