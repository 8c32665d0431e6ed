// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/StationaryFlow.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "bundle/DirectionDistribution.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <cmath>
#include <vector>

using namespace cactus;

namespace
{

using cactus::degree;

BundleInitializerOptions asked(double side, double angle, double sinuosity, std::uint64_t seed = 1)
{
  BundleInitializerOptions options;
  options.side = side;
  options.meanDispersion = angle;
  options.sinuosity = sinuosity;
  options.seed = seed;
  return options;
}

Context onThreads(int threads)
{
  Context context;
  context.threads = threads;
  return context;
}

std::vector<Eigen::Vector2d> gridOf(double side, int count)
{
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < count * count; ++i)
  {
    points.emplace_back(side * ((i % count + 0.5) / count - 0.5), side * ((i / count + 0.5) / count - 0.5));
  }
  return points;
}

/// The angles of all steps of paths to the axis, and how they turn around it.
struct Found
{
  std::vector<double> angles;
  std::vector<double> ends; ///< angles from end to end
  double meanAngle = 0.0;   ///< degrees
  double twist = 0.0;
  double sinuosity = 0.0;
};

Found follow(const StationaryFlow& flow, double side)
{
  const std::vector<Eigen::Vector2d> start = gridOf(side, 30);
  const FlowPaths paths = flow.carry(start, side, {});
  const double step = side / static_cast<double>(paths.places.size() - 1);
  Found found;
  double turned = 0.0;
  double most = 0.0;
  for (std::size_t p = 0; p < start.size(); ++p)
  {
    double length = 0.0;
    for (std::size_t k = 0; k + 1 < paths.places.size(); ++k)
    {
      const Eigen::Vector2d shift = paths.places[k + 1][p] - paths.places[k][p];
      length += std::hypot(shift.norm(), step);
      found.angles.push_back(std::atan2(shift.norm(), step));
      found.meanAngle += found.angles.back() / degree;
      const Eigen::Vector2d place = paths.places[k][p];
      if (place.cwiseAbs().maxCoeff() <= 0.5 * side)
      {
        turned += place.x() * shift.y() - place.y() * shift.x();
        most += place.norm() * shift.norm();
      }
    }
    const double shift = (paths.places.back()[p] - paths.places.front()[p]).norm();
    found.ends.push_back(std::atan2(shift, side));
    found.sinuosity += length / std::hypot(shift, side) / 900.0;
  }
  found.meanAngle /= static_cast<double>(found.angles.size());
  found.twist = turned / most;
  return found;
}

} // namespace

TEST(StationaryFlow, HasTheAnglesOfWatsonAroundNoAxis)
{
  for (const double angle : { 5.0, 20.0 })
  {
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
    {
      const StationaryFlow flow = StationaryFlow::draw(asked(30.0, angle, 1.0, seed), {});
      EXPECT_NEAR(flow.report().meanAngle, angle, 1e-6);
      const Found found = follow(flow, 30.0);
      EXPECT_NEAR(found.meanAngle, angle, 0.05 * angle);
      EXPECT_LT(distanceToWatson(found.angles), 0.08) << angle << " " << seed;
      EXPECT_LT(distanceToWatson(found.ends), 0.07) << angle << " " << seed;
      EXPECT_LT(std::abs(found.twist), 0.1) << angle << " " << seed;
    }
  }
}

TEST(StationaryFlow, UndulatesAsMuchAsAskedFor)
{
  for (const double sinuosity : { 1.01, 1.03, 1.1 })
  {
    const StationaryFlow flow = StationaryFlow::draw(asked(30.0, 5.0, sinuosity), {});
    EXPECT_NEAR(flow.report().sinuosity, sinuosity, 3e-4);
    EXPECT_NEAR(follow(flow, 25.0).sinuosity, sinuosity, 0.05 * (sinuosity - 1.0) + 2e-4);
    EXPECT_NEAR(follow(flow, 30.0).sinuosity, sinuosity, 0.15 * (sinuosity - 1.0));
  }
  // Fibres that have to wind more tell so.
  EXPECT_GT(StationaryFlow::draw(asked(30.0, 25.0, 1.03), {}).report().sinuosity, 1.05);
}

TEST(StationaryFlow, KeepsAreasAndBits)
{
  const StationaryFlow flow = StationaryFlow::draw(asked(20.0, 10.0, 1.03), onThreads(1));
  constexpr double step = 1e-4;
  std::vector<Eigen::Vector2d> points;
  for (const Eigen::Vector2d& point : gridOf(20.0, 6))
  {
    points.insert(points.end(), { point, point + Eigen::Vector2d(step, 0.0), point + Eigen::Vector2d(0.0, step) });
  }
  const FlowPaths paths = flow.carry(points, 24.0, onThreads(1));
  for (std::size_t p = 0; p < points.size(); p += 3)
  {
    const std::vector<Eigen::Vector2d>& top = paths.places.back();
    Eigen::Matrix2d change;
    change << top[p + 1] - top[p], top[p + 2] - top[p];
    EXPECT_NEAR(change.determinant() / (step * step), 1.0, 1e-3);
  }
  EXPECT_EQ(StationaryFlow::draw(asked(20.0, 10.0, 1.03), onThreads(3)).carry(points, 24.0, onThreads(2)).places, paths.places);
}

TEST(StationaryFlow, IsTheSameTissueInDomainsOfAnySize)
{
  // How much the directions of points 4 µm apart differ, relative to their own.
  const auto unlikeness = [](double side)
  {
    double sum = 0.0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed)
    {
      const StationaryFlow flow = StationaryFlow::draw(asked(side, 5.0, 1.0, seed), {});
      const std::vector<Eigen::Vector2d> here = gridOf(side, 12);
      std::vector<Eigen::Vector2d> both = here;
      for (const Eigen::Vector2d& point : here)
      {
        both.push_back(point + Eigen::Vector2d(4.0, 0.0));
      }
      const FlowPaths paths = flow.carry(both, 2.0, {});
      double differences = 0.0;
      double own = 0.0;
      for (std::size_t i = 0; i < here.size(); ++i)
      {
        const Eigen::Vector2d one = paths.places.back()[i] - paths.places.front()[i];
        const Eigen::Vector2d other = paths.places.back()[i + here.size()] - paths.places.front()[i + here.size()];
        differences += (one - other).squaredNorm();
        own += one.squaredNorm() + other.squaredNorm();
      }
      sum += differences / own / 4.0;
    }
    return sum;
  };
  const double small = unlikeness(25.0);
  EXPECT_NEAR(unlikeness(100.0), small, 0.15 * small);
}

TEST(StationaryFlow, RefusesALengthThatItCannotResolve)
{
  BundleInitializerOptions options = asked(200.0, 5.0, 1.03);
  options.correlationLength = 1.0;
  try
  {
    StationaryFlow::draw(options, {});
    FAIL();
  }
  catch (const InvalidInput& error)
  {
    EXPECT_NE(std::string(error.what()).find("CorrelationLength is 1 µm: give at least"), std::string::npos) << error.what();
  }
}
