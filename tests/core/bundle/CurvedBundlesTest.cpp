// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/CurvedBundles.h"

#include "BundleBetweenWalls.h"
#include "FilledThirds.h"
#include "base/Constants.h"
#include "base/Error.h"
#include "bundle/GuideCurves.h"
#include "fibres/SegmentDistance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

using namespace cactus;

namespace
{

CurvedBundlesOptions curved(BundleShape shape)
{
  CurvedBundlesOptions options = ofPipes<CurvedBundlesOptions>();
  options.shape = shape;
  options.side = 12.0;
  options.bendRadius = 18.0;
  options.radius.minimum = 0.4;
  options.radius.maximum = 1.0;
  options.margin = 0.0;
  options.grownFibreVolumeFraction = 0.0; // fibres start with the drawn radii, at which they touch
  return options;
}

/// Returns the angle (degrees) from z to the direction at the end of a curve, positive towards larger x.
double angleAtEnd(const GuideCurve& curve)
{
  const Eigen::Vector2d along = curve.points.back() - curve.points[curve.points.size() - 2];
  return std::atan2(along.x(), along.y()) / degree;
}

/// Returns the smallest distance of points of two curves.
double nearestPoints(const GuideCurve& one, const GuideCurve& other)
{
  double nearest = INFINITY;
  for (const Eigen::Vector2d& point : one.points)
  {
    for (const Eigen::Vector2d& beside : other.points)
    {
      nearest = std::min(nearest, (point - beside).norm());
    }
  }
  return nearest;
}

void expectOnCircle(const GuideCurve& curve, const Eigen::Vector2d& centre, double radius)
{
  ASSERT_GT(curve.points.size(), 2U);
  for (const Eigen::Vector2d& point : curve.points)
  {
    ASSERT_NEAR((point - centre).norm(), radius, 1e-9);
  }
}

/// Returns the largest overlap of any two fibres over the sum of their radii, by all pairs of segments.
double largestOverlapOf(const Fibres& fibres)
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
          const double distance =
            closestPoints(fibres.points[i], fibres.points[i + 1], fibres.points[j], fibres.points[j + 1]).distance;
          largest = std::max(largest, 1.0 - distance / touching);
        }
      }
    }
  }
  return largest;
}

} // namespace

TEST(GuideCurves, ABendIsOfArcsAboutOneAxis)
{
  const CurvedBundlesOptions options = curved(BundleShape::Bend);
  for (const double place : { -7.0, 0.0, 3.0 })
  {
    expectOnCircle(guideCurve(options, place), { 18.0, 0.0 }, 18.0 - place);
  }
  EXPECT_NEAR(nearestPoints(guideCurve(options, -1.0), guideCurve(options, 2.0)), 3.0, 1e-9);
}

TEST(GuideCurves, AFanOpensByItsAngle)
{
  CurvedBundlesOptions options = curved(BundleShape::Fan);
  for (const double angle : { 1.0, 30.0, 60.0, 90.0 })
  {
    options.fanAngle = angle;
    const double edge = 0.5 * options.fanEntry();
    const GuideCurve left = guideCurve(options, -edge);
    const GuideCurve right = guideCurve(options, edge);
    EXPECT_NEAR(angleAtEnd(right) - angleAtEnd(left), angle, 1e-9);
    EXPECT_NEAR(angleAtEnd(guideCurve(options, 0.5 * edge)), 0.25 * angle, 1e-9);
    EXPECT_NEAR(angleAtEnd(guideCurve(options, 1.5 * edge)), 0.5 * angle, 1e-9);
    // The edges leave the domain at its own edges, and came in along z.
    const auto atTop = [&](const GuideCurve& curve) { return curve.points[curve.points.size() - 2]; };
    EXPECT_NEAR((atTop(right) - Eigen::Vector2d(6.0, 6.0)).norm(), 0.0, 1e-9);
    EXPECT_NEAR((atTop(left) - Eigen::Vector2d(-6.0, 6.0)).norm(), 0.0, 1e-9);
    EXPECT_EQ(right.points[0].x(), right.points[1].x());
    EXPECT_NEAR(right.points[1].x(), edge, 1e-12);
  }
}

