// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/Tractogram.h"
#include "stages/Stages.h"

class vtkPolyData;

namespace cactus
{

/// Streamlines as polylines, as vtkTractogramReader describes them, with lengths in `unit`. `radius` (µm) is that of every point
/// where the tractogram has none; 0 for none.
void toPolyData(Tractogram tractogram, LengthUnit unit, double radius, vtkPolyData* output);

} // namespace cactus
