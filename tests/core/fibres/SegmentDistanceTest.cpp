// SPDX-License-Identifier: BSD-3-Clause
#include "fibres/SegmentDistance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace
{

using Eigen::Vector3d;

/// Returns the distance of a point to a segment, for the brute force below.
double pointDistance(const Vector3d& p, const Vector3d& q0, const Vector3d& q1)
{
  const Vector3d d = q1 - q0;
  const double t = std::min(1.0, std::max(0.0, (p - q0).dot(d) / d.squaredNorm()));
  return (q0 + t * d - p).norm();
}

/// Smallest distance by ternary search over one segment: the distance to a convex set is convex along a line.
double bruteForce(const Vector3d& p0, const Vector3d& p1, const Vector3d& q0, const Vector3d& q1)
{
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < 200; ++i)
  {
    const double a = low + (high - low) / 3.0;
    const double b = high - (high - low) / 3.0;
    if (pointDistance(p0 + a * (p1 - p0), q0, q1) < pointDistance(p0 + b * (p1 - p0), q0, q1))
    {
      high = b;
    }
    else
    {
      low = a;
    }
  }
  return pointDistance(p0 + 0.5 * (low + high) * (p1 - p0), q0, q1);
}

Vector3d randomPoint(std::mt19937& engine, double size)
{
  std::uniform_real_distribution<double> uniform(-size, size);
  return { uniform(engine), uniform(engine), uniform(engine) };
}

} // namespace

// Guarantee: closest points are exact also where both parameters end up clamped, which independent clamping gets wrong.
TEST(SegmentDistance, AgreesWithBruteForceMinimisation)
{
  std::mt19937 engine(1);
  int clamped = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const Vector3d p0 = randomPoint(engine, 1.0);
    const Vector3d p1 = p0 + randomPoint(engine, 1.0);
    const Vector3d q0 = randomPoint(engine, 1.0);
    const Vector3d q1 = q0 + randomPoint(engine, 1.0);
    const cactus::SegmentPair pair = cactus::closestPoints(p0, p1, q0, q1);
    ASSERT_NEAR(pair.distance, bruteForce(p0, p1, q0, q1), 1e-9);
    ASSERT_NEAR((p0 + pair.s * (p1 - p0) - q0 - pair.t * (q1 - q0)).norm(), pair.distance, 1e-12);
    clamped += (pair.s == 0.0 || pair.s == 1.0) && (pair.t == 0.0 || pair.t == 1.0) ? 1 : 0;
  }
  EXPECT_GT(clamped, 1000);
}

// Guarantee: parallel and nearly parallel segments are no special case: below 1e-6 rad, where segments count as parallel, the
// distance is off by at most that angle times their length.
TEST(SegmentDistance, ParallelSegments)
{
  std::mt19937 engine(2);
  std::uniform_real_distribution<double> uniform(-2.0, 2.0);
  for (const double skew : { 0.0, 1e-12, 1e-9, 1e-7, 1e-5, 1e-3 })
  {
    for (int i = 0; i < 2000; ++i)
    {
      const Vector3d p0 = randomPoint(engine, 1.0);
      const Vector3d p1 = p0 + randomPoint(engine, 1.0);
      const Vector3d q0 = p0 + uniform(engine) * (p1 - p0) + 0.3 * randomPoint(engine, 1.0);
      const Vector3d q1 = q0 + uniform(engine) * (p1 - p0) + skew * randomPoint(engine, 1.0);
      if ((q1 - q0).norm() < 1e-2 || (p1 - p0).norm() < 1e-2)
      {
        continue;
      }
      ASSERT_NEAR(cactus::closestPoints(p0, p1, q0, q1).distance, bruteForce(p0, p1, q0, q1), 4e-6) << skew;
    }
  }
  // Side by side: the middle of the part they share.
  const cactus::SegmentPair pair = cactus::closestPoints({ 0, 0, 0 }, { 4, 0, 0 }, { 2, 1, 0 }, { 8, 1, 0 });
  EXPECT_DOUBLE_EQ(pair.s, 0.75);
  EXPECT_DOUBLE_EQ(pair.t, 1.0 / 6.0);
}
