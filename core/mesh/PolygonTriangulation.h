// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace cactus
{

/// Cuts a polygon, whose corners run counter-clockwise, into the triangles of its constrained Delaunay triangulation (see
/// PlaneTriangulation), also counter-clockwise, as indices of corners. Returns none if the polygon crosses or touches itself, or
/// has fewer than three corners.
std::vector<std::array<std::int32_t, 3>> trianglesOf(const std::vector<Eigen::Vector2d>& polygon);

} // namespace cactus
