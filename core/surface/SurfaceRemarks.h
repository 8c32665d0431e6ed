// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface/FibreField.h"
#include "surface/FibreSurfacePair.h"
#include "surface/MyelinSurfaceOptions.h"

#include <string>
#include <vector>

namespace cactus
{

/// How many fibres did not come out as asked, in what way, and what to do about it, in one sentence; empty where all did.
/// `voxelSize` is in µm. Fibres that pass by outside the domain are not missed.
std::string notAsAsked(
  const std::vector<FibreSurfacePair>& pairs, double voxelSize, const LabelImageFacts& facts, bool byFilters = false);

} // namespace cactus
