// SPDX-License-Identifier: BSD-3-Clause
// Guarantees: a remeshed surface stays closed, near the level of its field and in the faces of its box, and has few small angles.
#include "mesh/SurfaceRemeshing.h"

#include "mesh/ExampleContours.h"
#include "mesh/SurfaceCheck.h"
#include "mesh/SurfaceIntersection.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace cactus;
using namespace example;
using Eigen::Vector3d;

constexpr double toDegrees = 57.29577951308232;

/// Depth in a fibre that winds from one face of the box to the other, and is thinner in the middle.
double windingDepth(const Vector3d& p)
{
  const Vector3d axis(0.3 * std::sin(2.0 * p[2]), 0.2 * std::cos(1.5 * p[2]), p[2]);
  return 0.5 + 0.08 * std::cos(3.0 * p[2]) - (p - axis).norm();
}

CappedSurface contourOf(double (*depth)(const Vector3d&), int nodes = 33, double spacing = 0.1)
{
  const NodeLattice lattice = cubeLattice(nodes, spacing);
  const double half = 0.5 * (nodes - 1);
  return contour(lattice, allBlocks(lattice),
    sampled([=](int i, int j, int k) { return depth(spacing * Vector3d(i - half, j - half, k - half)) + 1e-5; }));
}

SurfaceRemeshingOptions optionsFor(double (*depth)(const Vector3d&), double error)
{
  SurfaceRemeshingOptions options;
  options.surface.field = depth;
  options.surface.maximumError = error;
  return options;
}

/// The part of the triangles that have an angle below so many degrees.
double partBelow(const TriangleMesh& mesh, double degrees)
{
  std::size_t count = 0;
  for (const auto& t : mesh.triangles)
  {
    double smallest = 180.0;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const Vector3d& p = mesh.points[std::size_t(t[i])];
      const Vector3d u = mesh.points[std::size_t(t[(i + 1) % 3])] - p;
      const Vector3d v = mesh.points[std::size_t(t[(i + 2) % 3])] - p;
      smallest = std::min(smallest, toDegrees * std::acos(u.dot(v) / (u.norm() * v.norm())));
    }
    count += smallest < degrees ? 1 : 0;
  }
  return double(count) / double(mesh.triangles.size());
}

TEST(SurfaceRemeshing, MakesTheTrianglesOfAFibreEven)
{
  const CappedSurface fine = contourOf(windingDepth);
  const SurfaceReport before = checkSurface(fine.mesh);
  EXPECT_GT(partBelow(fine.mesh, 20.0), 0.1);
  for (const double error : { 0.003, 0.01 })
  {
    CappedSurface surface = fine;
    remesh(surface, optionsFor(windingDepth, error));
    const SurfaceReport report = checkSurface(surface.mesh);
    EXPECT_TRUE(report.sound());
    EXPECT_EQ(report.degenerateTriangles, 0u);
    EXPECT_FALSE(meetsItself(surface.mesh));
    EXPECT_LT(partBelow(surface.mesh, 20.0), 0.01);
    EXPECT_NEAR(report.volume, before.volume, before.area * error);
    std::size_t caps = 0;
    for (const auto& t : surface.mesh.triangles)
    {
      if (surface.isCap(t))
      {
        ++caps;
        continue;
      }
      Vector3d centre = Vector3d::Zero();
      for (const std::int32_t corner : t)
      {
        const Vector3d& point = surface.mesh.points[std::size_t(corner)];
        centre += point / 3.0;
        EXPECT_NEAR(windingDepth(point), 0.0, 0.5 * error);
        EXPECT_LE(std::fabs(point[2]), 1.6);
      }
      EXPECT_NEAR(windingDepth(centre), 0.0, 1.5 * error);
    }
    EXPECT_GT(caps, 20u);
  }
}

/// A fibre through two edges of the box, on whose faces it has three caps.
double cornerDepth(const Vector3d& p)
{
  const Vector3d along = Vector3d(1.0, 0.7, 0.4).normalized();
  const Vector3d from = p - Vector3d(1.2, 1.1, 0.0);
  return 0.7 - (from - along.dot(from) * along).norm();
}

TEST(SurfaceRemeshing, KeepsCapsInTheFacesOfTheBoxAndOutOfItsEdges)
{
  CappedSurface surface = contourOf(cornerDepth);
  const SurfaceReport before = checkSurface(surface.mesh);
  remesh(surface, optionsFor(cornerDepth, 0.005));
  const SurfaceReport report = checkSurface(surface.mesh);
  EXPECT_TRUE(report.sound());
  EXPECT_FALSE(meetsItself(surface.mesh));
  EXPECT_NEAR(report.volume, before.volume, before.area * 0.005);
  EXPECT_LT(partBelow(surface.mesh, 20.0), 0.02);
  for (std::size_t p = 0; p < surface.mesh.points.size(); ++p)
  {
    for (int face = 0; face < 6; ++face)
    {
      const double side = face % 2 == 0 ? surface.box.min()[face / 2] : surface.box.max()[face / 2];
      EXPECT_EQ(surface.mesh.points[p][face / 2] == side, (surface.faces[p] >> face & 1) == 1);
    }
  }
}

TEST(SurfaceRemeshing, GivesTheSameBitsAgain)
{
  CappedSurface first = contourOf(windingDepth);
  CappedSurface second = first;
  remesh(first, optionsFor(windingDepth, 0.005));
  remesh(second, optionsFor(windingDepth, 0.005));
  EXPECT_EQ(first.mesh.points, second.mesh.points);
  EXPECT_EQ(first.mesh.triangles, second.mesh.triangles);
}

} // namespace
