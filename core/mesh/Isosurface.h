// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/CappedSurface.h"
#include "mesh/NodeLattice.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace cactus
{

/// Returns the boundary of the region of the lattice's box in which a field is positive: its zero surface, closed by flat caps on
/// the faces of the box.
///
/// The field is given by `values` at the nodes. The surface crosses each edge of a cell once if the signs at its ends differ
/// (marching cubes, Lorensen and Cline 1987); on a face of a cell with four crossings the saddle of the bilinear field decides
/// which of them belong together (asymptotic decider, Nielson and Hamann 1991). Crossings of a cell are chained into loops, face
/// by face, so cells agree on what they share and the surface is a closed, outward 2-manifold. A loop is cut into triangles by
/// diagonals or, in a cell with such a face, around a point in its middle, since a diagonal might lie in the face and be made
/// twice. The surface may have several components.
///
/// Along an edge the field is a parabola. Its second difference is the one that the samples before and behind agree on, so that
/// the error on the surface of a smooth field is of third order in the spacing; linear interpolation would leave ripples of
/// spacing² / (8 radius of curvature). In the outermost cells, which may be flatter, the field is assumed to be the same on both
/// sides, as where its values at a face are copies.
///
/// `blocks` (increasing) must include all blocks with a positive node. `values(range, out)` writes the field at the nodes of a
/// range, which reaches one node beyond a block on every side, also beyond the lattice, where any value will do. A 0 counts as
/// negative, but leads to triangles without an area. The order of points and triangles follows only from the order of blocks and
/// cells. Throws InvalidInput for an invalid lattice.
CappedSurface contour(const NodeLattice& lattice, const std::vector<std::uint32_t>& blocks,
  const std::function<void(const NodeRange&, float*)>& values);

} // namespace cactus
