// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/CoherentFlow.h"

#include "base/Constants.h"
#include "base/Error.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <cmath>

using namespace cactus;

namespace
{

using cactus::degree;

Rectangle frameOf(double width, double height)
{
  Rectangle frame;
  frame.lower = Eigen::Vector2d(-0.5 * width, -0.5 * height);
  frame.upper = -frame.lower;
  return frame;
}

/// Points spread evenly at random over a frame.
std::vector<Eigen::Vector2d> pointsIn(const Rectangle& frame, std::size_t count)
{
  RandomEngine engine = randomStream(7, RandomStage::Packing);
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double x = uniform(engine);
    const double y = uniform(engine);
    points.push_back(frame.lower + Eigen::Vector2d(x, y).cwiseProduct(frame.size()));
  }
  return points;
}

CoherentFlow flow(const Rectangle& frame, double length, std::uint64_t seed = 1)
{
  RandomEngine engine = randomStream(seed, RandomStage::Directions);
  return CoherentFlow(frame, length, engine);
}

} // namespace

TEST(CoherentFlow, CarriesPointsAsFarAsAskedAndNotOutOfTheFrame)
{
  const Rectangle frame = frameOf(30.0, 20.0);
  const std::vector<Eigen::Vector2d> start = pointsIn(frame, 500);
  for (const double length : { 4.0, 12.0, 100.0 })
  {
    for (const double asked : { 0.1, 2.0, 5.0 })
    {
      const FlowPaths paths = flow(frame, length).carry(start, 30.0, asked * degree);
      ASSERT_TRUE(paths.isFarEnough);
      EXPECT_EQ(paths.places.front(), start);
      const std::vector<Eigen::Vector2d>& points = paths.places.back();
      double sum = 0.0;
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        sum += std::atan2((points[i] - start[i]).norm(), 30.0) / degree;
        EXPECT_TRUE(frame.holds(points[i], -1e-9)) << points[i].transpose();
      }
      EXPECT_NEAR(sum / 500.0, asked, 1e-4 * asked);
    }
  }
}

TEST(CoherentFlow, KeepsAreas)
{
  const Rectangle frame = frameOf(30.0, 30.0);
  const double h = 1e-4;
  // Around each place four more points, whose distances before and after give the map's derivative.
  std::vector<Eigen::Vector2d> points;
  for (const Eigen::Vector2d& place : pointsIn(frameOf(28.0, 28.0), 200))
  {
    for (const Eigen::Vector2d& shift :
      { Eigen::Vector2d(h, 0), Eigen::Vector2d(-h, 0), Eigen::Vector2d(0, h), Eigen::Vector2d(0, -h) })
    {
      points.push_back(place + shift);
    }
  }
  double largestStretch = 0.0;
  const FlowPaths paths = flow(frame, 12.0).carry(points, 30.0, 8.0 * degree);
  ASSERT_TRUE(paths.isFarEnough);
  for (const double share : { 0.0, 0.25, 0.4, 0.5, 0.77, 1.0 })
  {
    for (std::size_t i = 0; i < points.size(); i += 4)
    {
      const auto at = [&](std::size_t point) -> Eigen::Vector2d
      { return (1.0 - share) * points[point] + share * paths.places.back()[point] + paths.bend(point, share); };
      Eigen::Matrix2d derivative;
      derivative.col(0) = (at(i) - at(i + 1)) / (2.0 * h);
      derivative.col(1) = (at(i + 2) - at(i + 3)) / (2.0 * h);
      EXPECT_NEAR(derivative.determinant(), 1.0, 2e-3) << share;
      largestStretch = std::max(largestStretch, derivative.col(0).norm());
    }
  }
  EXPECT_GT(largestStretch, 1.3); // it is no rigid motion
}

