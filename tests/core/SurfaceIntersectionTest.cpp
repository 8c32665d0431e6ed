// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceIntersection.h"

#include <gtest/gtest.h>

namespace
{

/// A tetrahedron with a corner at `origin` and edges of length `size` along the axes.
cactus::TriangleMesh tetrahedron(const Eigen::Vector3d& origin, double size)
{
  cactus::TriangleMesh mesh;
  mesh.points = { origin, origin + Eigen::Vector3d(size, 0, 0), origin + Eigen::Vector3d(0, size, 0),
    origin + Eigen::Vector3d(0, 0, size) };
  mesh.triangles = { { { 0, 2, 1 } }, { { 0, 1, 3 } }, { { 0, 3, 2 } }, { { 1, 2, 3 } } };
  return mesh;
}

cactus::TriangleMesh both(cactus::TriangleMesh a, const cactus::TriangleMesh& b)
{
  const auto shift = static_cast<std::int32_t>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (auto t : b.triangles)
  {
    a.triangles.push_back({ { t[0] + shift, t[1] + shift, t[2] + shift } });
  }
  return a;
}

} // namespace

// Guarantee 2 rests on this: surfaces that cut each other are found, and those that do not are left alone.
TEST(SurfaceIntersection, TellsCuttingFromApartAndNested)
{
  const auto large = tetrahedron({ 0, 0, 0 }, 3.0);
  EXPECT_TRUE(cactus::surfacesMeet(large, tetrahedron({ 0.5, 0.5, 0.5 }, 3.0)));
  EXPECT_FALSE(cactus::surfacesMeet(large, tetrahedron({ 0.5, 0.5, 0.5 }, 0.5))); // inside
  EXPECT_FALSE(cactus::surfacesMeet(large, tetrahedron({ 4, 0, 0 }, 1.0)));
  EXPECT_FALSE(cactus::surfacesMeet(large, tetrahedron({ 0.5, 0.5, -1.001 }, 1.0)));
  EXPECT_TRUE(cactus::surfacesMeet(large, tetrahedron({ 0.5, 0.5, -0.999 }, 1.0)));
}

TEST(SurfaceIntersection, FindsASurfaceThatCutsItself)
{
  EXPECT_FALSE(cactus::meetsItself(tetrahedron({ 0, 0, 0 }, 1.0)));
  EXPECT_FALSE(cactus::meetsItself(both(tetrahedron({ 0, 0, 0 }, 1.0), tetrahedron({ 2, 0, 0 }, 1.0))));
  EXPECT_TRUE(cactus::meetsItself(both(tetrahedron({ 0, 0, 0 }, 1.0), tetrahedron({ 0.1, 0.1, 0.1 }, 1.0))));
}

// Flat caps are full of triangles in one plane that lie side by side.
TEST(SurfaceIntersection, NeighboursInOnePlaneAreApart)
{
  EXPECT_FALSE(cactus::surfacesMeet(tetrahedron({ 0, 0, 0 }, 1.0), tetrahedron({ 1.5, 0, 0 }, 1.0)));
  EXPECT_TRUE(cactus::surfacesMeet(tetrahedron({ 0, 0, 0 }, 1.0), tetrahedron({ 0.2, 0.2, 0 }, 1.0)));
}
