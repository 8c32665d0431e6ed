// SPDX-License-Identifier: BSD-3-Clause
// What the records of stages know data by: the checksums that the filters take of the same data in VTK's arrays, so that a recipe
// run without ParaView leaves the same records.
#pragma once

#include "fibres/Fibres.h"
#include "growth/LabelImage.h"
#include "io/Tractogram.h"
#include "mesh/SurfaceStore.h"
#include "surface/FibreSurfacePair.h"

#include <string>
#include <vector>

namespace cactus
{

std::string dataChecksum(const Fibres& fibres);

/// Of streamlines as TractogramReader gives them, with their lengths in the unit that it was told.
std::string dataChecksum(const Tractogram& tractogram);

/// Of a whole image.
std::string dataChecksum(const LabelImage& image);

/// Of surfaces of one kind (0 outer, 1 inner), by the places of their fibres.
std::string dataChecksum(const std::vector<FibreSurfacePair>& fibres, const SurfaceSource& surfaces, int kind);

} // namespace cactus
