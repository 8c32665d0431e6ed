// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/EditableSurface.h"
#include "mesh/TriangleShape.h"

namespace cactus
{

/// Least height of a triangle that coarsening makes, as a fraction of its longest edge.
constexpr double flattestTriangle = 0.015;

/// Keeps the triangles of a surface well formed while its edges are collapsed.
class ShapeBounds
{
public:
  /// Forbids triangles whose longest and shortest squared edges have a ratio above `largestEdgeRatio`. The normal of a triangle
  /// lower than `noise` (µm) counts as arbitrary. `surface` has to outlive the object.
  ShapeBounds(const EditableSurface& surface, double largestEdgeRatio, double noise)
    : Surface(surface)
    , LargestEdgeRatio(largestEdgeRatio)
    , Noise(noise)
  {
  }

  /// Tells whether no triangle around an edge is turned over or made a needle, or a worse one than exists, when the ends of the
  /// edge move to `place`. With `flatAllowed` triangles may become flatter than flattestTriangle.
  bool allowCollapse(std::int32_t u, std::int32_t v, const Eigen::Vector3d& place, bool flatAllowed) const;

  bool allow(const TriangleShape& shape) const { return shape.edgeRatio <= this->LargestEdgeRatio; }

  TriangleShape shapeOf(const std::array<std::int32_t, 3>& corners) const
  {
    return cactus::shapeOf(this->Surface.at(corners[0]), this->Surface.at(corners[1]), this->Surface.at(corners[2]));
  }

  /// Returns the sum of the area normals of the triangles at u and v, without caps.
  Eigen::Vector3d normalAround(std::int32_t u, std::int32_t v) const;

private:
  TriangleShape worstAround(std::int32_t u, std::int32_t v) const;

  const EditableSurface& Surface;
  double LargestEdgeRatio;
  double Noise;
};

} // namespace cactus
