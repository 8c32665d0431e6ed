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
/// which only points are kept whose chords would miss others. A strip is as long as the field lets it be, which at its edges and
/// the middles of its triangles has to be within little more than `options.maximumError` of `options.level`; bands that no strip
/// can replace stay as they are. Points of strips then move in their planes, so that the surface around each lies amid where the
/// field is too large and too small. The topology stays the same, and caps stay in their faces.
///
/// `lattice` is that of contour(), of which the outermost planes do not matter; `options.localBounds` are not looked at. Without
/// a `maximumError` nothing changes. The result depends on the input alone.
void coarsenBands(CappedSurface& surface, const NodeLattice& lattice, const SurfaceDecimationOptions& options);

} // namespace cactus
