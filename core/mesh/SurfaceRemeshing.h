// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/SurfaceDecimation.h"

namespace cactus
{

/// Parameters of remeshing; lengths in µm.
struct SurfaceRemeshingOptions
{
  /// The field that the surface follows, and how closely: its sampling and largest edge ratio are not used here.
  SurfaceDecimationOptions surface;
  /// Edges are no longer than this on a flat surface, and should be no shorter than an eighth of it.
  double longestEdge = 0.6;
  /// Aim for the smallest angle of a triangle, in degrees.
  double smallestAngle = 20.0;
};

/// Makes the triangles of a closed surface nearly equilateral, for finite elements (Botsch and Kobbelt 2004, with lengths that
/// follow the curvature as in Dunyach et al. 2013): long edges are split and short ones collapsed, edges flipped, points moved
/// along the surface and onto the field's level; finally the remaining small angles are treated one by one.
///
/// Each step keeps the surface a closed 2-manifold of the same topology, turns no triangle over, and leaves points on the faces
/// of the box in these, and the outlines of caps on the level there. The smallest angle is an aim: where an outline or the box
/// has a sharp corner, angles stay below it. Collisions of distant parts of the surface are not checked. Points are compacted;
/// the result depends only on the input.
void remesh(CappedSurface& surface, const SurfaceRemeshingOptions& options);

} // namespace cactus
