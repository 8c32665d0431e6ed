// SPDX-License-Identifier: BSD-3-Clause
#include "growth/GrowthTarget.h"

#include "BundleBetweenWalls.h"
#include "GrowthExamples.h"
#include "base/Constants.h"
#include "base/Error.h"
#include "bundle/BundleInitializer.h"
#include "fibres/FibreShape.h"
#include "fibres/TrimToDomain.h"
#include "growth/TargetRadii.h"
#include "growth/VolumeInDomain.h"
#include "judge/SubstrateStatistics.h"
#include "optimiser/CapsuleOptimizer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace
{

using namespace cactus;

using cactus::pi;
using cactus_testing::emptyFibres;
using cactus_testing::grown;

/// A straight fibre along z through the whole of a domain of `side`.
void addStraight(Fibres& fibres, double x, double y, double side, double radius, double targetRadius)
{
  fibres.addFibre(static_cast<int>(fibres.size()) + 1, 1, targetRadius);
  for (int i = 0; i <= 8; ++i)
  {
    fibres.addPoint({ x, y, side * (0.25 * i - 1.0) }, radius);
  }
}

/// Returns the volume (µm³) of each fibre by counting voxels, in the order of the fibres.
std::vector<double> countedVolumes(const Fibres& fibres, const LabelImage& image)
{
  std::map<int, double> voxels;
  for (const std::int32_t id : image.fibreId)
  {
    voxels[id] += 1.0;
  }
  std::vector<double> volumes;
  for (const int id : fibres.fibreIds)
  {
    volumes.push_back(voxels[id] * std::pow(image.grid.spacing, 3.0));
  }
  return volumes;
}

/// Target radii, and the radii of cylinders with the length of the centre line and the volume of the grown fibre, for the fibres
/// that run through the domain without touching one of its sides.
struct Radii
{
  std::vector<double> target;
  std::vector<double> grown;

  double correlation() const
  {
    const Eigen::Map<const Eigen::ArrayXd> x(target.data(), static_cast<Eigen::Index>(target.size()));
    const Eigen::Map<const Eigen::ArrayXd> y(grown.data(), static_cast<Eigen::Index>(grown.size()));
    const Eigen::ArrayXd a = x - x.mean();
    const Eigen::ArrayXd b = y - y.mean();
    return (a * b).sum() / std::sqrt(a.square().sum() * b.square().sum());
  }
  /// Returns the mean of grown minus target radius.
  double meanDifference() const
  {
    return (std::accumulate(grown.begin(), grown.end(), 0.0) - std::accumulate(target.begin(), target.end(), 0.0)) /
           static_cast<double>(target.size());
  }
  /// Returns the distance between grown radii and target radii plus `shift`, by counting at each of either.
  double kolmogorovSmirnov(double shift) const
  {
    std::vector<double> wanted = target;
    std::for_each(wanted.begin(), wanted.end(), [&](double& radius) { radius += shift; });
    double largest = 0.0;
    for (const std::vector<double>* radii : { &std::as_const(wanted), &grown })
    {
      for (const double radius : *radii)
      {
        const auto share = [&](const std::vector<double>& of)
        {
          return static_cast<double>(std::count_if(of.begin(), of.end(), [&](double r) { return r <= radius; })) /
                 static_cast<double>(of.size());
        };
        largest = std::max(largest, std::abs(share(wanted) - share(grown)));
      }
    }
    return largest;
  }
  /// Returns the smallest and largest of grown minus target radius.
  std::pair<double, double> differences() const
  {
    std::vector<double> all;
    std::transform(grown.begin(), grown.end(), target.begin(), std::back_inserter(all), std::minus<>());
    const auto ends = std::minmax_element(all.begin(), all.end());
    return { *ends.first, *ends.second };
  }
};

Radii measure(const Fibres& fibres, const LabelImage& image)
{
  const std::vector<double> volumes = countedVolumes(fibres, image);
  Radii radii;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    bool whole = lengthInDomain(fibres, f) > 0.9 * fibres.domain.size().z();
    for (std::size_t p = fibres.offsets[f]; p < fibres.offsets[f + 1]; ++p)
    {
      const Eigen::Vector3d& at = fibres.points[p];
      const double side = 0.5 * fibres.domain.size().x() - 1.4 * fibres.targetRadii[f] - 0.1;
      whole = whole && std::max(std::abs(at.x()), std::abs(at.y())) < side;
    }
    if (whole)
    {
      radii.target.push_back(fibres.targetRadii[f]);
      radii.grown.push_back(std::sqrt(volumes[f] / (pi * lengthInDomain(fibres, f))));
    }
  }
  return radii;
}

