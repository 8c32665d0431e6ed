// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Random.h"

namespace cactus
{

/// Random variates, each from the numbers of one stream (see randomStream). The distributions of <random> depend on the standard
/// library and its version: the same engine gives other numbers with another one. These use the engine's numbers in the order of
/// GNU libstdc++ 12, and round as it does, because it made the earlier substrates: a seed keeps its substrate. Only std::log,
/// std::exp, std::pow and std::cos depend on the platform (see docs/testing.md, "The same bits").

/// Returns a uniform number in [0, 1): 64 bits of the engine, rounded to double.
double uniformFromZero(RandomEngine& engine);

/// Returns a normal number of mean 0 and variance 1, from one pair of uniform numbers (Box and Muller 1958).
double normal(RandomEngine& engine);

/// Draws normal numbers of mean 0 and variance 1 by the polar method (Marsaglia and Bray 1964). The method makes two numbers at a
/// time; the second is kept for the next call.
class PolarNormal
{
public:
  double operator()(RandomEngine& engine);

private:
  double Kept = 0.0;
  bool HasKept = false;
};

/// Returns a gamma variate: mean shape · scale, variance shape · scale², both positive (Marsaglia and Tsang 2000, "A simple
/// method for generating gamma variables"; a shape below 1 by their note in section 6).
double gammaVariate(double shape, double scale, RandomEngine& engine);

/// Returns exp(logMean + logDeviation z) with z normal, by PolarNormal.
double lognormalVariate(double logMean, double logDeviation, RandomEngine& engine);

} // namespace cactus
