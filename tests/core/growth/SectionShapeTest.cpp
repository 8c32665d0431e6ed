// SPDX-License-Identifier: BSD-3-Clause
#include "growth/SectionShape.h"

#include "GrowthExamples.h"
#include "base/Constants.h"
#include "base/Random.h"
#include "bundle/BundleInitializer.h"
#include "growth/CapsuleField.h"
#include "growth/TargetRadii.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace cactus;
using cactus_testing::emptyFibres;
using cactus_testing::expectOnTarget;
using cactus_testing::grown;
using cactus_testing::piecesOf;
using cactus_testing::straightBundle;

namespace
{

/// Area, and the second moments along and across, of the part of the discs that lies deeper than `rim`.
struct Moments
{
  double area = 0.0;
  double along = 0.0;
  double across = 0.0;

  double axisRatio() const { return std::sqrt(this->across / this->along); }
};

Moments momentsOf(const SectionShape& shape, double rim)
{
  constexpr double step = 0.004;
  const double radius = SectionShape::discRadius(shape.elongation()) - rim;
  Moments moments;
  for (double x = -1.6; x < 1.6; x += step)
  {
    for (double y = -1.6; y < 1.6; y += step)
    {
      if (std::hypot(std::abs(x) - shape.elongation(), y) < radius || std::hypot(x, y) < radius)
      {
        moments.area += step * step;
        moments.along += x * x;
        moments.across += y * y;
      }
    }
  }
  return moments;
}

/// Axis ratio and mean place of a fibre's samples in one layer of an image, by their second moments.
double axisRatioInLayer(const LabelImage& image, int layer, std::int32_t fibre)
{
  double count = 0.0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
  for (int j = 0; j < image.grid.count[1]; ++j)
  {
    for (int i = 0; i < image.grid.count[0]; ++i)
    {
      if (image.fibreId[image.grid.index(i, j, layer)] == fibre)
      {
        const Eigen::Vector2d x = image.grid.position(i, j, layer).head<2>();
        count += 1.0;
        mean += x;
        square += x * x.transpose();
      }
    }
  }
  mean /= count;
  const Eigen::Matrix2d covariance = square / count - mean * mean.transpose();
  const double half = 0.5 * covariance.trace();
  const double difference = std::sqrt(std::max(0.0, half * half - covariance.determinant()));
  return std::sqrt((half - difference) / (half + difference));
}

constexpr double unset = std::numeric_limits<double>::quiet_NaN();

} // namespace

// Guarantee: a fibre's volume does not depend on the shape of its sections.
TEST(SectionShape, HasTheAreaOfACircle)
{
  EXPECT_TRUE(SectionShape(unset, 0.7, 0.8, 0.5).isRound());
  EXPECT_TRUE(SectionShape(1.0, 0.7, 0.8, 0.5).isRound());
  EXPECT_EQ(SectionShape().reach(), 1.0);
  EXPECT_EQ(SectionShape().core(), 1.0);
  for (const double axisRatio : { 0.95, 0.85, 0.75, 0.7 })
  {
    for (const double gRatio : { 0.5, 0.7, 1.0 })
    {
      const SectionShape shape(axisRatio, gRatio, 0.0, 0.5);
      EXPECT_NEAR(momentsOf(shape, 0.0).area, pi, 0.006 * pi) << axisRatio << " " << gRatio;
      EXPECT_GT(shape.core(), 0.37);
      EXPECT_LT(shape.reach(), 1.18);
    }
  }
}

// Guarantee: axons alone have the axis ratio asked for, whatever their myelin.
TEST(SectionShape, HasTheAxisRatioWithinTheMyelin)
{
  for (const double axisRatio : { 0.9, 0.8 })
  {
    for (const double gRatio : { 0.6, 0.7, 1.0 })
    {
      // Sections pass through round ones, so that the largest are more elongated than the mean.
      const SectionShape shape(axisRatio, gRatio, 0.0, 0.5);
      const double found = momentsOf(shape, 1.0 - gRatio).axisRatio();
      const double wanted = (1.0 - axisRatio) / (1.0 + axisRatio);
      EXPECT_NEAR((1.0 - found) / (1.0 + found) / wanted, 1.35, 0.15) << axisRatio << " " << gRatio;
    }
  }
  // Neighbours do a part of it, or all.
  EXPECT_TRUE(SectionShape(0.85, 0.7, 0.95, 0.5).isRound());
  EXPECT_FALSE(SectionShape(0.75, 0.7, 0.95, 0.5).isRound());
}

