// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/SurfaceDecimation.h"

namespace cactus
{

/// Parameters of remeshing; lengths in µm.
struct SurfaceRemeshingOptions
{
  /// What the surface follows, and how closely: its sampling and largest edge ratio are of no meaning here.
  SurfaceDecimationOptions surface;
  /// Edges are no longer than this, however flat the surface is, and wanted no shorter than an eighth of it.
  double longestEdge = 0.6;
  /// Degrees that triangles' angles are to have at least.
  double smallestAngle = 20.0;
};

/// Makes the triangles of a closed surface nearly equilateral, as finite elements want them (Botsch and Kobbelt 2004, with
/// lengths that follow the curvature as in Dunyach et al. 2013): long edges are split and short ones collapsed, edges flipped,
/// points moved along the surface, onto the field's level; in the end what is left of small angles is dealt with one by one.
///
/// Each step keeps the surface a closed 2-manifold of the same topology, turns no triangle over, and leaves points on the faces
/// of the box in these, and the outlines of caps on the level there. Smallest angles are an aim: where an outline or the box has
/// a sharp corner they stay below. Whether distant parts of the surface come to meet is not checked. Points are compacted; the
/// result depends on the input alone.
void remesh(CappedSurface& surface, const SurfaceRemeshingOptions& options);

} // namespace cactus
