// SPDX-License-Identifier: BSD-3-Clause
// Guarantees: a surface coarsened along its axis has far fewer triangles, and stays closed, of the same topology, near its field
// and in the faces of its box; parts that planes do not cut into single rings stay unchanged.
#include "mesh/BandCoarsening.h"
#include "base/Constants.h"
#include "mesh/BandExcesses.h"
#include "mesh/ExampleContours.h"
#include "mesh/PlaneLoops.h"
#include "mesh/SurfaceCheck.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>

namespace
{

using namespace cactus;
using namespace example;
using Eigen::Vector3d;

using Field = std::function<double(const Vector3d&)>;

constexpr double spacing = 0.1;
constexpr double error = 0.005;

/// A box around the origin, of so many cells per axis.
NodeLattice boxLattice(int x, int y, int z)
{
  NodeLattice lattice;
  const std::array<int, 3> cells{ { x, y, z } };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i <= cells[axis]; ++i)
    {
      lattice.planes[axis].push_back(spacing * (i - 0.5 * cells[axis]));
    }
  }
  return lattice;
}

CappedSurface contourOf(const NodeLattice& lattice, const Field& field)
{
  const Vector3d first(lattice.planes[0].front(), lattice.planes[1].front(), lattice.planes[2].front());
  return contour(
    lattice, allBlocks(lattice), sampled([&](int i, int j, int k) { return field(first + spacing * Vector3d(i, j, k)); }));
}

SurfaceDecimationOptions optionsFor(const Field& field)
{
  SurfaceDecimationOptions options;
  options.field = field;
  options.maximumError = error;
  return options;
}

/// Depth in a tube along z that winds about a line.
double windingTube(const Vector3d& p)
{
  const double x = 0.1 * p.z() + 0.05 * std::sin(p.z());
  return 0.6001 - std::hypot(p.x() - x, p.y() - 0.05 * std::cos(p.z())); // and nowhere 0 at a node
}

/// Points less edges plus triangles.
std::ptrdiff_t eulerCharacteristic(const TriangleMesh& mesh)
{
  return std::ptrdiff_t(mesh.points.size()) - std::ptrdiff_t(mesh.triangles.size()) / 2;
}

void expectOnFaces(const CappedSurface& surface)
{
  ASSERT_EQ(surface.faces.size(), surface.mesh.points.size());
  for (std::size_t p = 0; p < surface.faces.size(); ++p)
  {
    for (Eigen::Index axis = 0; axis < 3; ++axis)
    {
      const double x = surface.mesh.points[p][axis];
      EXPECT_EQ(x == surface.box.min()[axis], ((surface.faces[p] >> (2 * axis)) & 1) != 0);
      EXPECT_EQ(x == surface.box.max()[axis], ((surface.faces[p] >> (2 * axis)) & 2) != 0);
    }
  }
}

TEST(BandCoarsening, MakesLongTrianglesOfATube)
{
  const NodeLattice lattice = boxLattice(20, 20, 80);
  const CappedSurface fine = contourOf(lattice, windingTube);
  CappedSurface surface = fine;
  coarsenBands(surface, lattice, optionsFor(windingTube));
  const SurfaceReport report = checkSurface(surface.mesh);
  EXPECT_TRUE(report.closedManifold() && report.outward());
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(eulerCharacteristic(surface.mesh), 2);
  EXPECT_LT(3 * surface.mesh.triangles.size(), fine.mesh.triangles.size());
  EXPECT_NEAR(report.volume, checkSurface(fine.mesh).volume, 2.0 * pi * 0.6 * 8.0 * 0.4 * error);
  expectOnFaces(surface);
  for (const auto& t : surface.mesh.triangles)
  {
    const auto at = [&](std::size_t i) { return surface.mesh.points[std::size_t(t[i])]; };
    if (!surface.isCap(t))
    {
      for (std::size_t i = 0; i < 3; ++i)
      {
        EXPECT_LE(std::abs(windingTube(at(i))), 2.0 * error);
        EXPECT_LE(std::abs(windingTube(0.5 * (at(i) + at((i + 1) % 3)))), 2.0 * error);
      }
      EXPECT_LE(std::abs(windingTube((at(0) + at(1) + at(2)) / 3.0)), 2.0 * error);
    }
  }
}

