// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>

namespace cactus
{

// Tests whether triangles meet, by exact predicates (see ExactPredicates.h): no result depends on rounding. Triangles are closed
// sets, so that touching in a single point counts as meeting. Flat triangles (all corners on one line) are treated as lines.

/// Pointers to the corners of a triangle.
using TriangleCorners = std::array<const Eigen::Vector3d*, 3>;

inline TriangleCorners cornersOf(const TriangleMesh& mesh, std::uint32_t triangle)
{
  const auto& t = mesh.triangles[triangle];
  return { { &mesh.points[std::size_t(t[0])], &mesh.points[std::size_t(t[1])], &mesh.points[std::size_t(t[2])] } };
}

/// Tells whether all corners lie on one line.
bool isFlat(const TriangleCorners& t);

/// Tells whether two triangles have a point in common.
bool trianglesMeet(const TriangleCorners& a, const TriangleCorners& b);
bool trianglesMeet(const std::array<Eigen::Vector3d, 3>& a, const std::array<Eigen::Vector3d, 3>& b);

/// Tells whether two triangles of one mesh, neither of them flat, meet outside the corners that they share by index.
bool meetElsewhere(const TriangleMesh& mesh, std::uint32_t first, std::uint32_t second);

/// Tells whether the closed segment p–q and a triangle have a point in common.
bool segmentMeets(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const TriangleCorners& t);

} // namespace cactus
