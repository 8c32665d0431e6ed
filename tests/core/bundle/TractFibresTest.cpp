// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/TractFibres.h"

#include "BundleBetweenWalls.h"
#include "FilledThirds.h"
#include "base/Constants.h"
#include "base/Error.h"
#include "bundle/TractPath.h"
#include "fibres/SegmentDistance.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

using namespace cactus;

namespace
{

void addStreamline(Streamlines& streamlines, const std::vector<Eigen::Vector3d>& points)
{
  streamlines.points.insert(streamlines.points.end(), points.begin(), points.end());
  streamlines.offsets.push_back(streamlines.points.size());
}

/// Returns one streamline whose points a function gives for 0 to 1.
Streamlines streamlineAlong(const std::function<Eigen::Vector3d(double)>& at, int points)
{
  std::vector<Eigen::Vector3d> line;
  for (int i = 0; i < points; ++i)
  {
    line.push_back(at(static_cast<double>(i) / (points - 1)));
  }
  Streamlines streamlines;
  addStreamline(streamlines, line);
  return streamlines;
}

Streamlines straightAlong(const Eigen::Vector3d& direction, double length)
{
  return streamlineAlong([&](double t) { return Eigen::Vector3d((t - 0.5) * length * direction.normalized()); }, 21);
}

/// Half a circle around (0, 5, 0) in the x–z plane.
Streamlines halfCircle(double radius, int points)
{
  return streamlineAlong(
    [&](double t) { return Eigen::Vector3d(radius * std::cos(pi * t), 5.0, radius * std::sin(pi * t)); }, points);
}

/// Two straight legs at right angles, each of a length.
Streamlines rightAngle(double leg)
{
  Streamlines streamlines;
  addStreamline(streamlines, { { -leg, 0, 0 }, { 0, 0, 0 }, { 0, leg, 0 } });
  return streamlines;
}

TractFibresOptions optionsOf(double side)
{
  TractFibresOptions options = ofPipes<TractFibresOptions>();
  options.side = side;
  options.grownFibreVolumeFraction = 0.0; // fibres start with the drawn radii, at which they touch
  return options;
}

/// Returns the largest overlap of any two fibres over the sum of their radii, by all pairs of segments.
double largestOverlap(const Fibres& fibres)
{
  double largest = -1.0;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    for (std::size_t g = 0; g < f; ++g)
    {
      const double touching = fibres.radii[fibres.offsets[f]] + fibres.radii[fibres.offsets[g]];
      for (std::size_t i = fibres.offsets[f]; i + 1 < fibres.offsets[f + 1]; ++i)
      {
        for (std::size_t j = fibres.offsets[g]; j + 1 < fibres.offsets[g + 1]; ++j)
        {
          if ((fibres.points[i] - fibres.points[j]).norm() < touching + 5.0)
          {
            const double distance =
              closestPoints(fibres.points[i], fibres.points[i + 1], fibres.points[j], fibres.points[j + 1]).distance;
            largest = std::max(largest, 1.0 - distance / touching);
          }
        }
      }
    }
  }
  return largest;
}

double areaOfCircles(const Fibres& fibres)
{
  double area = 0.0;
  for (const double radius : fibres.targetRadii)
  {
    area += pi * radius * radius;
  }
  return area;
}

/// Distribution function of gamma(2.4, 0.25) cut to [0.2, 2], by the trapezoidal rule.
double gammaShare(double radius)
{
  const auto integral = [](double to)
  {
    const auto density = [](double r) { return std::pow(r, 1.4) * std::exp(-r / 0.25); };
    constexpr int steps = 2000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i)
    {
      const double width = (to - 0.2) / steps;
      sum += 0.5 * width * (density(0.2 + width * i) + density(0.2 + width * (i + 1)));
    }
    return sum;
  };
  return integral(radius) / integral(2.0);
}

} // namespace

TEST(TractFibres, StraightTractMakesAStraightBundleThatFillsTheDomain)
{
  const Eigen::Vector3d direction = Eigen::Vector3d(1, 2, 3).normalized();
  TractFibresReport report;
  const Fibres fibres = layTractFibres(straightAlong(direction, 500.0), optionsOf(14.0), {}, &report);
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    for (std::size_t i = fibres.offsets[f]; i + 1 < fibres.offsets[f + 1]; ++i)
    {
      ASSERT_LT((fibres.points[i + 1] - fibres.points[i]).normalized().cross(direction).norm(), 1e-9);
    }
  }
  EXPECT_LE(largestOverlap(fibres), 1e-9);
  EXPECT_EQ(report.smoothing, 0.0);
  EXPECT_EQ(report.ends, 0);
  EXPECT_NEAR(report.fibreVolumeFraction, 0.7, 0.04);
  EXPECT_DOUBLE_EQ(report.fibreVolumeFraction, capsuleVolumeInDomain(fibres) / fibres.domain.volume());
}

