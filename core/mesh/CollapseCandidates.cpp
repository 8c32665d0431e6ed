// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/CollapseCandidates.h"

#include "mesh/Quadric.h"

#include <Eigen/Geometry>

namespace cactus
{

namespace
{

using Eigen::Vector3d;

/// Returns the quadric of the present triangles at u and v, from `origin`. Using the present triangles, not the initial ones,
/// lets a surface of much fewer triangles follow the field, which tells the effect of earlier collapses (Lindstrom and Turk
/// 1998).
Quadric quadricAround(const EditableSurface& surface, std::int32_t u, std::int32_t v, const Vector3d& origin)
{
  Quadric sum;
  surface.visitCornersAt(u, v,
    [&](std::int32_t c, std::int32_t point)
    {
      const std::size_t triangle = std::size_t(c) / 3;
      const auto& corners = surface.cornersOf(triangle);
      // A triangle at both was already counted at u.
      const bool isCounted = point == v && (corners[0] == u || corners[1] == u || corners[2] == u);
      // Points of caps stay in their plane anyway; counting caps would dilute the error of their rims.
      if (!isCounted && (surface.facesOf(point) == 0 || !surface.isCap(corners)))
      {
        sum.addPlane(surface.normalOf(triangle), surface.at(corners[0]) - origin);
      }
      return false;
    });
  return sum;
}

/// Tells whether a triangle of the wall would lie in a face of the box if a point were merged into one on a face. Beside an edge
/// of the box the point may lie on the other face there: the wall is a strip between two rims.
bool flattensWall(const EditableSurface& surface, std::int32_t rim, std::int32_t point)
{
  return surface.visitCornersAt(point, point,
    [&](std::int32_t c, std::int32_t)
    {
      const auto edge = surface.oppositeEdge(c);
      const int faces = surface.facesOf(edge[0]) & surface.facesOf(edge[1]);
      return EditableSurface::outlivesCollapse(edge, rim, point) && (faces & surface.facesOf(point)) == 0 &&
             (faces & surface.facesOf(rim)) != 0;
    });
}

/// Tells whether an edge is part of a rim: a cap on one side, and the wall on the other.
bool isAlongRim(const EditableSurface& surface, std::int32_t u, std::int32_t v)
{
  return surface.isCap(surface.cornersOf(surface.triangleAlong(u, v))) !=
         surface.isCap(surface.cornersOf(surface.triangleAlong(v, u)));
}

} // namespace

CollapseCandidates collapseCandidates(
  const EditableSurface& surface, std::int32_t u, std::int32_t v, const Eigen::AlignedBox3d& box, double margin)
{
  const Vector3d& origin = surface.at(u); // near by, so that no digits are lost
  const Quadric sum = quadricAround(surface, u, v, origin);
  const std::uint8_t facesU = surface.facesOf(u);
  const std::uint8_t facesV = surface.facesOf(v);
  const std::uint8_t both = facesU & facesV;
  CollapseCandidates found;
  const bool isRimU = facesU != 0 && surface.isHeldRim(u);
  const bool isRimV = facesV != 0 && surface.isHeldRim(v);
  if (isRimU || isRimV)
  {
    // Points of such a rim take in their neighbours in it, others of its cap and of the wall, but do not move. Across the cap, a
    // point of the rim would take the one between them off it.
    const auto addInto = [&](std::int32_t into, std::int32_t other, bool isRim, bool isOtherRim)
    {
      const bool goes =
        both == surface.facesOf(other) && !(isOtherRim && (surface.isToStay(other) || !isAlongRim(surface, u, v)));
      if (isRim && goes && !flattensWall(surface, into, other))
      {
        found.add(surface.at(into));
      }
    };
    addInto(u, v, isRimU, isRimV);
    addInto(v, u, isRimV, isRimU);
  }
  else if (facesU == facesV)
  {
    const Vector3d middle = 0.5 * (surface.at(u) + surface.at(v));
    if (facesU == 0)
    {
      const double reach = (surface.at(u) - surface.at(v)).norm();
      found.add(keptInside(box, middle, sum.best(middle - origin, reach) + origin, margin));
    }
    else
    {
      found.add(middle);
    }
    found.add(surface.at(u));
    found.add(surface.at(v));
  }
  // Of a surface with held faces, pieces may be as thin as they come, and must not vanish in a face.
  else if (both == facesU && !(surface.hasHeldFaces() && flattensWall(surface, v, u)))
  {
    found.add(surface.at(v));
  }
  else if (both == facesV && !(surface.hasHeldFaces() && flattensWall(surface, u, v)))
  {
    found.add(surface.at(u));
  }
  for (std::size_t p = 0; p < found.count; ++p)
  {
    found.errors[p] = sum.error(found.places[p] - origin);
  }
  return found;
}

} // namespace cactus
