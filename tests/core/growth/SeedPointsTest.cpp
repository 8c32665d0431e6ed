// SPDX-License-Identifier: BSD-3-Clause
#include "growth/SeedPoints.h"

#include "GrowthExamples.h"
#include "base/Constants.h"
#include "bundle/BundleInitializer.h"
#include "growth/CapsuleField.h"
#include "growth/TargetRadii.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace cactus;
using cactus_testing::emptyFibres;
using cactus_testing::expectOnTarget;
using cactus_testing::grown;
using cactus_testing::straightBundle;

namespace
{

SeedOptions pointsOf(double density, std::uint64_t seed = 1)
{
  SeedOptions options;
  options.pointDensity = density;
  options.seed = seed;
  return options;
}

/// A fibre along z whose radius goes from 0.5 to 1 and back.
Fibres fibreOfTwoCones(int id)
{
  Fibres fibres = emptyFibres(8.0);
  fibres.addFibre(id, 1, 0.8);
  fibres.addPoint({ 0.1, 0.2, -4.0 }, 0.5);
  fibres.addPoint({ 0.1, 0.2, 0.0 }, 1.0);
  fibres.addPoint({ 0.1, 0.2, 4.0 }, 0.5);
  return fibres;
}

} // namespace

// Guarantee: points are uniform in the volume of the capsules, outside the core, as many per µm³ as asked for.
TEST(SeedPoints, FillTheCapsulesEvenly)
{
  const Fibres fibres = fibreOfTwoCones(7);
  double number = 0.0;
  double squares = 0.0; // of the distance from the centre line, as a fraction of the capsule's radius
  double thickHalf = 0.0;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::uint64_t seed = 1; seed <= 200; ++seed)
  {
    SeedPoints points(pointsOf(20.0, seed), fibres, 0, 0);
    number += double(points.size());
    for (std::size_t n = 0; n < points.size(); ++n)
    {
      const SeedPoints::Place place = points.next(Eigen::Vector3d::UnitZ());
      ASSERT_TRUE(place.along >= 0.0 && place.along < 1.0);
      ASSERT_NEAR(place.across.z(), 0.0, 1e-12);
      const double distance = place.across.norm();
      ASSERT_TRUE(distance >= SeedPoints::core - 1e-12 && distance <= 1.0 - SeedPoints::tip + 1e-12);
      squares += place.across.squaredNorm();
      thickHalf += place.along > 0.5 ? 1.0 : 0.0;
      mean += place.across;
    }
  }
  const double outermost = 1.0 - SeedPoints::tip;
  EXPECT_NEAR(number / 200.0, 20.0 * pi * 4.0 * (0.25 + 0.5 + 1.0) / 3.0, 1.0);
  EXPECT_NEAR(squares / number, 0.5 * (outermost * outermost + SeedPoints::core * SeedPoints::core), 0.01);
  EXPECT_NEAR(thickHalf / number, (0.5625 + 0.75 + 1.0) / (2.0 * (0.25 + 0.5 + 1.0)), 0.01);
  EXPECT_LT((mean / number).norm(), 0.02);
}

