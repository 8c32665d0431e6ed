// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface/FibreField.h"
#include "surface/FibreSurfacePair.h"
#include "surface/MyelinSurfaceOptions.h"

#include <string>
#include <vector>

namespace cactus
{

/// Returns one sentence on how many fibres deviate from the request, in what way, and what to do about it; empty if none does.
/// `voxelSize` is in µm. Fibres that pass outside the domain are not missing.
std::string notAsAsked(
  const std::vector<FibreSurfacePair>& pairs, double voxelSize, const LabelImageFacts& facts, bool byFilters = false);

/// Returns one sentence on how many axons swell less than asked, since their fibres have no room for it; empty if
/// none does.
std::string remarkOnSwellings(
  const std::vector<FibreSurfacePair>& pairs, const LabelImageFacts& facts, const MyelinSurfaceOptions& options);

} // namespace cactus
