// SPDX-License-Identifier: BSD-3-Clause
// Guarantees: axons without myelin fill what is asked for of the domain, with the radii asked for, in clusters; other fibres are
// as before; what has no place for them is refused by name.
#include "BundleBetweenWalls.h"
#include "base/Constants.h"
#include "base/Error.h"
#include "bundle/BundleInitializer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

using namespace cactus;

namespace
{

BundleInitializerOptions withBare(double fraction)
{
  BundleInitializerOptions options = ofPipes();
  options.side = 12.0;
  options.fibreVolumeFraction = 0.6;
  options.unmyelinated.fraction = fraction;
  return options;
}

/// Fraction of the domain that the capsules fill of fibres without myelin.
double bareFraction(const Fibres& fibres)
{
  double volume = 0.0;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    volume += isBare(fibres, f) ? capsuleVolumeInDomain(fibres, f) : 0.0;
  }
  return volume / fibres.domain.volume();
}

/// Mean distance of a middle of fibres without myelin to the nearest other one.
double meanNearest(const Fibres& fibres)
{
  std::vector<Eigen::Vector3d> middles;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    if (isBare(fibres, f))
    {
      middles.push_back(fibres.points[(fibres.offsets[f] + fibres.offsets[f + 1]) / 2]);
    }
  }
  double sum = 0.0;
  for (const Eigen::Vector3d& middle : middles)
  {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& other : middles)
    {
      const double apart = (middle - other).head<2>().norm();
      nearest = apart > 0.0 ? std::min(nearest, apart) : nearest;
    }
    sum += nearest;
  }
  return sum / static_cast<double>(middles.size());
}

std::string bareRefusal(const std::function<void(BundleInitializerOptions&)>& change)
{
  BundleInitializerOptions options = withBare(0.1);
  change(options);
  try
  {
    options.validate();
  }
  catch (const InvalidInput& error)
  {
    return error.what();
  }
  return "";
}

} // namespace

TEST(UnmyelinatedAxons, FillTheirPartOfTheDomain)
{
  for (const double fraction : { 0.05, 0.12, 0.3 })
  {
    for (const Border border : { Border::Cut, Border::PeriodicAcross, Border::Periodic })
    {
      BundleInitializerOptions options = withBare(fraction);
      options.border = border;
      const Fibres fibres = initialiseBundles(options);
      // Growth makes 0.9 of 0.6.
      EXPECT_NEAR(bareFraction(fibres) * 0.9 / 0.6, fraction, 0.003);
      EXPECT_NEAR(capsuleVolumeInDomain(fibres) / fibres.domain.volume(), 0.6, 0.012);
      double sum = 0.0;
      double squares = 0.0;
      double count = 0.0;
      for (std::size_t f = 0; f < fibres.size(); ++f)
      {
        EXPECT_EQ(fibres.fibreIds[f], static_cast<int>(f) + 1);
        const double radius = fibres.targetRadii[f];
        if (isBare(fibres, f))
        {
          EXPECT_GE(radius, 0.06 * (1.0 - 1e-12));
          EXPECT_LE(radius, 0.24 * (1.0 + 1e-12));
          sum += radius;
          squares += radius * radius;
          ++count;
        }
        else
        {
          EXPECT_TRUE(std::isnan(fibres.columns.value("TargetGRatio", f)));
          EXPECT_GE(radius, 0.2 * (1.0 - 1e-12));
        }
      }
      EXPECT_NEAR(sum / count, 0.12, 0.01);
      EXPECT_NEAR(std::sqrt(squares / count - sum * sum / count / count), 0.045, 0.01);
    }
  }
}

TEST(UnmyelinatedAxons, LieInClusters)
{
  BundleInitializerOptions options = withBare(0.05);
  options.unmyelinated.deviation = 0.0;
  options.meanDispersion = 0.0;
  const double clustered = meanNearest(initialiseBundles(options));
  options.unmyelinated.cluster = 1;
  const double alone = meanNearest(initialiseBundles(options));
  EXPECT_LT(clustered, 0.75 * alone);
  EXPECT_LT(clustered, 3.0 * 0.12 * std::sqrt(0.6 / 0.9)) << "hardly farther apart than if they touched";
}