/// Makes a bundle with the stages before growth.
Fibres bundle(double grownFraction)
{
  BundleBetweenWalls options;
  options.side = 12.0;
  options.radius.gammaShape = 2.4;
  options.radius.gammaScale = 0.15;
  options.radius.minimum = 0.2;
  options.radius.maximum = 1.2;
  options.meanDispersion = 8.0;
  options.grownFibreVolumeFraction = grownFraction;
  Fibres fibres = initialiseBundles(options);
  optimise(fibres, CapsuleOptimizerOptions(), Context());
  return trimToDomain(fibres);
}

TEST(GrowthTarget, RadiiOfAPackedBundleEndOnTarget)
{
  const Fibres fibres = bundle(0.9);
  FibreRadialGrowthOptions options;
  options.voxelSize = 0.05;
  options.surfaceRoughness = 0.1;
  options.targetFibreVolumeFraction = 0.9;
  const Radii aimed = measure(fibres, grown(aimAtTargetRadii(fibres, options), options));
  const Radii plain = measure(fibres, grown(fibres, options));
  ASSERT_GT(aimed.target.size(), 80u);
  EXPECT_GE(aimed.correlation(), 0.998);
  // So few fibres do not quite fill the fraction for which they were drawn.
  EXPECT_NEAR(aimed.meanDifference(), 0.0, 0.02);
  EXPECT_LE(aimed.kolmogorovSmirnov(aimed.meanDifference()), 0.05);
  // The same growth for all does not achieve that.
  EXPECT_GT(plain.kolmogorovSmirnov(plain.meanDifference()), 0.1);
}

// Their swellings have pushed fibres out of the domain: all end thicker, thin ones hardly more than others.
TEST(GrowthTarget, RadiiOfFibresThatSwellEndOnTarget)
{
  Radii all;
  double made = 0.0;
  for (const int seed : { 1, 2, 3 })
  {
    BundleInitializerOptions bundle;
    bundle.side = 14.0;
    bundle.seed = seed;
    bundle.fibreVolumeFraction = 0.6;
    bundle.grownFibreVolumeFraction = 0.8;
    Fibres fibres = initialiseBundles(bundle);
    optimise(fibres, CapsuleOptimizerOptions(), Context());
    fibres = trimToDomain(fibres);
    for (std::size_t f = 0; f < fibres.size(); ++f)
    {
      made += volumeInDomain(fibres, f, fibres.targetRadii[f] / rootMeanSquareRadius(fibres, f)) / (3.0 * fibres.domain.volume());
    }
    const FibreRadialGrowthOptions options;
    const Radii radii = measure(fibres, grown(aimAtTargetRadii(fibres, options), options));
    all.target.insert(all.target.end(), radii.target.begin(), radii.target.end());
    all.grown.insert(all.grown.end(), radii.grown.begin(), radii.grown.end());
  }
  ASSERT_GT(all.target.size(), 50u);
  const auto meanRatio = [&](double lowest, double highest)
  {
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < all.target.size(); ++i)
    {
      const bool isMeant = all.target[i] >= lowest && all.target[i] < highest;
      sum += isMeant ? all.grown[i] / all.target[i] : 0.0;
      count += isMeant ? 1.0 : 0.0;
    }
    return sum / count;
  };
  EXPECT_LT(made, 0.78);
  EXPECT_NEAR(meanRatio(0.0, 0.35), std::sqrt(0.8 / made), 0.04);
  EXPECT_NEAR(meanRatio(0.35, 9.0), std::sqrt(0.8 / made), 0.04);
}

