// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Properties.h"

namespace cactus
{

/// Parameters of the VTK filters that MyelinSurface can make surfaces with.
struct VtkMeshingOptions
{
  int sincIterations = 20;      ///< of vtkWindowedSincPolyDataFilter; 0 keeps the contour
  double sincPassBand = 0.1;    ///< in (0, 2]: the lower, the smoother
  double targetReduction = 0.9; ///< fraction of the triangles that vtkQuadricDecimation removes, in [0, 1); 0 keeps them all

  static const PropertyList<VtkMeshingOptions>& properties();
};

/// Throws InvalidInput, naming the property, for a value out of range.
void validate(const VtkMeshingOptions& options);

} // namespace cactus
