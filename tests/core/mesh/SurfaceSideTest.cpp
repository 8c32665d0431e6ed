// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: inside, outside and on a surface are distinguished for any point.
#include "mesh/SurfaceSide.h"

#include "ExampleSurfaces.h"
#include "base/Constants.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using Eigen::Vector3d;
using example::tube;

TEST(SurfaceSide, TellsInsideFromOutside)
{
  const auto mesh = tube(0.3, -0.2, 1.0, -2, 2);
  const cactus::TriangleTree tree(mesh);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-2.5, 2.5);
  const double inner = std::cos(cactus::pi / 24); // of the inscribed circle
  for (int trial = 0; trial < 5000; ++trial)
  {
    const Vector3d p(uniform(random), uniform(random), uniform(random));
    const double distance = std::hypot(p[0] - 0.3, p[1] + 0.2);
    if (distance > 1.0 || std::fabs(p[2]) > 2.0)
    {
      ASSERT_EQ(cactus::sideOf(tree, p), cactus::Side::Outside);
    }
    else if (distance < inner)
    {
      ASSERT_EQ(cactus::sideOf(tree, p), cactus::Side::Inside);
    }
  }
  for (const Vector3d& corner : mesh.points)
  {
    ASSERT_EQ(cactus::sideOf(tree, corner), cactus::Side::On);
  }
  EXPECT_EQ(cactus::sideOf(tree, { 0.4, -0.1, 2.0 }), cactus::Side::On);
  EXPECT_EQ(cactus::sideOf(tree, { 0.3, -0.2, 0.0 }), cactus::Side::Inside); // in line with many edges
  EXPECT_EQ(cactus::sideOf(tree, { 5.0, -0.2, 2.0 }), cactus::Side::Outside);
}
