// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

namespace cactus
{

/// The properties of one surface that a simulator relies on. Points that no triangle uses do not count.
struct SurfaceReport
{
  std::size_t triangles = 0;
  std::size_t points = 0;               ///< points used by a triangle
  std::size_t components = 0;           ///< pieces connected across edges
  std::size_t openEdges = 0;            ///< edges of one triangle only
  std::size_t crowdedEdges = 0;         ///< edges of three triangles or more
  std::size_t flippedEdges = 0;         ///< edges of two triangles that run through them in the same sense
  std::size_t pinchedPoints = 0;        ///< points whose triangles form more than one fan
  std::size_t degenerateTriangles = 0;  ///< triangles with a corner twice or without an area
  std::size_t repeatedCorners = 0;      ///< triangles that use a point twice; left out of edges, fans and components
  std::size_t inwardComponents = 0;     ///< components with a negative or no volume
  double volume = 0.0;                  ///< µm³, signed: positive where normals point outward; meaningful if closed()
  double area = 0.0;                    ///< µm²
  double smallestAngle = 0.0;           ///< degrees, over all triangles' corners
  double largestSquaredEdgeRatio = 0.0; ///< longest² / shortest² edge of a triangle; MCDC warns above 1000
  double smallestAltitude = 0.0;        ///< µm, over all triangles; no edge of a triangle is shorter
  double largestAspect = 0.0;           ///< longest edge over the altitude on it, over all triangles; 2 / √3 at best
  /// Degrees, between a point's area-weighted normal and the normal of one of its triangles, over all points: beyond 90° the
  /// triangle seems to be turned inside out to a reader that takes points' normals.
  double largestNormalAngle = 0.0;
  std::vector<std::int32_t> pieces; ///< one point of each component

  /// Tells whether every edge belongs to exactly two triangles, which run through it in opposite senses.
  bool closed() const { return components > 0 && openEdges == 0 && crowdedEdges == 0 && flippedEdges == 0; }
  /// Tells whether the surface is closed(), no triangle uses a corner twice, and around each point the triangles form a single
  /// fan.
  bool closedManifold() const { return closed() && pinchedPoints == 0 && repeatedCorners == 0; }
  /// Tells whether every component encloses a positive volume. A cavity with correct orientation counts as inward.
  bool outward() const { return components > 0 && inwardComponents == 0; }
  /// Tells whether a simulator can tell inside from outside.
  bool sound() const { return closedManifold() && outward(); }
};

/// Lists all of a report, see base/Bytes.h.
inline auto membersOf(SurfaceReport& report)
{
  return std::tie(report.triangles, report.points, report.components, report.openEdges, report.crowdedEdges, report.flippedEdges,
    report.pinchedPoints, report.degenerateTriangles, report.repeatedCorners, report.inwardComponents, report.volume, report.area,
    report.smallestAngle, report.largestSquaredEdgeRatio, report.smallestAltitude, report.largestAspect,
    report.largestNormalAngle, report.pieces);
}

/// Throws InvalidInput if a triangle names a point that does not exist, or one with a coordinate that is not finite or beyond
/// limits::coordinate.
void requireCorners(const TriangleMesh& mesh);

/// Measures one surface in time linear in its triangles. The volume uses the divergence theorem about a point of the surface, so
/// that a small surface far from the origin loses no digits. An empty surface gives a report of zeros, which is not closed.
/// Throws InvalidInput as requireCorners() does for used points. `componentOf`, if given, receives the component of each
/// triangle, numbered as in `pieces`.
SurfaceReport checkSurface(const TriangleMesh& mesh, std::vector<std::uint32_t>* componentOf = nullptr);

} // namespace cactus
