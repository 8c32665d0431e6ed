// SPDX-License-Identifier: BSD-3-Clause
// The table of facts about fibres' surfaces.
#pragma once

#include "surface/FibreSurfacePair.h"

#include <vector>

class vtkTable;

namespace cactus
{

/// Fills the table with a row for each fibre.
void fillSurfaceTable(vtkTable* table, const std::vector<FibreSurfacePair>& fibres);

} // namespace cactus
