// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Properties.h"

namespace cactus
{

/// Parameters of the filters of VTK that MyelinSurface can make surfaces with.
struct VtkMeshingOptions
{
  int sincIterations = 20;      ///< of vtkWindowedSincPolyDataFilter; 0 leaves the contour as it is
  double sincPassBand = 0.1;    ///< in (0, 2]: the lower, the smoother
  double targetReduction = 0.9; ///< part of the triangles that vtkQuadricDecimation removes, in [0, 1); 0 leaves them all

  static const PropertyList<VtkMeshingOptions>& properties();
};

/// Throws InvalidInput, naming the property, for a value out of range.
void validate(const VtkMeshingOptions& options);

} // namespace cactus
