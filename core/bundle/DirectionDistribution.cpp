// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/DirectionDistribution.h"

#include "base/Constants.h"
#include "base/Error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace cactus
{

namespace
{

double meanWatsonAngle(double kappa)
{
  return watsonMean(kappa, [](double angle) { return angle; });
}

/// Returns the mean angle of directions uniform in a cap of half angle a: ∫θ sin θ / ∫sin θ on [0, a], by its series for small a,
/// where digits cancel.
double meanConeAngle(double a)
{
  if (a < 1e-2)
  {
    return 2.0 * a / 3.0 * (1.0 - a * a / 60.0);
  }
  return (std::sin(a) - a * std::cos(a)) / (1.0 - std::cos(a));
}

/// Returns the parameter of a model, Watson or Cone, with this mean angle (radians). Both means are monotonic: bisection over log
/// κ (falling) or over the half angle (rising).
double parameterFor(DispersionModel model, double wanted)
{
  const bool watson = model == DispersionModel::Watson;
  double low = watson ? std::log(1e-3) : 0.0;
  double high = watson ? std::log(1e14) : 0.5 * pi;
  for (int i = 0; i < 200; ++i)
  {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high)
    {
      break;
    }
    const bool tooWide = watson ? meanWatsonAngle(std::exp(middle)) > wanted : meanConeAngle(middle) > wanted;
    (tooWide == watson ? low : high) = middle;
  }
  return watson ? std::exp(0.5 * (low + high)) : 0.5 * (low + high);
}

} // namespace

/// It is ∫q w / ∫w with w = exp(-κ sin²θ) sin θ on [0, π/2], by Simpson's rule.
double watsonMean(double kappa, double (*quantity)(double angle))
{
  const double end = std::min(0.5 * pi, 9.0 / std::sqrt(kappa));
  constexpr int intervals = 2000;
  double weighted = 0.0;
  double weights = 0.0;
  for (int i = 0; i <= intervals; ++i)
  {
    const double angle = end * i / intervals;
    const double sine = std::sin(angle);
    const double weight = std::exp(-kappa * sine * sine) * sine * (i == 0 || i == intervals ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0));
    weighted += quantity(angle) * weight;
    weights += weight;
  }
  return weighted / weights;
}

DirectionDistribution::DirectionDistribution(DispersionModel model, double meanAngle)
  : Model(model)
{
  if (!(meanAngle > 0.0 && meanAngle <= 45.0))
  {
    TextStream message;
    message << "MeanDispersion is " << meanAngle << "°: give an angle above 0 and at most 45";
    throw InvalidInput(message.str());
  }
  if (model != DispersionModel::Watson && model != DispersionModel::Cone)
  {
    throw InvalidInput("angles are drawn from DispersionModel Watson (0) or Cone (1) only");
  }
  this->Parameter = parameterFor(model, meanAngle * pi / 180.0);
}

double watsonMeanAngle(double kappa)
{
  return meanWatsonAngle(kappa) / degree;
}

double watsonKappa(double meanAngle)
{
  return parameterFor(DispersionModel::Watson, meanAngle * degree);
}

double odiOfKappa(double kappa)
{
  return 2.0 / pi * std::atan2(1.0, kappa);
}

double kappaOfOdi(double odi)
{
  return 1.0 / std::tan(0.5 * pi * odi);
}

double distanceToWatson(std::vector<double> angles)
{
  std::sort(angles.begin(), angles.end());
  const auto count = static_cast<double>(angles.size());
  const double mean = std::accumulate(angles.begin(), angles.end(), 0.0) / count;
  const double kappa = parameterFor(DispersionModel::Watson, mean);
  constexpr int intervals = 2000;
  std::vector<double> distribution = { 0.0 }; // by the trapezoidal rule
  double before = 0.0;
  for (int i = 1; i <= intervals; ++i)
  {
    const double sine = std::sin(0.5 * pi * i / intervals);
    const double weight = std::exp(-kappa * sine * sine) * sine;
    distribution.push_back(distribution.back() + before + weight);
    before = weight;
  }
  double largest = 0.0;
  for (std::size_t i = 0; i < angles.size(); ++i)
  {
    const double place = std::min(angles[i] / (0.5 * pi), 1.0) * intervals;
    const auto k = static_cast<std::size_t>(std::min(place, intervals - 1.0));
    const double share = place - static_cast<double>(k);
    const double expected = (distribution[k] + share * (distribution[k + 1] - distribution[k])) / distribution.back();
    largest = std::max({ largest, expected - static_cast<double>(i) / count, static_cast<double>(i + 1) / count - expected });
  }
  return largest;
}

double DirectionDistribution::sampleAngle(RandomEngine& engine) const
{
  // x = 1 − cos θ is handled directly: small angles keep their digits.
  double x = 0.0;
  if (Model == DispersionModel::Cone)
  {
    const double half = std::sin(0.5 * Parameter);
    x = uniform(engine) * 2.0 * half * half;
  }
  else
  {
    // The density of x is ∝ exp(−κ(2x − x²)) ≤ exp(−κx): a truncated exponential, accepted at least about every other time.
    do
    {
      x = -std::log1p(uniform(engine) * std::expm1(-Parameter)) / Parameter;
    } while (uniform(engine) > std::exp(-Parameter * (x - x * x)));
  }
  return 2.0 * std::asin(std::sqrt(std::clamp(0.5 * x, 0.0, 0.5)));
}

} // namespace cactus
