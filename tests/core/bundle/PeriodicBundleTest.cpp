// SPDX-License-Identifier: BSD-3-Clause
// Guarantees: circles do not overlap across periodic faces; with Border Periodic every fibre comes back to its place, and has its
// angles and calibre all the same; what cannot repeat is refused by name.
#include "BundleBetweenWalls.h"
#include "base/Constants.h"
#include "base/Error.h"
#include "bundle/BundleInitializer.h"
#include "bundle/CircleRelaxation.h"
#include "fibres/FibreShape.h"
#include "fibres/PeriodicImages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

using namespace cactus;

namespace
{

BundleInitializerOptions periodic(Border border, double side)
{
  BundleInitializerOptions options = ofPipes();
  options.border = border;
  options.side = side;
  options.radius.maximum = 0.25 * side;
  return options;
}

std::string refusal(const std::function<void(BundleInitializerOptions&)>& change)
{
  BundleInitializerOptions options = periodic(Border::Periodic, 12.0);
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

TEST(PeriodicBundle, CirclesComeApartAcrossTheFaces)
{
  Circles circles;
  Rectangle frame;
  frame.upper = Eigen::Vector2d(4.0, 4.0);
  frame.repeats = true;
  circles.frames = { frame };
  for (int i = 0; i < 25; ++i)
  {
    circles.radii.push_back(i % 6 == 0 ? 0.6 : 0.3);
    const Eigen::Vector2d cell(i % 5, i / 5); // NOLINT(bugprone-integer-division): row and column
    circles.centres.emplace_back(0.8 * cell + 0.1 * Eigen::Vector2d(std::sin(i), std::cos(3.0 * i)));
    circles.frameOf.push_back(0);
  }
  EXPECT_TRUE(relaxCircles(circles).separated);
  EXPECT_GT(circles.density(), 0.6);
  for (std::size_t i = 0; i < circles.size(); ++i)
  {
    EXPECT_TRUE(frame.holds(circles.centres[i], 0.0));
    for (std::size_t j = 0; j < i; ++j)
    {
      for (int image = 0; image < 9; ++image)
      {
        const Eigen::Vector2d shift(4.0 * (image % 3 - 1), 4.0 * (image / 3 - 1)); // NOLINT(bugprone-integer-division)
        const double distance = (circles.centres[i] - circles.centres[j] + shift).norm();
        EXPECT_GE(distance, circles.radii[i] + circles.radii[j]);
      }
    }
  }
}

TEST(PeriodicBundle, FibresComeBackToTheirPlacesWithTheAnglesAskedFor)
{
  for (const double angle : { 5.0, 15.0 })
  {
    BundleInitializerOptions options = periodic(Border::Periodic, 20.0);
    options.length = 24.0;
    options.meanDispersion = angle;
    options.sinuosity = 1.0;
    options.calibre.deviation = 0.3;
    const Fibres fibres = initialiseBundles(options);
    ASSERT_TRUE(fibres.domain.periodic[2]);
    double bends = 0.0;
    double length = 0.0;
    double variance = 0.0;
    for (std::size_t f = 0; f < fibres.size(); ++f)
    {
      const FibrePeriod period = periodOf(fibres, f);
      EXPECT_EQ(period.shift, Eigen::Vector3d(0.0, 0.0, 24.0));
      EXPECT_LE(fibres.points[fibres.offsets[f]].z(), -12.0 - 2.0);
      EXPECT_GE(fibres.points[fibres.offsets[f + 1] - 1].z(), 12.0 + 2.0);
      double mean = 0.0;
      double square = 0.0;
      for (std::size_t i = fibres.offsets[f]; i < fibres.offsets[f] + period.points; ++i)
      {
        if (i + period.points < fibres.offsets[f + 1])
        {
          EXPECT_EQ(fibres.radii[i], fibres.radii[i + period.points]);
        }
        const Eigen::Vector3d step = fibres.points[i + 1] - fibres.points[i];
        bends += step.norm() * std::acos(step.z() / step.norm()) / degree;
        length += step.norm();
        mean += std::log(fibres.radii[i]) / static_cast<double>(period.points);
        square += std::pow(std::log(fibres.radii[i]), 2) / static_cast<double>(period.points);
      }
      variance += (square - mean * mean) / static_cast<double>(fibres.size());
    }
    EXPECT_NEAR(bends / length, angle, 0.05 * angle);
    EXPECT_GT(std::sqrt(variance), 0.1);
    EXPECT_NEAR(capsuleVolumeInDomain(fibres) / fibres.domain.volume(), options.fibreVolumeFraction, 0.01);
  }
}

/// A fibre that leaves through a face counts as a whole, wherever its images lie.
TEST(PeriodicBundle, FibresThatLeaveAreMeasuredOnce)
{
  const Fibres fibres = initialiseBundles(periodic(Border::PeriodicAcross, 10.0));
  EXPECT_EQ(fibres.domain.periodic, (std::array<bool, 3>{ { true, true, false } }));
  std::size_t leaving = 0;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    double outside = 0.0;
    for (std::size_t i = fibres.offsets[f]; i < fibres.offsets[f + 1]; ++i)
    {
      outside = std::max(outside, fibres.points[i].head<2>().cwiseAbs().maxCoeff() - 5.0);
    }
    leaving += outside > 0.0 ? 1 : 0;
    EXPECT_GT(lengthInDomain(fibres, f), 10.0);
    EXPECT_LT(lengthInDomain(fibres, f), 12.0);
  }
  EXPECT_GT(leaving, 5u);
}

TEST(PeriodicBundle, WhatCannotRepeatIsRefusedByName)
{
  EXPECT_EQ(refusal([](BundleInitializerOptions&) {}), "");
  EXPECT_NE(refusal([](BundleInitializerOptions& o) { o.numberOfBundles = 2; }).find("NumberOfBundles is 2"), std::string::npos);
  EXPECT_NE(
    refusal([](BundleInitializerOptions& o) { o.direction.x() = 0.1; }).find("Direction is not along z"), std::string::npos);
  EXPECT_NE(refusal([](BundleInitializerOptions& o) { o.dispersionModel = DispersionModel::Harmonics; }).find("Harmonics"),
    std::string::npos);
  EXPECT_NE(refusal([](BundleInitializerOptions& o) { o.dispersionModel = DispersionModel::Watson; }).find("straight fibres"),
    std::string::npos);
  EXPECT_EQ(refusal(
              [](BundleInitializerOptions& o)
              {
                o.dispersionModel = DispersionModel::Watson;
                o.meanDispersion = 0.0;
              }),
    "");
  EXPECT_NE(
    refusal([](BundleInitializerOptions& o) { o.radius.maximum = 4.0; }).find("four times MaximumRadius"), std::string::npos);
}
