// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SurfaceDistance.h"

#include "ExampleSurfaces.h"
#include "TriangleGap.h"
#include "mesh/SurfaceIntersection.h"
#include "mesh/TriangleIntersection.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace
{

using Eigen::Vector3d;
using Triangle = std::array<Vector3d, 3>;
using example::both;
using example::tube;

Triangle pointsOf(const cactus::TriangleMesh& mesh, std::size_t t)
{
  const auto& i = mesh.triangles[t];
  return { { mesh.points[std::size_t(i[0])], mesh.points[std::size_t(i[1])], mesh.points[std::size_t(i[2])] } };
}

void expectOn(const Vector3d& point, const Triangle& t)
{
  Eigen::Matrix3d basis;
  const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
  basis << t[1] - t[0], t[2] - t[0], normal;
  const Vector3d weights = basis.inverse() * (point - t[0]);
  const double tolerance = 1e-9;
  EXPECT_GE(weights[0], -tolerance);
  EXPECT_GE(weights[1], -tolerance);
  EXPECT_LE(weights[0] + weights[1], 1.0 + tolerance);
  EXPECT_NEAR(weights[2], 0.0, tolerance);
}

/// Two points of two convex sets are the nearest ones if neither set reaches into the slab between them.
void expectNearest(const cactus::SurfaceGap& gap, const Triangle& a, const Triangle& b)
{
  ASSERT_TRUE(gap.found());
  expectOn(gap.pointA, a);
  expectOn(gap.pointB, b);
  const Vector3d across = (gap.pointB - gap.pointA).normalized();
  EXPECT_NEAR((gap.pointB - gap.pointA).norm(), gap.distance, 1e-12);
  for (std::size_t i = 0; i < 3; ++i)
  {
    EXPECT_LE(across.dot(a[i] - gap.pointA), 1e-9);
    EXPECT_GE(across.dot(b[i] - gap.pointB), -1e-9);
  }
}

} // namespace

// The certificate's smallest gap is the true one: proven for each pair by the slab that separates two convex sets.
TEST(SurfaceDistance, TrianglesAreAsFarApartAsTheSlabBetweenThem)
{
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::size_t meeting = 0;
  for (int trial = 0; trial < 20000; ++trial)
  {
    Triangle a;
    Triangle b;
    const Vector3d shift(trial % 4, 0.5 * (trial % 3), 0.0);
    for (std::size_t i = 0; i < 3; ++i)
    {
      a[i] = { uniform(random), uniform(random), uniform(random) };
      b[i] = shift + Vector3d(uniform(random), uniform(random), uniform(random));
      if (trial % 5 == 0)
      {
        b[i] = a[i] + Vector3d(0.1, 0.2, 0.3); // parallel throughout
      }
      else if (trial % 5 == 1)
      {
        b[i] = a[(i + 1) % 3] + 0.05 * b[i]; // close by
      }
    }
    const auto gap = triangleGap(a, b);
    if (cactus::trianglesMeet(a, b))
    {
      ++meeting;
      EXPECT_EQ(gap.distance, 0.0);
    }
    else
    {
      expectNearest(gap, a, b);
      EXPECT_FALSE(triangleGap(a, b, 0.999 * gap.distance).found());
      EXPECT_EQ(triangleGap(a, b, 1.001 * gap.distance).distance, gap.distance);
    }
    if (HasFailure())
    {
      FAIL() << "trial " << trial;
    }
  }
  EXPECT_GT(meeting, 500U);
  EXPECT_LT(meeting, 10000U);
}

