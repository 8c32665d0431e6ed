// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/RadiusDistribution.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "base/Limits.h"
#include "base/MyelinThickness.h"
#include "base/Numbers.h"
#include "base/PosixFile.h"
#include "base/RandomVariates.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string_view>
#include <utility>

namespace cactus
{

namespace
{

double drawFromHistogram(const RadiusDistributionOptions& options, RandomEngine& engine)
{
  const double inner = options.histogramFactor * sampleDiameter(radiusHistogram(options.histogram), engine);
  const double outer = options.histogramGRatio > 0.0 ? inner / options.histogramGRatio : logLinearOuterDiameter(inner);
  return options.histogramScale * 0.5 * outer;
}

double draw(const RadiusDistributionOptions& options, RandomEngine& engine)
{
  if (options.model == RadiusModel::Histogram)
  {
    return drawFromHistogram(options, engine);
  }
  if (options.model == RadiusModel::Gamma)
  {
    return gammaVariate(options.gammaShape, options.gammaScale, engine);
  }
  const double ratio = options.lognormalDeviation / options.lognormalMean;
  const double variance = std::log1p(ratio * ratio);
  return lognormalVariate(std::log(options.lognormalMean) - 0.5 * variance, std::sqrt(variance), engine);
}

/// Between limits so near each other, relative to the radius, any density is nearly constant.
constexpr double narrow = 1e-4;
/// Number of draws for one radius.
constexpr int tries = 100000;
/// The smallest fraction of draws within the limits for which thousands of radii can be drawn.
constexpr double smallestShare = 1e-4;

[[noreturn]] void throwHardlyAny(const RadiusDistributionOptions& options)
{
  throw InvalidInput(text("hardly any of the RadiusDistribution lies between MinimumRadius ", options.minimum,
    " and MaximumRadius ", options.maximum, " (less than one draw in ", 1.0 / smallestShare,
    "): widen the limits, make them equal for equal radii, or change the distribution"));
}

} // namespace

const PropertyList<RadiusDistributionOptions>& RadiusDistributionOptions::properties()
{
  using Options = RadiusDistributionOptions;
  static const auto list =
    PropertyList<Options>()
      .add("RadiusDistribution", &Options::model, { "Gamma", "Lognormal", "Table", "Histogram" },
        "Distribution of the fibres' outer radii.")
      .add("GammaShape", &Options::gammaShape, limits::gammaShape, "Shape of the gamma distribution.")
      .where("RadiusDistribution", { 0 })
      .add("GammaScale", &Options::gammaScale, limits::gammaScale,
        "Scale of the gamma distribution in µm. Shape times scale is the mean radius before truncation to the limits.")
      .where("RadiusDistribution", { 0 })
      .add("LognormalMean", &Options::lognormalMean, limits::lognormalMean,
        "Mean outer radius in µm, before truncation to the limits.")
      .where("RadiusDistribution", { 1 })
      .add("LognormalDeviation", &Options::lognormalDeviation, limits::lognormalDeviation,
        "Standard deviation of the outer radius in µm, before truncation to the limits.")
      .where("RadiusDistribution", { 1 })
      .add("RadiusTable", &Options::table,
        "Outer radii in µm, separated by blanks or commas, for example \"0.4 0.5 0.7\". Each fibre gets one of them at random; "
        "all entries are equally likely.")
      .where("RadiusDistribution", { 2 })
      .add("RadiusHistogram", &Options::histogram, radiusHistogramNames(),
        "Published histogram of axon diameters, from which the fibres' radii are drawn. All are of inner diameters in fixed "
        "tissue; docs/histology.md gives their sources.")
      .where("RadiusDistribution", { 3 })
      .add("RadiusHistogramFactor", &Options::histogramFactor, limits::histogramFactor,
        "Factor for the histogram's diameters. 1: as in the fixed tissue; a larger factor corrects for its shrinkage.")
      .where("RadiusDistribution", { 3 })
      .add("RadiusHistogramGRatio", &Options::histogramGRatio, limits::histogramGRatio,
        "g-ratio that turns the histogram's inner radii into outer radii. Give MyelinSurface the same value. 0: the axon's "
        "diameter sets the myelin, as in the GRatioModel LogLinear. 1: the diameters are taken as outer ones.")
      .where("RadiusDistribution", { 3 })
      .add("MinimumRadius", &Options::minimum, limits::radius, "Smallest outer radius in µm. Smaller radii are drawn again.")
      .add("MaximumRadius", &Options::maximum, limits::radius, "Largest outer radius in µm. Larger radii are drawn again.");
  return list;
}

void RadiusDistributionOptions::validate() const
{
  validateProperties(*this);
  TextStream message;
  if (minimum > maximum)
  {
    message << "MinimumRadius " << minimum << " is larger than MaximumRadius " << maximum << ": exchange them";
    throw InvalidInput(message.str());
  }
  if (model != RadiusModel::Table)
  {
    return;
  }
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
}

RadiusDistributionOptions RadiusDistributionOptions::scaled(double factor) const
{
  RadiusDistributionOptions result = *this;
  for (double* length : { &result.gammaScale, &result.lognormalMean, &result.lognormalDeviation, &result.histogramScale,
         &result.minimum, &result.maximum })
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
    // Most distributions pass at once.
    if (within >= 20)
    {
      return;
    }
  }
  throwHardlyAny(options);
}

