// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bundle/Streamlines.h"

class vtkDataObject;

namespace cactus
{

/// Converts polylines to validated streamlines, those of several blocks one after the other, with the cell data `BundleId` if all
/// blocks have it. Throws InvalidInput for anything else.
Streamlines streamlinesFrom(vtkDataObject* input);

} // namespace cactus
