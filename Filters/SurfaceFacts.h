// SPDX-License-Identifier: BSD-3-Clause
// Facts about surfaces in their field data, from which missing surfaces are detected.
#pragma once

#include "mesh/FibreSurfaces.h"

#include <vector>

class vtkDataObject;

namespace cactus
{

/// Adds the field data `WantedFibres` (ids of the fibres that were to have a surface) and `MinimumGap` (µm, least distance that
/// the surfaces were made to keep).
void setSurfaceFacts(vtkDataObject* output, const std::vector<int>& wantedFibres, double minimumGap);

/// Fills wantedIds and promisedGap from the field data of surfaces or of their blocks, and isGiven: whether there is any `input`.
/// Missing or invalid data count as unknown.
void readSurfaceFacts(vtkDataObject* input, FibreSurfaces& surfaces);

} // namespace cactus
