// SPDX-License-Identifier: BSD-3-Clause
// Bundles along any axis, in domains of any length, and bundles that cross in one place.
#include "BundleBetweenWalls.h"
#include "base/Constants.h"
#include "base/Error.h"
#include "bundle/BundleInitializer.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

using namespace cactus;

namespace
{

using cactus::degree;

BundleInitializerOptions along(const Eigen::Vector3d& direction, double side = 20.0)
{
  BundleInitializerOptions options = ofPipes();
  options.side = side;
  options.direction = direction;
  return options;
}

/// Calls visit(middle, unit tangent, length, radius) for every segment of a bundle whose middle lies in the box.
void forEachSegmentIn(const Fibres& fibres, const Domain& box, int bundle,
  const std::function<void(const Eigen::Vector3d&, const Eigen::Vector3d&, double, double)>& visit)
{
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    for (std::size_t i = fibres.offsets[f]; fibres.bundleIds[f] == bundle && i + 1 < fibres.offsets[f + 1]; ++i)
    {
      const Eigen::Vector3d middle = 0.5 * (fibres.points[i] + fibres.points[i + 1]);
      const Eigen::Vector3d step = fibres.points[i + 1] - fibres.points[i];
      if (box.depth(middle) >= 0.0)
      {
        visit(middle, step.normalized(), step.norm(), fibres.radii[i]);
      }
    }
  }
}

/// Returns the mean of the tangents' outer products in the domain, by length.
Eigen::Matrix3d orientationTensor(const Fibres& fibres, int bundle)
{
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  forEachSegmentIn(fibres, fibres.domain, bundle,
    [&](const Eigen::Vector3d&, const Eigen::Vector3d& tangent, double length, double)
    { sum += length * tangent * tangent.transpose(); });
  return sum / sum.trace();
}

Eigen::Vector3d axisOf(const Fibres& fibres, int bundle)
{
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(orientationTensor(fibres, bundle)).eigenvectors().col(2);
}

/// Returns the part of a box that a bundle's segments fill.
double filled(const Fibres& fibres, const Domain& box, int bundle)
{
  double volume = 0.0;
  forEachSegmentIn(fibres, box, bundle,
    [&](const Eigen::Vector3d&, const Eigen::Vector3d&, double length, double radius)
    { volume += pi * radius * radius * length; });
  return volume / box.volume();
}

double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return std::acos(std::min(1.0, std::abs(a.normalized().dot(b.normalized())))) / degree;
}

TEST(BundleDirection, FibresRunAlongItAndFillTheDomainEvenly)
{
  for (const Eigen::Vector3d& direction : { Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, -3, 0), Eigen::Vector3d(1, 1, 1),
         Eigen::Vector3d(-0.3, 0.2, -0.8), Eigen::Vector3d(1e-5, 0, -1) })
  {
    for (const DispersionModel model : { DispersionModel::Coherent, DispersionModel::Watson })
    {
      BundleInitializerOptions options = along(direction);
      options.dispersionModel = model;
      BundleInitializerReport report;
      const Fibres fibres = initialiseBundles(options, {}, &report);
      validate(fibres);
      EXPECT_NEAR(report.fibreVolumeFraction, 0.7, 0.014);
      EXPECT_NEAR(report.meanDispersion, 5.0, 0.05);
      EXPECT_EQ(fibres.domain.size(), Eigen::Vector3d::Constant(20.0));
      EXPECT_LT(angleBetween(axisOf(fibres, 1), direction), 2.0);
      for (int octant = 0; octant < 8; ++octant)
      {
        Domain box = fibres.domain;
        for (int axis = 0; axis < 3; ++axis)
        {
          ((octant >> axis) % 2 == 0 ? box.upper : box.lower)[axis] = 0.0;
        }
        EXPECT_NEAR(filled(fibres, box, 1), 0.7, 0.13) << direction.transpose() << ", octant " << octant;
      }
    }
  }
}

TEST(BundleDirection, NothingOfItDependsOnItsLengthOrSense)
{
  const Fibres fibres = initialiseBundles(along({ 1, 2, 0 }, 6.0));
  for (const double factor : { -1.0, 0.125, -4.0 })
  {
    EXPECT_EQ(initialiseBundles(along(factor * Eigen::Vector3d(1, 2, 0), 6.0)).points, fibres.points);
  }
  EXPECT_EQ(initialiseBundles(along({ 0, 0, -7 }, 6.0)).points, initialiseBundles(along({ 0, 0, 1 }, 6.0)).points);
}

TEST(BundleDirection, BundlesOfOneSeedAreIndependent)
{
  const Fibres x = initialiseBundles(along({ 1, 0, 0 }, 10.0));
  const Fibres y = initialiseBundles(along({ 0, 1, 0 }, 10.0));
  std::vector<double> shared;
  std::set_intersection(x.radii.begin(), x.radii.end(), y.radii.begin(), y.radii.end(), std::back_inserter(shared));
  EXPECT_TRUE(shared.empty());
}

