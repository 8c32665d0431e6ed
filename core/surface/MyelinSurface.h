// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "surface/FibreField.h"
#include "surface/FibreSurfacePair.h"
#include "surface/MyelinSurfaceOptions.h"
#include "surface/SurfaceFilters.h"

#include <vector>

namespace cactus
{

/// Returns the outer and inner surfaces of all fibres of a label image, in increasing order of fibres.
///
/// The outer surface of a fibre is where its smoothed field (see SmoothedField) equals a level at or just below 0, contoured by
/// contour(), with flat caps on the faces of the box. The level compensates the volume that smoothing removes, up to the
/// tolerance. The inner surface is where the field is `thickness`, its caps moved into the box by MinimumGap, but at least a
/// twentieth and at most a quarter of a voxel, so that they do not meet the outer ones. The thickness is solved for so that inner
/// volume over outer volume is the square of the fibre's g-ratio, measured on the final surfaces.
///
/// Each surface is coarsened as long as the field at points spread over it stays within decimationError of its level, or within
/// the initial error of the contour, and moved along its normals to its target volume. It has to be a closed, outward 2-manifold
/// that meets neither itself (exact predicates) nor its outer surface; if it fails it is made again with less coarsening around
/// that place, finally with none. Triangles whose squared edges have a ratio above 800 are split. Then outer surfaces are moved
/// inwards, by nanometres, where two of them are nearer than MinimumGap (see keepApart()); one that then meets itself is made
/// again with less coarsening, or deeper if nothing is coarsened. Where growth has left less than 0.01 µm between two fibres,
/// outer surfaces lie deeper by half of the missing distance. Inner surfaces keep the same distance from the walls of the outer
/// ones: where coarsening or creases bring them nearer, the myelin gets thicker (Thicker), or there is no axon. All of this is
/// checked without coarsening, too. Remaining faults are marked (isFlawed). A piece of a surface that encloses no positive
/// volume, as of a fibre of a voxel or two, is left out.
///
/// A fibre that leaves the box through a face and comes back has a piece for each stay; of other pieces the largest is kept (see
/// keepMainPart()).
///
/// With `filters` these contour the unsmoothed fields and coarsen the contours, in place of all this; surfaces are then not
/// repaired and not moved apart. Faults of a single surface are marked (isFlawed); the certificate finds those between two, see
/// markFaults().
///
/// Throws InvalidInput (options; an invalid image; a fibre in the image that is not in the table; decimationError above the
/// tolerance), Infeasible (a target fraction that cannot be met), Cancelled.
std::vector<FibreSurfacePair> myelinSurfaces(const LabelImageView& image, const LabelImageFacts& facts,
  const MyelinSurfaceOptions& options, const Context& context = {}, const SurfaceFilters* filters = nullptr);

} // namespace cactus
