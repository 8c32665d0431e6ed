// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/SurfaceDistance.h"

#include <array>
#include <limits>

/// Returns smallestGap() of two triangles.
inline cactus::SurfaceGap triangleGap(const std::array<Eigen::Vector3d, 3>& a, const std::array<Eigen::Vector3d, 3>& b,
  double below = std::numeric_limits<double>::infinity())
{
  const auto alone = [](const std::array<Eigen::Vector3d, 3>& corners)
  {
    cactus::TriangleMesh mesh;
    mesh.points.assign(corners.begin(), corners.end());
    mesh.triangles = { { { 0, 1, 2 } } };
    return mesh;
  };
  const cactus::TriangleMesh meshA = alone(a);
  const cactus::TriangleMesh meshB = alone(b);
  return cactus::smallestGap(cactus::TriangleTree(meshA), cactus::TriangleTree(meshB), below);
}