TEST(GuideCurves, AFanThinsOutWithinItsEdgesAndNowhereElse)
{
  CurvedBundlesOptions options = curved(BundleShape::Fan);
  options.fanAngle = 60.0;
  const double edge = 0.5 * options.fanEntry();
  EXPECT_NEAR(nearestPoints(guideCurve(options, edge + 1.0), guideCurve(options, edge + 2.0)), 1.0, 1e-3); // of points
  const auto atTop = [&](double place) { return guideCurve(options, place).points; };
  const double apart = atTop(0.1)[atTop(0.1).size() - 2].x() - atTop(-0.1)[atTop(-0.1).size() - 2].x();
  EXPECT_GT(apart, 0.2 * 1.5);
}

TEST(GuideCurves, TwoBundlesKissAtTheirDistance)
{
  CurvedBundlesOptions options = curved(BundleShape::Kiss);
  options.kissDistance = 5.0;
  const GuideCurve left = guideCurve(options, -2.5);
  const GuideCurve right = guideCurve(options, 2.5);
  expectOnCircle(left, { -2.5 - 18.0, 0.0 }, 18.0);
  expectOnCircle(right, { 2.5 + 18.0, 0.0 }, 18.0);
  EXPECT_NEAR(nearestPoints(left, right), 5.0, 1e-9);
  EXPECT_NE(left.bundleId, right.bundleId);
  EXPECT_TRUE(guideCurve(options, 5.1).points.empty());
  expectOnCircle(guideCurve(options, 4.0), { 2.5 + 18.0, 0.0 }, 16.5);
  options.kissDistance = 0.0;
  EXPECT_EQ(options.kiss(), 6.0);
}

TEST(CurvedBundles, NoFibreEndsInTheDomain)
{
  for (const BundleShape shape : { BundleShape::Bend, BundleShape::Fan, BundleShape::Kiss })
  {
    for (const double length : { 0.0, 6.0, 30.0 })
    {
      for (const double kissDistance : { 2.2, 5.0, 0.0 })
      {
        CurvedBundlesOptions options = curved(shape);
        options.length = length;
        options.kissDistance = kissDistance;
        options.bendRadius = shape == BundleShape::Kiss ? 4.0 + 0.5 * options.kiss() : 9.0;
        options.fanAngle = 25.0;
        const Fibres fibres = layCurvedBundles(options);
        EXPECT_EQ(fibres.domain.upper, Eigen::Vector3d(6.0, 6.0, length > 0.0 ? 0.5 * length : 6.0));
        for (std::size_t f = 0; f < fibres.size(); ++f)
        {
          EXPECT_LE(fibres.domain.depth(fibres.points[fibres.offsets[f]]), 1e-9);
          EXPECT_LE(fibres.domain.depth(fibres.points[fibres.offsets[f + 1] - 1]), 1e-9);
        }
      }
    }
  }
}

TEST(CurvedBundles, ABoxIsFilledFromEndToEnd)
{
  CurvedBundlesOptions options = curved(BundleShape::Bend);
  options.bendRadius = 30.0;
  options.length = 30.0;
  double filled = 0.0;
  const Fibres fibres = layCurvedBundles(options, {}, &filled);
  EXPECT_NEAR(bundlesShare(options), 1.0, 1e-3);
  EXPECT_NEAR(filled, 0.7, 0.01);
  for (const double filledThird : filledThirds(fibres))
  {
    EXPECT_NEAR(filledThird, 0.7, 0.06);
  }
}

TEST(CurvedBundles, AFanTooWideForItsLengthNamesTheWidestThatWorks)
{
  CurvedBundlesOptions options = curved(BundleShape::Fan);
  options.length = 30.0;
  options.fanAngle = 60.0;
  try
  {
    options.validate();
    FAIL();
  }
  catch (const InvalidInput& error)
  {
    EXPECT_NE(std::string(error.what()).find("give at most 40.8"), std::string::npos) << error.what();
  }
  options.fanAngle = 40.8;
  EXPECT_NO_THROW(options.validate());
}

