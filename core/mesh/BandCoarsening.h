// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/CappedSurface.h"
#include "mesh/NodeLattice.h"
#include "mesh/SurfaceDecimation.h"

namespace cactus
{

/// Coarsens a contour along the longest axis of its lattice: a cheap first step before decimate().
///
/// The planes of the lattice across that axis cut a contour into bands. Bands that are rings between planes which meet the
/// surface in one loop each (see PlaneLoops) are replaced, several together, by one strip of triangles between two loops. Of each
/// loop only those points are kept that chords between the others would miss. Where the field differs from `options.level` by
/// little more than `options.maximumError`, points of loops in between are kept, too (see LoopStitching). Caps in the outermost
/// planes are cut from the loops there. Bands that no strip can replace stay as they are. Points of strips then move in their
/// planes, to balance the field's excess and deficit around each. The topology stays the same, and caps stay in their faces.
///
/// `lattice` is that of contour(), except that its outermost planes do not matter; `options.localBounds` are ignored. Without a
/// `maximumError` nothing changes. The result depends only on the input.
void coarsenBands(CappedSurface& surface, const NodeLattice& lattice, const SurfaceDecimationOptions& options);

} // namespace cactus
