// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/OrientationDistribution.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "base/SphericalHarmonics.h"
#include "bundle/BundleInitializer.h"
#include "bundle/DirectionDistribution.h"
#include "optimiser/CapsuleOptimizer.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

using namespace cactus;

namespace
{

/// Three peaks at right angles with shares of 0.5, 0.3 and 0.2, none along an axis of coordinates.
const std::array<double, 3> shares{ 0.5, 0.3, 0.2 };

Eigen::Matrix3d peakAxes()
{
  Eigen::Matrix3d axes;
  axes.col(0) = Eigen::Vector3d(1, 2, 2) / 3.0;
  axes.col(1) = Eigen::Vector3d(2, 1, -2) / 3.0;
  axes.col(2) = Eigen::Vector3d(-2, 2, -1) / 3.0;
  return axes;
}

/// Calls visit(direction) for directions that cover the sphere evenly.
void forEachDirection(int count, const std::function<void(const Eigen::Vector3d&)>& visit)
{
  for (int i = 0; i < count; ++i)
  {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double angle = goldenAngle * i;
    const double sine = std::sqrt(1.0 - z * z);
    visit({ sine * std::cos(angle), sine * std::sin(angle), z });
  }
}

/// Returns the coefficients of Watson peaks of this concentration, by a sum over the sphere.
std::vector<double> peaks(double kappa, int order)
{
  const Eigen::Matrix3d axes = peakAxes();
  std::vector<double> coefficients(harmonicCount(order), 0.0);
  forEachDirection(20000,
    [&](const Eigen::Vector3d& direction)
    {
      double value = 0.0;
      for (int i = 0; i < 3; ++i)
      {
        const double cosine = axes.col(i).dot(direction);
        value += shares[std::size_t(i)] * std::exp(kappa * (cosine * cosine - 1.0));
      }
      const std::vector<double> harmonics = harmonicsAt(direction, order);
      for (std::size_t k = 0; k < harmonics.size(); ++k)
      {
        coefficients[k] += value * harmonics[k];
      }
    });
  return coefficients;
}

/// Returns the angular correlation coefficient of two functions (Anderson 2005, Magn Reson Med 54:1194).
double correlation(const std::vector<double>& a, const std::vector<double>& b)
{
  double ab = 0.0;
  double aa = 0.0;
  double bb = 0.0;
  for (std::size_t i = 1; i < a.size(); ++i)
  {
    ab += a[i] * b[i];
    aa += a[i] * a[i];
    bb += b[i] * b[i];
  }
  return ab / std::sqrt(aa * bb);
}

/// Returns the mean of a function over directions of even quantiles.
double meanOver(const OrientationDistribution& distribution, const std::function<double(const Eigen::Vector3d&)>& function)
{
  constexpr int side = 200;
  double sum = 0.0;
  for (int i = 0; i < side * side; ++i)
  {
    sum += function(distribution.at((i % side + 0.5) / side, (i / side + 0.5) / side)); // NOLINT(bugprone-integer-division)
  }
  return sum / (side * side);
}

BundleInitializerOptions optionsFor(const std::vector<double>& harmonics)
{
  BundleInitializerOptions options;
  options.side = 15.0;
  options.dispersionModel = DispersionModel::Harmonics;
  options.harmonics = harmonics;
  options.fibreVolumeFraction = 0.5;
  return options;
}

/// Returns the coefficients of the tangents in the domain, by length.
std::vector<double> harmonicsOf(const Fibres& fibres, int order)
{
  std::vector<double> sum(harmonicCount(order), 0.0);
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    for (std::size_t i = fibres.offsets[f]; i + 1 < fibres.offsets[f + 1]; ++i)
    {
      const Eigen::Vector3d step = fibres.points[i + 1] - fibres.points[i];
      if (fibres.domain.depth(0.5 * (fibres.points[i] + fibres.points[i + 1])) >= 0.0)
      {
        const std::vector<double> values = harmonicsAt(step.normalized(), order);
        for (std::size_t k = 0; k < sum.size(); ++k)
        {
          sum[k] += step.norm() * fibres.radii[i] * fibres.radii[i] * values[k];
        }
      }
    }
  }
  return sum;
}

std::string messageFor(const BundleInitializerOptions& options)
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
}

TEST(OrientationDistribution, HasTheMomentsOfItsHarmonics)
{
  // ⟨P2⟩ of c0 Y00 + c2 Y20 is c2 / (√5 c0).
  const HarmonicsDistribution along({ 2.0, 0.0, 0.0, 1.5, 0.0, 0.0 });
  const auto p2 = [](const Eigen::Vector3d& d) { return 1.5 * d.z() * d.z() - 0.5; };
  EXPECT_NEAR(meanOver(along, p2), 1.5 / (2.0 * std::sqrt(5.0)), 1e-4);
  EXPECT_NEAR(meanOver(HarmonicsDistribution({ 3.0 }), p2), 0.0, 1e-4);
  // ⟨Y22⟩ is c22 / (√(4π) c0); √3 times a function with the mean square 1/5 of x² − y² is meant.
  const HarmonicsDistribution across({ 2.0, 0.0, 0.0, 0.0, 0.0, 0.7 });
  const auto y22 = [](const Eigen::Vector3d& d) { return std::sqrt(15.0 / (16.0 * pi)) * (d.x() * d.x() - d.y() * d.y()); };
  EXPECT_NEAR(meanOver(across, y22), 0.7 / (2.0 * std::sqrt(4.0 * pi)), 1e-4);
}