TEST(CurvedBundles, FibresOfNoShapeOverlap)
{
  for (const BundleShape shape : { BundleShape::Bend, BundleShape::Fan, BundleShape::Kiss })
  {
    const Fibres fibres = layCurvedBundles(curved(shape));
    EXPECT_GT(fibres.size(), 30U);
    EXPECT_LT(largestOverlapOf(fibres), 0.01) << static_cast<int>(shape); // capsules are chords of the arcs
    const std::set<int> bundles(fibres.bundleIds.begin(), fibres.bundleIds.end());
    EXPECT_EQ(bundles.size(), shape == BundleShape::Kiss ? 2U : 1U);
  }
}

TEST(CurvedBundles, ControlPointsOfABendAreOnItsArcs)
{
  const Fibres fibres = layCurvedBundles(curved(BundleShape::Bend));
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    const Eigen::Vector3d& first = fibres.points[fibres.offsets[f]];
    for (std::size_t i = fibres.offsets[f]; i < fibres.offsets[f + 1]; ++i)
    {
      const Eigen::Vector3d& point = fibres.points[i];
      ASSERT_NEAR(std::hypot(point.x() - 18.0, point.z()), std::hypot(first.x() - 18.0, first.z()), 1e-3);
      ASSERT_EQ(point.y(), first.y());
    }
  }
}

TEST(CurvedBundles, ABendFillsTheDomainAndAFanThinsOut)
{
  CurvedBundlesOptions options = curved(BundleShape::Bend);
  options.side = 20.0;
  double filled = 0.0;
  layCurvedBundles(options, {}, &filled);
  EXPECT_NEAR(bundlesShare(options), 1.0, 1e-3);
  EXPECT_NEAR(filled, 0.7, 0.007);
  options.shape = BundleShape::Fan;
  options.fanAngle = 60.0;
  options.grownFibreVolumeFraction = 0.9;
  const Fibres fan = layCurvedBundles(options, {}, &filled);
  EXPECT_LT(bundlesShare(options), 0.9);
  EXPECT_NEAR(filled, 0.7 * bundlesShare(options), 0.007);
  EXPECT_NEAR(fan.grownFraction, filled * 0.9 / 0.7, 1e-12);
  EXPECT_NEAR(capsuleVolumeInDomain(fan) / fan.domain.volume(), filled, 1e-12);
}

TEST(CurvedBundles, ABendTooSharpNamesTheSmallestThatWorks)
{
  CurvedBundlesOptions options = curved(BundleShape::Bend);
  options.bendRadius = 8.9;
  try
  {
    options.validate();
    FAIL();
  }
  catch (const InvalidInput& error)
  {
    EXPECT_NE(std::string(error.what()).find("BendRadius 8.9 µm is too sharp here: give 9 µm or more"), std::string::npos)
      << error.what();
  }
  options.bendRadius = 9.0;
  EXPECT_NO_THROW(options.validate());
  options.shape = BundleShape::Kiss; // has a radius of its own
  options.bendRadius = 4.9;
  EXPECT_THROW(options.validate(), InvalidInput);
  options.bendRadius = 5.1;
  EXPECT_NO_THROW(options.validate());
  options.shape = BundleShape::Fan;
  options.fanAngle = 90.0;
  EXPECT_NO_THROW(options.validate());
  options.margin = 100.0;
  EXPECT_THROW(options.validate(), InvalidInput);
}

TEST(CurvedBundles, DoNotDependOnThreads)
{
  Context one;
  one.threads = 1;
  Context four;
  four.threads = 4;
  CurvedBundlesOptions options = curved(BundleShape::Fan);
  options.calibre.deviation = 0.25;
  options.fibreVolumeFraction = 0.5;
  const Fibres a = layCurvedBundles(options, one);
  const Fibres b = layCurvedBundles(options, four);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.radii, b.radii);
}
