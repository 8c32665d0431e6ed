// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: collapses and flips of edges leave a closed, outward 2-manifold of the same topology; a surface that is not closed
// is refused, without an endless search.
#include "mesh/EditableSurface.h"
#include "ExampleSurfaces.h"
#include "mesh/SurfaceCheck.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

namespace
{

using namespace cactus;

CappedSurface tube()
{
  CappedSurface surface;
  surface.mesh = example::tube(0.0, 0.0, 1.0, 0.0, 5.0);
  surface.faces.assign(surface.mesh.points.size(), 0);
  return surface;
}

TEST(EditableSurface, StaysClosedThroughCollapsesAndFlips)
{
  CappedSurface surface = tube();
  const std::size_t before = surface.mesh.triangles.size();
  EditableSurface mesh(surface);
  std::mt19937 random(1);
  std::size_t collapses = 0;
  std::size_t flips = 0;
  for (int round = 0; round < 3000; ++round)
  {
    const std::size_t t = random() % mesh.triangleCount();
    if (mesh.isDead(t))
    {
      continue;
    }
    const std::int32_t a = mesh.cornersOf(t)[0];
    const std::int32_t b = mesh.cornersOf(t)[1];
    const std::size_t other = mesh.triangleAlong(b, a);
    const std::int32_t c = mesh.thirdCorner(t, a, b);
    const std::int32_t d = mesh.thirdCorner(other, a, b);
    ASSERT_NE(t, other);
    ASSERT_NE(c, d);
    ASSERT_TRUE(mesh.areLinked(a, b) && mesh.areLinked(a, c) && mesh.areLinked(b, d));
    if (round % 4 != 0)
    {
      if (!mesh.areLinked(c, d))
      {
        mesh.flip(t, other, a, b);
        ++flips;
        ASSERT_TRUE(mesh.areLinked(c, d));
        ASSERT_FALSE(mesh.areLinked(a, b));
      }
    }
    else if (mesh.isCollapsible(a, b))
    {
      mesh.collapse(a, b, 0.5 * (mesh.at(a) + mesh.at(b)));
      ++collapses;
      ASSERT_TRUE(mesh.isDeadPoint(b));
    }
  }
  EXPECT_GT(collapses, 200u);
  EXPECT_GT(flips, 200u);
  EXPECT_EQ(mesh.aliveCount(), before - 2 * collapses);
  mesh.compact();
  EXPECT_EQ(surface.mesh.triangles.size(), before - 2 * collapses);
  // Whatever the shape has become, every edge has two triangles and Euler's characteristic is that of a sphere.
  const SurfaceReport report = checkSurface(surface.mesh);
  EXPECT_EQ(report.openEdges, 0u);
  EXPECT_EQ(report.crowdedEdges, 0u);
  EXPECT_EQ(report.pinchedPoints, 0u);
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(2 * surface.mesh.points.size(), surface.mesh.triangles.size() + 4);
}

TEST(EditableSurface, FlippingTwiceTurnsAnEdgeBack)
{
  CappedSurface surface = tube();
  const double volume = checkSurface(surface.mesh).volume;
  EditableSurface mesh(surface);
  const std::int32_t a = mesh.cornersOf(0)[0];
  const std::int32_t b = mesh.cornersOf(0)[1];
  const std::size_t other = mesh.triangleAlong(b, a);
  const std::int32_t c = mesh.thirdCorner(0, a, b);
  const std::int32_t d = mesh.thirdCorner(other, a, b);
  mesh.flip(0, other, a, b);
  mesh.flip(0, other, d, c);
  EXPECT_TRUE(mesh.areLinked(a, b));
  EXPECT_FALSE(mesh.areLinked(c, d));
  mesh.compact();
  const SurfaceReport report = checkSurface(surface.mesh);
  EXPECT_TRUE(report.closedManifold() && report.outward());
  EXPECT_NEAR(report.volume, volume, 1e-12);
}

TEST(EditableSurface, SaysWhereASurfaceIsOpen)
{
  CappedSurface surface = tube();
  const std::array<std::int32_t, 3> gone = surface.mesh.triangles.back();
  surface.mesh.triangles.pop_back();
  const EditableSurface mesh(surface);
  EXPECT_NO_THROW(mesh.triangleAlong(gone[1], gone[0]));
  EXPECT_THROW(mesh.triangleAlong(gone[0], gone[1]), std::logic_error);
}

} // namespace