TEST(BundleDirection, ADomainMayBeLong)
{
  for (const Border border : { Border::Cut, Border::Walls })
  {
    for (const int bundles : { 1, 2 })
    {
      BundleInitializerOptions options = ofPipes();
      options.side = 10.0;
      options.length = 25.0;
      options.border = border;
      options.numberOfBundles = bundles;
      options.meanDispersion = 3.0;
      BundleInitializerReport report;
      const Fibres fibres = initialiseBundles(options, {}, &report);
      validate(fibres);
      EXPECT_EQ(fibres.domain.size(), Eigen::Vector3d(10.0, 10.0, 25.0));
      EXPECT_NEAR(report.fibreVolumeFraction, 0.7, 0.03);
      EXPECT_NEAR(capsuleVolumeInDomain(fibres) / fibres.domain.volume(), 0.7, 0.04);
      for (const double end : { -1.0, 1.0 })
      {
        Domain half = fibres.domain;
        (end < 0.0 ? half.upper : half.lower)[2] = 0.0;
        double both = 0.0;
        for (int bundle = 1; bundle <= bundles; ++bundle)
        {
          both += filled(fibres, half, bundle);
        }
        EXPECT_NEAR(both, 0.7, 0.1);
      }
    }
  }
  BundleInitializerOptions cube = ofPipes();
  cube.side = 10.0;
  const Fibres fibres = initialiseBundles(cube);
  cube.length = 10.0;
  EXPECT_EQ(initialiseBundles(cube).points, fibres.points);
}

TEST(BundleDirection, InterpenetratingBundlesAreAsRoundAsOne)
{
  constexpr double asked = 60.0;
  BundleInitializerOptions options = ofPipes();
  options.numberOfBundles = 2;
  options.crossingAngle = asked;
  BundleInitializerReport report;
  const Fibres fibres = initialiseBundles(options, {}, &report);
  validate(fibres);
  EXPECT_NEAR(report.fibreVolumeFraction, 0.7, 0.014);
  EXPECT_NEAR(capsuleVolumeInDomain(fibres) / fibres.domain.volume(), 0.7, 0.014);
  EXPECT_NEAR(report.meanDispersion, 5.0, 0.05);
  EXPECT_NEAR(report.sinuosity, 1.03, 0.001);
  EXPECT_EQ(fibres.grownFraction, 0.9);
  EXPECT_EQ(fibres.fibreIds.back(), static_cast<int>(fibres.size()));
  const double half = 0.5 * asked * degree;
  for (const int bundle : { 1, 2 })
  {
    const Eigen::Vector3d axis((bundle == 1 ? 1.0 : -1.0) * std::sin(half), 0.0, std::cos(half));
    EXPECT_LT(angleBetween(axisOf(fibres, bundle), axis), 2.0);
    EXPECT_NEAR(filled(fibres, fibres.domain, bundle), 0.35, 0.02);
    // Directions deviate as much out of the plane of the two axes as within it.
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> tensor(orientationTensor(fibres, bundle));
    EXPECT_LT(std::sqrt(tensor.eigenvalues()[1] / tensor.eigenvalues()[0]), 1.2);
  }
}

TEST(BundleDirection, LayersRemainAChoice)
{
  BundleInitializerOptions options = ofPipes();
  options.side = 12.0;
  options.numberOfBundles = 2;
  options.mixing = Mixing::Layers;
  const Fibres fibres = initialiseBundles(options);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> tensor(orientationTensor(fibres, 1));
  EXPECT_GT(std::sqrt(tensor.eigenvalues()[1] / tensor.eigenvalues()[0]), 2.0); // flat
  // Between walls there are none but layers.
  options.border = Border::Walls;
  const Fibres walled = initialiseBundles(options);
  options.mixing = Mixing::Interpenetrating;
  EXPECT_EQ(initialiseBundles(options).points, walled.points);
}

TEST(BundleDirection, WhatIsNoDirectionIsNamed)
{
  const auto messageFor = [](const BundleInitializerOptions& options) -> std::string
  {
    try
    {
      initialiseBundles(options);
    }
    catch (const InvalidInput& error)
    {
      return error.what();
    }
    return "no error";
  };
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  constexpr double endless = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& bad : { Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(none, 0, 1), Eigen::Vector3d(endless, 0, 1) })
  {
    EXPECT_EQ(messageFor(along(bad)).find("Direction is "), 0U) << messageFor(along(bad));
    BundleInitializerOptions crossing = along(bad, 5.0);
    crossing.numberOfBundles = 2; // where it has no effect
    crossing.radius.maximum = 1.0;
    EXPECT_EQ(messageFor(crossing), "no error");
  }
  BundleInitializerOptions walled = along({ 1, 0, 1 });
  walled.border = Border::Walls;
  EXPECT_NE(messageFor(walled).find("use Border Cut"), std::string::npos);
  BundleInitializerOptions options = ofPipes();
  for (const double bad : { -1.0, 0.01, 1e6, none })
  {
    options.length = bad;
    EXPECT_EQ(messageFor(options).find("Length is "), 0U) << messageFor(options);
  }
  options.length = 0.0;
  options.numberOfBundles = 2;
  options.mixing = static_cast<Mixing>(2);
  EXPECT_EQ(messageFor(options).find("Mixing has no choice 2"), 0U) << messageFor(options);
}

} // namespace