namespace
{

const std::string hint = ", which is no number: list radii in µm, for example \"0.4 0.5 0.7\"";

} // namespace

std::vector<double> parseRadiusTable(const std::string& text)
{
  std::vector<double> table;
  std::string_view rest = text;
  if (!takeNumbers(rest, table))
  {
    throw InvalidInput("RadiusTable holds \"" + excerpt(rest) + "\"" + hint);
  }
  return table;
}

std::vector<double> readRadiusTable(std::istream& stream, const std::string& name)
{
  std::string text;
  constexpr std::size_t chunk = 1 << 16;
  constexpr std::size_t longest = std::size_t(1) << 26;
  try
  {
    for (std::size_t got = chunk; got == chunk && text.size() <= longest;)
    {
      const std::size_t before = text.size();
      text.resize(before + chunk);
      got = static_cast<std::size_t>(stream.rdbuf()->sgetn(&text[before], chunk));
      text.resize(before + got);
    }
  }
  catch (const std::ios_base::failure& error) // a folder or a disk error
  {
    throw FileError("RadiusTableFile " + name + " cannot be read: " + error.code().message());
  }
  if (text.size() > longest)
  {
    throw FileError("RadiusTableFile " + name + " is longer than 64 MB: this is no text file of radii");
  }
  std::string_view rest = text;
  if (rest.substr(0, 3) == "\xef\xbb\xbf")
  {
    rest.remove_prefix(3); // byte-order mark of UTF-8
  }
  std::vector<double> table;
  if (!takeNumbers(rest, table))
  {
    const auto line = 1 + std::count(std::as_const(text).data(), rest.data(), '\n');
    throw FileError("RadiusTableFile " + name + ", line " + std::to_string(line) + ", holds \"" + excerpt(rest) + "\"" + hint);
  }
  if (table.empty())
  {
    throw FileError("RadiusTableFile " + name + " is empty: list at least one radius in µm");
  }
  return table;
}

std::vector<double> readRadiusTable(const std::string& path)
{
  requireNoPipe("RadiusTableFile " + path, path);
  std::ifstream file(path);
  if (!file)
  {
    throw FileError("RadiusTableFile " + path + " cannot be read: name a text file of radii in µm");
  }
  return readRadiusTable(file, path);
}

RadiusDistributionOptions withTable(const RadiusDistributionOptions& options, const std::string& text, const std::string& path)
{
  RadiusDistributionOptions result = options;
  if (options.model != RadiusModel::Table)
  {
    return result;
  }
  result.table = parseRadiusTable(text);
  if (!path.empty())
  {
    if (!result.table.empty())
    {
      throw InvalidInput("RadiusTable and RadiusTableFile are both given: clear one of them");
    }
    result.table = readRadiusTable(path);
  }
  return result;
}

} // namespace cactus
