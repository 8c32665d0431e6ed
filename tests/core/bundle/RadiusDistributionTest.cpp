// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/RadiusDistribution.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "bundle/RadiusColumn.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <sstream>

using namespace cactus;

namespace
{

/// Integral of a density from a to b, by the midpoint rule.
double integral(const std::function<double(double)>& density, double a, double b)
{
  constexpr int steps = 4000;
  double sum = 0.0;
  for (int i = 0; i < steps; ++i)
  {
    sum += density(a + (b - a) * (i + 0.5) / steps);
  }
  return sum * (b - a) / steps;
}

/// Kolmogorov–Smirnov distance of sampled radii to a density cut to the options' limits.
double kolmogorovSmirnov(const RadiusDistributionOptions& options, const std::function<double(double)>& density)
{
  constexpr int draws = 20000;
  std::vector<double> radii;
  for (int i = 0; i < draws; ++i)
  {
    radii.push_back(sampleRadius(options, 5, static_cast<std::uint64_t>(i)));
  }
  std::sort(radii.begin(), radii.end());
  EXPECT_GE(radii.front(), options.minimum);
  EXPECT_LE(radii.back(), options.maximum);
  const double whole = integral(density, options.minimum, options.maximum);
  double worst = 0.0;
  for (int i = 0; i < draws; i += 50)
  {
    const double expected = integral(density, options.minimum, radii[static_cast<std::size_t>(i)]) / whole;
    worst = std::max(worst, std::abs(expected - (i + 0.5) / draws));
  }
  return worst;
}

} // namespace

TEST(RadiusDistribution, GammaIsCutAndOtherwiseTrue)
{
  RadiusDistributionOptions options;
  const auto density = [&](double r) { return std::pow(r, options.gammaShape - 1.0) * std::exp(-r / options.gammaScale); };
  EXPECT_LT(kolmogorovSmirnov(options, density), 0.0115); // 1.63/√20000, the 1 % point
  options.gammaShape = 0.99;
  options.gammaScale = 0.723;
  EXPECT_LT(kolmogorovSmirnov(options, density), 0.0115);
}

TEST(RadiusDistribution, LognormalHasMeanAndDeviationOfTheRadius)
{
  RadiusDistributionOptions options;
  options.model = RadiusModel::Lognormal;
  options.lognormalMean = 0.7;
  options.lognormalDeviation = 0.3;
  options.minimum = 1e-6;
  options.maximum = 1e6;
  double sum = 0.0;
  double squares = 0.0;
  constexpr int draws = 40000;
  for (int i = 0; i < draws; ++i)
  {
    const double r = sampleRadius(options, 3, static_cast<std::uint64_t>(i));
    sum += r;
    squares += r * r;
  }
  const double mean = sum / draws;
  EXPECT_NEAR(mean, 0.7, 0.006);
  EXPECT_NEAR(std::sqrt(squares / draws - mean * mean), 0.3, 0.01);

  options.minimum = 0.3;
  options.maximum = 1.2;
  const double variance = std::log1p(0.09 / 0.49);
  const double mu = std::log(0.7) - 0.5 * variance;
  EXPECT_LT(
    kolmogorovSmirnov(options, [&](double r) { return std::exp(-std::pow(std::log(r) - mu, 2) / (2 * variance)) / r; }), 0.0115);
}

TEST(RadiusDistribution, TableEntriesAreEquallyLikely)
{
  RadiusDistributionOptions options;
  options.model = RadiusModel::Table;
  options.table = parseRadiusTable("0.4, 0.5;0.7\n 0.5");
  ASSERT_EQ(options.table, (std::vector<double>{ 0.4, 0.5, 0.7, 0.5 }));
  std::map<double, int> counts;
  for (int i = 0; i < 8000; ++i)
  {
    ++counts[sampleRadius(options, 1, static_cast<std::uint64_t>(i))];
  }
  EXPECT_EQ(counts.size(), 3u);
  EXPECT_NEAR(counts[0.4], 2000, 150);
  EXPECT_NEAR(counts[0.5], 4000, 170);
}

TEST(RadiusDistribution, DrawsAreKeyedByIndex)
{
  const RadiusDistributionOptions options;
  EXPECT_EQ(sampleRadius(options, 1, 17), sampleRadius(options, 1, 17));
  EXPECT_NE(sampleRadius(options, 1, 17), sampleRadius(options, 1, 18));
  EXPECT_NE(sampleRadius(options, 1, 17), sampleRadius(options, 2, 17));
  const auto radii = drawRadii(options, 1, 100.0);
  for (std::size_t i = 0; i + 1 < radii.size(); ++i)
  {
    EXPECT_EQ(radii[i], sampleRadius(options, 1, i));
  }
}

