// SPDX-License-Identifier: BSD-3-Clause
// Guarantees: a surface is moved to exactly the requested volume, by no more than allowed, and its caps stay in their faces. A
// surface that is coarsened, moved or rounded beside a face of the box stays in the box.
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
  // Just cut off, just not, and with a vertex of the coarsened ball beyond the face if nothing held it back.
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

// Faces need not be numbers in single precision.
TEST(CappedSurface, IsRoundedToWhatFilesHold)
{
  const Eigen::AlignedBox3d box(Eigen::Vector3d(-0.1, 0.3, 0.0), Eigen::Vector3d(22.3, 22.7, 16.0));
  ASSERT_LT(double(-0.1F), -0.1) << "rounding leaves the box";
  TriangleMesh mesh;
  mesh.points = { { -0.1, 0.3, 0.0 }, { 22.3, 22.7, 16.0 }, { std::nextafter(-0.1, 1.0), 1.0 / 3.0, 1e-9 / 3.0 },
    { 22.3, 8.5, 16.0 / 3.0 }, { -0.3, 23.1, 16.1 } };
  TriangleMesh rounded = mesh;
  roundPoints(rounded, box);
  EXPECT_EQ(rounded.points[0], mesh.points[0]);
  EXPECT_EQ(rounded.points[1], mesh.points[1]);
  EXPECT_EQ(rounded.points[2], Eigen::Vector3d(-0.1, double(1.0F / 3.0F), double(float(1e-9 / 3.0))));
  EXPECT_EQ(rounded.points[3], Eigen::Vector3d(22.3, 8.5, double(16.0F / 3.0F)));
  EXPECT_FALSE(isInSinglePrecision(rounded)) << "faces of the box";
  // Without a box, and beyond it, like surfaces that are not clipped.
  TriangleMesh free = mesh;
  roundPoints(free, {});
  EXPECT_TRUE(isInSinglePrecision(free));
  EXPECT_EQ(free.points[4], Eigen::Vector3d(double(-0.3F), double(23.1F), double(16.1F)));
  EXPECT_EQ(inSinglePrecision(mesh).points, free.points);
}

// Each coordinate, for meshes of any number of points: a compiler may omit some of a vector's.
TEST(CappedSurface, IsRoundedWhateverItsSize)
{
  for (int count = 1; count < 20; ++count)
  {
    TriangleMesh mesh;
    for (int i = 0; i < count; ++i)
    {
      mesh.points.emplace_back((i + 1) / 23.0, -(i + 1) / 29.0, (i + 1) / 31.0);
    }
    TriangleMesh moved = mesh;
    roundPoints(moved, {});
    const TriangleMesh written = inSinglePrecision(mesh);
    EXPECT_EQ(written.points, moved.points);
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
    {
      for (Eigen::Index axis = 0; axis < 3; ++axis)
      {
        EXPECT_NE(written.points[i][axis], mesh.points[i][axis]) << count;
        EXPECT_EQ(float(written.points[i][axis]), float(mesh.points[i][axis])) << count;
      }
    }
    EXPECT_TRUE(isInSinglePrecision(written));
    EXPECT_FALSE(isInSinglePrecision(mesh));
  }
}

} // namespace
