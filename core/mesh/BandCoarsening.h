// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/CappedSurface.h"
#include "mesh/NodeLattice.h"
#include "mesh/SurfaceDecimation.h"

namespace cactus
{

/// Coarsens a contour along the axis of its lattice along which it is longest, as a cheap beginning of decimate().
///
/// The planes of the lattice across that axis cut a contour into bands. Where a plane meets it in one loop, so does the next one,
/// and what lies between them is a ring (its Euler characteristic is 0), any number of such bands is replaced by one strip of
/// triangles between two loops, of which only points are kept that their chords would miss. The strip is as long as the
/// field lets it be: at the middles of its edges and the centroids of its triangles, and at points at most `options.sampling`
/// apart along its edges, the field is within `options.maximumError` of the level. Everything else stays as it is, so that the
/// topology does not change, no point moves, and caps stay in their faces.
///
/// `lattice` is that of contour(); its outermost planes do not matter. Of the options, `localBounds` are not looked at.
void coarsenBands(CappedSurface& surface, const NodeLattice& lattice, const SurfaceDecimationOptions& options);

} // namespace cactus
