// SPDX-License-Identifier: BSD-3-Clause
#include "surface/MyelinSurfaceOptions.h"

#include "base/Error.h"
#include "base/Limits.h"

namespace cactus
{

void validate(const MyelinSurfaceOptions& options)
{
  const int model = static_cast<int>(options.model);
  require(model >= 0 && model <= 3, "GRatioModel must be Constant, LogLinear, Distributed or TargetAxonVolumeFraction");
  if (options.model == GRatioModel::Constant)
  {
    requireWithin("GRatio", options.gRatio, limits::gRatio);
  }
  if (options.model == GRatioModel::Distributed)
  {
    distributedGRatio(options.gRatio, options.gRatioDeviation, 0, 1);
  }
  if (options.model == GRatioModel::TargetAxonVolumeFraction)
  {
    requireWithin("TargetAxonVolumeFraction", options.targetAxonVolumeFraction, limits::targetAxonFraction,
      " where GRatioModel is TargetAxonVolumeFraction");
  }
  requireWithin("SmoothingIterations", options.smoothingIterations, limits::smoothingIterations,
    "; more would blur fibres of few voxels away");
  requireWithin("DecimationError", options.decimationError, limits::surfaceTolerance);
}

} // namespace cactus
