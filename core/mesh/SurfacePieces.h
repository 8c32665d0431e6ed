// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/CappedSurface.h"
#include "mesh/SurfaceCheck.h"
#include "mesh/TriangleTree.h"

namespace cactus
{

// Which pieces of a surface, connected across edges, are kept.

/// Leaves the main part of a surface and returns the sum of the other pieces' volumes (µm³), each taken as positive.
///
/// Pieces that the same face of the box cuts off count as one part, since what leaves the box through a face and comes back
/// through it is connected outside. The main part is the one of the largest volume. Of its pieces, those below `smallest` (µm³)
/// go, except the largest.
double keepMainPart(CappedSurface& surface, double smallest = 0.0);

/// Leaves the pieces of a surface that enclose a positive volume, or an empty mesh if it is no closed manifold, and measures what
/// is left. Adds what goes (µm³) to `dropped`.
SurfaceReport keepSoundPieces(TriangleMesh& mesh, double& dropped);

/// Leaves the pieces of a surface that begin inside another one.
void keepPiecesInside(CappedSurface& surface, const TriangleTree& around);

/// Whether all pieces of a surface that does not meet another one, or any of them, lie inside that.
bool liesInside(const TriangleMesh& mesh, const SurfaceReport& report, const TriangleTree& around);
bool anyLiesInside(const TriangleMesh& mesh, const SurfaceReport& report, const TriangleTree& around);

/// Whether a piece of a surface, which does not meet itself, lies inside another one of its pieces.
bool holdsItself(const TriangleMesh& mesh);

} // namespace cactus