TEST(BandCoarsening, GoesAlongEachAxis)
{
  for (Eigen::Index axis = 0; axis < 3; ++axis)
  {
    std::array<int, 3> cells{ { 20, 20, 20 } };
    cells[std::size_t(axis)] = 60;
    const NodeLattice lattice = boxLattice(cells[0], cells[1], cells[2]);
    const Field tube = [axis](const Vector3d& p)
    { return 0.6 - std::hypot(p[(axis + 1) % 3] - 0.1 * p[axis] - 0.013, p[(axis + 2) % 3] + 0.021); };
    const CappedSurface fine = contourOf(lattice, tube);
    CappedSurface surface = fine;
    coarsenBands(surface, lattice, optionsFor(tube));
    const SurfaceReport report = checkSurface(surface.mesh);
    EXPECT_TRUE(report.closedManifold() && report.outward());
    EXPECT_LT(5 * surface.mesh.triangles.size(), fine.mesh.triangles.size());
  }
}

TEST(BandCoarsening, KeepsWhatFacesCutOff)
{
  // Tubes along an edge of the box and along one of its faces: beside the caps at their ends they have caps along them.
  for (const Vector3d& line : { Vector3d(1.0, 0.2, 0.0), Vector3d(0.98, -0.97, 0.0), Vector3d(0.7, 0.0, 0.0) })
  {
    const NodeLattice lattice = boxLattice(20, 20, 60);
    const Field tube = [&line](const Vector3d& p)
    { return 0.6001 - std::hypot(p.x() - line.x() - 0.03 * std::sin(p.z()), p.y() - line.y()); };
    const CappedSurface fine = contourOf(lattice, tube);
    CappedSurface surface = fine;
    coarsenBands(surface, lattice, optionsFor(tube));
    const SurfaceReport report = checkSurface(surface.mesh);
    EXPECT_TRUE(report.closedManifold() && report.outward());
    EXPECT_EQ(eulerCharacteristic(surface.mesh), 2);
    EXPECT_LT(3 * surface.mesh.triangles.size(), fine.mesh.triangles.size());
    EXPECT_NEAR(report.volume, checkSurface(fine.mesh).volume, 2.0 * pi * 0.6 * 6.0 * error);
    expectOnFaces(surface);
  }
}

TEST(BandCoarsening, RefinesOnlyWhereTheFieldAsksForIt)
{
  // A straight tube, and one with a small bump on one side.
  const NodeLattice lattice = boxLattice(20, 20, 80);
  const Field plain = [](const Vector3d& p) { return 0.6001 - std::hypot(p.x() - 0.013, p.y() + 0.021); };
  const Field bumpy = [&plain](const Vector3d& p)
  { return plain(p) + 0.04 * std::exp(-(p - Vector3d(0.6, 0.0, 0.3)).squaredNorm() / 0.06); };
  std::array<std::size_t, 2> triangles{};
  std::array<std::size_t, 2> opposite{}; // of the points on the side opposite the bump
  for (std::size_t i = 0; i < 2; ++i)
  {
    const Field& field = i == 0 ? plain : bumpy;
    CappedSurface surface = contourOf(lattice, field);
    coarsenBands(surface, lattice, optionsFor(field));
    const SurfaceReport report = checkSurface(surface.mesh);
    EXPECT_TRUE(report.closedManifold() && report.outward());
    EXPECT_EQ(eulerCharacteristic(surface.mesh), 2);
    triangles[i] = surface.mesh.triangles.size();
    for (const auto& t : surface.mesh.triangles)
    {
      const auto at = [&](std::size_t k) { return surface.mesh.points[std::size_t(t[k])]; };
      const Vector3d middle = (at(0) + at(1) + at(2)) / 3.0;
      EXPECT_LE(surface.isCap(t) ? 0.0 : std::abs(field(middle)), 2.0 * error);
      opposite[i] += middle.x() < -0.3 && std::abs(middle.z() - 0.3) < 0.6 ? 1 : 0;
    }
  }
  EXPECT_GT(triangles[1], triangles[0]);
  // Rings all around the bump would be a quarter as long and so have four times as many there.
  EXPECT_LT(opposite[1], 2 * opposite[0]);
}

