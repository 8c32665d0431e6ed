// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: no triangle is left too long for its width, and the surface keeps its shape.
#include "mesh/NeedleSplitting.h"
#include "mesh/ExampleContours.h"
#include "mesh/SurfaceCheck.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace cactus;
using example::ballInBox;

TEST(NeedleSplitting, SplitsNeedlesAndKeepsTheShape)
{
  CappedSurface surface = ballInBox({ 1, 0, 0 });
  // Makes a short edge in its middle: one end of an edge is moved to the other.
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

} // namespace
