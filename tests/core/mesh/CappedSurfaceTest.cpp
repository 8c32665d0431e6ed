// SPDX-License-Identifier: BSD-3-Clause
// Guarantees: a surface is moved to just the volume asked for, by no more than allowed, and its caps stay in their faces.
// What is coarsened or moved beside a face of the box stays in the box.
#include "mesh/CappedSurface.h"
#include "base/Constants.h"
#include "mesh/Isosurface.h"
#include "mesh/SurfaceCheck.h"
#include "mesh/SurfaceDecimation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace
{

using namespace cactus;

using cactus::pi;

/// The parts of a ball of radius 0.8 around `centre` and of a small ball that lie in the box [-1, 1]³.
CappedSurface ball(
  const Eigen::Vector3d& centre, const Eigen::Vector3d& smallCentre = Eigen::Vector3d::Zero(), double smallRadius = -1.0)
{
  NodeLattice lattice;
  for (auto& planes : lattice.planes)
  {
    for (int i = 0; i <= 40; ++i)
    {
      planes.push_back(-1.0 + 0.05 * i);
    }
  }
  std::vector<std::uint32_t> blocks(lattice.blockCount());
  std::iota(blocks.begin(), blocks.end(), 0u);
  return contour(lattice, blocks,
    [&](const NodeRange& range, float* out)
    {
      for (int k = 0; k < range.count[2]; ++k)
      {
        for (int j = 0; j < range.count[1]; ++j)
        {
          for (int i = 0; i < range.count[0]; ++i, ++out)
          {
            const Eigen::Vector3d p = Eigen::Vector3d::Constant(-1.0) +
                                      0.05 * Eigen::Vector3d(range.first[0] + i, range.first[1] + j, range.first[2] + k);
            const double big = 0.8 - (p - centre).norm();
            const double small = smallRadius - (p - smallCentre).norm();
            *out = static_cast<float>(std::max(big, small) + 1e-5);
          }
        }
      }
    });
}

TEST(CappedSurface, MeasuresVolumeAndFreeArea)
{
  const SurfaceMeasure half = measure(ball({ 1, 0, 0 }));
  EXPECT_NEAR(half.volume, 2.0 / 3.0 * pi * 0.512, 0.005);
  EXPECT_NEAR(half.freeArea, 2.0 * pi * 0.64, 0.02);
}

TEST(CappedSurface, IsMovedToItsVolume)
{
  for (const double factor : { 0.99, 1.004 })
  {
    CappedSurface surface = ball({ 1, 0, 0 });
    const SurfaceMeasure before = measure(surface);
    const double wanted = factor * before.volume;
    const double moved = moveToVolume(surface, wanted, 0.1);
    EXPECT_NEAR(measure(surface).volume, wanted, 1e-6);
    EXPECT_NEAR(moved, (factor - 1.0) * before.volume / before.freeArea, 1e-4);
    const SurfaceReport report = checkSurface(surface.mesh);
    EXPECT_TRUE(report.closedManifold());
    EXPECT_TRUE(report.outward());
    for (std::size_t p = 0; p < surface.mesh.points.size(); ++p)
    {
      const Eigen::Vector3d& point = surface.mesh.points[p];
      if ((surface.faces[p] & 2) != 0)
      {
        EXPECT_EQ(point[0], 1.0);
      }
      else
      {
        EXPECT_NEAR((point - Eigen::Vector3d(1, 0, 0)).norm(), 0.8 + moved, 2e-3);
      }
    }
  }
}

TEST(CappedSurface, MovesNoFartherThanAllowed)
{
  CappedSurface surface = ball({ 1, 0, 0 });
  const SurfaceMeasure before = measure(surface);
  EXPECT_EQ(moveToVolume(surface, 2.0 * before.volume, 0.003), 0.003);
  EXPECT_NEAR(measure(surface).volume, before.volume + 0.003 * before.freeArea, 1e-3);
  EXPECT_EQ(moveToVolume(surface, 0.1, 0.002), -0.002);
}

TEST(CappedSurface, KeepsItsMainPart)
{
  CappedSurface two = ball({ 1, 0, 0 }, { -0.7, -0.7, -0.7 }, 0.2);
  const CappedSurface one = ball({ 1, 0, 0 });
  EXPECT_EQ(checkSurface(two.mesh).components, 2u);
  EXPECT_NEAR(keepMainPart(two), 4.0 / 3.0 * pi * 0.008, 2e-3);
  EXPECT_EQ(two.mesh.triangles.size(), one.mesh.triangles.size());
  EXPECT_EQ(two.faces, one.faces);
  EXPECT_EQ(measure(two).volume, measure(one).volume);
  EXPECT_EQ(keepMainPart(two), 0.0);
}

TEST(CappedSurface, PiecesCutOffByTheSameFaceBelongTogether)
{
  // A bump on the same face belongs to the half ball, unless it is too small; one on the opposite face does not.
  const double bump = 2.0 / 3.0 * pi * 0.008;
  CappedSurface same = ball({ 1, 0, 0 }, { 1, 0.97, 0.97 }, 0.2);
  EXPECT_EQ(checkSurface(same.mesh).components, 2u);
  EXPECT_EQ(keepMainPart(same), 0.0);
  EXPECT_EQ(checkSurface(same.mesh).components, 2u);
  CappedSurface copy = same;
  EXPECT_GT(keepMainPart(copy, 10.0), 0.0);
  EXPECT_EQ(checkSurface(copy.mesh).components, 1u); // the larger one stays, however small
  EXPECT_GT(keepMainPart(same, bump), 0.0);
  EXPECT_EQ(checkSurface(same.mesh).components, 1u);
  CappedSurface opposite = ball({ 1, 0, 0 }, { -1, 0, 0 }, 0.2);
  EXPECT_EQ(checkSurface(opposite.mesh).components, 1u + 1u);
  EXPECT_NEAR(keepMainPart(opposite), bump, 2e-3);
  EXPECT_EQ(checkSurface(opposite.mesh).components, 1u);
}

TEST(CappedSurface, SplitsNeedles)
{
  CappedSurface surface = ball({ 1, 0, 0 });
  // A short edge amid it: one end of an edge is drawn to the other.
  auto& points = surface.mesh.points;
  const auto t = surface.mesh.triangles[surface.mesh.triangles.size() / 2];
  points[std::size_t(t[0])] += 0.999 * (points[std::size_t(t[1])] - points[std::size_t(t[0])]);
  const SurfaceReport before = checkSurface(surface.mesh);
  ASSERT_GT(before.largestSquaredEdgeRatio, 1e5);
  splitNeedles(surface, 800.0);
  const SurfaceReport after = checkSurface(surface.mesh);
  EXPECT_LE(after.largestSquaredEdgeRatio, 800.0);
  EXPECT_TRUE(after.closedManifold());
  EXPECT_NEAR(after.volume, before.volume, 1e-12);
  EXPECT_NEAR(after.area, before.area, 1e-9);
  EXPECT_LT(after.triangles, before.triangles + 500);
  ASSERT_EQ(surface.faces.size(), points.size());
  for (std::size_t p = 0; p < points.size(); ++p)
  {
    EXPECT_EQ((surface.faces[p] & 2) != 0, points[p][0] == 1.0);
  }
}

TEST(CappedSurface, StaysInTheBoxWhereItGrazesAFace)
{
  // Just cut off, just not, and with a vertex of the coarsened ball beyond the face where nothing held it back.
  for (const double x : { 0.19, 0.197, 0.199, 0.2003, 0.203 })
  {
    const Eigen::Vector3d centre(x, 0.01, -0.02);
    CappedSurface surface = ball(centre);
    SurfaceDecimationOptions options;
    options.field = [&centre](const Eigen::Vector3d& p) { return 0.8 - (p - centre).norm(); };
    options.maximumError = 0.02;
    decimate(surface, options);
    moveToVolume(surface, 10.0, 0.01);
    ASSERT_TRUE(checkSurface(surface.mesh).closedManifold());
    for (std::size_t p = 0; p < surface.mesh.points.size(); ++p)
    {
      const double fromFace = 1.0 - surface.mesh.points[p][0];
      EXPECT_TRUE(surface.faces[p] != 0 ? fromFace == 0.0 : fromFace > 0.0) << x << ": " << fromFace;
    }
  }
}

} // namespace