TEST(UnmyelinatedAxons, OfTwoBundlesEachHasItsHalf)
{
  BundleInitializerOptions options = withBare(0.1);
  options.numberOfBundles = 2;
  const Fibres fibres = initialiseBundles(options);
  EXPECT_NEAR(bareFraction(fibres) * 0.9 / 0.6, 0.1, 0.004);
  EXPECT_EQ(fibres.bundleIds.back(), 2);
  EXPECT_TRUE(isBare(fibres, fibres.size() - 1));
}

TEST(UnmyelinatedAxons, OfPeaksEachBundleHasItsShare)
{
  BundleInitializerOptions options = withBare(0.1);
  options.dispersionModel = DispersionModel::Peaks;
  options.peaks = { { 0.7, 0.0, 0.0 }, { 0.0, 0.0, 0.3 } };
  options.unmyelinated.deviation = 0.0;
  const Fibres fibres = initialiseBundles(options);
  EXPECT_NEAR(bareFraction(fibres) * 0.9 / 0.6, 0.1, 0.003);
  EXPECT_NEAR(capsuleVolumeInDomain(fibres) / fibres.domain.volume(), 0.6, 0.012);
  double first = 0.0;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    first += isBare(fibres, f) && fibres.bundleIds[f] == 1 ? capsuleVolumeInDomain(fibres, f) / fibres.domain.volume() : 0.0;
  }
  EXPECT_NEAR(first / bareFraction(fibres), 0.7, 0.1);
  EXPECT_LT(meanNearest(fibres), 3.0 * 0.12 * std::sqrt(0.6 / 0.9)) << "hardly farther apart than if they touched";
}

TEST(UnmyelinatedAxons, OfPeaksNoneEndsInTheDomain)
{
  BundleInitializerOptions options = withBare(0.3);
  options.dispersionModel = DispersionModel::Peaks;
  options.peaks = { { 1.0, 0.0, 0.3 }, { 0.2, 0.4, 0.3 } };
  options.meanDispersion = 20.0;
  options.unmyelinated.cluster = 200;
  for (const double margin : { 0.0, -1.0 })
  {
    options.margin = margin;
    const Fibres fibres = initialiseBundles(options);
    for (std::size_t f = 0; f < fibres.size(); ++f)
    {
      EXPECT_LE(fibres.domain.depth(fibres.points[fibres.offsets[f]]), 1e-9);
      EXPECT_LE(fibres.domain.depth(fibres.points[fibres.offsets[f + 1] - 1]), 1e-9);
    }
  }
}

TEST(UnmyelinatedAxons, AreThereBetweenWallsToo)
{
  BundleInitializerOptions options = withBare(0.1);
  options.border = Border::Walls;
  const Fibres fibres = initialiseBundles(options);
  EXPECT_NEAR(bareFraction(fibres) * 0.9 / 0.6, 0.1, 0.004);
}

TEST(UnmyelinatedAxons, AreRefusedWhereTheyHaveNoPlace)
{
  EXPECT_EQ(bareRefusal([](auto&) {}), "");
  EXPECT_NE(bareRefusal([](auto& o) { o.unmyelinated.fraction = 0.7; }).find("UnmyelinatedFraction is 0.7: give 0 to 0.6"),
    std::string::npos);
  EXPECT_NE(bareRefusal([](auto& o) { o.unmyelinated.fraction = std::nan(""); }).find("UnmyelinatedFraction"), std::string::npos);
  EXPECT_NE(bareRefusal(
              [](auto& o)
              {
                o.unmyelinated.fraction = 0.58;
                o.grownFibreVolumeFraction = 0.6;
              })
              .find("UnmyelinatedFraction is 0.58: give at most 0.95 of GrownFibreVolumeFraction 0.6"),
    std::string::npos);
  EXPECT_NE(bareRefusal(
              [](auto& o)
              {
                o.numberOfBundles = 2;
                o.border = Border::Walls;
              })
              .find("or choose Mixing Interpenetrating"),
    std::string::npos);
  EXPECT_NE(bareRefusal([](auto& o) { o.unmyelinated.radius = 0.0; }).find("UnmyelinatedRadius is 0"), std::string::npos);
  EXPECT_NE(bareRefusal([](auto& o) { o.unmyelinated.cluster = 0; }).find("UnmyelinatedCluster is 0"), std::string::npos);
}
