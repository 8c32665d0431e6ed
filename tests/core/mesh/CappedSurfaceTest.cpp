// SPDX-License-Identifier: BSD-3-Clause
// Guarantees: a surface is moved to just the volume asked for, by no more than allowed, and its caps stay in their faces.
// What is coarsened or moved beside a face of the box stays in the box.
#include "mesh/CappedSurface.h"
#include "base/Constants.h"
#include "mesh/ExampleContours.h"
#include "mesh/SurfaceCheck.h"
#include "mesh/SurfaceDecimation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace cactus;
using example::ballInBox;

using cactus::pi;

TEST(CappedSurface, MeasuresVolumeAndFreeArea)
{
  const SurfaceMeasure half = measure(ballInBox({ 1, 0, 0 }));
  EXPECT_NEAR(half.volume, 2.0 / 3.0 * pi * 0.512, 0.005);
  EXPECT_NEAR(half.freeArea, 2.0 * pi * 0.64, 0.02);
}

TEST(CappedSurface, IsMovedToItsVolume)
{
  for (const double factor : { 0.99, 1.004 })
  {
    CappedSurface surface = ballInBox({ 1, 0, 0 });
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
  CappedSurface surface = ballInBox({ 1, 0, 0 });
  const SurfaceMeasure before = measure(surface);
  EXPECT_EQ(moveToVolume(surface, 2.0 * before.volume, 0.003), 0.003);
  EXPECT_NEAR(measure(surface).volume, before.volume + 0.003 * before.freeArea, 1e-3);
  EXPECT_EQ(moveToVolume(surface, 0.1, 0.002), -0.002);
}

TEST(CappedSurface, StaysInTheBoxWhereItGrazesAFace)
{
  // Just cut off, just not, and with a vertex of the coarsened ball beyond the face where nothing held it back.
  for (const double x : { 0.19, 0.197, 0.199, 0.2003, 0.203 })
  {
    const Eigen::Vector3d centre(x, 0.01, -0.02);
    CappedSurface surface = ballInBox(centre);
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
