// SPDX-License-Identifier: BSD-3-Clause
#include "stages/VtkMeshingOptions.h"

#include "base/Limits.h"

namespace cactus
{

const PropertyList<VtkMeshingOptions>& VtkMeshingOptions::properties()
{
  using Options = VtkMeshingOptions;
  static const auto list =
    PropertyList<Options>()
      .add("SincIterations", &Options::sincIterations, limits::sincIterations,
        "Iterations of VTK's windowed sinc smoothing; 0 leaves the contour as it is.")
      .add("SincPassBand", &Options::sincPassBand, limits::sincPassBand,
        "Pass band of VTK's windowed sinc smoothing. A lower value smooths more and moves surfaces further.")
      .add("TargetReduction", &Options::targetReduction, limits::targetReduction,
        "Fraction of the triangles that VTK's quadric decimation removes; 0 keeps all.");
  return list;
}

void validate(const VtkMeshingOptions& options)
{
  validateProperties(options);
}

} // namespace cactus
