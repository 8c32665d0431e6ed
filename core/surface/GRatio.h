// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/MyelinThickness.h"

#include <cstdint>

namespace cactus
{

/// The model of a fibre's myelin thickness. Values are those of the filter's property.
enum class GRatioModel
{
  Constant = 0,                ///< the same g-ratio for all fibres
  LogLinear = 1,               ///< by the fibre's diameter, see logLinearGRatio()
  Distributed = 2,             ///< per fibre from a normal distribution
  TargetAxonVolumeFraction = 3 ///< the same for all fibres, so that the axons fill a given fraction of the domain
};

/// Returns the g-ratio of one fibre from a normal distribution of this mean and standard deviation, truncated to [smallestGRatio,
/// largestGRatio]: the same for the same seed and fibre, whatever the other fibres are. Throws InvalidInput for a mean outside
/// that range or a deviation that is negative or above 0.3.
double distributedGRatio(double mean, double deviation, std::uint64_t seed, std::int32_t fibreId);

} // namespace cactus
