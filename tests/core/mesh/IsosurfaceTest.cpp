// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: whatever the field, its contour is a closed, outward 2-manifold that does not cut itself, on the field's zero to
// third order, flat on the box.
#include "mesh/Isosurface.h"
#include "Sanitized.h"
#include "base/Constants.h"
#include "base/Error.h"
#include "base/Random.h"
#include "mesh/ExampleContours.h"
#include "mesh/SurfaceCheck.h"
#include "mesh/SurfaceIntersection.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace cactus;
using namespace example;

using cactus::pi;

double noise(std::uint64_t seed, int i, int j, int k)
{
  RandomEngine engine = randomStream(
    seed, RandomStage::Seeds, std::uint64_t(i + 50) + 1000 * std::uint64_t(j + 50) + 1000000 * std::uint64_t(k + 50));
  return 2.0 * uniform(engine) - 1.0;
}

TEST(Isosurface, NoiseGivesClosedManifolds)
{
  for (std::uint64_t seed = 1; seed <= std::uint64_t(fewerWhereSanitized(20)); ++seed)
  {
    // Noise has all possible ambiguous cells; with more than one block, and up to the faces.
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

TEST(Isosurface, GoesThroughNodesWhereTheFieldIsZero)
{
  // An octahedron with its corners, and nodes along its edges and faces.
  const NodeLattice lattice = cubeLattice(18, 0.25);
  const CappedSurface surface = contour(lattice, allBlocks(lattice),
    sampled([](int i, int j, int k) { return 4.0 - std::abs(i - 9) - std::abs(j - 9) - std::abs(k - 9); }));
  const SurfaceReport report = checkSurface(surface.mesh);
  EXPECT_TRUE(report.closedManifold());
  EXPECT_NEAR(report.volume, 4.0 / 3.0, 1e-6);
  const Eigen::Vector3d middle(lattice.planes[0][9], lattice.planes[1][9], lattice.planes[2][9]);
  for (const Eigen::Vector3d& point : surface.mesh.points)
  {
    EXPECT_NEAR((point - middle).lpNorm<1>(), 1.0, 1e-6);
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

} // namespace
