// SPDX-License-Identifier: BSD-3-Clause
#include "growth/Calibre.h"

#include "base/Error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using cactus::Calibre;

/// Returns the fraction at this place alone, without cached values.
double fractionAt(const Calibre& calibre, int fibreId, double length)
{
  return cactus::FibreCalibre(calibre, fibreId).fraction(length);
}

// Guarantee: the fraction stays between the smallest one and 1, and comes near both along a fibre.
TEST(Calibre, FillsTheRangeAskedFor)
{
  const Calibre calibre({ 0.4, 1 });
  EXPECT_DOUBLE_EQ(calibre.smallestFraction(), 0.6);
  double least = 1.0;
  double most = 0.0;
  for (int n = 0; n < 20000; ++n)
  {
    const double fraction = fractionAt(calibre, 3, 0.1 * n);
    least = std::min(least, fraction);
    most = std::max(most, fraction);
  }
  EXPECT_GE(least, calibre.smallestFraction());
  EXPECT_LE(most, 1.0);
  EXPECT_LT(least, 0.65);
  EXPECT_GT(most, 0.95);
}

// Guarantee: a fibre's calibre depends on seed and id alone, and other seeds and ids have others.
TEST(Calibre, DependsOnSeedAndFibre)
{
  const Calibre calibre({ 0.4, 1 });
  EXPECT_EQ(fractionAt(calibre, 3, 7.7), fractionAt(Calibre({ 0.4, 1 }), 3, 7.7));
  EXPECT_NE(fractionAt(calibre, 3, 7.7), fractionAt(Calibre({ 0.4, 2 }), 3, 7.7));
  EXPECT_NE(fractionAt(calibre, 3, 7.7), fractionAt(calibre, 4, 7.7));
}

// Guarantee: values cached between lengths change no bit: in steps along a fibre, onto and across knots, to the same length
// again, back, and far away.
TEST(Calibre, IsTheSameAlongAFibreAsAtOnePlace)
{
  const Calibre calibre({ 0.4, 1 });
  cactus::FibreCalibre along(calibre, 3);
  double length = 0.0;
  for (const double step :
    { 0.0, 0.7, 0.7, 0.0, 0.6, 1.9, 2.0, 2.1, 0.3, 4.0, 0.5, -0.5, -2.0, -1.7, 0.1, 40.0, -43.0, 3e10, 1.0 })
  {
    length += step;
    EXPECT_EQ(along.fraction(length), fractionAt(calibre, 3, length)) << length;
  }
}

// Guarantee: between the places where the radius is evaluated, it hardly differs from a straight line.
TEST(Calibre, IsNearlyLinearAlongAPiece)
{
  const Calibre calibre({ 0.4, 1 });
  const double piece = calibre.longestPiece();
  for (int n = 0; n < 1000; ++n)
  {
    const double start = 0.37 * n;
    const double middle = 0.5 * (fractionAt(calibre, 1, start) + fractionAt(calibre, 1, start + piece));
    EXPECT_NEAR(fractionAt(calibre, 1, start + 0.5 * piece), middle, 0.1 * 0.4);
  }
}

TEST(Calibre, IsEvenWithoutRoughness)
{
  const Calibre calibre({ 0.0, 1 });
  EXPECT_FALSE(calibre.varies());
  EXPECT_EQ(fractionAt(calibre, 1, 2.3), 1.0);
  EXPECT_EQ(calibre.smallestFraction(), 1.0);
  EXPECT_EQ(calibre.longestPiece(), std::numeric_limits<double>::infinity());
}

TEST(Calibre, RefusesRoughnessOutOfRange)
{
  EXPECT_THROW(Calibre({ -0.1, 1 }), cactus::InvalidInput);
  EXPECT_THROW(Calibre({ 0.6, 1 }), cactus::InvalidInput);
  EXPECT_THROW(Calibre({ std::nan(""), 1 }), cactus::InvalidInput);
}