TEST(BandCoarsening, CutsCapsFromTheirRims)
{
  const NodeLattice lattice = boxLattice(20, 20, 60);
  const CappedSurface fine = contourOf(lattice, windingTube);
  CappedSurface surface = fine;
  coarsenBands(surface, lattice, optionsFor(windingTube));
  for (const std::uint8_t face : { std::uint8_t(1 << 4), std::uint8_t(2 << 4) })
  {
    const auto areaAndCount = [face](const CappedSurface& of)
    {
      std::pair<double, std::size_t> sum{ 0.0, 0 };
      for (const auto& t : of.mesh.triangles)
      {
        const auto at = [&](std::size_t k) { return of.mesh.points[std::size_t(t[k])]; };
        if ((of.faces[std::size_t(t[0])] & of.faces[std::size_t(t[1])] & of.faces[std::size_t(t[2])] & face) != 0)
        {
          const double area = 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).z();
          EXPECT_EQ(area > 0.0, face == 2 << 4); // outwards
          sum.first += std::abs(area);
          ++sum.second;
        }
      }
      return sum;
    };
    const auto points = std::count(surface.faces.begin(), surface.faces.end(), face);
    EXPECT_EQ(areaAndCount(surface).second, std::size_t(points - 2));
    EXPECT_LT(5 * areaAndCount(surface).second, areaAndCount(fine).second);
    EXPECT_NEAR(areaAndCount(surface).first, areaAndCount(fine).first, 2.0 * pi * 0.6 * error);
  }
}

TEST(BandCoarsening, KeepsHandlesAndBranches)
{
  // A ring with a tube through the box on either side: planes meet it in one loop, then in two, then in one again.
  const Field ringOnTube = [](const Vector3d& p)
  {
    const double along = std::hypot(p.x(), p.z()) - 1.0;
    const double ring = 0.3 - std::hypot(along, p.y());
    const double tube = std::abs(p.z()) > 1.0 ? 0.3 - std::hypot(p.x(), p.y()) : -1.0;
    return std::max(ring, tube) + 1e-4;
  };
  const NodeLattice lattice = boxLattice(30, 20, 60);
  const CappedSurface fine = contourOf(lattice, ringOnTube);
  ASSERT_EQ(eulerCharacteristic(fine.mesh), 0);
  CappedSurface surface = fine;
  coarsenBands(surface, lattice, optionsFor(ringOnTube));
  const SurfaceReport report = checkSurface(surface.mesh);
  EXPECT_TRUE(report.closedManifold() && report.outward());
  EXPECT_EQ(eulerCharacteristic(surface.mesh), 0);
  EXPECT_LT(surface.mesh.triangles.size(), fine.mesh.triangles.size());
  // Every triangle of the two arms is kept.
  const auto inTheMiddle = [](const CappedSurface& of)
  {
    return std::count_if(of.mesh.triangles.begin(), of.mesh.triangles.end(),
      [&](const auto& t) { return std::abs(of.mesh.points[std::size_t(t[0])].z()) < 0.5; });
  };
  EXPECT_EQ(inTheMiddle(surface), inTheMiddle(fine));
}

TEST(BandCoarsening, KeepsTheTopologyOfAnything)
{
  for (int seed = 0; seed < 40; ++seed)
  {
    const double a = 2.0 + 0.05 * seed;
    const double b = 0.3 * seed;
    const Field waves = [a, b](const Vector3d& p)
    {
      return 0.1 * (std::sin(a * p.x() + b) * std::cos(3.0 * p.y()) + std::sin(3.0 * p.y()) * std::cos(a * p.z() - b) +
                     std::sin(2.5 * p.z()) * std::cos(a * p.x())) +
             0.02;
    };
    const NodeLattice lattice = boxLattice(24, 24, 40);
    const CappedSurface fine = contourOf(lattice, waves);
    CappedSurface surface = fine;
    coarsenBands(surface, lattice, optionsFor(waves));
    EXPECT_TRUE(checkSurface(surface.mesh).closedManifold());
    EXPECT_EQ(eulerCharacteristic(surface.mesh), eulerCharacteristic(fine.mesh));
    expectOnFaces(surface);
  }
}

