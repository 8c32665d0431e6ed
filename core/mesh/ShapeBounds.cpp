// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/ShapeBounds.h"

#include <algorithm>
#include <cmath>

namespace cactus
{

namespace
{

using Eigen::Vector3d;

/// Least cosine between a triangle's normals before and after a collapse.
constexpr double leastTurn = 0.3;

} // namespace

Vector3d ShapeBounds::normalAround(std::int32_t u, std::int32_t v) const
{
  Vector3d sum = Vector3d::Zero();
  this->Surface.visitCornersAt(u, v,
    [&](std::int32_t c, std::int32_t)
    {
      const std::size_t triangle = std::size_t(c) / 3;
      if (!this->Surface.isCap(this->Surface.cornersOf(triangle)))
      {
        sum += this->Surface.normalOf(triangle);
      }
      return false;
    });
  return sum;
}

/// Returns the worst shapes among the triangles at u and v, or the worst that are always allowed.
TriangleShape ShapeBounds::worstAround(std::int32_t u, std::int32_t v) const
{
  TriangleShape worst{ this->LargestEdgeRatio, flattestTriangle };
  this->Surface.visitCornersAt(u, v,
    [&](std::int32_t c, std::int32_t)
    {
      const TriangleShape shape = this->shapeOf(this->Surface.cornersOf(std::size_t(c) / 3));
      worst.edgeRatio = std::max(worst.edgeRatio, shape.edgeRatio);
      worst.flatness = std::min(worst.flatness, shape.flatness);
      return false;
    });
  return worst;
}

bool ShapeBounds::allowCollapse(std::int32_t u, std::int32_t v, const Vector3d& place, bool flatAllowed) const
{
  Vector3d around = Vector3d::Zero();
  bool isAroundKnown = false;
  TriangleShape worst{ 0.0, 1.0 };
  const auto isTurnedOver = [&](std::int32_t c, std::int32_t point)
  {
    const std::array<std::int32_t, 2> opposite = this->Surface.oppositeEdge(c);
    if (!EditableSurface::outlivesCollapse(opposite, u, v))
    {
      return false; // removed with the edge
    }
    const Vector3d& b = this->Surface.at(opposite[0]);
    const Vector3d edge = this->Surface.at(opposite[1]) - b;
    const Vector3d before = this->Surface.at(point) - b;
    const Vector3d after = place - b;
    const Vector3d normalBefore = edge.cross(before);
    const Vector3d normalAfter = edge.cross(after);
    const double edgeSquared = edge.squaredNorm();
    const double normalSquared = normalAfter.squaredNorm();
    // The normal of a very low triangle is mostly noise: that of the surroundings is used instead.
    const double longestBefore = std::max({ edgeSquared, before.squaredNorm(), (before - edge).squaredNorm() });
    const bool isNoise = normalBefore.squaredNorm() < this->Noise * this->Noise * longestBefore &&
                         !this->Surface.isCap(this->Surface.cornersOf(std::size_t(c) / 3));
    if (isNoise && !isAroundKnown)
    {
      around = this->normalAround(u, v);
      isAroundKnown = true;
    }
    const Vector3d& reference = isNoise ? around : normalBefore;
    const double turn = normalAfter.dot(reference);
    if (!(normalSquared > 0.0) || !(turn > 0.0) || turn * turn < leastTurn * leastTurn * normalSquared * reference.squaredNorm())
    {
      return true;
    }
    const double edges[2] = { after.squaredNorm(), (after - edge).squaredNorm() };
    const double longest = std::max({ edgeSquared, edges[0], edges[1] });
    const double shortest = std::min({ edgeSquared, edges[0], edges[1] });
    worst.edgeRatio = std::max(worst.edgeRatio, longest / shortest);
    worst.flatness = std::min(worst.flatness, normalSquared / (longest * longest));
    return false;
  };
  if (this->Surface.visitCornersAt(u, v, isTurnedOver))
  {
    return false;
  }
  worst.flatness = std::sqrt(worst.flatness);
  if (this->allow(worst) && (flatAllowed || worst.flatness >= flattestTriangle))
  {
    return true;
  }
  const TriangleShape old = this->worstAround(u, v);
  return worst.edgeRatio <= old.edgeRatio && (flatAllowed || worst.flatness >= old.flatness);
}

} // namespace cactus
