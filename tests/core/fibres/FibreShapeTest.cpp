// SPDX-License-Identifier: BSD-3-Clause
#include "fibres/FibreShape.h"

#include "base/Constants.h"

#include <gtest/gtest.h>

#include <cmath>

// A circular arc has the radius it was made with, in multiples of its calibre, and the length of its chords.
TEST(FibreShape, KnowsAnArc)
{
  using cactus::pi;
  cactus::Fibres fibres;
  fibres.addFibre(1, 1, 0.5);
  for (int i = 0; i <= 18; ++i)
  {
    const double angle = pi / 36.0 * i;
    fibres.addPoint({ 6.0 * std::cos(angle), 6.0 * std::sin(angle), 1.0 }, 0.5);
  }
  const cactus::FibreShape shape = cactus::measureShape(fibres);
  EXPECT_NEAR(shape.smallestBendRadius, 12.0, 1e-9);
  EXPECT_NEAR(shape.smallestCurvatureRadius, 6.0, 1e-9);
  EXPECT_NEAR(shape.totalLength, 18 * 12.0 * std::sin(pi / 72.0), 1e-9);
  EXPECT_NEAR(shape.meanDispersion, 0.0, 1e-6);
  // Tangents turn from +45° to −45° off the chord: 22.5° in the mean.
  EXPECT_NEAR(shape.tangentDispersion, 22.5, 0.1);
  EXPECT_EQ(shape.crossingAngle, 0.0);
}

// Straight fibres have no bend; a fold has the sharpest; two bundles cross at the angle between their lines, whichever way they
// run.
TEST(FibreShape, KnowsStraightFibresFoldsAndCrossings)
{
  cactus::Fibres fibres;
  for (int f = 0; f < 2; ++f)
  {
    fibres.addFibre(f + 1, f + 1, 0.5);
    for (int i = 0; i < 4; ++i)
    {
      fibres.addPoint(f == 0 ? Eigen::Vector3d(0, 0, i) : Eigen::Vector3d(0, -std::sqrt(3.0) * i, -1.0 * i), 0.5);
    }
  }
  EXPECT_TRUE(std::isinf(cactus::measureShape(fibres).smallestBendRadius));
  EXPECT_NEAR(cactus::measureShape(fibres).crossingAngle, 60.0, 1e-9);
  fibres.points[2] = { 0.0, 0.0, 0.5 };
  EXPECT_LT(cactus::measureShape(fibres).smallestBendRadius, 1e13);
}

// The distance of two sets of radii: none from itself, however its fibres are ordered; 1 if they do not overlap; and a quarter if
// one fibre of four has changed its place in the order.
TEST(FibreShape, ComparesRadii)
{
  const auto bundle = [](const std::vector<double>& radii)
  {
    cactus::Fibres fibres;
    for (const double radius : radii)
    {
      fibres.addFibre(static_cast<int>(fibres.size()) + 1, 1, radius);
      fibres.addPoint({ 0, 0, 0 }, 0.9 * radius);
      fibres.addPoint({ 0, 0, 1 }, 1.1 * radius);
    }
    return fibres;
  };
  const cactus::Fibres four = bundle({ 0.5, 0.7, 0.7, 1.1 });
  EXPECT_EQ(cactus::radiusDistance(four, bundle({ 1.1, 0.7, 0.5, 0.7 })), 0.0);
  EXPECT_EQ(cactus::radiusDistance(four, bundle({ 2.0, 3.0 })), 1.0);
  EXPECT_EQ(cactus::radiusDistance(four, bundle({ 0.5, 0.7, 0.9, 1.1 })), 0.25);
}

// Lengths along an arc, and tangents halfway between its chords; where a line turns back on itself, along the way that follows.
TEST(FibreShape, LengthsAndTangentsAlongAFibre)
{
  using cactus::pi;
  cactus::Fibres fibres;
  fibres.addFibre(1, 1, 0.5);
  fibres.addPoint({ 0.0, 0.0, 0.0 }, 0.5);
  fibres.addPoint({ 0.0, 0.0, 3.0 }, 0.5);
  fibres.addPoint({ 0.0, 0.0, 1.0 }, 0.5);
  fibres.addFibre(2, 1, 0.5);
  for (int i = 0; i <= 18; ++i)
  {
    const double angle = pi / 36.0 * i;
    fibres.addPoint({ 6.0 * std::cos(angle), 6.0 * std::sin(angle), 1.0 }, 0.5);
  }
  EXPECT_EQ(cactus::arcLengths(fibres, 0), (std::vector<double>{ 0.0, 3.0, 5.0 }));
  const std::vector<Eigen::Vector3d> fold = cactus::unitTangents(fibres, 0);
  EXPECT_EQ(fold[0], Eigen::Vector3d(0.0, 0.0, 1.0));
  EXPECT_EQ(fold[1], Eigen::Vector3d(0.0, 0.0, -1.0));
  EXPECT_EQ(fold[2], Eigen::Vector3d(0.0, 0.0, -1.0));

  const std::vector<double> lengths = cactus::arcLengths(fibres, 1);
  const std::vector<Eigen::Vector3d> tangents = cactus::unitTangents(fibres, 1);
  ASSERT_EQ(lengths.size(), 19U);
  ASSERT_EQ(tangents.size(), 19U);
  for (int i = 1; i < 18; ++i)
  {
    const double angle = pi / 36.0 * i;
    EXPECT_NEAR(lengths[std::size_t(i)], i * 12.0 * std::sin(pi / 72.0), 1e-9);
    EXPECT_LT((tangents[std::size_t(i)] - Eigen::Vector3d(-std::sin(angle), std::cos(angle), 0.0)).norm(), 1e-9);
  }
}
