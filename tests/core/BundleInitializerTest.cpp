// SPDX-License-Identifier: BSD-3-Clause
#include "BundleInitializer.h"
#include "Error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

using namespace cactus;

namespace
{

constexpr double degree = 3.14159265358979323846 / 180.0;

/// First (end 0) or last control point of a fibre.
Eigen::Vector3d endPoint(const Fibres& fibres, std::size_t f, int end)
{
  return fibres.points[end == 0 ? fibres.offsets[f] : fibres.offsets[f + 1] - 1];
}

/// Mean angle (degrees) of a bundle's fibres to a given axis, computed from the end points alone.
double meanAngleTo(const Fibres& fibres, const Eigen::Vector3d& axis, int bundle)
{
  double sum = 0.0;
  int count = 0;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    if (fibres.bundleIds[f] == bundle)
    {
      sum += std::acos(std::min(1.0, (endPoint(fibres, f, 1) - endPoint(fibres, f, 0)).normalized().dot(axis)));
      ++count;
    }
  }
  return sum / count / degree;
}

/// Every pair of one bundle's circles on the face at one end, by brute force, with lengths along the face.
void expectNoOverlap(const Fibres& fibres, int end)
{
  for (std::size_t i = 0; i < fibres.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      if (fibres.bundleIds[i] == fibres.bundleIds[j])
      {
        const double distance = (endPoint(fibres, i, end) - endPoint(fibres, j, end)).norm();
        ASSERT_GE(distance, (fibres.targetRadii[i] + fibres.targetRadii[j]) * (1.0 - 1e-9)) << i << " " << j;
      }
    }
  }
}

double circleArea(const Fibres& fibres)
{
  double area = 0.0;
  for (const double r : fibres.targetRadii)
  {
    area += 3.14159265358979 * r * r;
  }
  return area;
}

std::string errorOf(const std::function<void(BundleInitializerOptions&)>& change)
{
  BundleInitializerOptions options;
  change(options);
  try
  {
    initialiseBundles(options);
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return "no error";
}

} // namespace

TEST(BundleInitializer, FacesHoldAllCirclesApartAndInside)
{
  for (const double density : { 0.3, 0.7, 0.78 })
  {
    for (const double margin : { 0.0, 3.0 })
    {
      BundleInitializerOptions options;
      options.fibreVolumeFraction = density;
      options.meanDispersion = 10.0;
      options.margin = margin;
      const Fibres fibres = initialiseBundles(options);
      validate(fibres);
      const double face = options.side + 2.0 * margin;
      EXPECT_NEAR(circleArea(fibres) / (face * face), density, 0.005);
      for (const int end : { 0, 1 })
      {
        expectNoOverlap(fibres, end);
        for (std::size_t f = 0; f < fibres.size(); ++f)
        {
          const Eigen::Vector3d p = endPoint(fibres, f, end);
          EXPECT_EQ(p.z(), end == 0 ? -15.0 : 15.0);
          EXPECT_LE(std::max(std::abs(p.x()), std::abs(p.y())) + fibres.targetRadii[f], 0.5 * face + 1e-9);
        }
      }
      EXPECT_EQ(fibres.domain.upper, Eigen::Vector3d::Constant(15.0));
    }
  }
}

TEST(BundleInitializer, MeanDispersionIsTheOneAsked)
{
  for (const DispersionModel model : { DispersionModel::Watson, DispersionModel::Cone })
  {
    for (const double asked : { 0.0, 2.0, 5.0, 10.0, 15.0, 20.0, 25.0 })
    {
      BundleInitializerOptions options;
      options.meanDispersion = asked;
      options.dispersionModel = model;
      BundleInitializerReport report;
      const Fibres fibres = initialiseBundles(options, {}, &report);
      EXPECT_NEAR(meanAngleTo(fibres, Eigen::Vector3d::UnitZ(), 1), asked, 0.1);
      EXPECT_NEAR(meanDispersion(fibres, 1), asked, 0.25);
      EXPECT_NEAR(report.meanDispersion, meanAngleTo(fibres, Eigen::Vector3d::UnitZ(), 1), 1e-6);
      expectNoOverlap(fibres, 1);
    }
  }
}

TEST(BundleInitializer, WithoutDispersionEndsLieOppositeEachOther)
{
  BundleInitializerOptions options;
  options.meanDispersion = 0.0;
  const Fibres fibres = initialiseBundles(options);
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    EXPECT_EQ(endPoint(fibres, f, 1).head<2>(), endPoint(fibres, f, 0).head<2>());
  }
}

