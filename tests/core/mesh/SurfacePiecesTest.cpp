// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: for a surface in pieces, exactly those that belong to it stay, whole, and the removed volume is counted.
#include "mesh/SurfacePieces.h"
#include "base/Constants.h"
#include "mesh/ExampleContours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace
{

using namespace cactus;
using example::ballInBox;

TEST(SurfacePieces, KeepsItsMainPart)
{
  CappedSurface two = ballInBox({ 1, 0, 0 }, { -0.7, -0.7, -0.7 }, 0.2);
  const CappedSurface one = ballInBox({ 1, 0, 0 });
  EXPECT_EQ(checkSurface(two.mesh).components, 2u);
  EXPECT_NEAR(keepMainPart(two), 4.0 / 3.0 * pi * 0.008, 2e-3);
  EXPECT_EQ(two.mesh.triangles.size(), one.mesh.triangles.size());
  EXPECT_EQ(two.faces, one.faces);
  EXPECT_EQ(measure(two).volume, measure(one).volume);
  EXPECT_EQ(keepMainPart(two), 0.0);
}

TEST(SurfacePieces, PiecesCutOffByTheSameFaceBelongTogether)
{
  // A bump on the same face belongs to the half ball, unless it is too small; one on the opposite face does not.
  const double bump = 2.0 / 3.0 * pi * 0.008;
  CappedSurface same = ballInBox({ 1, 0, 0 }, { 1, 0.97, 0.97 }, 0.2);
  EXPECT_EQ(checkSurface(same.mesh).components, 2u);
  EXPECT_EQ(keepMainPart(same), 0.0);
  EXPECT_EQ(checkSurface(same.mesh).components, 2u);
  CappedSurface copy = same;
  EXPECT_GT(keepMainPart(copy, 10.0), 0.0);
  EXPECT_EQ(checkSurface(copy.mesh).components, 1u); // the larger one stays, however small
  EXPECT_GT(keepMainPart(same, bump), 0.0);
  EXPECT_EQ(checkSurface(same.mesh).components, 1u);
  CappedSurface opposite = ballInBox({ 1, 0, 0 }, { -1, 0, 0 }, 0.2);
  EXPECT_EQ(checkSurface(opposite.mesh).components, 1u + 1u);
  EXPECT_NEAR(keepMainPart(opposite), bump, 2e-3);
  EXPECT_EQ(checkSurface(opposite.mesh).components, 1u);
}

TEST(SurfacePieces, InsideOutPiecesGo)
{
  // Two balls, the small one inside out; and then both.
  CappedSurface two = ballInBox(Eigen::Vector3d::Zero(), { -0.9, -0.9, -0.9 }, 0.2);
  const SurfaceReport before = checkSurface(two.mesh);
  ASSERT_EQ(before.components, 2u);
  std::vector<std::uint32_t> pieceOf;
  checkSurface(two.mesh, &pieceOf);
  const std::size_t sizes[2] = { std::size_t(std::count(pieceOf.begin(), pieceOf.end(), 0u)),
    std::size_t(std::count(pieceOf.begin(), pieceOf.end(), 1u)) };
  const std::uint32_t small = sizes[0] < sizes[1] ? 0 : 1;
  for (std::size_t t = 0; t < pieceOf.size(); ++t)
  {
    if (pieceOf[t] == small)
    {
      std::swap(two.mesh.triangles[t][0], two.mesh.triangles[t][1]);
    }
  }
  TriangleMesh mesh = two.mesh;
  double dropped = 0.0;
  const SurfaceReport after = keepSoundPieces(mesh, dropped);
  EXPECT_TRUE(after.sound());
  EXPECT_EQ(after.components, 1u);
  EXPECT_EQ(mesh.triangles.size(), std::max(sizes[0], sizes[1]));
  EXPECT_GT(dropped, 0.0);
  EXPECT_NEAR(after.volume - dropped, checkSurface(two.mesh).volume, 1e-9);

  for (auto& triangle : mesh.triangles)
  {
    std::swap(triangle[0], triangle[1]);
  }
  EXPECT_FALSE(keepSoundPieces(mesh, dropped).sound());
  EXPECT_TRUE(mesh.triangles.empty());
}

} // namespace
