// SPDX-License-Identifier: BSD-3-Clause
// Checksums of data in the records of stages.
//
// They equal those that the filters compute from VTK's arrays, so that a recipe run without ParaView leaves the same records.
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

/// Returns that of TractogramReader's streamlines, with their lengths in its unit.
std::string dataChecksum(const Tractogram& tractogram);

/// Returns that of a whole image.
std::string dataChecksum(const LabelImage& image);

/// Returns that of surfaces of one kind (0 outer, 1 inner), by the indices of their fibres.
std::string dataChecksum(const std::vector<FibreSurfacePair>& fibres, const SurfaceSource& surfaces, int kind);

} // namespace cactus
