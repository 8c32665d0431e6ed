// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/CappedSurface.h"
#include "mesh/SurfaceCheck.h"
#include "mesh/TriangleTree.h"

namespace cactus
{

// Selection of the pieces of a surface, connected across edges, that are kept.

/// Keeps only the main part of a surface and returns the sum of the other pieces' volumes (µm³), each taken as positive.
///
/// Pieces that the same face of the box cuts off count as one part, since a surface that leaves the box through a face and comes
/// back through it is connected outside. The main part is the one of the largest volume. Of its pieces, those below `smallest`
/// (µm³) are removed, except the largest.
double keepMainPart(CappedSurface& surface, double smallest = 0.0);

/// Keeps only the pieces of a surface that enclose a positive volume, or an empty mesh if it is no closed manifold, and measures
/// the result. Adds the removed volume (µm³) to `dropped`.
SurfaceReport keepSoundPieces(TriangleMesh& mesh, double& dropped);

/// Keeps only the pieces of a surface whose first point lies inside another one.
void keepPiecesInside(CappedSurface& surface, const TriangleTree& around);

/// Tells whether all pieces of a surface, or any of them, lie inside another surface that it does not meet.
bool liesInside(const TriangleMesh& mesh, const SurfaceReport& report, const TriangleTree& around);
bool anyLiesInside(const TriangleMesh& mesh, const SurfaceReport& report, const TriangleTree& around);

/// Tells whether a piece of a surface, which does not meet itself, lies inside another one of its pieces.
bool holdsItself(const TriangleMesh& mesh);

} // namespace cactus
