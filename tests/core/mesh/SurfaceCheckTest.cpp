// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SurfaceCheck.h"

#include "ExampleSurfaces.h"
#include "base/Constants.h"
#include "base/Error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

namespace
{

using cactus::pi;

/// A cube of the given side with its lower corner at `at`.
cactus::TriangleMesh cube(double side, const Eigen::Vector3d& at)
{
  return example::box(at, at + Eigen::Vector3d::Constant(side));
}

/// A unit sphere: an octahedron with every triangle split in four `levels` times.
cactus::TriangleMesh octahedralSphere(int levels)
{
  cactus::TriangleMesh mesh;
  mesh.points = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 } };
  mesh.triangles = { { { 0, 2, 4 } }, { { 2, 1, 4 } }, { { 1, 3, 4 } }, { { 3, 0, 4 } }, { { 2, 0, 5 } }, { { 1, 2, 5 } },
    { { 3, 1, 5 } }, { { 0, 3, 5 } } };
  for (int level = 0; level < levels; ++level)
  {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b)
    {
      const auto key = std::minmax(a, b);
      const auto found = middles.find(key);
      if (found != middles.end())
      {
        return found->second;
      }
      mesh.points.push_back((mesh.points[std::size_t(a)] + mesh.points[std::size_t(b)]).normalized());
      return middles[key] = static_cast<int>(mesh.points.size()) - 1;
    };
    std::vector<std::array<std::int32_t, 3>> finer;
    for (const auto& t : mesh.triangles)
    {
      const int ab = middle(t[0], t[1]);
      const int bc = middle(t[1], t[2]);
      const int ca = middle(t[2], t[0]);
      finer.insert(finer.end(), { { { t[0], ab, ca } }, { { ab, t[1], bc } }, { { ca, bc, t[2] } }, { { ab, bc, ca } } });
    }
    mesh.triangles = finer;
  }
  return mesh;
}

/// Both meshes in one; `shared` maps points of the second onto points of the first.
cactus::TriangleMesh joined(const cactus::TriangleMesh& a, const cactus::TriangleMesh& b, const std::map<int, int>& shared)
{
  cactus::TriangleMesh mesh = a;
  mesh.points.insert(mesh.points.end(), b.points.begin(), b.points.end());
  for (auto t : b.triangles)
  {
    for (auto& point : t)
    {
      const auto found = shared.find(point);
      point = found != shared.end() ? found->second : point + static_cast<int>(a.points.size());
    }
    mesh.triangles.push_back(t);
  }
  return mesh;
}

} // namespace

// Guarantee 3: volumes and areas are those of the mesh, also of a small mesh far from the origin.
TEST(SurfaceCheck, CubeFarFromTheOrigin)
{
  const auto report = cactus::checkSurface(cube(0.5, { 250.0, -250.0, 250.0 }));
  EXPECT_TRUE(report.closed());
  EXPECT_TRUE(report.closedManifold());
  EXPECT_TRUE(report.outward());
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(report.points, 8u);
  EXPECT_EQ(report.triangles, 12u);
  EXPECT_EQ(report.degenerateTriangles, 0u);
  EXPECT_NEAR(report.volume, 0.125, 1e-14);
  EXPECT_NEAR(report.area, 1.5, 1e-13);
  EXPECT_NEAR(report.smallestAngle, 45.0, 1e-9);
  EXPECT_NEAR(report.largestSquaredEdgeRatio, 2.0, 1e-9);
}

TEST(SurfaceCheck, NormalOfTheApexOfAPyramid)
{
  // Over a square of side 2, so low that the base outweighs a side at a corner of it; at the apex all sides weigh the same.
  cactus::TriangleMesh mesh;
  const double height = 0.5;
  mesh.points = { { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 }, { 0, 0, height } };
  mesh.triangles = { { { 0, 2, 1 } }, { { 0, 3, 2 } }, { { 0, 1, 4 } }, { { 1, 2, 4 } }, { { 2, 3, 4 } }, { { 3, 0, 4 } } };
  // Twice the area normals: 4 down of each half of the base, (0, -2 height, 2) and (-2 height, 0, 2) of the sides at a corner.
  const Eigen::Vector3d side(0.0, -2.0 * height, 2.0);
  const Eigen::Vector3d sum(-2.0 * height, -2.0 * height, 4.0 - 8.0);
  const double expected = 180.0 / pi * std::acos(sum.normalized().dot(side.normalized()));
  EXPECT_NEAR(cactus::checkSurface(mesh).largestNormalAngle, expected, 1e-9);
  EXPECT_NEAR(cactus::checkSurface(cube(2.0, { 3, 4, 5 })).largestNormalAngle, 180.0 / pi * std::acos(1.0 / 3.0), 1e-9);
}

TEST(SurfaceCheck, SphereApproachesItsFormulas)
{
  const auto report = cactus::checkSurface(octahedralSphere(5));
  EXPECT_TRUE(report.closedManifold() && report.outward());
  EXPECT_EQ(report.points, report.triangles / 2 + 2); // Euler's formula for a sphere
  EXPECT_NEAR(report.volume, 4.0 / 3.0 * pi, 0.01);
  EXPECT_LT(report.volume, 4.0 / 3.0 * pi);
  EXPECT_NEAR(report.area, 4.0 * pi, 0.02);
}

