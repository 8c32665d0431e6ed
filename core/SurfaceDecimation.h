// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Isosurface.h"

#include <functional>
#include <vector>

namespace cactus
{

/// A ball in which less coarsening is wanted; lengths in µm.
struct CalmPlace
{
  Eigen::Vector3d centre;
  double radius;
  double part; ///< of the largest error that is allowed here; where balls overlap the parts multiply
};

/// Parameters of decimation; lengths in µm.
struct SurfaceDecimationOptions
{
  /// Largest distance between the surface before and after, as quadrics estimate it.
  double maximumError = 0.005;
  /// No triangle is made whose longest and shortest squared edges have a ratio above this, unless it was worse before.
  double largestSquaredEdgeRatio = 300.0;
  /// If given: a value at every point of space. A collapse is left out where, at a corner, an edge's middle or the centroid of a
  /// new triangle, it would lie outside [smallestField, largestField] by more than before; on faces of the box only the lower
  /// bound counts.
  std::function<double(const Eigen::Vector3d&)> field;
  double smallestField = 0.0;
  double largestField = 0.0;
  std::vector<CalmPlace> calm;
};

/// Coarsens a closed surface by edge collapses (Garland and Heckbert 1997, quadric error with optimal placement), in sweeps of
/// rising error, cheapest first.
///
/// Each collapse keeps the surface a closed 2-manifold of the same topology (link condition), turns no triangle over, makes no
/// needle, and leaves points on the faces of the box in the faces that they lie in. That distant parts of the surface do not
/// meet is not checked. Points are compacted; the result depends on the input alone.
void decimate(CappedSurface& surface, const SurfaceDecimationOptions& options);

} // namespace cactus
