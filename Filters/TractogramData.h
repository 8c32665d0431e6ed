// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/Tractogram.h"

class vtkPolyData;

namespace cactus
{

/// Streamlines as polylines, as vtkTractogramReader describes them, with lengths as they are.
void toPolyData(Tractogram tractogram, vtkPolyData* output);

} // namespace cactus
