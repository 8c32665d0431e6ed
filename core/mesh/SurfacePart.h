// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

#include <cstdint>
#include <vector>

namespace cactus
{

/// Some triangles of a surface, as a mesh of its own: in the surface's order, and the points in the order in which these have
/// them.
struct SurfacePart
{
  TriangleMesh mesh;
  std::vector<std::int32_t> pointOf; ///< the surface's points that are the mesh's
};

/// The triangles of a surface that touch `lower` <= z <= `upper` (µm).
SurfacePart cutOut(const TriangleMesh& surface, double lower, double upper);

} // namespace cactus