TEST(CoherentFlow, ShiftsNeighboursAlikeAndStrangersNot)
{
  const Rectangle frame = frameOf(100.0, 100.0);
  const double length = 10.0;
  double near = 0.0;
  double far = 0.0;
  std::size_t nearCount = 0;
  std::size_t farCount = 0;
  double square = 0.0;
  for (const std::uint64_t seed : { 1, 2, 3 })
  {
    const std::vector<Eigen::Vector2d> start = pointsIn(frame, 1500);
    const FlowPaths paths = flow(frame, length, seed).carry(start, 100.0, 0.5 * degree);
    ASSERT_TRUE(paths.isFarEnough);
    const std::vector<Eigen::Vector2d>& points = paths.places.back();
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const Eigen::Vector2d one = points[i] - start[i];
      square += one.squaredNorm();
      for (std::size_t j = 0; j < i; ++j)
      {
        const double distance = (start[i] - start[j]).norm();
        const double product = one.dot(points[j] - start[j]);
        if (distance < 0.15 * length)
        {
          near += product;
          ++nearCount;
        }
        else if (distance > 2.5 * length)
        {
          far += product;
          ++farCount;
        }
      }
    }
  }
  square /= 4500.0;
  EXPECT_GT(near / double(nearCount), 0.9 * square);
  EXPECT_LT(std::abs(far / double(farCount)), 0.02 * square);
}

TEST(CoherentFlow, SaysWhereItGoesRoundInCircles)
{
  const Rectangle frame = frameOf(30.0, 30.0);
  const std::vector<Eigen::Vector2d> start = pointsIn(frame, 200);
  const FlowPaths paths = flow(frame, 3.0).carry(start, 30.0, 30.0 * degree);
  EXPECT_FALSE(paths.isFarEnough);
  EXPECT_NE(paths.places.back(), start);
}

TEST(CoherentFlow, WaysLeadWhereTheFlowDoes)
{
  const Rectangle frame = frameOf(30.0, 30.0);
  const std::vector<Eigen::Vector2d> start = pointsIn(frame, 200);
  const FlowPaths paths = flow(frame, 8.0).carry(start, 30.0, 5.0 * degree);
  ASSERT_TRUE(paths.isFarEnough);
  const std::vector<Eigen::Vector2d>& ends = paths.places.back();
  double largest = 0.0;
  for (std::size_t k = 0; k < paths.places.size(); ++k)
  {
    const double share = double(k) / double(paths.places.size() - 1);
    for (std::size_t i = 0; i < start.size(); ++i)
    {
      const Eigen::Vector2d straight = (1.0 - share) * start[i] + share * ends[i];
      EXPECT_LT((straight + paths.bend(i, share) - paths.places[k][i]).norm(), 1e-12);
      largest = std::max(largest, paths.bend(i, share).norm());
    }
  }
  EXPECT_GT(largest, 0.2);
  // Between its places: if every other one is left out, the paths still pass through them.
  FlowPaths coarse = paths;
  coarse.places.clear();
  ASSERT_EQ((paths.places.size() - 1) % 2, 0u);
  for (std::size_t k = 0; k < paths.places.size(); k += 2)
  {
    coarse.places.push_back(paths.places[k]);
  }
  for (std::size_t k = 1; k < paths.places.size(); k += 2)
  {
    const double share = double(k) / double(paths.places.size() - 1);
    for (std::size_t i = 0; i < start.size(); ++i)
    {
      EXPECT_LT((coarse.bend(i, share) - paths.bend(i, share)).norm(), 0.05 * largest);
    }
  }
  EXPECT_EQ(FlowPaths().bend(0, 0.5), Eigen::Vector2d::Zero());
}

TEST(CoherentFlow, SameSeedSameBitsOnAnyNumberOfThreads)
{
  const Rectangle frame = frameOf(30.0, 30.0);
  const std::vector<Eigen::Vector2d> start = pointsIn(frame, 1000);
  std::vector<FlowPaths> results;
  for (const int threads : { 1, 2, 4 })
  {
    Context context;
    context.threads = threads;
    results.push_back(flow(frame, 10.0).carry(start, 30.0, 10.0 * degree, context));
    ASSERT_TRUE(results.back().isFarEnough);
    EXPECT_EQ(results.back().places, results.front().places);
  }
  EXPECT_NE(flow(frame, 10.0, 2).carry(start, 30.0, 10.0 * degree).places.back(), results.front().places.back());
}

TEST(CoherentFlow, ALengthThatCannotBeResolvedIsNamed)
{
  for (const double bad : { 0.1, 0.0, -1.0, static_cast<double>(NAN) })
  {
    EXPECT_THROW(flow(frameOf(30.0, 30.0), bad), InvalidInput);
  }
}
