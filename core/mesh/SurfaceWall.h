// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Domain.h"
#include "mesh/TriangleMesh.h"

#include <cstdint>
#include <vector>

namespace cactus
{

/// µm. How far before a face of the domain a surface's cap may lie: MyelinSurface ends axons a quarter of a voxel before it at
/// most.
constexpr double largestInset = 0.5;

/// The triangles of a fibre's surface that are no caps, in increasing order. A cap lies in a face of the domain, or in the plane
/// where the surface ends beyond that face, as it does unless it was clipped, or at most `inset` µm before it, as inner surfaces
/// do. Coordinates have to be finite.
std::vector<std::uint32_t> wallTriangles(const TriangleMesh& mesh, const Domain& box, double inset = 0.0);

/// The part of the domain between the caps of a surface: the domain itself, but for sides at which caps lie at most `inset` µm
/// before the face.
Domain betweenCaps(const TriangleMesh& mesh, const Domain& box, double inset);

/// The area (µm²) of some triangles.
double areaOf(const TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles);

} // namespace cactus
