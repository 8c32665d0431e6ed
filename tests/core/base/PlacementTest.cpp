// SPDX-License-Identifier: BSD-3-Clause
#include "base/Placement.h"

#include "base/Error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

cactus::PlacementOptions oblique()
{
  cactus::PlacementOptions options;
  options.positionX = -71.25;
  options.positionY = 1204.5;
  options.positionZ = 3.0;
  options.rotationX = 20.0;
  options.rotationY = -130.0;
  options.rotationZ = 75.0;
  options.scaleFactor = 2.0;
  return options;
}

TEST(Placement, OfNothingMakesMillimetres)
{
  const Eigen::Vector3d placed = cactus::PlacementOptions().placement().toImage({ 1.0, -2.0, 3.5 });
  EXPECT_EQ(placed, Eigen::Vector3d(0.001, -0.002, 0.0035));
}

TEST(Placement, TurnsAboutYThenXThenZ)
{
  cactus::PlacementOptions options;
  options.rotationY = 90.0; // z to x
  options.rotationX = 90.0; // y to z
  EXPECT_LT((options.placement().toImage({ 0.0, 0.0, 1000.0 }) - Eigen::Vector3d(1.0, 0.0, 0.0)).norm(), 1e-14);
  EXPECT_LT((options.placement().toImage({ 1000.0, 0.0, 0.0 }) - Eigen::Vector3d(0.0, 1.0, 0.0)).norm(), 1e-14);
  options.rotationZ = 90.0; // x to y
  EXPECT_LT((options.placement().toImage({ 0.0, 0.0, 1000.0 }) - Eigen::Vector3d(0.0, 1.0, 0.0)).norm(), 1e-14);
}

TEST(Placement, IsTakenBackToWhatLayInAFace)
{
  const cactus::Placement placement = oblique().placement();
  for (int i = 0; i < 1000; ++i)
  {
    const Eigen::Vector3d point(15.0, -15.0 + 0.03125 * i, 0.1 * i);
    const Eigen::Vector3d back = placement.toSubstrate(placement.toImage(point));
    EXPECT_EQ(back[0], point[0]);
    EXPECT_EQ(back[1], point[1]);
    EXPECT_NEAR(back[2], point[2], 1.5e-8);
  }
}

TEST(Placement, IsKnownByItsMatrix)
{
  const cactus::Placement placement = oblique().placement();
  const cactus::Placement again = cactus::Placement::of(placement.matrix());
  EXPECT_LT((again.axes - placement.axes).norm(), 1e-14);
  EXPECT_NEAR(again.scale, 0.002, 1e-16);
  EXPECT_EQ(again.position, placement.position);
}

TEST(Placement, RefusesWhatIsNone)
{
  const auto matrix = oblique().placement().matrix();
  const auto refused = [&](std::size_t place, double value)
  {
    auto bad = matrix;
    bad[place] = value;
    EXPECT_THROW(cactus::Placement::of(bad), cactus::InvalidInput) << place << " " << value;
  };
  EXPECT_THROW(cactus::Placement::of({}), cactus::InvalidInput);
  refused(0, std::nan(""));
  refused(3, INFINITY);
  refused(5, 1.0);
  refused(12, 1e-3);
  refused(15, 0.0);
  auto mirrored = matrix;
  for (const std::size_t place : { 0, 4, 8 })
  {
    mirrored[place] = -mirrored[place];
  }
  EXPECT_THROW(cactus::Placement::of(mirrored), cactus::InvalidInput);
}

TEST(Placement, NamesWhatIsOutOfRange)
{
  cactus::PlacementOptions options;
  options.scaleFactor = 0.0;
  EXPECT_THROW(options.placement(), cactus::InvalidInput);
  options = {};
  options.positionZ = std::nan("");
  EXPECT_THROW(options.placement(), cactus::InvalidInput);
}

} // namespace
