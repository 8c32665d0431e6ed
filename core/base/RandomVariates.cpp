// SPDX-License-Identifier: BSD-3-Clause
#include "base/RandomVariates.h"

#include "base/Constants.h"

#include <cmath>
#include <cstdint>

namespace cactus
{

double uniformFromZero(RandomEngine& engine)
{
  const std::uint64_t low = engine();
  const std::uint64_t bits = (std::uint64_t(engine()) << 32) | low;
  const double value = static_cast<double>(bits) * 0x1p-64;
  return value < 1.0 ? value : 0x1.fffffffffffffp-1; // the largest bits round up to 1
}

double normal(RandomEngine& engine)
{
  const double radius = std::sqrt(-2.0 * std::log(uniform(engine)));
  return radius * std::cos(2.0 * pi * uniform(engine));
}

double PolarNormal::operator()(RandomEngine& engine)
{
  if (HasKept)
  {
    HasKept = false;
    return Kept;
  }
  for (;;)
  {
    const double x = 2.0 * uniformFromZero(engine) - 1.0;
    const double y = 2.0 * uniformFromZero(engine) - 1.0;
    const double square = x * x + y * y;
    if (square <= 1.0 && square != 0.0)
    {
      const double factor = std::sqrt(-2.0 * std::log(square) / square);
      Kept = x * factor;
      HasKept = true;
      return y * factor;
    }
  }
}

double gammaVariate(double shape, double scale, RandomEngine& engine)
{
  // In the paper's letters: d = shape − 1/3, c = 1/√(9d), v = (1 + c x)³ with x normal. d·v is accepted at once if u is below the
  // squeeze, which needs no logarithm, or else by the exact comparison. A shape below 1 is drawn as shape + 1, times u^(1/shape).
  const bool boosted = shape < 1.0;
  const double d = (boosted ? shape + 1.0 : shape) - 1.0 / 3.0;
  const double c = 1.0 / std::sqrt(9.0 * d);
  PolarNormal polarNormal;
  for (;;)
  {
    double x;
    double root;
    do
    {
      x = polarNormal(engine);
      root = 1.0 + c * x;
    } while (root <= 0.0);
    const double v = root * root * root;
    double u = uniformFromZero(engine);
    if (u > 1.0 - 0.0331 * x * x * x * x && std::log(u) > 0.5 * x * x + d * (1.0 - v + std::log(v)))
    {
      continue;
    }
    if (!boosted)
    {
      return d * v * scale;
    }
    do
    {
      u = uniformFromZero(engine);
    } while (u == 0.0);
    return std::pow(u, 1.0 / shape) * d * v * scale;
  }
}

double lognormalVariate(double logMean, double logDeviation, RandomEngine& engine)
{
  return std::exp(logDeviation * PolarNormal()(engine) + logMean);
}

} // namespace cactus
