// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Random.h"

namespace cactus
{

/// Random variates, each from numbers of one stream (see randomStream). They are written out because the distributions of
/// <random> draw what the standard library's authors chose: the same engine gives other numbers with another library, or with the
/// next version of the same. These take the engine's numbers in the order, and round as, GNU libstdc++ 12 does, which is
/// what made the substrates before them, so a seed keeps its substrate. What is left to the platform are std::log, std::exp,
/// std::pow and std::cos (see docs/testing.md, "The same bits").

/// Uniform in [0, 1): 64 bits of the engine, rounded to double.
double uniformFromZero(RandomEngine& engine);

/// Normally distributed with mean 0 and variance 1, from one pair of uniform numbers (Box and Muller 1958).
double normal(RandomEngine& engine);

/// Normally distributed with mean 0 and variance 1, by the polar method (Marsaglia and Bray 1964). It makes two numbers
/// at a time; the second is kept for the next call.
class PolarNormal
{
public:
  double operator()(RandomEngine& engine);

private:
  double Kept = 0.0;
  bool HasKept = false;
};

/// Gamma distributed: mean shape · scale, variance shape · scale², both positive (Marsaglia and Tsang 2000, "A simple method for
/// generating gamma variables"; a shape below 1 by their note in section 6).
double gammaVariate(double shape, double scale, RandomEngine& engine);

/// exp(logMean + logDeviation z) with z normally distributed, by PolarNormal.
double lognormalVariate(double logMean, double logDeviation, RandomEngine& engine);

} // namespace cactus
