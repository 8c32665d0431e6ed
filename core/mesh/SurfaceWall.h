// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Domain.h"
#include "mesh/TriangleMesh.h"

#include <cstdint>
#include <vector>

namespace cactus
{

/// The largest distance (µm) of a surface's cap before a face of the domain: MyelinSurface ends axons at most a quarter of a
/// voxel before it.
constexpr double largestInset = 0.5;

/// Returns the triangles of a fibre's surface that are no caps, in increasing order. A cap lies in a face of the domain, or in
/// the plane beyond that face where an unclipped surface ends, or at most `inset` µm before it, as in inner surfaces. Coordinates
/// have to be finite.
std::vector<std::uint32_t> wallTriangles(const TriangleMesh& mesh, const Domain& box, double inset = 0.0);

/// Returns the part of the domain between the caps of a surface: the domain itself, except on sides at which caps lie at most
/// `inset` µm before the face.
Domain betweenCaps(const TriangleMesh& mesh, const Domain& box, double inset);

/// Returns the area (µm²) of some triangles.
double areaOf(const TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles);

} // namespace cactus