// A thin fibre crosses it: it is held back there, and nowhere else.
TEST(GrowthTarget, AThickFibreIsHeldBackOnlyBesideAThinOne)
{
  const auto factors = [](double x)
  {
    Fibres fibres;
    fibres.domain.lower = Eigen::Vector3d(-4.0, -4.0, -4.0);
    fibres.domain.upper = Eigen::Vector3d(4.0, 4.0, 4.0);
    fibres.domain.periodic = { true, true, false };
    fibres.addFibre(1, 1, 1.5);
    for (int p = 0; p <= 16; ++p)
    {
      fibres.addPoint(Eigen::Vector3d(x, 0.0, -4.0 + 0.5 * p), 1.0);
    }
    fibres.addFibre(2, 1, 0.24);
    for (int p = 0; p <= 16; ++p)
    {
      fibres.addPoint(Eigen::Vector3d(x + 1.25, -4.0 + 0.5 * p, 0.0), 0.2);
    }
    FibreRadialGrowthOptions options;
    options.targetFibreVolumeFraction = 0.113;
    return factorsForTargetRadii(fibres, options);
  };
  const std::vector<double> middle = factors(0.0);
  ASSERT_EQ(middle.size(), 34u);
  EXPECT_LT(middle[8], middle[0] - 0.05);
  EXPECT_EQ(middle[7], middle[8]);
  EXPECT_EQ(middle[9], middle[8]);
  EXPECT_EQ(middle[2], middle[0]);
  EXPECT_EQ(middle[14], middle[0]);
  // The same through a periodic face, but for samples that lie elsewhere.
  const std::vector<double> through = factors(3.4);
  for (std::size_t p = 0; p < 17; ++p)
  {
    EXPECT_NEAR(through[p], middle[p], 0.03) << p;
  }
}

TEST(GrowthTarget, RadiiEndAsMuchLargerWhereTheFractionAsksForMore)
{
  const Fibres fibres = bundle(0.0);
  FibreRadialGrowthOptions options;
  options.voxelSize = 0.05;
  options.targetFibreVolumeFraction = 0.93;
  const LabelImage image = grown(aimAtTargetRadii(fibres, options), options);
  const auto outside = static_cast<double>(std::count(image.fibreId.begin(), image.fibreId.end(), 0));
  EXPECT_NEAR(1.0 - outside / static_cast<double>(image.fibreId.size()), 0.93, 0.002);
  const Radii radii = measure(fibres, image);
  ASSERT_GT(radii.target.size(), 50u);
  EXPECT_GE(radii.correlation(), 0.998);
  const auto [least, most] = radii.differences();
  EXPECT_GT(least, 0.02);
  EXPECT_LT(most - least, 0.06);
}

TEST(GrowthTarget, ComesFromTheFibresUnlessGiven)
{
  Fibres fibres = emptyFibres(4.0);
  addStraight(fibres, 0.0, 0.0, 4.0, 0.9, 1.0);
  FibreRadialGrowthOptions byIterations;
  EXPECT_EQ(growthFor(fibres, byIterations).growth, byIterations.growthIterations * byIterations.voxelSize);
  EXPECT_EQ(remarkOnTarget(fibres, byIterations), "");

  fibres.grownFraction = pi / 16.0;
  FibreRadialGrowthOptions given;
  given.targetFibreVolumeFraction = pi / 16.0;
  EXPECT_EQ(growthFor(fibres, {}).growth, growthFor(fibres, given).growth);
  EXPECT_EQ(aimAtTargetRadii(fibres, {}).radii, aimAtTargetRadii(fibres, given).radii);
  EXPECT_EQ(trimToDomain(fibres).grownFraction, fibres.grownFraction);
}

