// SPDX-License-Identifier: BSD-3-Clause
// The steps from growth to the writer: facts of the image for the surfaces, and surfaces for the writer.
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

/// Returns labelImageFacts() for the image grown from the fibres with these options, with the fibres' lengths in the domain.
LabelImageFacts grownImageFacts(const Fibres& fibres, const FibreRadialGrowthOptions& growth);

/// Adds the surfaces of a SurfaceMaker, wherever they are stored, to the contents to be written, with the ids of the fibres that
/// were to have some. `outer` and `inner` hold them by the indices of their fibres in `fibres`, and have to outlive `contents`.
/// `gap` (µm) is the distance that they were made to keep from each other.
void addMadeSurfaces(const std::vector<FibreSurfacePair>& fibres, const SurfaceSource& outer, const SurfaceSource& inner,
  double gap, SubstrateFolderContents& contents);

} // namespace cactus
