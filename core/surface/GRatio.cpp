// SPDX-License-Identifier: BSD-3-Clause
#include "surface/GRatio.h"

#include "base/Error.h"
#include "base/Limits.h"
#include "base/RandomVariates.h"

namespace cactus
{

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