TEST(SurfaceDistance, SmallestGapIsThatOfAllPairs)
{
  for (unsigned seed = 1; seed <= 3; ++seed)
  {
    const auto a = tube(0, 0, 1.0, -2, 2, 16, 12, 0.05, seed);
    const auto b = tube(2.2, 0.1, 1.0, -2, 2, 12, 18, 0.05, seed + 10);
    const cactus::TriangleTree treeA(a);
    const cactus::TriangleTree treeB(b);
    double smallest = std::numeric_limits<double>::infinity();
    const double reach = 0.3;
    std::vector<std::uint32_t> near;
    for (std::size_t s = 0; s < a.triangles.size(); ++s)
    {
      double own = std::numeric_limits<double>::infinity();
      for (std::size_t t = 0; t < b.triangles.size(); ++t)
      {
        own = std::min(own, triangleGap(pointsOf(a, s), pointsOf(b, t)).distance);
      }
      smallest = std::min(smallest, own);
      if (own < reach)
      {
        near.push_back(static_cast<std::uint32_t>(s));
      }
    }
    const auto gap = cactus::smallestGap(treeA, treeB);
    EXPECT_EQ(gap.distance, smallest);
    EXPECT_EQ(triangleGap(pointsOf(a, gap.triangleA), pointsOf(b, gap.triangleB)).distance, smallest);
    EXPECT_EQ(cactus::smallestGap(treeA, treeB, 1.01 * smallest).distance, smallest);
    EXPECT_FALSE(cactus::smallestGap(treeA, treeB, 0.99 * smallest).found());
    EXPECT_EQ(cactus::trianglesNear(treeA, treeB, reach), near);
    EXPECT_FALSE(near.empty());
  }
}

// The trees' planes, which exclude most triangles, exclude no near one: not even for slivers, which hardly have a plane.
TEST(SurfaceDistance, TreesFindWhatTrianglesDo)
{
  std::mt19937 random(8);
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  std::size_t meeting = 0;
  for (int trial = 0; trial < 20000; ++trial)
  {
    std::array<cactus::TriangleMesh, 2> meshes;
    for (cactus::TriangleMesh& mesh : meshes)
    {
      for (int i = 0; i < 3; ++i)
      {
        mesh.points.emplace_back(coordinate(random), coordinate(random), coordinate(random));
      }
      if (trial % 2 == 0)
      {
        const double aside = std::pow(10.0, -4.0 * (trial % 5));
        mesh.points[2] = 0.5 * (mesh.points[0] + mesh.points[1]) + aside * mesh.points[2];
      }
      mesh.triangles = { { { 0, 1, 2 } } };
    }
    const cactus::TriangleTree a(meshes[0]);
    const cactus::TriangleTree b(meshes[1]);
    const double distance = triangleGap(pointsOf(meshes[0], 0), pointsOf(meshes[1], 0)).distance;
    ASSERT_EQ(cactus::smallestGap(a, b).distance, distance) << "trial " << trial;
    ASSERT_EQ(cactus::smallestGap(a, b, 1.0001 * distance + 1e-9).distance, distance) << "trial " << trial;
    ASSERT_EQ(cactus::smallestGap(a, b, 0.9999 * distance).found(), distance == 0.0) << "trial " << trial;
    ASSERT_EQ(cactus::surfacesMeet(a, b), distance == 0.0) << "trial " << trial;
    meeting += distance == 0.0 ? 1 : 0;
  }
  EXPECT_GT(meeting, 500U);
}

TEST(SurfaceDistance, KnowsTubesByFormula)
{
  const auto left = tube(0, 0, 1.0, -2, 2);
  const cactus::TriangleTree tree(left);
  const auto gapTo = [&tree](const cactus::TriangleMesh& other)
  { return cactus::smallestGap(tree, cactus::TriangleTree(other)); };
  EXPECT_NEAR(gapTo(tube(2.02, 0, 1.0, -2, 2)).distance, 0.02, 1e-14);
  EXPECT_NEAR(gapTo(tube(0, 0, 0.7, -1.9, 1.9)).distance, 0.1, 1e-14) << "one inside the other, nearest at the caps";
  EXPECT_EQ(gapTo(tube(2, 0, 1.0, -2, 2)).distance, 0.0) << "touching";
  EXPECT_EQ(gapTo(tube(0.1, 0, 0.05, -9, 9)).distance, 0.0) << "through both caps, far from all corners";
  EXPECT_FALSE(cactus::smallestGap(tree, cactus::TriangleTree(cactus::TriangleMesh())).found());
}