TEST(RadiusDistribution, AreaIsMet)
{
  const RadiusDistributionOptions options;
  for (std::uint64_t seed = 1; seed <= 50; ++seed)
  {
    double area = 0.0;
    for (const double r : drawRadii(options, seed, 630.0))
    {
      area += cactus::pi * r * r;
    }
    EXPECT_NEAR(area, 630.0, 630.0 * 0.005) << seed;
  }
}

TEST(RadiusDistribution, AColumnOfAnotherWidthIsNamed)
{
  const auto read = [](const std::string& text)
  {
    std::istringstream stream(text);
    return readRadiusColumn(stream, "a.csv", "r");
  };
  EXPECT_EQ(read("r\n1.25\n\n0.5,\n"), (std::vector<double>{ 1.25, 0.5 }));
  for (const char* text : { "r\n1,25\n1,75\n", "r,d\n7,0.5,0.6\n" })
  {
    try
    {
      read(text);
      FAIL() << text;
    }
    catch (const FileError& error)
    {
      EXPECT_NE(std::string(error.what()).find("line 2, has more cells"), std::string::npos) << error.what();
    }
  }
}

TEST(RadiusDistribution, ColumnsOfOtherProgramsAreRead)
{
  const auto read = [](const std::string& text, const std::string& column)
  {
    std::istringstream stream(text);
    return readRadiusColumn(stream, "a.csv", column);
  };
  const std::vector<double> wanted{ 1.25, 0.5 };
  EXPECT_EQ(read("x;r\n1,5;1,25\n2,5;0,5\n", "r"), wanted);
  EXPECT_EQ(read("x\tr\n1,5\t1,25\n2,5\t0.5\n", "r"), wanted);
  EXPECT_EQ(read("x,r\n1,\"1,25\"\n2,\"0,5\"\n", "r"), wanted);
  for (const std::string micro : { "u", "\xc2\xb5", "\xce\xbc", "\xb5" })
  {
    const std::string file = "x0 (px),axon_diam (" + micro + "m)\n1,1.25\n2,0.5\n";
    for (const std::string asked : { "axon_diam (um)", "axon_diam (\xc2\xb5m)" })
    {
      EXPECT_EQ(read(file, asked), wanted) << file << asked;
    }
  }
  for (const std::string cell : { "", "nan", "1,2,5", "1.000,5", "x" })
  {
    try
    {
      read("x;r\n1;2\n1;" + cell + "\n", "r");
      ADD_FAILURE() << cell;
    }
    catch (const FileError& error)
    {
      const std::string wanted = "line 3, has no number in column \"r\", but \"" + cell + "\"";
      EXPECT_NE(std::string(error.what()).find(wanted), std::string::npos) << error.what();
    }
  }
}

TEST(RadiusDistribution, BadParametersAreNamed)
{
  const auto message = [](const std::function<void(RadiusDistributionOptions&)>& change)
  {
    RadiusDistributionOptions options;
    change(options);
    try
    {
      options.validate();
      sampleRadius(options, 1, 0);
    }
    catch (const InvalidInput& error)
    {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const auto names = [&](const char* property, const std::function<void(RadiusDistributionOptions&)>& change)
  { return message(change).find(property) != std::string::npos; };
  EXPECT_TRUE(names("GammaShape", [](auto& o) { o.gammaShape = 0.0; }));
  EXPECT_TRUE(names("GammaScale", [](auto& o) { o.gammaScale = std::nan(""); }));
  EXPECT_TRUE(names("MinimumRadius", [](auto& o) { o.minimum = -0.2; }));
  EXPECT_TRUE(names("MaximumRadius", [](auto& o) { o.maximum = INFINITY; }));
  EXPECT_TRUE(names("MinimumRadius 3", [](auto& o) { o.minimum = 3.0; }));
  EXPECT_TRUE(names("hardly any",
    [](auto& o)
    {
      o.minimum = 50.0;
      o.maximum = 51.0;
    }));
  EXPECT_TRUE(names("RadiusTable is empty", [](auto& o) { o.model = RadiusModel::Table; }));
  EXPECT_TRUE(names("RadiusTable holds 5",
    [](auto& o)
    {
      o.model = RadiusModel::Table;
      o.table = { 0.5, 5.0 };
    }));
  EXPECT_TRUE(names("LognormalDeviation",
    [](auto& o)
    {
      o.model = RadiusModel::Lognormal;
      o.lognormalDeviation = 0.0;
    }));
  EXPECT_THROW(parseRadiusTable("0.4 thin"), InvalidInput);
  EXPECT_THROW(readRadiusTable("no/such/file"), FileError);
}
