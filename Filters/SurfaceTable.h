// SPDX-License-Identifier: BSD-3-Clause
// The table of what is known of fibres' surfaces.
#pragma once

#include "surface/FibreSurfacePair.h"

#include <vector>

class vtkTable;

namespace cactus
{

/// A row for each fibre.
void fillSurfaceTable(vtkTable* table, const std::vector<FibreSurfacePair>& fibres);

} // namespace cactus