std::vector<Eigen::Vector3d> weightedAxes()
{
  std::vector<Eigen::Vector3d> axes;
  for (int i = 0; i < 3; ++i)
  {
    axes.emplace_back(2.0 * shares[std::size_t(i)] * peakAxes().col(i));
  }
  axes.insert(axes.begin() + 1, Eigen::Vector3d::Zero()); // of which there are no fibres
  return axes;
}

TEST(OrientationDistribution, AxialIsWatsonsAboutItsAxis)
{
  const Eigen::Vector3d axis = peakAxes().col(2);
  const AxialDistribution axial(axis, 20.0);
  constexpr int count = 300; // of quantiles each way
  Eigen::Vector3d across = Eigen::Vector3d::Zero();
  std::vector<double> angles;
  double sum = 0.0;
  for (int i = 0; i < count * count; ++i)
  {
    const Eigen::Vector3d one =
      axial.at((i % count + 0.5) / count, (i / count + 0.5) / count); // NOLINT(bugprone-integer-division)
    ASSERT_NEAR(one.norm(), 1.0, 1e-12);
    const double along = one.dot(axis);
    across += (along < 0.0 ? -1.0 : 1.0) * one - std::abs(along) * axis;
    angles.push_back(std::acos(std::min(1.0, std::abs(along))));
    sum += angles.back() / degree;
  }
  EXPECT_LT(across.norm() / (count * count), 1e-3); // no azimuth is preferred
  EXPECT_NEAR(sum / (count * count), 20.0, 0.02);
  EXPECT_LT(distanceToWatson(angles), 0.005);

  const AxialDistribution straight(Eigen::Vector3d(0.0, 0.6, 0.8), 0.0);
  EXPECT_LT((straight.at(0.3, 0.8) - Eigen::Vector3d(0.0, 0.6, 0.8)).norm(), 1e-12);
}

TEST(OrientationDistribution, PeaksHaveTheHarmonicsOfTheirSum)
{
  const double kappa = 8.0;
  const std::vector<double> summed = peaks(kappa, 8);
  BundleInitializerOptions options = optionsFor({});
  options.side = 6.0;
  options.dispersionModel = DispersionModel::Peaks;
  options.peaks = weightedAxes();
  options.meanDispersion = watsonMeanAngle(kappa);
  const std::vector<double> found = initialiseBundles(options).orientationHarmonics;
  ASSERT_EQ(found.size(), summed.size());
  const double scale = summed[0] / found[0];
  for (std::size_t k = 0; k < found.size(); ++k)
  {
    EXPECT_NEAR(scale * found[k], summed[k], 1e-3 * summed[0]) << k;
  }
}

TEST(OrientationDistribution, BundlesOfPeaksHaveTheirSharesAndAxes)
{
  BundleInitializerOptions options = optionsFor({});
  options.side = 30.0;
  options.fibreVolumeFraction = 0.4;
  options.dispersionModel = DispersionModel::Peaks;
  options.peaks = weightedAxes();
  options.meanDispersion = 10.0;
  BundleInitializerReport report;
  const Fibres fibres = initialiseBundles(options, {}, &report);
  EXPECT_NEAR(report.meanDispersion, 10.0, 0.5);
  std::array<double, 5> volumes{};
  std::array<Eigen::Matrix3d, 5> moments;
  moments.fill(Eigen::Matrix3d::Zero());
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    const auto bundle = std::size_t(fibres.bundleIds[f]);
    const Eigen::Vector3d way = (fibres.points[fibres.offsets[f + 1] - 1] - fibres.points[fibres.offsets[f]]).normalized();
    const double volume = capsuleVolumeInDomain(fibres, f);
    volumes.at(bundle) += volume;
    moments.at(bundle) += volume * way * way.transpose();
  }
  EXPECT_EQ(volumes[2], 0.0);
  const std::array<std::size_t, 3> bundles{ 1, 3, 4 };
  for (int i = 0; i < 3; ++i)
  {
    const std::size_t bundle = bundles[std::size_t(i)];
    EXPECT_NEAR(volumes[bundle] / fibres.domain.volume(), 0.4 * shares[std::size_t(i)], 0.005);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(moments[bundle]);
    EXPECT_LT(angleBetweenLines(solver.eigenvectors().col(2), peakAxes().col(i)), 1.5);
  }
  const std::vector<double> asked = peaks(watsonKappa(10.0), 8);
  EXPECT_GT(correlation(fibres.orientationHarmonics, asked), 0.9999);
  EXPECT_NEAR(fibres.orientationHarmonics[0] * std::sqrt(4.0 * pi), 0.4, 1e-9);
}

