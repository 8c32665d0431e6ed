// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: along a fibre, the axon's radius is lognormal with the deviation and the correlation asked for, the myelin is as
// thick everywhere, and the mean square of the outer radius is the fibre's; the same fibre has the same calibre however long it
// is.
#include "bundle/VaryingCalibre.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace
{

using namespace cactus;

constexpr double apart = 0.1; // µm, between control points

/// Fibres of one radius that are not to grow.
BundleInitializerOptions equalRadii(double radius, double deviation = 0.25)
{
  BundleInitializerOptions options;
  options.radius.minimum = options.radius.maximum = radius;
  options.grownFibreVolumeFraction = 0.0;
  options.calibre.deviation = deviation;
  return options;
}

Fibres straightFibres(int count, double length, double radius)
{
  Fibres fibres;
  fibres.domain = Domain::cube(length);
  const int half = static_cast<int>(std::lround(0.5 * length / apart));
  for (int f = 0; f < count; ++f)
  {
    fibres.addFibre(f + 1, 1, radius);
    for (int k = -half; k <= half; ++k)
    {
      fibres.addPoint({ 10.0 * f, 0.0, apart * k }, radius);
    }
  }
  return fibres;
}

TEST(VaryingCalibre, ZeroLeavesPipes)
{
  Fibres fibres = straightFibres(1, 20.0, 0.7);
  varyCalibre(equalRadii(0.7, 0.0), fibres);
  for (const double radius : fibres.radii)
  {
    EXPECT_EQ(radius, 0.7);
  }
}

TEST(VaryingCalibre, IsTheStationaryProcessAskedFor)
{
  const double radius = 0.8;
  const double g = 0.7;
  for (const double asked : { 0.1, 0.25, 0.4 })
  {
    Fibres fibres = straightFibres(200, 100.0, radius);
    BundleInitializerOptions options = equalRadii(radius, asked);
    options.calibre.correlationLength = 2.0;
    options.seed = 3;
    varyCalibre(options, fibres);

    double squares = 0.0;
    for (const double r : fibres.radii)
    {
      squares += r * r / static_cast<double>(fibres.radii.size());
    }
    EXPECT_NEAR(std::sqrt(squares), radius, 0.01 * radius);

    // The axon's radius in units of the mean myelin: r_o = R N (1 - g + g exp(σ z)).
    const double a = asked * asked;
    const double n = 1.0 / std::sqrt((1.0 - g) * (1.0 - g) + 2.0 * g * (1.0 - g) * std::exp(0.5 * a) + g * g * std::exp(2.0 * a));
    std::vector<double> z;
    for (const double r : fibres.radii)
    {
      z.push_back(std::log((r / (radius * n) - (1.0 - g)) / g));
    }
    const auto covariance = [&](std::size_t shift)
    {
      double sum = 0.0;
      double pairs = 0.0;
      for (std::size_t f = 0; f < fibres.size(); ++f)
      {
        for (std::size_t i = fibres.offsets[f]; i + shift < fibres.offsets[f + 1]; ++i)
        {
          sum += z[i] * z[i + shift];
          pairs += 1.0;
        }
      }
      return sum / pairs;
    };
    const double variance = covariance(0);
    EXPECT_NEAR(std::sqrt(variance), asked, 0.05 * asked);
    for (const double distance : { 0.5, 1.0, 2.0, 4.0 })
    {
      const double x = std::sqrt(3.0) * distance / (0.8 * options.calibre.correlationLength); // 0.8: what comes later smooths it
      const double measured = covariance(static_cast<std::size_t>(std::lround(distance / apart))) / variance;
      EXPECT_NEAR(measured, (1.0 + x) * std::exp(-x), 0.03) << "at " << distance;
    }
  }
}

TEST(VaryingCalibre, IsThatOfTheAxonInsideAGivenMyelin)
{
  const auto spread = [](double gRatio)
  {
    BundleInitializerOptions options = equalRadii(0.8, 0.1);
    options.calibre.gRatio = gRatio;
    Fibres fibres = straightFibres(1, 400.0, 0.8);
    varyCalibre(options, fibres);
    EXPECT_EQ(fibres.columns.value(targetGRatioColumn.name, 0), gRatio);
    double squares = 0.0;
    for (const double radius : fibres.radii)
    {
      squares += std::pow(radius / 0.8 - 1.0, 2);
    }
    return std::sqrt(squares / double(fibres.radii.size()));
  };
  EXPECT_NEAR(spread(0.9) / spread(0.5), 0.9 / 0.5, 0.05);

  // One without myelin stays so.
  BundleInitializerOptions options = equalRadii(0.8);
  options.calibre.gRatio = 0.6;
  Fibres fibres = straightFibres(2, 20.0, 0.8);
  fibres.columns.set(targetGRatioColumn.name, 1, bareGRatio);
  varyCalibre(options, fibres);
  EXPECT_EQ(fibres.columns.value(targetGRatioColumn.name, 0), 0.6);
  EXPECT_EQ(fibres.columns.value(targetGRatioColumn.name, 1), bareGRatio);
}

TEST(VaryingCalibre, OfALongerFibreIsTheSameInItsMiddle)
{
  Fibres shorter = straightFibres(2, 20.0, 0.8);
  Fibres longer = straightFibres(2, 40.0, 0.8);
  varyCalibre(equalRadii(0.8), shorter);
  varyCalibre(equalRadii(0.8), longer);
  for (std::size_t f = 0; f < 2; ++f)
  {
    const std::size_t beyond = (longer.pointCount(f) - shorter.pointCount(f)) / 2;
    for (std::size_t i = 0; i < shorter.pointCount(f); ++i)
    {
      EXPECT_NEAR(shorter.radii[shorter.offsets[f] + i], longer.radii[longer.offsets[f] + beyond + i], 1e-6);
    }
  }
  EXPECT_NE(shorter.radii[0], shorter.radii[shorter.offsets[1]]);
}

TEST(VaryingCalibre, ThickFibresVaryLess)
{
  BundleInitializerOptions options;
  options.grownFibreVolumeFraction = 0.0;
  Fibres fibres = straightFibres(1, 2000.0, 0.6);
  Fibres thick = straightFibres(1, 2000.0, 2.0);
  varyCalibre(options, fibres);
  varyCalibre(options, thick);
  const auto deviation = [](const Fibres& all)
  {
    double mean = 0.0;
    double square = 0.0;
    for (const double r : all.radii)
    {
      mean += std::log(r) / static_cast<double>(all.radii.size());
      square += std::log(r) * std::log(r) / static_cast<double>(all.radii.size());
    }
    return std::sqrt(square - mean * mean);
  };
  EXPECT_NEAR(deviation(thick) / deviation(fibres), std::pow(2.0 / 0.6, -0.3), 0.08);
}

TEST(VaryingCalibre, NecksOfThinAxonsCanBeResolved)
{
  for (const double radius : { 0.15, 0.25, 0.35 })
  {
    Fibres fibres = straightFibres(20, 100.0, radius);
    varyCalibre(equalRadii(radius, 0.5), fibres);
    const double thinnest = *std::min_element(fibres.radii.begin(), fibres.radii.end());
    EXPECT_GT(thinnest - 0.3 * radius, std::min(0.12, 0.7 * radius) * 0.8) << radius;
    EXPECT_EQ(thinnest<radius, radius> 0.2) << radius;
  }
}

TEST(VaryingCalibre, AxonsWithoutMyelinVaryWhereAFinerGridResolvesTheirNecks)
{
  for (const double radius : { 0.05, 0.12, 0.2 })
  {
    Fibres fibres = straightFibres(20, 100.0, radius);
    for (std::size_t f = 0; f < fibres.size(); ++f)
    {
      fibres.columns.set(targetGRatioColumn.name, f, 1.0);
    }
    varyCalibre(equalRadii(radius, 0.5), fibres);
    const auto [thinnest, thickest] = std::minmax_element(fibres.radii.begin(), fibres.radii.end());
    EXPECT_GT(*thinnest, std::min(0.06, radius) * 0.8) << radius;
    EXPECT_EQ(*thickest > 1.2 * radius, radius > 0.06) << radius;
    double square = 0.0;
    for (const double r : fibres.radii)
    {
      square += r * r / static_cast<double>(fibres.radii.size());
    }
    EXPECT_NEAR(std::sqrt(square), radius, 0.05 * radius);
  }
}

TEST(VaryingCalibre, AllowsForWhatGrowthMakesOfIt)
{
  BundleInitializerOptions options = equalRadii(0.8, 0.14);
  options.fibreVolumeFraction = 0.5;
  const auto varies = [&](double grown)
  {
    options.grownFibreVolumeFraction = grown;
    Fibres fibres = straightFibres(1, 20.0, 0.8);
    varyCalibre(options, fibres);
    return *std::max_element(fibres.radii.begin(), fibres.radii.end()) - 0.8;
  };
  EXPECT_GT(varies(0.6), 0.05);
  EXPECT_LT(varies(0.8), varies(0.6));
  EXPECT_EQ(varies(0.9), 0.0); // neighbours alone make more of it
}

} // namespace