TEST(GrowthTarget, FibresFromElsewhereKeepTheirVolume)
{
  const Fibres fibres = bundle(0.0);
  const double given = capsuleVolumeInDomain(fibres) / fibres.domain.volume();
  FibreRadialGrowthOptions options;
  options.voxelSize = 0.05;
  const FibreRadialGrowthOptions own = forFibres(fibres, options);
  const LabelImage image = grown(aimAtTargetRadii(fibres, own), own);
  const auto outside = static_cast<double>(std::count(image.fibreId.begin(), image.fibreId.end(), 0));
  EXPECT_NEAR(1.0 - outside / static_cast<double>(image.fibreId.size()), given, 0.01 * given);
  const Radii radii = measure(fibres, image);
  ASSERT_GT(radii.target.size(), 50u);
  EXPECT_NEAR(radii.meanDifference(), 0.0, 0.02);

  // Unless growth or a target is asked for, or what they were made for is known.
  const auto target = [](const Fibres& some, const FibreRadialGrowthOptions& asked)
  { return forFibres(some, asked).targetFibreVolumeFraction; };
  options.growthIterations = 2;
  EXPECT_EQ(target(fibres, options), -1.0);
  options.growthIterations = 0;
  EXPECT_EQ(target(bundle(0.9), options), -1.0);
  options.targetFibreVolumeFraction = 0.0;
  EXPECT_EQ(target(fibres, options), 0.0);

  options.targetFibreVolumeFraction = -1.0;
  options.surfaceRoughness = 0.0;
  EXPECT_EQ(target(fibres, options), -1.0);

  // Too little for samples, and more than the domain holds.
  options.surfaceRoughness = 0.1;
  Fibres thin = emptyFibres(4.0);
  addStraight(thin, 0.0, 0.0, 4.0, 0.01, 0.01);
  EXPECT_EQ(target(thin, options), 0.0);
  Fibres full = emptyFibres(4.0);
  addStraight(full, 0.0, 0.0, 4.0, 1.9, 1.9);
  addStraight(full, 0.1, 0.0, 4.0, 1.9, 1.9);
  EXPECT_THROW(forFibres(full, options), InvalidInput);
}

TEST(GrowthTarget, SaysWhereItPartsFromWhatTheFibresWereMadeFor)
{
  Fibres fibres = emptyFibres(4.0);
  addStraight(fibres, 0.0, 0.0, 4.0, 0.9, 1.0);
  fibres.grownFraction = pi / 16.0;
  FibreRadialGrowthOptions options;
  EXPECT_EQ(remarkOnTarget(fibres, options), "");
  // Half the volume makes a round fibre thinner by 1 - 1/sqrt(2).
  options.targetFibreVolumeFraction = 0.5 * fibres.grownFraction;
  EXPECT_NE(remarkOnTarget(fibres, options).find("thinner than their TargetRadius, by about 29 %"), std::string::npos);
  options.targetFibreVolumeFraction = 1.002 * fibres.grownFraction;
  EXPECT_NE(remarkOnTarget(fibres, options).find("thicker than their TargetRadius, by less than 1 %"), std::string::npos);
  options.targetFibreVolumeFraction = 0.0;
  options.growthIterations = 4;
  EXPECT_NE(remarkOnTarget(fibres, options).find("GrowthIterations (4 voxels)"), std::string::npos);
  options.growthIterations = 0;

  // Twice as many as one of them was made for, as when another filter has joined them.
  options.targetFibreVolumeFraction = -1.0;
  addStraight(fibres, 1.0, 1.0, 4.0, 0.9, 1.0);
  EXPECT_NE(remarkOnTarget(fibres, options).find("thinner, by about 29 %"), std::string::npos);
  fibres.grownFraction = 1.8;
  EXPECT_THROW(growthFor(fibres, options), InvalidInput);
}

TEST(GrowthTarget, LoneFibresEndAtTheirTargetRadii)
{
  // Apart from each other, so that each area gives a radius; together they fill the volume of their target radii. One lies half
  // outside the domain.
  const double targets[] = { 0.9, 0.5, 0.3, 0.6 };
  const double places[] = { -1.0, 0.0, 1.0, 2.0 };
  Fibres fibres = emptyFibres(4.0);
  double area = 0.0;
  for (int f = 0; f < 4; ++f)
  {
    addStraight(fibres, places[f], f < 3 ? places[f] : -0.5, 4.0, (0.7 + 0.1 * f) * targets[f], targets[f]);
    area += (f < 3 ? 1.0 : 0.5) * pi * targets[f] * targets[f];
  }
  FibreRadialGrowthOptions options;
  options.surfaceRoughness = 0.0;
  options.voxelSize = 0.02;
  options.targetFibreVolumeFraction = area / 16.0;
  const Fibres aimed = aimAtTargetRadii(fibres, options);
  EXPECT_NEAR(growthFor(aimed, options).growth, 0.0, 0.01);
  const std::vector<double> volumes = countedVolumes(fibres, grown(aimed, options));
  for (std::size_t f = 0; f < 4; ++f)
  {
    EXPECT_NEAR(std::sqrt(volumes[f] / (4.0 * pi * (f < 3 ? 1.0 : 0.5))), targets[f], 0.006) << f;
  }
}