// Guarantee: the seed lies within the capsules, holds each point and the core, is 1-Lipschitz, and fills the capsules as the
// points become many. It depends on the fibre's id and the seed.
TEST(SeedPoints, LieWithinTheCapsules)
{
  const Fibres fibres = fibreOfTwoCones(7);
  const Eigen::AlignedBox3d region(fibres.domain.lower, fibres.domain.upper);
  const CapsuleField capsules(fibres, SeedOptions(), region, 1e3);
  const CapsuleField few(fibres, pointsOf(2.0), region, 1e3);
  const CapsuleField many(fibres, pointsOf(200.0), region, 1e3);
  const CapsuleField other(fibres, pointsOf(2.0, 2), region, 1e3);
  const CapsuleField ofOther(fibreOfTwoCones(8), pointsOf(2.0), region, 1e3);
  RandomEngine engine = randomStream(4, RandomStage::Directions);
  double largestOfFew = 0.0;
  double largestOfMany = 0.0;
  double changeBySeed = 0.0;
  double changeById = 0.0;
  for (int n = 0; n < 2000; ++n)
  {
    const Eigen::Vector3d x(3.0 * uniform(engine) - 1.5, 3.0 * uniform(engine) - 1.5, 7.8 * uniform(engine) - 3.9);
    const Eigen::Vector3d y = x + 0.1 * Eigen::Vector3d(uniform(engine), uniform(engine), uniform(engine));
    const double value = few.value(0, x);
    ASSERT_LE(std::abs(value - few.value(0, y)), (x - y).norm() + 1e-9);
    const double whole = capsules.value(0, x);
    ASSERT_LE(value, whole + 1e-9);
    ASSERT_LE(many.value(0, x), whole + 1e-9);
    if (whole > 0.0)
    {
      largestOfFew = std::max(largestOfFew, -value);
      largestOfMany = std::max(largestOfMany, -many.value(0, x));
    }
    changeBySeed = std::max(changeBySeed, std::abs(value - other.value(0, x)));
    changeById = std::max(changeById, std::abs(value - ofOther.value(0, x)));
  }
  EXPECT_GT(largestOfFew, 0.3);
  EXPECT_LT(largestOfMany, 0.3);
  EXPECT_GT(changeBySeed, 0.1);
  EXPECT_GT(changeById, 0.1);
  for (std::size_t segment = 0; segment < 2; ++segment)
  {
    SeedPoints points(pointsOf(2.0), fibres, 0, segment);
    for (std::size_t n = points.size(); n > 0; --n)
    {
      const SeedPoints::Place place = points.next(Eigen::Vector3d::UnitZ());
      const double radius = segment == 0 ? 0.5 + 0.5 * place.along : 1.0 - 0.5 * place.along;
      const Eigen::Vector3d foot(0.1, 0.2, (segment == 0 ? -4.0 : 0.0) + 4.0 * place.along);
      EXPECT_GE(few.value(0, foot), SeedPoints::core * radius - 1e-9);
      EXPECT_GE(few.value(0, foot + radius * place.across), SeedPoints::tip * radius - 1e-9);
    }
  }
}

// Guarantee: in a periodic domain points come again with the fibre; the length of the centre line is that of the capsules.
TEST(SeedPoints, RepeatWithTheFibre)
{
  BundleInitializerOptions bundle;
  bundle.side = 5.0;
  bundle.radius.maximum = 1.0;
  bundle.border = Border::Periodic;
  bundle.fibreVolumeFraction = 0.4;
  bundle.calibre.sectionAxisRatio = 1.0;
  const Fibres fibres = initialiseBundles(bundle, {}, nullptr);
  const Eigen::AlignedBox3d region(fibres.domain.lower, fibres.domain.upper);
  const CapsuleField points(fibres, pointsOf(20.0), region, 1.0);
  const CapsuleField capsules(fibres, SeedOptions(), region, 1.0);
  RandomEngine engine = randomStream(5, RandomStage::Directions);
  for (int rank = 0; rank < int(fibres.size()); ++rank)
  {
    Eigen::Vector3d middle;
    Eigen::Vector3d middleOfCapsules;
    EXPECT_NEAR(points.length(rank, middle), capsules.length(rank, middleOfCapsules), 0.02 * points.length(rank, middle));
    EXPECT_LT((middle - middleOfCapsules).norm(), 0.1);
    for (int n = 0; n < 200; ++n)
    {
      const double x = 5.0 * uniform(engine) - 2.5;
      const double y = 5.0 * uniform(engine) - 2.5;
      const double below = points.value(rank, { x, y, -2.5 });
      if (below > -0.5)
      {
        EXPECT_NEAR(below, points.value(rank, { x, y, 2.5 }), 1e-9);
      }
      const double before = points.value(rank, { -2.5, y, x });
      if (before > -0.5)
      {
        EXPECT_NEAR(before, points.value(rank, { 2.5, y, x }), 1e-9);
      }
    }
  }
}

// Guarantee: a bundle grown from points reaches its volume fraction and radii, each fibre in one piece; fibres have more
// surface than those grown from capsules.
TEST(SeedPoints, BundlesReachTheirFractionAndRadii)
{
  const Fibres fibres = straightBundle(1.0);
  std::vector<double> surfaces;
  for (const double density : { 0.0, 30.0, 10.0 })
  {
    FibreRadialGrowthOptions options;
    options.voxelSize = 0.08;
    options.seedDensity = density;
    const LabelImage image = grown(aimAtTargetRadii(fibres, options), options);
    SCOPED_TRACE(density);
    expectOnTarget(image, fibres);
    double faces = 0.0; // between voxels along x of which one is in a fibre
    for (std::size_t i = 1; i < image.fibreId.size(); ++i)
    {
      faces += (image.fibreId[i] > 0) != (image.fibreId[i - 1] > 0) ? 1.0 : 0.0;
    }
    surfaces.push_back(faces);
  }
  EXPECT_GT(surfaces[1], 1.03 * surfaces[0]);
  EXPECT_GT(surfaces[2], 1.03 * surfaces[0]);
}
