// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: whatever the field, its contour is a closed, outward 2-manifold that does not cut itself, on the field's zero to
// third order, flat on the box.
#include "mesh/Isosurface.h"
#include "base/Constants.h"
#include "base/Error.h"
#include "base/Random.h"
#include "mesh/SurfaceCheck.h"
#include "mesh/SurfaceDecimation.h"
#include "mesh/SurfaceIntersection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <numeric>

namespace
{

using namespace cactus;

using cactus::pi;

NodeLattice cubeLattice(int nodes, double spacing)
{
  NodeLattice lattice;
  for (auto& planes : lattice.planes)
  {
    for (int i = 0; i < nodes; ++i)
    {
      planes.push_back(spacing * (i - 0.5 * (nodes - 1)));
    }
  }
  return lattice;
}

std::vector<std::uint32_t> allBlocks(const NodeLattice& lattice)
{
  std::vector<std::uint32_t> blocks(lattice.blockCount());
  std::iota(blocks.begin(), blocks.end(), 0u);
  return blocks;
}

/// Values of a function of the nodes' numbers.
std::function<void(const NodeRange&, float*)> sampled(const std::function<double(int, int, int)>& field)
{
  return [field](const NodeRange& range, float* out)
  {
    for (int k = 0; k < range.count[2]; ++k)
    {
      for (int j = 0; j < range.count[1]; ++j)
      {
        for (int i = 0; i < range.count[0]; ++i)
        {
          *out++ = static_cast<float>(field(range.first[0] + i, range.first[1] + j, range.first[2] + k));
        }
      }
    }
  };
}

double noise(std::uint64_t seed, int i, int j, int k)
{
  RandomEngine engine = randomStream(
    seed, RandomStage::Seeds, std::uint64_t(i + 50) + 1000 * std::uint64_t(j + 50) + 1000000 * std::uint64_t(k + 50));
  return 2.0 * uniform(engine) - 1.0;
}

double sphereDepth(const Eigen::Vector3d& p, double radius)
{
  return radius - (p - Eigen::Vector3d(0.013, -0.021, 0.007)).norm();
}

CappedSurface sphere(double radius, double spacing, int nodes)
{
  const NodeLattice lattice = cubeLattice(nodes, spacing);
  const double half = 0.5 * (nodes - 1);
  return contour(lattice, allBlocks(lattice),
    sampled([=](int i, int j, int k) { return sphereDepth(spacing * Eigen::Vector3d(i - half, j - half, k - half), radius); }));
}

TEST(Isosurface, NoiseGivesClosedManifolds)
{
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    // Noise has all ambiguous cells there are; of more than one block, and up to the faces.
    const NodeLattice lattice = cubeLattice(19 + int(seed % 3), 0.1);
    const CappedSurface surface =
      contour(lattice, allBlocks(lattice), sampled([seed](int i, int j, int k) { return noise(seed, i, j, k) - 0.1; }));
    const SurfaceReport report = checkSurface(surface.mesh);
    EXPECT_GT(report.triangles, 10000u);
    EXPECT_EQ(report.openEdges, 0u);
    EXPECT_EQ(report.crowdedEdges, 0u);
    EXPECT_EQ(report.flippedEdges, 0u);
    EXPECT_EQ(report.pinchedPoints, 0u);
    EXPECT_GT(report.volume, 0.0);
    EXPECT_EQ(report.points, surface.mesh.points.size());
    const auto cuts = selfIntersections(TriangleTree(surface.mesh));
    EXPECT_TRUE(cuts.empty()) << cuts.size() << " of " << report.triangles;
  }
}

TEST(Isosurface, FieldThatIsPositiveEverywhereGivesTheBox)
{
  const NodeLattice lattice = cubeLattice(18, 0.25);
  const CappedSurface surface = contour(lattice, allBlocks(lattice), sampled([](int, int, int) { return 1.0; }));
  const SurfaceReport report = checkSurface(surface.mesh);
  EXPECT_TRUE(report.closedManifold());
  EXPECT_NEAR(report.volume, std::pow(4.25, 3), 1e-9);
  EXPECT_NEAR(report.area, 6 * 4.25 * 4.25, 1e-9);
  for (std::size_t p = 0; p < surface.mesh.points.size(); ++p)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      EXPECT_EQ((surface.faces[p] >> (2 * axis)) & 1, surface.mesh.points[p][axis] == lattice.planes[std::size_t(axis)].front());
      EXPECT_EQ(
        (surface.faces[p] >> (2 * axis + 1)) & 1, surface.mesh.points[p][axis] == lattice.planes[std::size_t(axis)].back());
    }
  }
}

TEST(Isosurface, LiesOnASphereToThirdOrder)
{
  double worst[2] = { 0.0, 0.0 };
  for (int finer = 0; finer < 2; ++finer)
  {
    const double spacing = finer ? 0.05 : 0.1;
    const CappedSurface surface = sphere(0.5, spacing, finer ? 33 : 17);
    const SurfaceReport report = checkSurface(surface.mesh);
    EXPECT_TRUE(report.closedManifold() && report.outward());
    EXPECT_EQ(report.components, 1u);
    for (const auto& p : surface.mesh.points)
    {
      worst[finer] = std::max(worst[finer], std::abs(sphereDepth(p, 0.5)));
    }
  }
  // Linear interpolation would be off by up to 3 · 0.1² / (8 · 0.5) = 0.0075.
  EXPECT_LT(worst[0], 0.0015);
  EXPECT_LT(worst[1], worst[0] / 5.0);
}

TEST(Isosurface, FindsTheSameInTheBlocksThatMatterAsInAll)
{
  const NodeLattice lattice = cubeLattice(50, 0.1);
  const auto values =
    sampled([](int i, int j, int k) { return 0.6 - 0.1 * (Eigen::Vector3d(i, j, k) - Eigen::Vector3d(20, 9, 33)).norm(); });
  const CappedSurface all = contour(lattice, allBlocks(lattice), values);
  std::vector<std::uint32_t> some;
  for (std::uint32_t block = 0; block < lattice.blockCount(); ++block)
  {
    const NodeRange range = nodesOfBlock(lattice, block);
    std::vector<float> buffer(range.size());
    values(range, buffer.data());
    if (*std::max_element(buffer.begin(), buffer.end()) > 0.0f)
    {
      some.push_back(block);
    }
  }
  EXPECT_LT(some.size(), lattice.blockCount());
  const CappedSurface part = contour(lattice, some, values);
  EXPECT_EQ(part.mesh.triangles, all.mesh.triangles);
  EXPECT_TRUE(checkSurface(part.mesh).closedManifold());
}

TEST(Isosurface, RefusesALatticeThatIsNone)
{
  NodeLattice lattice = cubeLattice(5, 0.1);
  lattice.planes[1][2] = lattice.planes[1][3];
  const auto values = sampled([](int, int, int) { return 1.0; });
  EXPECT_THROW(contour(lattice, { 0 }, values), InvalidInput);
  EXPECT_THROW(contour(cubeLattice(5, 0.1), { 1 }, values), InvalidInput);
}

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
    EXPECT_LT(report.largestSquaredEdgeRatio, 1000.0);
    EXPECT_LT(report.triangles, before);
    EXPECT_NEAR(report.volume, 4.0 / 3.0 * pi, 4.0 * pi * std::max(error, 0.0025));
    for (const auto& p : surface.mesh.points)
    {
      // Where triangles of the contour cut corners off the sphere by more than the error, that may stay so: √2 · 0.1 long, they
      // do by up to 0.0025.
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

} // namespace
