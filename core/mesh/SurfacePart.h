// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

#include <cstdint>
#include <vector>

namespace cactus
{

/// Some triangles of a surface as a separate mesh: triangles in the surface's order, points in the order of their first use.
struct SurfacePart
{
  TriangleMesh mesh;
  std::vector<std::int32_t> pointOf; ///< per point of the mesh, its index in the surface
};

/// Returns the triangles of a surface that touch `lower` <= z <= `upper` (µm).
SurfacePart cutOut(const TriangleMesh& surface, double lower, double upper);

} // namespace cactus
