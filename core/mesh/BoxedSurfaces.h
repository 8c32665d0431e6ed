// SPDX-License-Identifier: BSD-3-Clause
// Closed surfaces in a box as one complex of triangles, for tetrahedral meshing.
//
// Where a surface was capped on a face of the box, the face itself replaces the cap.
#pragma once

#include "base/Context.h"
#include "base/Domain.h"
#include "mesh/TriangleMesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace cactus
{

/// A closed, outward surface (µm) between two compartments.
struct CompartmentSurface
{
  TriangleMesh mesh;
  std::int32_t inside = 0;
  std::int32_t outside = 0;
};

/// A point (µm) well inside a connected part of a compartment.
struct CompartmentPoint
{
  std::int32_t compartment = 0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
};

/// Triangles that meet only in corners and edges, and cut a box into compartments.
struct BoxedSurfaces
{
  static constexpr std::int32_t beyond = -1; ///< the compartment outside the box

  TriangleMesh mesh;
  /// Per triangle, the compartment behind it and the one that its normal points into; the faces' normals point out of the box.
  std::vector<std::array<std::int32_t, 2>> sides;

  /// Returns the volume (µm³) of each compartment, by the divergence theorem.
  std::vector<double> volumes(std::size_t compartments) const;
  /// Returns a point for each connected part of the border of a compartment, by compartment: well inside, as far as a cheap test
  /// of the surrounding triangles can tell.
  std::vector<CompartmentPoint> pointsInside(const Context& context = {}) const;
};

/// Joins surfaces with the faces of a box. Caps, which are the triangles with all corners on one face (up to rounding), are
/// removed; each face is cut into triangles between its corners and the outlines of the surfaces in it. `around` is the
/// compartment outside all surfaces, and `inside` of one surface is `outside` of those that it contains. Throws InvalidInput if a
/// surface is not closed or reaches out of the box, or if outlines in a face cross.
BoxedSurfaces joinInBox(const Domain& box, const std::vector<CompartmentSurface>& surfaces, std::int32_t around);

/// Moves the flat end of a surface that lies up to `furthest` (µm) before a face of the box into that face: inner surfaces end a
/// little before outer ones. Faces are numbered as the bits of CappedSurface. Returns whether anything moved.
bool extendToFace(TriangleMesh& mesh, const Domain& box, int face, double furthest);

/// Returns the triangles of a surface without those that joinInBox() removes.
std::vector<std::uint32_t> trianglesOffFaces(const TriangleMesh& mesh, const Domain& box);

} // namespace cactus
