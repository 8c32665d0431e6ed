// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/WaveField.h"

#include "base/Random.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace cactus;

namespace
{

WaveField drawn(double period, double length, std::uint64_t seed = 1)
{
  RandomEngine engine = randomStream(seed, RandomStage::Directions);
  return WaveField(period, length, { 0.25, 0.04 }, engine);
}

constexpr double period = 30.0;

/// Calls visit(point) at the points of a grid over one period, fine enough for sums over it to be integrals.
template <typename Visit>
void overPeriod(Visit&& visit)
{
  constexpr int side = 64;
  for (int i = 0; i < side * side; ++i)
  {
    visit(Eigen::Vector2d(period * (i % side) / side, period * (i / side) / side));
  }
}

} // namespace

TEST(WaveField, HasItsMeanSquaresOnEveryPlane)
{
  for (const double length : { 3.0, 8.0 })
  {
    const WaveField field = drawn(period, length);
    for (const double z : { -12.0, 0.0, 31.0 })
    {
      const WaveField::Plane plane = field.plane(z);
      WaveField::Work work;
      double stream = 0.0;
      Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
      overPeriod(
        [&](const Eigen::Vector2d& point)
        {
          const WaveField::Value value = field.at(point, plane, work);
          stream += value.stream * value.stream / 4096.0;
          squares += value.curl * value.curl.transpose() / 4096.0;
        });
      EXPECT_NEAR(stream, 1.0, 1e-9);
      EXPECT_TRUE(squares.isApprox(Eigen::Matrix2d::Identity(), 1e-9)) << squares;
    }
  }
}

TEST(WaveField, TheCurlIsThatOfTheStreamFunction)
{
  const WaveField field = drawn(period, 6.0);
  const WaveField::Plane plane = field.plane(4.0);
  WaveField::Work work;
  constexpr double step = 1e-4;
  const auto stream = [&](double x, double y) { return field.at({ x, y }, plane, work).stream; };
  double factor = 0.0; // the stream function is given over its deviation
  for (const Eigen::Vector2d& p : { Eigen::Vector2d(1.0, 2.0), Eigen::Vector2d(-17.0, 8.5), Eigen::Vector2d(40.0, -3.0) })
  {
    const Eigen::Vector2d curl = field.at(p, plane, work).curl;
    const Eigen::Vector2d found(
      stream(p.x(), p.y() + step) - stream(p.x(), p.y() - step), stream(p.x() - step, p.y()) - stream(p.x() + step, p.y()));
    factor = factor == 0.0 ? curl.norm() / found.norm() : factor;
    EXPECT_TRUE((factor * found).isApprox(curl, 1e-6)) << curl;
  }
}

TEST(WaveField, ATableGivesTheSame)
{
  constexpr double wide = 220.0;
  const WaveField field = drawn(wide, 6.0);
  ASSERT_TRUE(field.needsTable(2000));
  EXPECT_FALSE(field.needsTable(50));
  EXPECT_FALSE(drawn(period, 6.0).needsTable(1000000));
  WaveField::Plane plane = field.plane(4.0);
  const WaveField::Plane whole = plane;
  field.tabulate(plane, {});
  WaveField::Work work;
  RandomEngine engine = randomStream(3, RandomStage::Directions);
  double factor = 0.0; // the stream function is given over its deviation
  for (int i = 0; i < 2000; ++i)
  {
    const Eigen::Vector2d point(wide * (4.0 * uniform(engine) - 2.0), wide * (4.0 * uniform(engine) - 2.0));
    const WaveField::Value value = field.at(point, plane, work);
    const WaveField::Value expected = field.at(point, whole, work);
    ASSERT_NEAR(value.stream, expected.stream, 1e-4) << point;
    ASSERT_LT((value.curl - expected.curl).norm(), 1e-3) << point;
    // The table's own curl is that of its stream, so that the flow preserves areas, except across a place of the table.
    constexpr double step = 1e-4;
    const auto stream = [&](double x, double y) { return field.at(point + Eigen::Vector2d(x, y), plane, work).stream; };
    const Eigen::Vector2d found(stream(0.0, step) - stream(0.0, -step), stream(-step, 0.0) - stream(step, 0.0));
    factor = factor == 0.0 ? value.curl.norm() / found.norm() : factor;
    ASSERT_LT((factor * found - value.curl).norm(), 1e-3) << point;
  }
  // Where one period ends and the next begins, too.
  for (const double y : { -1e-12, 0.0, 1e-12, wide, -wide, 3.0 * wide - 1e-12 })
  {
    const WaveField::Value value = field.at({ 1.0, y }, plane, work);
    EXPECT_NEAR(value.stream, field.at({ 1.0, 0.0 }, whole, work).stream, 1e-6) << y;
  }
}

TEST(WaveField, IsCorrelatedOverItsLength)
{
  constexpr double length = 4.0;
  const WaveField field = drawn(period, length);
  const WaveField::Plane plane = field.plane(0.0);
  WaveField::Work work;
  for (const double distance : { 1.0, 3.0, 6.0 })
  {
    double product = 0.0;
    overPeriod(
      [&](const Eigen::Vector2d& p)
      {
        const double here = field.at(p, plane, work).stream;
        product += here * field.at(p + Eigen::Vector2d(distance, 0.0), plane, work).stream / 8192.0;
        product += here * field.at(p + Eigen::Vector2d(0.0, distance), plane, work).stream / 8192.0;
      });
    // Waves that are longer than the period are missing.
    EXPECT_NEAR(product, std::exp(-distance * distance / (length * length)), 0.06) << distance;
  }
}