TEST(TractFibres, ABoxIsFilledFromEndToEnd)
{
  TractFibresOptions options = optionsOf(12.0);
  options.length = 30.0;
  TractFibresReport report;
  const Fibres fibres = layTractFibres(straightAlong(Eigen::Vector3d(1, 2, 3).normalized(), 500.0), options, {}, &report);
  EXPECT_EQ(fibres.domain.upper, Eigen::Vector3d(6.0, 6.0, 15.0));
  EXPECT_EQ(fibres.domain.lower, Eigen::Vector3d(-6.0, -6.0, -15.0));
  EXPECT_NEAR(report.fibreVolumeFraction, 0.7, 0.04);
  for (const double filledThird : filledThirds(fibres))
  {
    EXPECT_NEAR(filledThird, 0.7, 0.06);
  }
}

TEST(TractFibres, FibresOfAnArcKeepTheirDistanceFromIt)
{
  TractFibresReport report;
  const Fibres fibres = layTractFibres(halfCircle(60.0, 400), optionsOf(20.0), {}, &report);
  EXPECT_EQ(report.smoothing, 0.0);
  EXPECT_LT((report.middle - Eigen::Vector3d(0, 5, 60)).norm(), 1.0); // half way
  const Eigen::Vector3d centre = Eigen::Vector3d(0, 5, 0) - report.middle;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    Eigen::Array2d lowest = Eigen::Array2d::Constant(1e9);
    Eigen::Array2d highest = -lowest;
    for (std::size_t i = fibres.offsets[f]; i < fibres.offsets[f + 1]; ++i)
    {
      const Eigen::Vector3d p = fibres.points[i] - centre;
      const Eigen::Array2d beside(std::hypot(p.x(), p.z()) - 60.0, p.y());
      lowest = lowest.min(beside);
      highest = highest.max(beside);
    }
    ASSERT_LT((highest - lowest).maxCoeff(), 0.02) << "fibre " << f;
  }
  EXPECT_LE(largestOverlap(fibres), 0.03); // chords of bent fibres
  EXPECT_NEAR(report.fibreVolumeFraction, 0.7, 0.03);
}

TEST(TractFibres, RoundsOffWhatABundleCannotFollow)
{
  TractFibresOptions options = optionsOf(30.0);
  options.bundleDiameter = 8.0;
  options.spacing.minimum = 0.2;
  options.spacing.maximum = 0.2;
  TractFibresReport report;
  const Fibres fibres = layTractFibres(rightAngle(100.0), options, {}, &report);
  EXPECT_GT(report.smoothing, 1.0);
  EXPECT_LT(report.smoothing, 10.0);
  EXPECT_LE(largestOverlap(fibres), 0.03);
  // From leg to leg: fibres begin along x and end along y.
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    const std::size_t first = fibres.offsets[f];
    const std::size_t last = fibres.offsets[f + 1] - 1;
    EXPECT_GT((fibres.points[first + 1] - fibres.points[first]).normalized().x(), 0.98);
    EXPECT_GT((fibres.points[last] - fibres.points[last - 1]).normalized().y(), 0.98);
  }
}

TEST(TractFibres, RoundingOffStopsAtTheRadiusAskedAndHoldsTheEnds)
{
  TractStretch stretch =
    stretchAround(rightAngle(100.0), { 0, 0, Eigen::Vector3d::Zero(), 0.0 }, Eigen::Vector3d::Zero(), 1.0, 60.0, 0.25);
  const TractStretch before = stretch;
  EXPECT_GT(roundOff(stretch, 5.0), 0.0);
  EXPECT_GE(smallestBend(stretch.points), 5.0);
  EXPECT_LT(smallestBend(stretch.points), 8.0);
  EXPECT_EQ(stretch.points.front(), before.points.front());
  EXPECT_EQ(stretch.points.back(), before.points.back());
  TractStretch again = stretch;
  EXPECT_EQ(roundOff(again, 5.0), 0.0);
  EXPECT_EQ(again.points, stretch.points);
}

TEST(TractFibres, RadiiAreThoseAskedFor)
{
  TractFibresOptions options = optionsOf(30.0);
  options.grownFibreVolumeFraction = 0.9;
  std::vector<double> radii = layTractFibres(straightAlong({ 0, 0, 1 }, 200.0), options).targetRadii;
  std::sort(radii.begin(), radii.end());
  const auto count = static_cast<double>(radii.size());
  ASSERT_GT(count, 300.0);
  double distance = 0.0;
  for (std::size_t i = 0; i < radii.size(); ++i)
  {
    const double share = gammaShare(radii[i]);
    distance = std::max({ distance, share - static_cast<double>(i) / count, static_cast<double>(i + 1) / count - share });
  }
  EXPECT_LT(distance * std::sqrt(count), 1.63); // Kolmogorov's distribution at 1 %
}

