// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/Tractogram.h"

class vtkPolyData;

namespace cactus
{

/// Converts streamlines to polylines, as described in vtkTractogramReader, with unchanged lengths.
void toPolyData(Tractogram tractogram, vtkPolyData* output);

} // namespace cactus