TEST(BandCoarsening, ChangesNothingWithoutAnErrorOrBands)
{
  const NodeLattice lattice = boxLattice(20, 20, 40);
  const CappedSurface fine = contourOf(lattice, windingTube);
  SurfaceDecimationOptions options = optionsFor(windingTube);
  options.maximumError = 0.0;
  CappedSurface surface = fine;
  coarsenBands(surface, lattice, options);
  EXPECT_EQ(surface.mesh.triangles, fine.mesh.triangles);

  const NodeLattice thin = boxLattice(2, 2, 2);
  const Field all = [](const Vector3d&) { return 1.0; };
  const CappedSurface box = contourOf(thin, all);
  surface = box;
  coarsenBands(surface, thin, optionsFor(all));
  EXPECT_EQ(surface.mesh.triangles, box.mesh.triangles);
  CappedSurface empty;
  coarsenBands(empty, thin, optionsFor(all));
  EXPECT_TRUE(empty.mesh.triangles.empty());
}

TEST(PlaneLoops, FindsLoopsRingsAndAnchors)
{
  const NodeLattice lattice = boxLattice(20, 20, 40);
  const CappedSurface tube = contourOf(lattice, windingTube);
  const PlaneLoops loops(tube, 2, lattice.planes[2]);
  ASSERT_EQ(loops.planeCount(), 41u);
  ASSERT_EQ(loops.bandCount(), 40u);
  for (std::size_t plane = 0; plane <= 40; ++plane)
  {
    // In the outermost planes it is the rim of the caps.
    const PlaneLoop& loop = loops.loop(plane);
    ASSERT_FALSE(loop.isEmpty());
    EXPECT_TRUE(loop.anchors.empty());
    double area = 0.0; // positive if counterclockwise
    for (std::size_t i = 0; i < loop.points.size(); ++i)
    {
      const Vector3d& p = tube.mesh.points[std::size_t(loop.points[i])];
      const Vector3d& q = tube.mesh.points[std::size_t(loop.points[(i + 1) % loop.points.size()])];
      EXPECT_EQ(p.z(), lattice.planes[2][plane]);
      area += 0.5 * (p.x() * q.y() - q.x() * p.y());
    }
    EXPECT_NEAR(area, pi * 0.36, 0.03);
    EXPECT_TRUE(plane == 40 || loops.isRing(plane));
  }

  const Field cutTube = [](const Vector3d& p) { return 0.6 - std::hypot(p.x() - 1.0, p.y() - 0.013); };
  const CappedSurface cut = contourOf(lattice, cutTube);
  const PlaneLoops cutLoops(cut, 2, lattice.planes[2]);
  for (std::size_t plane = 1; plane < 40; ++plane)
  {
    const PlaneLoop& loop = cutLoops.loop(plane);
    ASSERT_EQ(loop.anchors.size(), 2u); // where it reaches the face, and where it leaves it
    EXPECT_EQ(loop.anchors[0], 0u);
    for (const std::size_t anchor : loop.anchors)
    {
      EXPECT_NEAR(std::abs(cut.mesh.points[std::size_t(loop.points[anchor])].y() - 0.013), 0.6, 0.01);
    }
  }

  const Field twoTubes = [](const Vector3d& p)
  { return std::max(0.3 - std::hypot(p.x() - 0.5, p.y()), 0.3 - std::hypot(p.x() + 0.5, p.y())) + 1e-4; };
  const CappedSurface two = contourOf(lattice, twoTubes);
  const PlaneLoops twoLoops(two, 2, lattice.planes[2]);
  for (std::size_t plane = 0; plane < twoLoops.planeCount(); ++plane)
  {
    EXPECT_TRUE(twoLoops.loop(plane).isEmpty());
  }
}

// For a field that rises along the axis, the value in each band is known.
TEST(BandExcesses, AreTheLargestInEachBand)
{
  const NodeLattice lattice = boxLattice(20, 20, 40);
  const CappedSurface tube = contourOf(lattice, windingTube);
  const PlaneLoops loops(tube, 2, lattice.planes[2]);
  SurfaceDecimationOptions options = optionsFor([](const Vector3d& p) { return p.z(); });
  options.level = -1.0;
  const BandExcesses excesses(tube, loops, options);
  for (std::size_t band = loops.bandCount(); band-- > 0;)
  {
    const double lower = lattice.planes[2][band] - options.level;
    if (lower <= -spacing)
    {
      EXPECT_EQ(excesses.in(band), 0.0);
    }
    else if (lower >= 0.0)
    {
      // Middles of triangles, some of which reach from plane to plane.
      EXPECT_GT(excesses.in(band), lower + 0.5 * spacing);
      EXPECT_LT(excesses.in(band), lower + spacing);
    }
  }
}

} // namespace
