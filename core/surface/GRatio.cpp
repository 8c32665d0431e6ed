// SPDX-License-Identifier: BSD-3-Clause
#include "surface/GRatio.h"

#include "base/Error.h"
#include "base/Limits.h"
#include "base/MyelinThickness.h"
#include "base/RandomVariates.h"

#include <algorithm>
#include <cmath>

namespace cactus
{

double logLinearGRatio(double outerDiameter)
{
  if (!(outerDiameter > 0.0) || !std::isfinite(outerDiameter))
  {
    throw InvalidInput("a fibre's diameter must be positive");
  }
  double lower = smallestGRatio * outerDiameter;
  double upper = largestGRatio * outerDiameter;
  if (logLinearOuterDiameter(lower) >= outerDiameter)
  {
    return smallestGRatio;
  }
  if (logLinearOuterDiameter(upper) <= outerDiameter)
  {
    return largestGRatio;
  }
  while (upper - lower > 1e-12 * outerDiameter)
  {
    const double middle = 0.5 * (lower + upper);
    (logLinearOuterDiameter(middle) < outerDiameter ? lower : upper) = middle;
  }
  return 0.5 * (lower + upper) / outerDiameter;
}

double distributedGRatio(double mean, double deviation, std::uint64_t seed, std::int32_t fibreId)
{
  if (!(mean >= smallestGRatio && mean <= largestGRatio))
  {
    throw InvalidInput("GRatio must be between 0.3 and 0.95 where the g-ratios of fibres are distributed about it");
  }
  requireWithin("GRatioDeviation", deviation, limits::gRatioDeviation);
  RandomEngine engine = randomStream(seed, RandomStage::GRatio, static_cast<std::uint64_t>(fibreId));
  for (;;)
  {
    const double g = mean + deviation * normal(engine);
    if (g >= smallestGRatio && g <= largestGRatio)
    {
      return g;
    }
  }
}

} // namespace cactus
