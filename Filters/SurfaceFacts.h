// SPDX-License-Identifier: BSD-3-Clause
// What surfaces say of themselves in their field data, so that what is missing of them can be told.
#pragma once

#include "mesh/FibreSurfaces.h"

#include <vector>

class vtkDataObject;

namespace cactus
{

/// Adds the field data `WantedFibres` (ids of the fibres that were to have a surface) and `MinimumGap` (µm that the surfaces were
/// made to keep from each other at least).
void setSurfaceFacts(vtkDataObject* output, const std::vector<int>& wantedFibres, double minimumGap);

/// Fills wantedIds and promisedGap from the field data of surfaces or, where these are composite, of their blocks, and isGiven:
/// whether there is any `input`. What is not there, or is no such number, is taken as not said.
void readSurfaceFacts(vtkDataObject* input, FibreSurfaces& surfaces);

} // namespace cactus
