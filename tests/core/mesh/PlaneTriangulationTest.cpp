// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/PlaneTriangulation.h"

#include "base/Error.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <utility>

namespace
{

using cactus::PlaneTriangulation;
using Eigen::Vector2d;

/// The inserted points, by their numbers, and edges.
struct Plane
{
  Plane(const Vector2d& lower, const Vector2d& upper)
    : Triangles(lower, upper)
    , Points{ lower, { upper[0], lower[1] }, upper, { lower[0], upper[1] } }
  {
  }

  std::int32_t insert(const Vector2d& point)
  {
    const std::int32_t number = this->Triangles.insert(point);
    if (std::size_t(number) == this->Points.size())
    {
      this->Points.push_back(point);
    }
    return number;
  }

  double area(const std::array<std::int32_t, 3>& t) const
  {
    const Vector2d ab = this->at(t[1]) - this->at(t[0]);
    const Vector2d ac = this->at(t[2]) - this->at(t[0]);
    return 0.5 * (ab[0] * ac[1] - ab[1] * ac[0]);
  }

  const Vector2d& at(std::int32_t point) const { return this->Points[std::size_t(point)]; }

  /// Expects triangles that fill the rectangle once, by area and by Euler's formula, with each edge in both senses except on the
  /// border.
  void expectFills() const
  {
    double sum = 0.0;
    std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
    std::set<std::int32_t> used;
    for (const auto& t : this->Triangles.triangles())
    {
      EXPECT_GT(this->area(t), 0.0);
      sum += this->area(t);
      for (std::size_t i = 0; i < 3; ++i)
      {
        ++edges[{ t[i], t[(i + 1) % 3] }];
        used.insert(t[i]);
      }
    }
    std::size_t border = 0;
    for (const auto& [edge, count] : edges)
    {
      EXPECT_EQ(count, 1);
      border += edges.count({ edge.second, edge.first }) == 0 ? 1 : 0;
    }
    const Vector2d size = this->at(2) - this->at(0);
    EXPECT_NEAR(sum, size[0] * size[1], 1e-9 * size[0] * size[1]);
    EXPECT_EQ(used.size(), this->Points.size());
    EXPECT_EQ(this->Triangles.triangles().size(), 2 * this->Points.size() - 2 - border);
  }

  bool hasEdge(std::int32_t from, std::int32_t to) const
  {
    return std::any_of(this->Triangles.triangles().begin(), this->Triangles.triangles().end(),
      [&](const auto& t) { return std::count(t.begin(), t.end(), from) + std::count(t.begin(), t.end(), to) == 2; });
  }

  /// Returns the number of points that lie in the circle around a triangle, over all triangles.
  std::size_t pointsInCircles() const
  {
    std::size_t count = 0;
    for (const auto& t : this->Triangles.triangles())
    {
      Eigen::Matrix2d twice;
      twice << 2.0 * (this->at(t[1]) - this->at(t[0])).transpose(), 2.0 * (this->at(t[2]) - this->at(t[0])).transpose();
      const Vector2d squares((this->at(t[1]) - this->at(t[0])).squaredNorm(), (this->at(t[2]) - this->at(t[0])).squaredNorm());
      const Vector2d centre = twice.inverse() * squares;
      for (const Vector2d& point : this->Points)
      {
        count += (point - this->at(t[0]) - centre).norm() < centre.norm() * (1.0 - 1e-9) ? 1 : 0;
      }
    }
    return count;
  }

  PlaneTriangulation Triangles;
  std::vector<Vector2d> Points;
};

TEST(PlaneTriangulation, RandomPointsAreDelaunayByBruteForce)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> along(0.0, 1.0);
  Plane plane({ -3.0, 1.0 }, { 2.0, 4.0 });
  for (int i = 0; i < 300; ++i)
  {
    plane.insert({ -3.0 + 5.0 * along(random), 1.0 + 3.0 * along(random) });
  }
  plane.expectFills();
  EXPECT_EQ(plane.pointsInCircles(), 0u);
}

TEST(PlaneTriangulation, GridsWhereEverythingLiesOnLinesAndCircles)
{
  Plane plane({ 0.0, 0.0 }, { 12.0, 12.0 });
  for (int i = 0; i <= 12; ++i)
  {
    for (int j = 0; j <= 12; ++j)
    {
      plane.insert({ double(5 * i % 13), double(7 * j % 13) });
    }
  }
  EXPECT_EQ(plane.Points.size(), 169u); // corners come twice
  plane.expectFills();
  plane.Triangles.insertEdge(plane.insert({ 1.0, 2.0 }), plane.insert({ 12.0, 3.0 }));
  plane.expectFills();
  EXPECT_TRUE(plane.hasEdge(plane.insert({ 1.0, 2.0 }), plane.insert({ 12.0, 3.0 })));
}

TEST(PlaneTriangulation, EdgesThatHaveToBeThereAre)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> along(0.0, 1.0);
  Plane plane({ 0.0, 0.0 }, { 10.0, 10.0 });
  // Rings within rings, and a chain from side to side, among scattered points; a ring's corners come in a mixed order.
  std::vector<std::vector<std::int32_t>> chains;
  for (const double radius : { 1.0, 1.02, 3.0, 4.4 })
  {
    std::vector<std::int32_t> ring(40);
    for (int i = 0; i < 40; ++i)
    {
      const int k = 7 * i % 40;
      const double wave = radius + 0.01 * std::sin(9.0 * k);
      ring[std::size_t(k)] = plane.insert({ 5.0 + wave * std::cos(0.05 * M_PI * k), 5.0 + wave * std::sin(0.05 * M_PI * k) });
    }
    ring.push_back(ring.front());
    chains.push_back(ring);
  }
  chains.push_back({ plane.insert({ 0.0, 0.2 }), plane.insert({ 4.0, 0.11 }), plane.insert({ 10.0, 0.3 }) });
  for (int i = 0; i < 500; ++i)
  {
    plane.insert({ 10.0 * along(random), 10.0 * along(random) });
  }
  for (const auto& chain : chains)
  {
    for (std::size_t i = 1; i < chain.size(); ++i)
    {
      plane.Triangles.insertEdge(chain[i - 1], chain[i]);
    }
  }
  plane.expectFills();
  for (const auto& chain : chains)
  {
    for (std::size_t i = 1; i < chain.size(); ++i)
    {
      EXPECT_TRUE(plane.hasEdge(chain[i - 1], chain[i]));
    }
  }
}

TEST(PlaneTriangulation, WhatCannotBeIsRefused)
{
  Plane plane({ 0.0, 0.0 }, { 4.0, 4.0 });
  const std::int32_t left = plane.insert({ 1.0, 2.0 });
  const std::int32_t right = plane.insert({ 3.0, 2.0 });
  const std::int32_t low = plane.insert({ 2.0, 1.0 });
  const std::int32_t high = plane.insert({ 2.0, 3.0 });
  plane.Triangles.insertEdge(left, right);
  EXPECT_THROW(plane.Triangles.insertEdge(low, high), cactus::InvalidInput);
  plane.insert({ 2.5, 1.5 });
  EXPECT_THROW(plane.Triangles.insertEdge(low, right), cactus::InvalidInput);
  EXPECT_THROW(plane.insert({ 4.5, 1.0 }), cactus::InvalidInput);
}

} // namespace
