// SPDX-License-Identifier: BSD-3-Clause
// From growth to the writer: what surfaces are to be told of the image, and the writer of them.
#pragma once

#include "fibres/Fibres.h"
#include "growth/FibreRadialGrowthOptions.h"
#include "io/SubstrateContents.h"
#include "mesh/SurfaceStore.h"
#include "surface/FibreSurfacePair.h"
#include "surface/MyelinSurfaceOptions.h"

#include <vector>

namespace cactus
{

/// Of the image that these options grow from the fibres: labelImageFacts() with the fibres' lengths in the domain.
LabelImageFacts grownImageFacts(const Fibres& fibres, const FibreRadialGrowthOptions& growth);

/// Puts the surfaces that a SurfaceMaker has made, wherever they are, into what is to be written, with the ids of the fibres that
/// were to have some. `outer` and `inner` hold them by the places of their fibres in `fibres`, and have to outlive `contents`.
/// `gap` (µm) is what they were made to keep from each other.
void addMadeSurfaces(const std::vector<FibreSurfacePair>& fibres, const SurfaceSource& outer, const SurfaceSource& inner,
  double gap, SubstrateFolderContents& contents);

} // namespace cactus