// Guarantee: sections turn smoothly, across the fibre, in a way of each fibre and seed; and repeat where the fibre does.
TEST(SectionTurn, IsSmoothAndRepeats)
{
  const SectionShape shape(0.75, 0.7, 0.0, 0.5);
  const Eigen::Vector3d tangent = Eigen::Vector3d(0.2, -0.1, 1.0).normalized();
  SectionTurn turn(shape, 1, 3, 0.0);
  SectionTurn other(shape, 1, 4, 0.0);
  SectionTurn reseeded(shape, 2, 3, 0.0);
  double sum = 0.0;
  double alike = 0.0;
  double alikeBySeed = 0.0;
  Eigen::Vector3d before = turn.offset(0.0, tangent);
  constexpr int places = 20000;
  for (int n = 1; n <= places; ++n)
  {
    const double length = 0.1 * n;
    const Eigen::Vector3d offset = turn.offset(length, tangent);
    ASSERT_NEAR(offset.dot(tangent), 0.0, 1e-12);
    ASSERT_LT(offset.norm(), shape.elongation());
    ASSERT_LT((offset - before).norm(), 0.4 * shape.elongation());
    sum += offset.norm();
    alike += offset.normalized().dot(other.offset(length, tangent).normalized());
    alikeBySeed += offset.normalized().dot(reseeded.offset(length, tangent).normalized());
    before = offset;
  }
  EXPECT_NEAR(sum / places, 0.886 * shape.elongation(), 0.02 * shape.elongation());
  EXPECT_NEAR(alike / places, 0.0, 0.1);
  EXPECT_NEAR(alikeBySeed / places, 0.0, 0.1);

  SectionTurn repeating(shape, 1, 3, 13.0);
  for (double length = 0.0; length < 13.0; length += 0.37)
  {
    const Eigen::Vector3d offset = repeating.offset(length, tangent);
    EXPECT_LT((repeating.offset(length + 13.0, tangent) - offset).norm(), 1e-9);
  }
}

// Guarantee: the field rests on three chains of balls, which a fibre's own capsules, longer by the reach, contain; it is
// 1-Lipschitz.
TEST(SectionShape, BoundsTheSeedField)
{
  Fibres fibres = emptyFibres(6.0);
  fibres.addFibre(1, 1, 0.8);
  for (int i = 0; i <= 8; ++i)
  {
    fibres.addPoint({ 0.4 * std::sin(0.8 * i), 0.3 * std::cos(i), i - 4.0 }, 0.7 + 0.1 * std::sin(i));
  }
  fibres.columns.set(targetAxisRatioColumn.name, 0, 0.7);
  const Eigen::AlignedBox3d region(fibres.domain.lower, fibres.domain.upper);
  Fibres plain = fibres;
  plain.columns = ColumnTable();
  const SectionShape shape = sectionShapes(fibres, SeedOptions())[0];
  ASSERT_FALSE(shape.isRound());
  const CapsuleField field(fibres, { 0.0, 1 }, region, 1e3);
  const CapsuleField round(plain, { 0.0, 1 }, region, 1e3);
  Eigen::Vector3d middle;
  Eigen::Vector3d middleOfRound;
  EXPECT_NEAR(field.length(0, middle), round.length(0, middleOfRound), 0.05 * round.length(0, middleOfRound));
  EXPECT_LT((middle - middleOfRound).norm(), 0.05);
  RandomEngine engine = randomStream(4, RandomStage::Directions);
  double largestGain = 0.0;
  double largestLoss = 0.0;
  for (int n = 0; n < 4000; ++n)
  {
    const Eigen::Vector3d x(4.0 * uniform(engine) - 2.0, 4.0 * uniform(engine) - 2.0, 6.0 * uniform(engine) - 3.0);
    const Eigen::Vector3d y = x + 0.1 * Eigen::Vector3d(uniform(engine), uniform(engine), uniform(engine));
    ASSERT_LE(std::abs(field.value(0, x) - field.value(0, y)), (x - y).norm() + 1e-9);
    const double gain = field.value(0, x) - round.value(0, x);
    largestGain = std::max(largestGain, gain);
    largestLoss = std::max(largestLoss, -gain);
  }
  // Chains are straight between places that follow the fibre's bends, a little shorter than it.
  EXPECT_LE(largestGain, 0.8 * (shape.reach() - 1.0) + 0.02);
  EXPECT_GT(largestGain, 0.4 * 0.8 * (shape.reach() - 1.0));
  EXPECT_LE(largestLoss, 0.8 * (1.0 - shape.core()) + 0.02);
  for (std::size_t p = 1; p + 1 < fibres.points.size(); ++p)
  {
    EXPECT_GE(field.value(0, fibres.points[p]), shape.core() * fibres.radii[p] - 1e-9);
  }
}

