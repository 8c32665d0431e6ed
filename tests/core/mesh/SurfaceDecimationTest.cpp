// SPDX-License-Identifier: BSD-3-Clause
// Guarantees: a coarsened surface stays closed, near the level of its field and in the faces of its box, and gets no needles; the
// points that are left of a rim in a held face are still on the rim.
#include "mesh/SurfaceDecimation.h"
#include "base/Constants.h"
#include "mesh/EditableSurface.h"
#include "mesh/ExampleContours.h"
#include "mesh/HeldRims.h"
#include "mesh/Quadric.h"
#include "mesh/ShapeBounds.h"
#include "mesh/SurfaceCheck.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <set>

namespace
{

using namespace cactus;
using namespace example;

TEST(SurfaceDecimation, KeepsASphereClosedAndNear)
{
  const CappedSurface fine = sphere(1.0, 0.1, 27);
  std::size_t before = fine.mesh.triangles.size();
  for (const double error : { 0.001, 0.005, 0.02 })
  {
    CappedSurface surface = fine;
    SurfaceDecimationOptions options;
    options.maximumError = error;
    options.field = [](const Eigen::Vector3d& p) { return sphereDepth(p, 1.0); };
    decimate(surface, options);
    const SurfaceReport report = checkSurface(surface.mesh);
    EXPECT_TRUE(report.closedManifold() && report.outward());
    EXPECT_EQ(report.components, 1u);
    EXPECT_LT(report.largestSquaredEdgeRatio, 1000.0) << error;
    EXPECT_LT(report.triangles, before);
    EXPECT_NEAR(report.volume, 4.0 / 3.0 * pi, 4.0 * pi * std::max(error, 0.0025));
    for (const auto& p : surface.mesh.points)
    {
      // Triangles of the contour that cut corners off the sphere by more than the error may stay: with a length of √2 · 0.1, they
      // do so by up to 0.0025.
      EXPECT_LE(std::abs(sphereDepth(p, 1.0)), std::max(error, 0.0025));
    }
    before = report.triangles;
  }
  EXPECT_LT(double(before), 0.06 * double(fine.mesh.triangles.size()));
}

TEST(SurfaceDecimation, KeepsFlatFacesAndTheirEdges)
{
  const NodeLattice lattice = cubeLattice(18, 0.25);
  CappedSurface surface = contour(lattice, allBlocks(lattice), sampled([](int, int, int) { return 1.0; }));
  SurfaceDecimationOptions options;
  options.maximumError = 0.001;
  options.field = [](const Eigen::Vector3d&) { return 1.0; };
  decimate(surface, options);
  const SurfaceReport report = checkSurface(surface.mesh);
  EXPECT_TRUE(report.closedManifold() && report.outward());
  EXPECT_NEAR(report.volume, std::pow(4.25, 3), 1e-9);
  EXPECT_LT(report.triangles, 100u);
}

TEST(SurfaceDecimation, FlipsFlatTriangles)
{
  // A prism, none of whose corners can go, over a b c d with c but 0.012 beyond the line from a to b: lid and floor do not have
  // to be divided along that line.
  const std::array<Eigen::Vector2d, 4> outline{ { { 0.0, 0.0 }, { 0.5, -0.8 }, { 1.0, 0.0 }, { 0.5, 0.012 } } };
  CappedSurface surface;
  for (const double z : { 0.0, 0.5 })
  {
    for (const Eigen::Vector2d& p : outline)
    {
      surface.mesh.points.push_back({ p[0], p[1], z });
    }
  }
  surface.faces.assign(8, 0);
  surface.mesh.triangles = { { { 0, 2, 1 } }, { { 0, 3, 2 } }, { { 4, 5, 6 } }, { { 4, 6, 7 } } };
  for (std::int32_t i = 0; i < 4; ++i)
  {
    const std::int32_t next = (i + 1) % 4;
    surface.mesh.triangles.push_back({ { i, next, next + 4 } });
    surface.mesh.triangles.push_back({ { i, next + 4, i + 4 } });
  }
  const double volume = checkSurface(surface.mesh).volume;
  SurfaceDecimationOptions options;
  options.maximumError = 0.002;
  options.field = [&outline](const Eigen::Vector3d& p)
  {
    double depth = std::min(p[2], 0.5 - p[2]);
    for (std::size_t i = 0; i < 4; ++i)
    {
      const Eigen::Vector2d along = (outline[(i + 1) % 4] - outline[i]).normalized();
      depth = std::min(depth, along[0] * (p[1] - outline[i][1]) - along[1] * (p[0] - outline[i][0]));
    }
    return depth;
  };
  decimate(surface, options);
  const SurfaceReport report = checkSurface(surface.mesh);
  EXPECT_TRUE(report.closedManifold() && report.outward());
  EXPECT_EQ(report.triangles, 12u);
  EXPECT_NEAR(report.volume, volume, 1e-12);
  for (const auto& t : surface.mesh.triangles)
  {
    const Eigen::Vector3d ab = surface.mesh.points[std::size_t(t[1])] - surface.mesh.points[std::size_t(t[0])];
    const Eigen::Vector3d ac = surface.mesh.points[std::size_t(t[2])] - surface.mesh.points[std::size_t(t[0])];
    EXPECT_GT(ab.cross(ac).norm(), 0.1 * std::max({ ab.squaredNorm(), ac.squaredNorm(), (ac - ab).squaredNorm() }));
  }
}

/// Depth in a tube that winds about the z axis, with a period of 9 µm.
double depthInWindingTube(const Eigen::Vector3d& p)
{
  const double turn = 2.0 * pi * p.z() / 9.0;
  return 0.6 - std::hypot(p.x() - 0.2 * std::cos(turn), p.y() - 0.2 * std::sin(turn));
}

TEST(SurfaceDecimation, LongSurfacesCostAsManyTrianglesPerLengthAsShortOnes)
{
  // The long one is coarsened in stretches: as much is collapsed at their ends, and the surface keeps its distance.
  std::vector<double> triangles;
  for (const int periods : { 1, 2, 8 })
  {
    NodeLattice lattice = cubeLattice(20, 0.1);
    lattice.planes[2].clear();
    for (int k = 0; k <= 90 * periods; ++k)
    {
      lattice.planes[2].push_back(0.1 * k);
    }
    const auto field = [](int i, int j, int k) { return depthInWindingTube(0.1 * Eigen::Vector3d(i - 9.5, j - 9.5, k)); };
    CappedSurface surface = contour(lattice, allBlocks(lattice), sampled(field));
    const double volume = checkSurface(surface.mesh).volume;
    SurfaceDecimationOptions options;
    options.field = depthInWindingTube;
    decimate(surface, options);
    const SurfaceReport report = checkSurface(surface.mesh);
    EXPECT_TRUE(report.closedManifold() && report.outward());
    EXPECT_NEAR(report.volume, volume, 0.005 * volume);
    for (const auto& t : surface.mesh.triangles)
    {
      const auto corner = [&](std::size_t i) -> const Eigen::Vector3d& { return surface.mesh.points[std::size_t(t[i])]; };
      const Eigen::Vector3d centroid = (corner(0) + corner(1) + corner(2)) / 3.0;
      EXPECT_TRUE(surface.isCap(t) || std::abs(depthInWindingTube(centroid)) <= 1.001 * options.maximumError);
    }
    triangles.push_back(double(report.triangles));
  }
  const double ofAPeriod = triangles[1] - triangles[0]; // without caps
  EXPECT_NEAR(triangles[2] - triangles[1], 6.0 * ofAPeriod, 0.03 * 6.0 * ofAPeriod);
}

using Place = std::array<double, 3>;

/// The places of points in held faces: those of caps, or those of the wall, which are the rims.
std::set<Place> placesInHeldFaces(const CappedSurface& surface, bool ofCaps)
{
  std::set<Place> places;
  for (const auto& t : surface.mesh.triangles)
  {
    for (const std::int32_t p : t)
    {
      if (surface.isCap(t) == ofCaps && surface.isHeld(p))
      {
        const Eigen::Vector3d& place = surface.mesh.points[std::size_t(p)];
        places.insert({ { place.x(), place.y(), place.z() } });
      }
    }
  }
  return places;
}

// Beside an edge of the box the wall is a narrow strip between rims in two faces. If a point of one is merged into the end that
// both share, no triangle of the wall may come to lie in the other face.
TEST(SurfaceDecimation, PointsOfHeldRimsStayOnThemOrGo)
{
  const NodeLattice lattice = cubeLattice(11, 0.1);
  constexpr double radius = 10.0;
  std::size_t gone = 0;
  for (int n = 0; n < 200; ++n)
  {
    // A cube without what lies in a large ball, whose surface runs almost along an edge of the cube.
    const Eigen::Vector3d outwards = Eigen::Vector3d(1.0, 1.05, 0.01 * (1 + n % 20)).normalized();
    const Eigen::Vector3d centre = Eigen::Vector3d(0.5, 0.5, 0.01 * (n / 20) - 0.049) + radius * outwards;
    const auto depth = [&](const Eigen::Vector3d& p) { return (p - centre).norm() - radius; };
    CappedSurface surface = contour(lattice, allBlocks(lattice),
      sampled([&](int i, int j, int k) { return depth(0.1 * Eigen::Vector3d(i - 5, j - 5, k - 5)); }));
    surface.held = 0x3f;
    SurfaceDecimationOptions options;
    options.field = depth;
    surface.stays = HeldRims(surface, 0.5 * options.maximumError, options.sampling).stays();
    ASSERT_NE(surface.stays, nullptr);
    const std::set<Place> before = placesInHeldFaces(surface, false);
    decimate(surface, options);
    const std::set<Place> after = placesInHeldFaces(surface, false);
    const std::set<Place> ofCaps = placesInHeldFaces(surface, true);
    for (const Place& place : before)
    {
      EXPECT_TRUE(after.count(place) != 0 || (ofCaps.count(place) == 0 && surface.stays->count(place) == 0)) << n;
      gone += after.count(place) == 0 ? 1 : 0;
    }
  }
  EXPECT_GT(gone, 1000u);
}

TEST(SurfaceDecimation, DependsOnTheInputAlone)
{
  CappedSurface one = sphere(0.7, 0.1, 21);
  CappedSurface other = one;
  SurfaceDecimationOptions options;
  options.field = [](const Eigen::Vector3d& p) { return sphereDepth(p, 0.7); };
  decimate(one, options);
  decimate(other, options);
  ASSERT_EQ(one.mesh.points.size(), other.mesh.points.size());
  EXPECT_EQ(std::memcmp(one.mesh.points.data(), other.mesh.points.data(), one.mesh.points.size() * sizeof(Eigen::Vector3d)), 0);
  EXPECT_EQ(one.mesh.triangles, other.mesh.triangles);
}

TEST(Quadric, IsLeastWhereThePlanesMeet)
{
  Quadric corner;
  const Eigen::Vector3d place(0.3, -0.2, 0.1);
  for (int axis = 0; axis < 3; ++axis)
  {
    corner.addPlane((1.0 + axis) * Eigen::Vector3d::Unit(axis), place);
  }
  EXPECT_NEAR(corner.error(place), 0.0, 1e-15);
  EXPECT_GT(corner.error(place + Eigen::Vector3d(0.1, 0.0, 0.0)), 1e-4);
  EXPECT_NEAR((corner.best(Eigen::Vector3d::Zero(), 1.0) - place).norm(), 0.0, 1e-4);
  EXPECT_EQ(corner.best(Eigen::Vector3d::Zero(), 0.1), Eigen::Vector3d::Zero()) << "too far away";

  // One plane leaves two directions open, in which the place stays in the middle.
  Quadric flat;
  flat.addPlane(Eigen::Vector3d(0.0, 0.0, 2.0), place);
  EXPECT_NEAR((flat.best(Eigen::Vector3d(5.0, 6.0, 0.0), 1.0) - Eigen::Vector3d(5.0, 6.0, 0.1)).norm(), 0.0, 1e-4);
}

TEST(ShapeBounds, RefuseWhatTurnsATriangleOverOrMakesANeedle)
{
  // A fan of six triangles around point 0, closed from below by a seventh point.
  CappedSurface surface;
  surface.mesh.points.push_back({ 0.0, 0.0, 0.0 });
  for (int i = 0; i < 6; ++i)
  {
    surface.mesh.points.push_back({ std::cos(pi / 3.0 * i), std::sin(pi / 3.0 * i), 0.0 });
  }
  surface.mesh.points.push_back({ 0.0, 0.0, -1.0 });
  surface.faces.assign(8, 0);
  for (std::int32_t i = 0; i < 6; ++i)
  {
    const std::int32_t next = 1 + (i + 1) % 6;
    surface.mesh.triangles.push_back({ { 0, 1 + i, next } });
    surface.mesh.triangles.push_back({ { 7, next, 1 + i } });
  }
  const EditableSurface editable(surface);
  const ShapeBounds bounds(editable, 300.0, 0.0);
  EXPECT_TRUE(bounds.allowCollapse(0, 1, surface.mesh.points[1], false));
  EXPECT_TRUE(bounds.allowCollapse(0, 1, { 0.9, 0.0, 0.0 }, false));
  EXPECT_FALSE(bounds.allowCollapse(0, 1, { -1.2, 0.0, 0.0 }, false)) << "beyond the point across";
  EXPECT_FALSE(bounds.allowCollapse(0, 1, surface.mesh.points[3] + Eigen::Vector3d(0.0, -0.01, 0.0), true)) << "a needle";
}

} // namespace