// Guarantee 2: each way in which a surface can leak is distinguished from the others.
TEST(SurfaceCheck, Hole)
{
  auto mesh = cube(1.0, { 0, 0, 0 });
  mesh.triangles.pop_back();
  const auto report = cactus::checkSurface(mesh);
  EXPECT_FALSE(report.closed());
  EXPECT_EQ(report.openEdges, 3u);
}

TEST(SurfaceCheck, FlippedTriangle)
{
  auto mesh = cube(1.0, { 0, 0, 0 });
  std::swap(mesh.triangles[4][0], mesh.triangles[4][1]);
  const auto report = cactus::checkSurface(mesh);
  EXPECT_FALSE(report.closed());
  EXPECT_EQ(report.flippedEdges, 3u);
  EXPECT_EQ(report.openEdges + report.crowdedEdges, 0u);
}

TEST(SurfaceCheck, DuplicatedTriangle)
{
  auto mesh = cube(1.0, { 0, 0, 0 });
  mesh.triangles.push_back(mesh.triangles[7]);
  const auto report = cactus::checkSurface(mesh);
  EXPECT_FALSE(report.closed());
  EXPECT_EQ(report.crowdedEdges, 3u);
}

TEST(SurfaceCheck, Inward)
{
  auto mesh = joined(cube(1.0, { 0, 0, 0 }), cube(0.5, { 3, 0, 0 }), {});
  EXPECT_TRUE(cactus::checkSurface(mesh).outward());
  for (std::size_t t = 12; t < 24; ++t)
  {
    std::swap(mesh.triangles[t][0], mesh.triangles[t][1]);
  }
  const auto report = cactus::checkSurface(mesh);
  EXPECT_TRUE(report.closedManifold());
  EXPECT_FALSE(report.outward());
  EXPECT_EQ(report.inwardComponents, 1u);
  EXPECT_EQ(report.components, 2u);
  EXPECT_NEAR(report.volume, 0.875, 1e-14);
}

TEST(SurfaceCheck, TwoCubesSharingAPoint)
{
  const auto mesh = joined(cube(1.0, { 0, 0, 0 }), cube(1.0, { 1, 1, 1 }), { { 0, 7 } });
  const auto report = cactus::checkSurface(mesh);
  EXPECT_TRUE(report.closed());
  EXPECT_FALSE(report.closedManifold());
  EXPECT_EQ(report.pinchedPoints, 1u);
  EXPECT_EQ(report.components, 2u);
  EXPECT_EQ(report.points, 15u);
  EXPECT_NEAR(report.volume, 2.0, 1e-13);
}

TEST(SurfaceCheck, TwoCubesSharingAnEdge)
{
  // Points 0 and 4 of the second cube are the edge 3-7 of the first.
  const auto mesh = joined(cube(1.0, { 0, 0, 0 }), cube(1.0, { 1, 1, 0 }), { { 0, 3 }, { 4, 7 } });
  const auto report = cactus::checkSurface(mesh);
  EXPECT_FALSE(report.closed());
  EXPECT_EQ(report.crowdedEdges, 1u);
}

TEST(SurfaceCheck, DegenerateTriangles)
{
  auto mesh = cube(1.0, { 0, 0, 0 });
  mesh.triangles.push_back({ { 0, 0, 1 } });
  auto report = cactus::checkSurface(mesh);
  EXPECT_EQ(report.degenerateTriangles, 1u);
  EXPECT_FALSE(report.closedManifold());
  EXPECT_TRUE(report.closed());
  EXPECT_EQ(report.components, 1u);

  // A point on the middle of an edge, joined by a triangle without area: closed, but not usable.
  mesh = cube(1.0, { 0, 0, 0 });
  mesh.points.push_back({ 0.5, 0, 0 });
  mesh.triangles[0] = { { 0, 2, 8 } };
  mesh.triangles.push_back({ { 8, 2, 1 } });
  mesh.triangles.push_back({ { 0, 8, 1 } });
  report = cactus::checkSurface(mesh);
  EXPECT_TRUE(report.closedManifold());
  EXPECT_EQ(report.degenerateTriangles, 1u);
  EXPECT_NEAR(report.smallestAngle, 0.0, 1e-12);
}

TEST(SurfaceCheck, SliverRatio)
{
  cactus::TriangleMesh mesh;
  mesh.points = { { 0, 0, 0 }, { 40, 0, 0 }, { 0, 1, 0 } };
  mesh.triangles = { { { 0, 1, 2 } } };
  const auto report = cactus::checkSurface(mesh);
  EXPECT_DOUBLE_EQ(report.largestSquaredEdgeRatio, 1601.0);
  EXPECT_NEAR(report.smallestAngle, std::atan(1.0 / 40.0) * 180.0 / pi, 1e-9);
}

TEST(SurfaceCheck, EmptyAndDamaged)
{
  const auto empty = cactus::checkSurface({});
  EXPECT_FALSE(empty.closed() || empty.outward());
  auto mesh = cube(1.0, { 0, 0, 0 });
  mesh.triangles[3][1] = 8;
  EXPECT_THROW(cactus::checkSurface(mesh), cactus::InvalidInput);
  mesh = cube(1.0, { 0, 0, 0 });
  mesh.points[2][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(cactus::checkSurface(mesh), cactus::InvalidInput);
}