TEST(GrowthTarget, OnlyRadiiChangeAndOnlyForAFraction)
{
  const Fibres fibres = bundle(0.9);
  FibreRadialGrowthOptions options;
  options.targetFibreVolumeFraction = 0.0;
  const Fibres same = aimAtTargetRadii(fibres, options);
  EXPECT_EQ(same.radii, fibres.radii);
  options.targetFibreVolumeFraction = 0.9;
  const Fibres aimed = aimAtTargetRadii(fibres, options);
  EXPECT_NE(aimed.radii, fibres.radii);
  EXPECT_EQ(aimed.points, fibres.points);
  EXPECT_EQ(aimed.offsets, fibres.offsets);
  EXPECT_EQ(aimed.fibreIds, fibres.fibreIds);
  EXPECT_EQ(aimed.targetRadii, fibres.targetRadii);
}

TEST(GrowthTarget, GivesTheSameRadiiOnAnyNumberOfThreads)
{
  const Fibres fibres = bundle(0.9);
  FibreRadialGrowthOptions options;
  options.targetFibreVolumeFraction = 0.9;
  Context context;
  context.threads = 1;
  const Fibres one = aimAtTargetRadii(fibres, options, context);
  for (const int threads : { 2, 5 })
  {
    context.threads = threads;
    EXPECT_EQ(aimAtTargetRadii(fibres, options, context).radii, one.radii);
  }
}

TEST(GrowthTarget, SeversNoThinFibreBesideAThickOne)
{
  // A thick fibre, and thin ones that touch it.
  Fibres fibres = emptyFibres(5.0);
  addStraight(fibres, 0.0, 0.0, 5.0, 1.5, 1.5);
  for (int i = 0; i < 12; ++i)
  {
    const double angle = 2.0 * pi * i / 12.0;
    addStraight(fibres, 1.7 * std::cos(angle), 1.7 * std::sin(angle), 5.0, 0.2, 0.2);
  }
  FibreRadialGrowthOptions options;
  options.voxelSize = 0.025;
  options.targetFibreVolumeFraction = 0.8;
  const auto samplesOfOthers = [&](const Fibres& capsules)
  {
    const LabelImage image = grown(capsules, options);
    int others = 0;
    for (std::size_t f = 0; f < fibres.size(); ++f)
    {
      const Eigen::Vector3d centre = fibres.points[fibres.offsets[f]];
      for (int k = 0; k < image.grid.count[2]; ++k)
      {
        const Eigen::Array3d at = (centre - image.grid.origin) / image.grid.spacing;
        const std::size_t voxel = image.grid.index(static_cast<int>(std::round(at[0])), static_cast<int>(std::round(at[1])), k);
        others += image.fibreId[voxel] != fibres.fibreIds[f];
      }
    }
    return others;
  };
  EXPECT_EQ(samplesOfOthers(aimAtTargetRadii(fibres, options)), 0);
  // Proportional radii, without a bound, would do so.
  Fibres scaled = fibres;
  for (double& radius : scaled.radii)
  {
    radius *= std::sqrt(0.8 * 25.0 / (pi * (1.5 * 1.5 + 12 * 0.2 * 0.2)));
  }
  EXPECT_GT(samplesOfOthers(scaled), 100);
}

TEST(GrowthTarget, CanBeStoppedAndNamesWhatIsWrong)
{
  Fibres fibres = emptyFibres(6.0);
  addStraight(fibres, 0.0, 0.0, 6.0, 1.0, 1.0);
  FibreRadialGrowthOptions options;
  options.targetFibreVolumeFraction = 0.5;
  Context context;
  context.cancelled = [] { return true; };
  EXPECT_THROW(aimAtTargetRadii(fibres, options, context), Cancelled);
  options.targetFibreVolumeFraction = 1.5;
  EXPECT_THROW(aimAtTargetRadii(fibres, options), InvalidInput);
  options.targetFibreVolumeFraction = 0.5;
  fibres.radii[0] = -1.0;
  EXPECT_THROW(aimAtTargetRadii(fibres, options), InvalidInput);
}

} // namespace