TEST(OrientationDistribution, FibresInSpaceHaveIt)
{
  const std::vector<double> asked = peaks(8.0, 8);
  BundleInitializerOptions options = optionsFor(asked);
  options.side = 30.0;
  BundleInitializerReport report;
  const Fibres fibres = initialiseBundles(options, {}, &report);
  validate(fibres);
  // Once they wind: the mean sine of the angle between two of these fibres is 0.748.
  std::vector<double> wound = harmonicsOf(fibres, 8);
  const double variance = 0.257 * std::pow(0.5, 1.6) * 0.748;
  for (int l = 2; l <= 8; l += 2)
  {
    for (std::size_t i = harmonicCount(l) - std::size_t(2 * l + 1); i < harmonicCount(l); ++i)
    {
      wound[i] *= std::exp(-0.5 * l * (l + 1) * variance);
    }
  }
  EXPECT_GT(correlation(wound, asked), 0.98);
  EXPECT_NEAR(report.fibreVolumeFraction, 0.5, 0.01);
  EXPECT_NEAR(capsuleVolumeInDomain(fibres) / fibres.domain.volume(), 0.5, 0.01);
  EXPECT_EQ(fibres.grownFraction, 0.9);
  // As dense in every octant.
  for (int octant = 0; octant < 8; ++octant)
  {
    Fibres part = fibres;
    for (int axis = 0; axis < 3; ++axis)
    {
      ((octant >> axis) % 2 == 0 ? part.domain.upper : part.domain.lower)[axis] = 0.0;
    }
    EXPECT_NEAR(capsuleVolumeInDomain(part) / part.domain.volume(), 0.5, 0.12);
  }
  // And without a preferred direction, where none is asked for.
  const std::vector<double> even = harmonicsOf(initialiseBundles(optionsFor({ 1.0 })), 2);
  for (std::size_t k = 1; k < even.size(); ++k)
  {
    EXPECT_LT(std::abs(even[k] / even[0]), 0.25);
  }
}

TEST(OrientationDistribution, ItsScaleDoesNotMatter)
{
  const std::vector<double> asked = peaks(8.0, 8);
  const Eigen::Vector3d direction = HarmonicsDistribution(asked, 0.5).at(0.3, 0.6);
  EXPECT_GT((HarmonicsDistribution(asked).at(0.3, 0.6) - direction).norm(), 1e-3) << "it is sharper";
  for (const double scale : { 1e-200, 1e200 })
  {
    std::vector<double> scaled = asked;
    for (double& value : scaled)
    {
      value *= scale;
    }
    EXPECT_LT((HarmonicsDistribution(scaled, 0.5).at(0.3, 0.6) - direction).norm(), 1e-6);
  }
}

TEST(OrientationDistribution, FibresThatWindHaveIt)
{
  const std::vector<double> asked = peaks(8.0, 8);
  BundleInitializerOptions options = optionsFor(asked);
  options.side = 24.0;
  options.fibreVolumeFraction = 0.4;
  Fibres fibres = initialiseBundles(options);
  EXPECT_LT(correlation(harmonicsOf(fibres, 8), asked), 0.95) << "they are laid with a sharper one";
  ASSERT_EQ(optimise(fibres, {}, {}).reason, StopReason::Converged);
  EXPECT_GT(correlation(harmonicsOf(fibres, 8), asked), 0.98);
}

TEST(OrientationDistribution, WhatIsNoneIsNamed)
{
  const auto expect = [](const std::vector<double>& harmonics, const std::string& words)
  { EXPECT_NE(messageFor(optionsFor(harmonics)).find(words), std::string::npos) << messageFor(optionsFor(harmonics)); };
  expect({}, "OrientationHarmonics has 0 coefficients: give 1, 6, 15");
  expect(std::vector<double>(5, 1.0), "OrientationHarmonics has 5 coefficients");
  expect(std::vector<double>(harmonicCount(18), 1.0), "OrientationHarmonics has 190 coefficients");
  expect({ -1.0 }, "OrientationHarmonics has no direction");
  expect({ std::numeric_limits<double>::quiet_NaN() }, "OrientationHarmonics has a coefficient that is no finite");
  const auto expectOfPeaks = [](const std::vector<Eigen::Vector3d>& axes, const std::string& words)
  {
    BundleInitializerOptions options = optionsFor({});
    options.dispersionModel = DispersionModel::Peaks;
    options.peaks = axes;
    EXPECT_NE(messageFor(options).find(words), std::string::npos) << messageFor(options);
  };
  expectOfPeaks({}, "OrientationPeaks has no peak");
  expectOfPeaks({ Eigen::Vector3d::Zero() }, "OrientationPeaks has no peak");
  expectOfPeaks({ Eigen::Vector3d::UnitX(), Eigen::Vector3d(1.0, std::nan(""), 0.0) }, "OrientationPeaks has a peak, 2, that");
  BundleInitializerOptions walled = optionsFor({ 1.0 });
  walled.border = Border::Walls;
  EXPECT_NE(messageFor(walled).find("Border Cut"), std::string::npos);
  BundleInitializerOptions two = optionsFor({ 1.0 });
  two.numberOfBundles = 2;
  EXPECT_NE(messageFor(two).find("NumberOfBundles"), std::string::npos);
}

} // namespace
