// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/FibreCostKernels.h"

#include "RandomBundle.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace
{

/// The contributions of some kernels for a fibre.
struct Added
{
  double curvature = 0.0;
  double length = 0.0;
  std::vector<double> byPoint;
  std::vector<double> byRadius;
  std::vector<double> stiffness;
  std::vector<std::uint32_t> sharp;
};

Added add(const cactus::FibreCostKernels& kernels, const cactus::FibreColumns& fibre)
{
  Added added;
  added.byPoint.assign(3 * fibre.count, 0.5);
  added.byRadius.assign(fibre.count, 0.25);
  added.stiffness.assign(fibre.count, 0.125);
  added.sharp.resize(fibre.count);
  std::vector<double> room(cactus::FibreCostKernels::roomFor(fibre.count), 1e300); // nothing in it is to be used
  const cactus::FibreColumnGradients to = { added.byPoint.data(), added.byRadius.data(), added.stiffness.data() };
  added.sharp.resize(kernels.addCurvature(fibre, 0.7, added.curvature, to, room.data(), added.sharp.data()));
  kernels.addLength(fibre, 1.3, added.length, to, room.data());
  return added;
}

} // namespace

// Guarantee: the costs that shape a fibre have the same bits on every vector unit, for fibres of any number of control points.
TEST(FibreCostKernels, SameBitsOnEveryVectorUnit)
{
  for (int points = 2; points < 40; ++points)
  {
    const cactus::Fibres before = randomBundle(31, 1, points, 4.0, 0.3);
    const cactus::Fibres fibres = randomBundle(32, 1, points, 4.4, 0.4);
    std::vector<double> lengths(fibres.points.size());
    for (std::size_t i = 0; i + 1 < lengths.size(); ++i)
    {
      lengths[i] = (before.points[i + 1] - before.points[i]).norm();
    }
    const std::vector<float> cosines(lengths.size(), 0.3f);
    const cactus::FibreColumns shape = { lengths.size(), fibres.points[0].data(), fibres.radii.data(), lengths.data(),
      cosines.data() };
    const Added first = add(cactus::portableFibreCostKernels, shape);
    EXPECT_EQ(first.curvature > 0.0, points > 2);
    EXPECT_TRUE(first.length > 0.0 || points < 5) << points;
    for (const cactus::FibreCostKernels* kernels : cactus::runnableKernels<cactus::FibreCostKernels>())
    {
      const Added added = add(*kernels, shape);
      EXPECT_EQ(added.curvature, first.curvature) << points;
      EXPECT_EQ(added.length, first.length) << points;
      EXPECT_EQ(added.byPoint, first.byPoint) << points;
      EXPECT_EQ(added.byRadius, first.byRadius) << points;
      EXPECT_EQ(added.stiffness, first.stiffness) << points;
      EXPECT_EQ(added.sharp, first.sharp) << points;
    }
  }
}

// Guarantee: every bend that exceeds its limit is reported.
TEST(FibreCostKernels, TellsSharpBends)
{
  const cactus::Fibres fibres = randomBundle(33, 1, 60, 6.0, 0.4);
  const std::size_t count = fibres.points.size();
  const std::vector<float> cosines(count, 0.3f);
  const std::vector<double> lengths(count, 0.1);
  std::vector<std::uint32_t> sharp;
  for (std::size_t i = 1; i + 1 < count; ++i)
  {
    const Eigen::Vector3d u = fibres.points[i] - fibres.points[i - 1];
    const Eigen::Vector3d w = fibres.points[i + 1] - fibres.points[i];
    if (u.normalized().dot(w.normalized()) < 0.3)
    {
      sharp.push_back(static_cast<std::uint32_t>(i));
    }
  }
  EXPECT_GT(sharp.size(), 5u);
  EXPECT_LT(sharp.size(), 55u);
  const cactus::FibreColumns shape = { count, fibres.points[0].data(), fibres.radii.data(), lengths.data(), cosines.data() };
  EXPECT_EQ(add(cactus::bestKernels<cactus::FibreCostKernels>(), shape).sharp, sharp);
}