TEST(BundleInitializer, FibresAreStraightAndEvenlySpaced)
{
  BundleInitializerOptions options;
  options.meanDispersion = 10.0;
  const Fibres fibres = initialiseBundles(options);
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    const double wanted = std::clamp(1.25 * fibres.targetRadii[f], 0.8, 2.0);
    const Eigen::Vector3d first = endPoint(fibres, f, 0);
    const Eigen::Vector3d chord = endPoint(fibres, f, 1) - first;
    ASSERT_GE(fibres.pointCount(f), 3u);
    const double segments = static_cast<double>(fibres.pointCount(f) - 1);
    EXPECT_NEAR(chord.norm() / segments, wanted, 0.05 * wanted);
    for (std::size_t k = 0; k < fibres.pointCount(f); ++k)
    {
      const Eigen::Vector3d expected = first + chord * (static_cast<double>(k) / segments);
      EXPECT_LT((fibres.points[fibres.offsets[f] + k] - expected).norm(), 1e-9);
      EXPECT_EQ(fibres.radii[fibres.offsets[f] + k], fibres.targetRadii[f]);
    }
  }
}

TEST(BundleInitializer, SameSeedSameBitsOnAnyNumberOfThreads)
{
  BundleInitializerOptions options;
  options.side = 130.0; // more circles than the relaxation treats serially
  options.minimumSpacing = options.maximumSpacing = 65.0;
  options.spacingFactor = 100.0;
  Context context;
  context.threads = 1;
  const Fibres one = initialiseBundles(options, context);
  ASSERT_GT(one.size(), 4096u);
  context.threads = 2;
  const Fibres two = initialiseBundles(options, context);
  EXPECT_EQ(one.points, two.points);
  EXPECT_EQ(one.radii, two.radii);
  options.seed = 2;
  EXPECT_NE(initialiseBundles(options, context).points, one.points);
}

TEST(BundleInitializer, WhatCannotBeReachedSaysWhatCan)
{
  EXPECT_NE(errorOf([](auto& o) { o.fibreVolumeFraction = 0.95; }).find("only at 0.8"), std::string::npos);
  BundleInitializerOptions options;
  options.fibreVolumeFraction = 0.95;
  EXPECT_THROW(initialiseBundles(options), Infeasible);
  options.fibreVolumeFraction = 0.7;
  options.meanDispersion = 45.0;
  EXPECT_THROW(initialiseBundles(options), Infeasible);
  EXPECT_NE(errorOf([](auto& o) { o.meanDispersion = 45.0; }).find("came to 4"), std::string::npos);
}

TEST(BundleInitializer, StopsWhenAsked)
{
  Context context;
  context.cancelled = [] { return true; };
  EXPECT_THROW(initialiseBundles({}, context), Cancelled);
}

TEST(BundleInitializer, BadParametersAreNamed)
{
  const auto names = [](const char* property, const std::function<void(BundleInitializerOptions&)>& change)
  {
    const std::string message = errorOf(change);
    EXPECT_NE(message.find(property), std::string::npos) << message;
  };
  for (const double bad : { 0.0, -1.0, static_cast<double>(NAN), static_cast<double>(INFINITY) })
  {
    names("Side", [&](auto& o) { o.side = bad; });
    names("FibreVolumeFraction", [&](auto& o) { o.fibreVolumeFraction = bad; });
    names("GammaScale", [&](auto& o) { o.radius.gammaScale = bad; });
    names("CrossingAngle", [&](auto& o) { o.crossingAngle = bad; });
    names("SpacingFactor", [&](auto& o) { o.spacingFactor = bad; });
    names("MinimumSpacing", [&](auto& o) { o.minimumSpacing = bad; });
    names("MaximumSpacing", [&](auto& o) { o.maximumSpacing = bad; });
  }
  names("FibreVolumeFraction", [](auto& o) { o.fibreVolumeFraction = 1.0; });
  names("MeanDispersion", [](auto& o) { o.meanDispersion = -1.0; });
  names("MeanDispersion", [](auto& o) { o.meanDispersion = 46.0; });
  names("NumberOfBundles", [](auto& o) { o.numberOfBundles = 3; });
  names("NumberOfBundles", [](auto& o) { o.numberOfBundles = 0; });
  names("CrossingAngle", [](auto& o) { o.crossingAngle = 91.0; });
  names("Margin", [](auto& o) { o.margin = -1.0; });
  names("SheetThickness", [](auto& o) { o.sheetThickness = -1.0; });
  names("DispersionModel", [](auto& o) { o.dispersionModel = static_cast<DispersionModel>(2); });
  names("RadiusDistribution", [](auto& o) { o.radius.model = static_cast<RadiusModel>(3); });
  names("CrossingStyle", [](auto& o) { o.crossingStyle = static_cast<CrossingStyle>(2); });
  names("Side 1e+07", [](auto& o) { o.side = 1e7; });
  names("Side gives", [](auto& o) { o.side = 0.3; });
}
