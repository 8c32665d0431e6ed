// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/CappedSurface.h"
#include "mesh/NodeLattice.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace cactus
{

/// The boundary of the region of the lattice's box in which a field is positive: its zero surface, closed by flat caps on the
/// faces of the box.
///
/// The field is what `values` gives at the nodes. The surface crosses each edge of a cell once where the signs at its ends differ
/// (marching cubes, Lorensen and Cline 1987); on a face of a cell with four crossings the saddle of the bilinear field says which
/// of them belong together (asymptotic decider, Nielson and Hamann 1991). Crossings of a cell are chained into loops, face by
/// face, so cells agree on what they share and the surface is a closed, outward 2-manifold. A loop is cut into triangles by
/// diagonals or, in a cell with such a face, around a point in its middle, since a diagonal might lie in the face and be made
/// twice. It may have several components.
///
/// Along an edge the field is taken as a parabola, bent by the second difference that the samples before and behind agree on, so
/// that the surface of a smooth field is off by the third power of the spacing; linear interpolation would leave ripples of
/// spacing² / (8 radius of curvature). In the outermost cells, which may be flatter, the field is taken to be the same on both
/// sides, as where its values at a face are copies.
///
/// `blocks` (increasing) is where to look: all blocks in which a node is positive must be among them. `values(range, out)` has
/// to give the field at the nodes of a range, which reaches one node beyond a block on every side, also beyond the lattice, where
/// anything will do. A 0 is taken for a negative number, but leaves triangles without an area.
/// The order of points and triangles follows from the order of blocks and cells alone. Throws InvalidInput for a lattice that is
/// none.
CappedSurface contour(const NodeLattice& lattice, const std::vector<std::uint32_t>& blocks,
  const std::function<void(const NodeRange&, float*)>& values);

} // namespace cactus