TEST(TractFibres, ANarrowBundleHasTheDensityAskedForToWithinACircle)
{
  for (const double asked : { 0.3, 0.6 })
  {
    TractFibresOptions options = optionsOf(30.0);
    options.bundleDiameter = 12.0;
    options.fibreVolumeFraction = asked;
    const Fibres fibres = layTractFibres(straightAlong({ 0, 1, 0 }, 200.0), options);
    EXPECT_NEAR(areaOfCircles(fibres), asked * pi * 36.0, 0.5 * pi * 4.0);
    for (const Eigen::Vector3d& point : fibres.points)
    {
      EXPECT_LT(std::hypot(point.x(), point.z()), 8.0);
    }
  }
}

TEST(TractFibres, SeveralStreamlinesFillTheDomainTogether)
{
  Streamlines streamlines;
  for (const Eigen::Vector3d& at :
    { Eigen::Vector3d(100, 0, 0), { 93, 0, 0 }, { 107, 0, 0 }, { 100, 7, 0 }, { 100, -7, 0 }, { 500, 0, 0 } })
  {
    addStreamline(streamlines, { at - Eigen::Vector3d(0, 0, 100), at + Eigen::Vector3d(0, 0, 100) });
  }
  streamlines.bundleIds = { 7, 7, 9, 9, 9, 3 };
  TractFibresOptions options = optionsOf(30.0);
  options.numberOfStreamlines = 0;
  options.middle = TractMiddle::Point;
  options.pointX = 101.0;
  TractFibresReport report;
  Fibres fibres = layTractFibres(streamlines, options, {}, &report);
  EXPECT_EQ(report.streamlines, 5U); // without the one that passes by
  EXPECT_NEAR(report.bundleDiameter, 2.0 * std::sqrt(30.0 * 30.0 / (5.0 * pi)), 1e-6);
  EXPECT_NEAR(areaOfCircles(fibres), 0.7 * 900.0, 0.5 * pi * 4.0); // the missing area of one bundle goes to the next
  std::sort(fibres.bundleIds.begin(), fibres.bundleIds.end());
  EXPECT_EQ(fibres.bundleIds.front(), 7);
  EXPECT_EQ(fibres.bundleIds.back(), 9);
}

TEST(TractFibres, TakesTheStreamlinesSelected)
{
  Streamlines streamlines;
  for (int i = 0; i < 4; ++i)
  {
    addStreamline(streamlines, { { 100.0 * i, 0, -50 }, { 100.0 * i, 0, 70 } });
  }
  streamlines.bundleIds = { 1, 1, 2, 2 };
  TractFibresOptions options;
  const auto middleX = [&] { return chooseStreamlines(streamlines, options, 30.0).middle.x(); };
  EXPECT_EQ(chooseStreamlines(streamlines, options, 30.0).middle, Eigen::Vector3d(100, 0, 10)); // the earlier one of two at the
                                                                                                // same distance
  options.select = StreamlineSelection::Bundle;
  options.bundleId = 2;
  EXPECT_EQ(middleX(), 200.0);
  options.select = StreamlineSelection::Range;
  options.first = 4;
  options.last = 4;
  EXPECT_EQ(middleX(), 300.0);
  options.last = 2147483647;
  EXPECT_EQ(middleX(), 300.0);
  options.select = StreamlineSelection::All;
  options.middle = TractMiddle::Point;
  options.pointX = 10.0;
  options.pointZ = 20.0;
  EXPECT_EQ(chooseStreamlines(streamlines, options, 30.0).middle, Eigen::Vector3d(0, 0, 20));
  options.numberOfStreamlines = 0;
  EXPECT_EQ(chooseStreamlines(streamlines, options, 30.0).places.size(), 1U);
  EXPECT_EQ(chooseStreamlines(streamlines, options, 250.0).places.size(), 3U);
}

TEST(TractFibres, MillimetresOnASmallScaleAreMicrometres)
{
  TractFibresOptions options = optionsOf(12.0);
  const Fibres fibres = layTractFibres(halfCircle(60.0, 200), options);
  options.lengthUnit = TractUnit::Millimetre;
  options.scaleFactor = 0.001;
  const Fibres scaled = layTractFibres(halfCircle(60.0, 200), options);
  EXPECT_EQ(fibres.points, scaled.points);
  options.scaleFactor = 1.0; // true size: nearly straight
  const Fibres straight = layTractFibres(halfCircle(60.0, 200), options);
  EXPECT_LT(meanTangentDispersion(straight), 0.1);
}

