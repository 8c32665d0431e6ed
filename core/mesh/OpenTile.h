// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Domain.h"
#include "mesh/TriangleMesh.h"

namespace cactus
{

/// Returns a closed surface of a periodic domain without its caps in the periodic faces: its copies, side by side, join to a
/// surface that goes on through them. Caps are the triangles that lie exactly in the surface's outermost plane before a face or
/// in it. Inner surfaces end a little before a face (see largestInset). Their rims are moved into it, and the rest that is nearer
/// to the face than twice that distance is stretched evenly between, to points in single precision.
///
/// Caps across axes that are not periodic stay. Such a cap may have points on an edge of the domain that the cap of the next copy
/// does not have; all lie on one straight line.
///
/// Throws InvalidInput if the surface is not closed, or if its rims in two opposite faces are not equal, bit for bit, so that
/// copies would not join. The message continues the name of the surface.
TriangleMesh openAtPeriodicFaces(const TriangleMesh& mesh, const Domain& domain);

/// Does the same without judging the rims.
TriangleMesh withoutPeriodicCaps(const TriangleMesh& mesh, const Domain& domain);

} // namespace cactus