// Guarantee: an axon that no neighbour touches has the axis ratio asked for, on average along it; a little less before surfaces
// are smoothed.
TEST(SectionShape, ALoneFibreGrowsToIt)
{
  Fibres fibres = emptyFibres(20.0);
  fibres.domain.lower.head<2>().setConstant(-2.0);
  fibres.domain.upper.head<2>().setConstant(2.0);
  fibres.addFibre(1, 1, 0.6);
  for (double z = -10.0; z <= 10.0; z += 1.0)
  {
    fibres.addPoint({ 0.0, 0.0, z }, 0.6);
  }
  fibres.columns.set(targetAxisRatioColumn.name, 0, 0.8);
  fibres.columns.set(targetGRatioColumn.name, 0, bareGRatio);
  FibreRadialGrowthOptions options;
  options.voxelSize = 0.05;
  options.targetFibreVolumeFraction = 0.07;
  double sum = 0.0;
  int layers = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
  {
    options.seed = seed;
    const LabelImage image = grown(aimAtTargetRadii(fibres, options), options);
    EXPECT_EQ(piecesOf(image, 1), 1);
    for (int k = 0; k < image.grid.count[2]; k += 10, ++layers)
    {
      sum += axisRatioInLayer(image, k, 1);
    }
  }
  EXPECT_NEAR(sum / layers, 0.78, 0.02);
}

// Guarantee: a thin fibre beside thick ones whose sections are as elongated as can be stays in one piece.
TEST(SectionShape, SeversNoThinNeighbour)
{
  for (const double thin : { 0.1, 0.2, 0.4 })
  {
    Fibres fibres = emptyFibres(10.0);
    fibres.grownFraction = 0.4;
    const auto add = [&](double x, double y, double radius)
    {
      fibres.addFibre(int(fibres.size()) + 1, 1, radius);
      for (double z = -5.0; z <= 5.0; z += 1.0)
      {
        fibres.addPoint({ x, y, z }, radius);
      }
      fibres.columns.set(targetAxisRatioColumn.name, fibres.size() - 1, 0.7);
    };
    add(0.0, 0.0, thin);
    add(-2.0 - thin, 0.0, 2.0);
    add(2.0 + thin, 0.0, 2.0);
    FibreRadialGrowthOptions options;
    options.voxelSize = 0.05;
    for (std::uint64_t seed = 1; seed <= 3; ++seed)
    {
      options.seed = seed;
      const LabelImage image = grown(aimAtTargetRadii(fibres, options), options);
      EXPECT_EQ(piecesOf(image, 1), 1) << thin << " " << seed;
    }
  }
}

// Guarantee: neighbours that are elongated grow to the volume fraction and radii asked for, each in one piece; their sections
// have about the axis ratio, which tests/paraview looks at on final surfaces.
TEST(SectionShape, BundlesReachTheirFractionAndAxisRatio)
{
  const Fibres fibres = straightBundle(0.75);
  FibreRadialGrowthOptions options;
  options.voxelSize = 0.08;
  const LabelImage image = grown(aimAtTargetRadii(fibres, options), options);
  expectOnTarget(image, fibres);
  double sum = 0.0;
  for (const int id : fibres.fibreIds)
  {
    sum += axisRatioInLayer(image, image.grid.count[2] / 2, id);
  }
  EXPECT_NEAR(sum / double(fibres.size()), 0.78, 0.05);
}