TEST(TractFibres, GrowsToItsShareOfTheDomain)
{
  TractFibresOptions options = optionsOf(30.0);
  options.grownFibreVolumeFraction = 0.9;
  EXPECT_NEAR(layTractFibres(straightAlong({ 0, 0, 1 }, 200.0), options).grownFraction, 0.9, 0.04);
  options.bundleDiameter = 10.0;
  EXPECT_NEAR(layTractFibres(straightAlong({ 0, 0, 1 }, 200.0), options).grownFraction, 0.9 * pi * 25.0 / 900.0, 0.005);
}

TEST(TractFibres, SameBitsOnAnyNumberOfThreadsAndForTheSameSeed)
{
  TractFibresOptions options = optionsOf(12.0);
  Context one;
  one.threads = 1;
  Context two;
  two.threads = 2;
  const Fibres fibres = layTractFibres(halfCircle(60.0, 100), options, one);
  EXPECT_EQ(layTractFibres(halfCircle(60.0, 100), options, two).points, fibres.points);
  options.seed = 2;
  EXPECT_NE(layTractFibres(halfCircle(60.0, 100), options, two).points, fibres.points);
}

TEST(TractFibres, CarriesAnEndInTheDomainOnAndSaysSo)
{
  TractFibresReport report;
  const Fibres fibres = layTractFibres(straightAlong({ 0, 0, 1 }, 6.0), optionsOf(12.0), {}, &report);
  EXPECT_EQ(report.ends, 2);
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    EXPECT_LT(fibres.points[fibres.offsets[f]].z(), -6.0);
    EXPECT_GT(fibres.points[fibres.offsets[f + 1] - 1].z(), 6.0);
  }
}

TEST(TractFibres, RefusesWhatIsNoTract)
{
  const TractFibresOptions options = optionsOf(12.0);
  EXPECT_THROW(layTractFibres({}, options), InvalidInput);
  Streamlines point;
  addStreamline(point, { { 1, 2, 3 } });
  EXPECT_THROW(layTractFibres(point, options), InvalidInput);
  Streamlines still;
  addStreamline(still, { { 1, 2, 3 }, { 1, 2, 3 } });
  EXPECT_THROW(layTractFibres(still, options), InvalidInput);
  for (const double bad : { notANumber, std::numeric_limits<double>::infinity(), 1e30 })
  {
    Streamlines streamlines = halfCircle(60.0, 10);
    streamlines.points[4].y() = bad;
    EXPECT_THROW(layTractFibres(streamlines, options), InvalidInput);
  }
  TractFibresOptions none = options;
  none.select = StreamlineSelection::Bundle;
  EXPECT_THROW(layTractFibres(halfCircle(60.0, 10), none), InvalidInput); // no bundles
  none.select = StreamlineSelection::Range;
  none.first = 2;
  none.last = 5;
  EXPECT_THROW(layTractFibres(halfCircle(60.0, 10), none), InvalidInput);
  none.first = 6;
  EXPECT_THROW(none.validate(), InvalidInput);
}

TEST(TractFibres, FollowsAWildStreamlineOrSaysWhyNot)
{
  // There and back on the same path.
  Streamlines hairpin;
  addStreamline(hairpin, { { 0, 0, -80 }, { 0, 0, 10 }, { 0, 0, -80 } });
  EXPECT_THROW(layTractFibres(hairpin, optionsOf(20.0)), Infeasible);
  // A million points that wind closely.
  const Streamlines spring = streamlineAlong(
    [](double t) { return Eigen::Vector3d(3.0 * std::sin(2000.0 * t), 3.0 * std::cos(2000.0 * t), 100.0 * (t - 0.5)); }, 1000000);
  TractFibresReport report;
  const Fibres fibres = layTractFibres(spring, optionsOf(20.0), {}, &report);
  EXPECT_GT(report.smoothing, 0.0);
  EXPECT_NO_THROW(validate(fibres));
  EXPECT_NEAR(report.fibreVolumeFraction, 0.7, 0.05);
}

TEST(TractFibres, BundlesThatOverlapBeyondAllSpaceAreRefused)
{
  Streamlines streamlines;
  for (int i = 0; i < 3; ++i)
  {
    addStreamline(streamlines, { { 0.1 * i, 0, -50 }, { 0.1 * i, 0, 50 } });
  }
  TractFibresOptions options = optionsOf(12.0);
  options.numberOfStreamlines = 0;
  options.bundleDiameter = 30.0;
  EXPECT_THROW(layTractFibres(streamlines, options), Infeasible);
}
