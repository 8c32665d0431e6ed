// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/CappedSurface.h"
#include "mesh/NodeLattice.h"
#include "mesh/SurfaceDecimation.h"

namespace cactus
{

/// Coarsens a contour along the axis of its lattice along which it is longest: a beginning of decimate() that costs little.
///
/// The planes of the lattice across that axis cut a contour into bands. Bands that are rings between planes which meet the
/// surface in one loop each (see PlaneLoops) are replaced, several together, by one strip of triangles between two loops, of
/// which only points are kept whose chords would miss others; where the field is farther from `options.level` than little more
/// than `options.maximumError`, points of loops between these are kept, too (see LoopStitching). Caps in the outermost planes are
/// cut from the loops there. Bands that no strip can replace stay as they are. Points of strips then move in their planes, so
/// that the surface around each lies amid where the field is too large and too small. The topology stays the same, and caps stay
/// in their faces.
///
/// `lattice` is that of contour(), of which the outermost planes do not matter; `options.localBounds` are not looked at. Without
/// a `maximumError` nothing changes. The result depends on the input alone.
void coarsenBands(CappedSurface& surface, const NodeLattice& lattice, const SurfaceDecimationOptions& options);

} // namespace cactus
