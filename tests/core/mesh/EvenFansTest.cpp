// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: normals of vertices stand for all triangles at them, at the rims of caps above all, and nothing of the surface
// moves but the rims of fibres that graze a face, inwards.
#include "mesh/EvenFans.h"
#include "ExampleSurfaces.h"
#include "mesh/SurfaceCheck.h"
#include "mesh/SurfaceIntersection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace
{

using namespace cactus;

constexpr double largestRatio = 800.0;
constexpr double smallestAngle = 0.6;

/// A prism along an axis from face to face of a box, with a ring of points at each cap and none between; or, with `isFlat`, so
/// short that its caps are large beside its wall. Its caps are strips or, with `isFan`, fans about a corner.
CappedSurface prism(int axis, bool isFlat, bool isFan)
{
  const int sides = 16;
  const double radius = 0.5;
  const double half = isFlat ? 0.011 : 1.53;
  TriangleMesh mesh;
  for (const double z : { -half, half })
  {
    for (int i = 0; i < sides; ++i)
    {
      const double angle = 2.0 * pi * i / sides;
      Eigen::Vector3d p;
      p[axis] = z;
      p[(axis + 1) % 3] = radius * std::cos(angle);
      p[(axis + 2) % 3] = radius * std::sin(angle);
      mesh.points.push_back(p);
    }
  }
  for (int i = 0; i < sides; ++i)
  {
    const int next = (i + 1) % sides;
    mesh.triangles.push_back({ { i, next, sides + next } });
    mesh.triangles.push_back({ { i, sides + next, sides + i } });
  }
  for (int i = 1; i + 1 < sides; ++i)
  {
    // A strip goes to and fro between both sides of the polygon.
    const auto at = [](int n) { return n % 2 == 0 ? n / 2 : sides - (n + 1) / 2; };
    std::array<std::int32_t, 3> t{ { 0, i, i + 1 } };
    if (!isFan)
    {
      t = { { at(i - 1), at(i), at(i + 1) } };
      std::sort(t.begin(), t.end());
    }
    mesh.triangles.push_back({ { t[0], t[2], t[1] } });
    mesh.triangles.push_back({ { sides + t[0], sides + t[1], sides + t[2] } });
  }
  const Eigen::AlignedBox3d box(Eigen::Vector3d::Constant(-half), Eigen::Vector3d::Constant(half));
  std::vector<std::uint8_t> faces(mesh.points.size(), 0);
  for (std::size_t p = 0; p < faces.size(); ++p)
  {
    faces[p] = static_cast<std::uint8_t>(1 << (2 * axis + (p < std::size_t(sides) ? 0 : 1)));
  }
  return { std::move(mesh), std::move(faces), box };
}

void expectSame(const SurfaceReport& before, const SurfaceReport& after)
{
  EXPECT_TRUE(after.closedManifold() && after.outward());
  EXPECT_EQ(after.components, before.components);
  EXPECT_NEAR(after.volume, before.volume, 1e-12);
  EXPECT_NEAR(after.area, before.area, 1e-12);
}

TEST(EvenFans, LongAndFlatPrismsInAnyPosition)
{
  for (const bool isFlat : { false, true })
  {
    for (const bool isFan : { false, true })
    {
      std::size_t triangles = 0;
      for (int axis = 0; axis < 3; ++axis)
      {
        CappedSurface surface = prism(axis, isFlat, isFan);
        const SurfaceReport before = checkSurface(surface.mesh);
        ASSERT_TRUE(before.sound());
        EXPECT_GT(before.largestNormalAngle, 80.0) << isFlat << isFan;
        evenFans(surface, largestRatio, smallestAngle, 0.0);
        const SurfaceReport after = checkSurface(surface.mesh);
        EXPECT_LT(after.largestNormalAngle, 75.0) << isFlat << isFan << axis;
        expectSame(before, after);
        EXPECT_LE(after.largestSquaredEdgeRatio, largestRatio);
        EXPECT_GE(after.smallestAngle, std::min(before.smallestAngle, smallestAngle));
        EXPECT_GE(after.smallestAltitude, 0.999e-3);
        EXPECT_TRUE(selfIntersections(TriangleTree(surface.mesh)).empty());
        ASSERT_EQ(surface.faces.size(), surface.mesh.points.size());
        for (std::size_t p = 0; p < surface.faces.size(); ++p)
        {
          const double x = surface.mesh.points[p][axis];
          const int face = x == surface.box.min()[axis] ? 1 : x == surface.box.max()[axis] ? 2 : 0;
          EXPECT_EQ(surface.faces[p], face << (2 * axis)) << p;
        }
        EXPECT_TRUE(axis == 0 || after.triangles == triangles) << "depends on the position";
        triangles = after.triangles;
      }
    }
  }
}

TEST(EvenFans, MirroredPrism)
{
  CappedSurface surface = prism(2, false, true);
  for (Eigen::Vector3d& p : surface.mesh.points)
  {
    p.x() = -p.x();
  }
  for (auto& t : surface.mesh.triangles)
  {
    std::swap(t[1], t[2]);
  }
  const SurfaceReport before = checkSurface(surface.mesh);
  evenFans(surface, largestRatio, smallestAngle, 0.0);
  const SurfaceReport after = checkSurface(surface.mesh);
  EXPECT_GT(before.largestNormalAngle, 85.0);
  EXPECT_LT(after.largestNormalAngle, 75.0);
  expectSame(before, after);
}

/// As a fibre that meets a face at 60°: normals of cap and wall are up to 120° apart.
TEST(EvenFans, ObliquePrism)
{
  CappedSurface surface = prism(2, false, false);
  for (Eigen::Vector3d& p : surface.mesh.points)
  {
    p.x() += p.z() * std::tan(pi / 6.0);
  }
  const SurfaceReport before = checkSurface(surface.mesh);
  ASSERT_GT(before.largestNormalAngle, 100.0);
  evenFans(surface, largestRatio, smallestAngle, 0.0);
  const SurfaceReport after = checkSurface(surface.mesh);
  EXPECT_LT(after.largestNormalAngle, 75.0);
  expectSame(before, after);
}

/// As a fibre that grazes a face at 25°: no direction is within 75° of cap and wall, unless the rim is blunted.
TEST(EvenFans, BluntsRimsOfGrazingFibres)
{
  const double half = 0.08;
  const double slope = 1.0 / std::tan(25.0 / radian);
  const double depth = 0.02;
  CappedSurface surface = prism(2, false, false);
  for (Eigen::Vector3d& p : surface.mesh.points)
  {
    p.z() = p.z() < 0.0 ? -half : half;
    p.x() += slope * p.z();
  }
  surface.box = Eigen::AlignedBox3d(Eigen::Vector3d(-9, -9, -half), Eigen::Vector3d(9, 9, half));
  const SurfaceReport before = checkSurface(surface.mesh);
  CappedSurface sharp = surface;
  evenFans(sharp, largestRatio, smallestAngle, 0.0);
  EXPECT_GT(checkSurface(sharp.mesh).largestNormalAngle, 77.0);

  evenFans(surface, largestRatio, smallestAngle, depth);
  const SurfaceReport after = checkSurface(surface.mesh);
  EXPECT_LT(after.largestNormalAngle, 75.0);
  EXPECT_TRUE(after.sound());
  EXPECT_LE(after.largestSquaredEdgeRatio, largestRatio);
  EXPECT_TRUE(selfIntersections(TriangleTree(surface.mesh)).empty());
  // It has lost less than a wedge along both rims has, and nothing elsewhere.
  EXPECT_LT(after.volume, before.volume - 1e-6);
  EXPECT_GT(after.volume, before.volume - 2.0 * pi * 0.5 * depth * depth * slope);
  int moved = 0;
  for (std::size_t i = 0; i < surface.mesh.points.size(); ++i)
  {
    const Eigen::Vector3d& p = surface.mesh.points[i];
    // A polygon of 16 sides, whatever the height.
    double reach = 0.0;
    for (int k = 0; k < 16; ++k)
    {
      const double angle = 2.0 * pi * (k + 0.5) / 16;
      reach = std::max(reach, (p.x() - slope * p.z()) * std::cos(angle) + p.y() * std::sin(angle));
    }
    const double inside = 0.5 * std::cos(pi / 16) - reach;
    EXPECT_GT(inside, -1e-12);
    EXPECT_EQ(surface.faces[i], p.z() == -half ? 16 : p.z() == half ? 32 : 0);
    EXPECT_EQ(surface.faces[i] == 0, std::abs(p.z()) < half);
    EXPECT_TRUE(half - std::abs(p.z()) < 0.999 * depth || inside < 1e-12) << "the wall was moved";
    moved += surface.faces[i] != 0 && inside > 1e-6 && inside < depth * slope ? 1 : 0;
  }
  EXPECT_GT(moved, 8);

  CappedSurface held = surface;
  held.held = 16 | 32;
  evenFans(held, largestRatio, smallestAngle, depth);
  EXPECT_NEAR(checkSurface(held.mesh).volume, after.volume, 1e-12) << "points of held faces moved";
}

/// At the tip of a cap, the way into it leads out of a wall that leans less than its neighbour: fibres would come nearer to
/// others.
TEST(EvenFans, BlunterTipsStayInside)
{
  const double half = 0.08;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  int moved = 0;
  for (int trial = 0; trial < 60; ++trial)
  {
    // An oblique prism over a triangle with a sharp tip.
    const double lean = 2.0 * pi * uniform(random);
    const double slope = 1.0 / std::tan((12.0 + 20.0 * uniform(random)) / radian);
    const Eigen::Vector2d way = slope * Eigen::Vector2d(std::cos(lean), std::sin(lean));
    const double width = 0.05 + 0.3 * uniform(random);
    const Eigen::Vector2d corners[] = { { 0.0, 0.0 }, { 0.8, -width * uniform(random) }, { 0.4 + 0.4 * uniform(random), width } };
    CappedSurface surface;
    for (const double z : { -half, half })
    {
      for (const Eigen::Vector2d& corner : corners)
      {
        surface.mesh.points.emplace_back(corner.x() + way.x() * z, corner.y() + way.y() * z, z);
        surface.faces.push_back(z < 0.0 ? 16 : 32);
      }
    }
    surface.mesh.triangles = { { { 0, 2, 1 } }, { { 3, 4, 5 } }, { { 0, 1, 4 } }, { { 0, 4, 3 } }, { { 1, 2, 5 } },
      { { 1, 5, 4 } }, { { 2, 0, 3 } }, { { 2, 3, 5 } } };
    surface.box = Eigen::AlignedBox3d(Eigen::Vector3d(-9, -9, -half), Eigen::Vector3d(9, 9, half));
    std::vector<std::pair<Eigen::Vector3d, double>> walls; // outward normals, and where the planes are
    for (const int t : { 2, 4, 6 })
    {
      const auto& triangle = surface.mesh.triangles[std::size_t(t)];
      const auto at = [&](int i) { return surface.mesh.points[std::size_t(triangle[std::size_t(i)])]; };
      const Eigen::Vector3d normal = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
      walls.emplace_back(normal, normal.dot(at(0)));
    }
    const double before = checkSurface(surface.mesh).volume;
    evenFans(surface, largestRatio, smallestAngle, 0.02);
    moved += checkSurface(surface.mesh).volume < before - 1e-9 ? 1 : 0;
    for (const Eigen::Vector3d& p : surface.mesh.points)
    {
      for (const auto& [normal, place] : walls)
      {
        EXPECT_LT(normal.dot(p) - place, 1e-9) << trial;
      }
    }
  }
  EXPECT_GT(moved, 5);
}

/// Whatever lies deeper than the layer stays, also where triangles end just below it.
TEST(EvenFans, BluntsNothingBelowItsLayer)
{
  const double slope = 1.0 / std::tan(25.0 / radian);
  const double depth = 0.02;
  bool hasMoved = false;
  for (const double height : { 0.9 * depth, 1.05 * depth, 1.2 * depth, 1.5 * depth, 4.0 * depth })
  {
    CappedSurface surface = prism(2, false, true);
    for (Eigen::Vector3d& p : surface.mesh.points)
    {
      p.z() = p.z() < 0.0 ? 0.0 : height;
      p.x() += slope * p.z();
    }
    surface.box = Eigen::AlignedBox3d(Eigen::Vector3d(-9, -9, 0), Eigen::Vector3d(9, 9, height));
    evenFans(surface, largestRatio, smallestAngle, depth);
    EXPECT_TRUE(checkSurface(surface.mesh).closedManifold());
    for (const auto& t : surface.mesh.triangles)
    {
      double lowest = height;
      double highest = 0.0;
      double inside = 0.0;
      for (const std::int32_t corner : t)
      {
        const Eigen::Vector3d& p = surface.mesh.points[std::size_t(corner)];
        double reach = 0.0;
        for (int k = 0; k < 16; ++k)
        {
          const double angle = 2.0 * pi * (k + 0.5) / 16;
          reach = std::max(reach, (p.x() - slope * p.z()) * std::cos(angle) + p.y() * std::sin(angle));
        }
        lowest = std::min(lowest, p.z());
        highest = std::max(highest, p.z());
        inside = std::max(inside, 0.5 * std::cos(pi / 16) - reach);
      }
      const bool isWall = !surface.isCap(t);
      hasMoved = hasMoved || (isWall && inside > 1e-6);
      EXPECT_TRUE(!isWall || inside < 1e-12 || highest - lowest <= depth * (1.0 + 1e-9)) << height;
    }
  }
  EXPECT_TRUE(hasMoved);
}

TEST(EvenFans, LeavesEvenSurfacesAsTheyAre)
{
  CappedSurface surface;
  surface.mesh = example::box({ 0, 0, 0 }, { 1, 1, 1 });
  surface.faces.assign(8, 0);
  const TriangleMesh before = surface.mesh;
  evenFans(surface, largestRatio, smallestAngle, 0.0);
  EXPECT_EQ(surface.mesh.points, before.points);
  EXPECT_EQ(surface.mesh.triangles, before.triangles);
}

} // namespace
