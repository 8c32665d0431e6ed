// SPDX-License-Identifier: BSD-3-Clause
// Guarantees: the triangles of a polygon fill it, without gaps or overlaps, however it winds; an invalid polygon has none.
#include "mesh/PolygonTriangulation.h"
#include "base/Constants.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

namespace
{

using namespace cactus;
using Eigen::Vector2d;

double area(const Vector2d& a, const Vector2d& b, const Vector2d& c)
{
  return 0.5 * ((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x());
}

void expectFilled(const std::vector<Vector2d>& polygon)
{
  const auto triangles = trianglesOf(polygon);
  const auto count = static_cast<std::int32_t>(polygon.size());
  ASSERT_EQ(triangles.size(), polygon.size() - 2);
  double whole = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    whole += area(Vector2d::Zero(), polygon[i], polygon[(i + 1) % polygon.size()]);
  }
  double sum = 0.0;
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  for (const auto& t : triangles)
  {
    const double part = area(polygon[std::size_t(t[0])], polygon[std::size_t(t[1])], polygon[std::size_t(t[2])]);
    EXPECT_GT(part, 0.0);
    sum += part;
    for (std::size_t i = 0; i < 3; ++i)
    {
      EXPECT_TRUE(edges.insert({ t[i], t[(i + 1) % 3] }).second);
    }
  }
  EXPECT_NEAR(sum, whole, 1e-12 * whole);
  for (const auto& [from, to] : edges)
  {
    EXPECT_EQ(edges.count({ to, from }), (from + 1) % count == to ? 0u : 1u);
  }
}

TEST(PolygonTriangulation, FillsPolygonsOfAnyShape)
{
  expectFilled({ { 0.0, 0.0 }, { 1.0, 0.0 }, { 0.0, 1.0 } });
  expectFilled({ { 0.0, 0.0 }, { 3.0, 0.0 }, { 3.0, 1.0 }, { 1.0, 1.0 }, { 1.0, 3.0 }, { 0.0, 3.0 } });
  // With points in the middle of straight sides.
  expectFilled({ { 0.0, 0.0 }, { 1.0, 0.0 }, { 2.0, 0.0 }, { 2.0, 2.0 }, { 1.0, 2.0 }, { 0.0, 2.0 } });
  for (const double depth : { 0.0, 0.3, 0.9 })
  {
    std::vector<Vector2d> star;
    for (int i = 0; i < 61; ++i)
    {
      const double angle = 2.0 * pi * i / 61;
      const double radius = 1.0 - depth * std::pow(std::sin(3.5 * angle), 2);
      star.emplace_back(5.0 + radius * std::cos(angle), radius * std::sin(angle) - 7.0);
    }
    expectFilled(star);
  }
}

TEST(PolygonTriangulation, GivesNothingForWhatIsNoPolygon)
{
  EXPECT_TRUE(trianglesOf({}).empty());
  EXPECT_TRUE(trianglesOf({ { 0.0, 0.0 }, { 1.0, 0.0 } }).empty());
  // Sides that cross, a corner twice, and one on another side.
  EXPECT_TRUE(trianglesOf({ { 0.0, 0.0 }, { 1.0, 1.0 }, { 1.0, 0.0 }, { 0.0, 1.0 } }).empty());
  EXPECT_TRUE(trianglesOf({ { 0.0, 0.0 }, { 2.0, 0.0 }, { 1.0, 1.0 }, { 2.0, 2.0 }, { 0.0, 2.0 }, { 1.0, 1.0 } }).empty());
  EXPECT_TRUE(trianglesOf({ { 0.0, 0.0 }, { 4.0, 0.0 }, { 4.0, 2.0 }, { 2.0, 0.0 }, { 0.0, 2.0 } }).empty());
}

} // namespace
