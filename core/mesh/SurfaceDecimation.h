// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/Isosurface.h"

#include <functional>
#include <vector>

namespace cactus
{

/// A ball in which the surface is coarsened less; lengths in µm.
struct LocalErrorBound
{
  Eigen::Vector3d centre;
  double radius;
  double part; ///< of the largest error that is allowed here; where balls overlap, the parts multiply
};

/// Parameters of decimation; lengths in µm.
struct SurfaceDecimationOptions
{
  /// A value at every point of space, which rises by about 1 per µm into the body, and the level of the surface.
  std::function<double(const Eigen::Vector3d&)> field;
  double level = 0.0;
  /// The largest distance of the field from its level at the new triangles' corners, middles of edges and centroids, and at
  /// points at most `sampling` apart on large ones; a larger initial distance may not grow. On faces of the box the field may be
  /// larger.
  double maximumError = 0.005;
  double sampling = 0.6;
  /// No triangle is made whose longest and shortest squared edges have a larger ratio, unless it was worse before.
  double largestSquaredEdgeRatio = 300.0;
  std::vector<LocalErrorBound> localBounds;
};

/// Coarsens a closed surface by edge collapses, in sweeps of rising error, cheapest first. The new point is placed nearest to the
/// planes of the triangles that it replaces (quadrics of Garland and Heckbert 1997, without memory as in Lindstrom and Turk
/// 1998), and moved from there along the normal, if that brings the field into its range. Then edges are flipped if that brings
/// the surface nearer to the level. Long surfaces are coarsened in stretches, one after the other.
///
/// Each collapse keeps the surface a closed 2-manifold of the same topology (link condition), turns no triangle over, makes no
/// needle, and leaves points on the faces of the box in their faces. Collisions of distant parts of the surface are not checked.
/// Points are compacted; the result depends only on the input.
void decimate(CappedSurface& surface, const SurfaceDecimationOptions& options);

} // namespace cactus
