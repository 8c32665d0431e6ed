// SPDX-License-Identifier: BSD-3-Clause
#include "RadiusDistribution.h"

#include "Error.h"
#include "Limits.h"
#include "RandomVariates.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace cactus
{

namespace
{

constexpr double pi = 3.14159265358979323846;

double draw(const RadiusDistributionOptions& options, RandomEngine& engine)
{
  if (options.model == RadiusModel::Gamma)
  {
    return gammaVariate(options.gammaShape, options.gammaScale, engine);
  }
  const double ratio = options.lognormalDeviation / options.lognormalMean;
  const double variance = std::log1p(ratio * ratio);
  return lognormalVariate(std::log(options.lognormalMean) - 0.5 * variance, std::sqrt(variance), engine);
}

/// Between limits so near each other, relative to the radius, the density of any distribution is as good as constant.
constexpr double narrow = 1e-4;
/// Draws for one radius.
constexpr int tries = 100000;
/// The smallest share of draws within the limits for which radii are drawn by the thousand.
constexpr double smallestShare = 1e-4;

[[noreturn]] void throwHardlyAny(const RadiusDistributionOptions& options)
{
  throw InvalidInput(text("hardly any of the RadiusDistribution lies between MinimumRadius ", options.minimum,
    " and MaximumRadius ", options.maximum, " (less than one draw in ", 1.0 / smallestShare,
    "): widen the limits, make them equal for equal radii, or change the distribution"));
}

} // namespace

void RadiusDistributionOptions::validate() const
{
  requireWithin("MinimumRadius", minimum, limits::radius);
  requireWithin("MaximumRadius", maximum, limits::radius);
  std::ostringstream message;
  if (minimum > maximum)
  {
    message << "MinimumRadius " << minimum << " is larger than MaximumRadius " << maximum << ": exchange them";
    throw InvalidInput(message.str());
  }
  switch (model)
  {
  case RadiusModel::Gamma:
    requireWithin("GammaShape", gammaShape, limits::gammaShape);
    requireWithin("GammaScale", gammaScale, limits::gammaScale);
    break;
  case RadiusModel::Lognormal:
    requireWithin("LognormalMean", lognormalMean, limits::lognormalMean);
    requireWithin("LognormalDeviation", lognormalDeviation, limits::lognormalDeviation);
    break;
  case RadiusModel::Table:
    if (table.empty())
    {
      throw InvalidInput("RadiusTable is empty: list at least one radius in µm, for example \"0.4 0.5 0.7\", or name a "
                         "RadiusTableFile");
    }
    for (const double radius : table)
    {
      if (!std::isfinite(radius) || radius < minimum || radius > maximum)
      {
        message << "RadiusTable holds " << radius << ", which is not between MinimumRadius " << minimum << " and MaximumRadius "
                << maximum << ": change the one or the other";
        throw InvalidInput(message.str());
      }
    }
    break;
  default:
    throw InvalidInput("RadiusDistribution has no such choice: use Gamma (0), Lognormal (1) or Table (2)");
  }
}

RadiusDistributionOptions RadiusDistributionOptions::scaled(double factor) const
{
  RadiusDistributionOptions result = *this;
  for (double* length :
    { &result.gammaScale, &result.lognormalMean, &result.lognormalDeviation, &result.minimum, &result.maximum })
  {
    *length *= factor;
  }
  for (double& radius : result.table)
  {
    radius *= factor;
  }
  return result;
}

double sampleRadius(const RadiusDistributionOptions& options, std::uint64_t seed, std::uint64_t index)
{
  RandomEngine engine = randomStream(seed, RandomStage::Radii, index);
  if (options.model == RadiusModel::Table)
  {
    const auto size = options.table.size();
    return options.table[std::min(size - 1, static_cast<std::size_t>(uniform(engine) * static_cast<double>(size)))];
  }
  if (options.maximum - options.minimum <= narrow * options.maximum)
  {
    return options.minimum + uniform(engine) * (options.maximum - options.minimum);
  }
  for (int i = 0; i < tries; ++i)
  {
    const double radius = draw(options, engine);
    if (radius >= options.minimum && radius <= options.maximum)
    {
      return radius;
    }
  }
  throwHardlyAny(options);
}

std::vector<double> drawRadii(const RadiusDistributionOptions& options, std::uint64_t seed, double area, std::uint64_t firstIndex)
{
  std::vector<double> radii;
  double sum = 0.0;
  std::uint64_t index = firstIndex;
  double next = sampleRadius(options, seed, index++);
  while (sum + pi * next * next < area)
  {
    radii.push_back(next);
    sum += pi * next * next;
    next = sampleRadius(options, seed, index++);
  }
  double best = radii.empty() ? next : 0.0;
  for (int i = 0; i < 48; ++i)
  {
    if (std::abs(sum + pi * next * next - area) < std::abs(sum + pi * best * best - area))
    {
      best = next;
    }
    next = sampleRadius(options, seed, index++);
  }
  if (best > 0.0)
  {
    radii.push_back(best);
  }
  return radii;
}

double meanCircleArea(const RadiusDistributionOptions& options)
{
  constexpr int draws = 2000;
  requireShareWithinLimits(options);
  double sum = 0.0;
  for (int i = 0; i < draws; ++i)
  {
    const double radius = sampleRadius(options, 0, static_cast<std::uint64_t>(i));
    sum += pi * radius * radius;
  }
  return sum / draws;
}

void requireShareWithinLimits(const RadiusDistributionOptions& options)
{
  if (options.model == RadiusModel::Table || options.maximum - options.minimum <= narrow * options.maximum)
  {
    return;
  }
  RandomEngine engine = randomStream(0, RandomStage::Radii, 0);
  constexpr int draws = 200000;
  int within = 0;
  for (int i = 0; i < draws; ++i)
  {
    const double radius = draw(options, engine);
    within += radius >= options.minimum && radius <= options.maximum;
    // By far the most distributions show at once that they are not so.
    if (within >= 20)
    {
      return;
    }
  }
  throwHardlyAny(options);
}

std::vector<double> parseRadiusTable(const std::string& text)
{
  std::string spaced = text;
  for (char& c : spaced)
  {
    if (c == ',' || c == ';')
    {
      c = ' ';
    }
  }
  std::vector<double> table;
  std::istringstream stream(spaced);
  std::string word;
  while (stream >> word)
  {
    char* end = nullptr;
    table.push_back(std::strtod(word.c_str(), &end));
    if (end == word.c_str() || *end != '\0')
    {
      throw InvalidInput("RadiusTable holds \"" + word + "\", which is no number: list radii in µm, for example \"0.4 0.5 0.7\"");
    }
  }
  return table;
}

std::vector<double> readRadiusTable(const std::string& path)
{
  std::ifstream file(path);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf()))
  {
    throw FileError("RadiusTableFile " + path + " cannot be read, or is empty: name a text file of radii in µm");
  }
  return parseRadiusTable(text.str());
}

} // namespace cactus
