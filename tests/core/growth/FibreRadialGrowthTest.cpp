// SPDX-License-Identifier: BSD-3-Clause
#include "growth/FibreRadialGrowth.h"

#include "FieldAtSample.h"
#include "GrowthExamples.h"
#include "Sanitized.h"
#include "base/Constants.h"
#include "base/Error.h"
#include "base/Random.h"
#include "growth/CapsuleField.h"
#include "growth/GrowthTarget.h"
#include "growth/VolumeInDomain.h"
#include "surface/FibreField.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace
{

using namespace cactus;

using cactus::pi;
using cactus_testing::emptyFibres;
using cactus_testing::grown;

void addStraight(
  Fibres& fibres, const Eigen::Vector3d& from, const Eigen::Vector3d& to, double radius, int points = 2, int id = 0)
{
  fibres.addFibre(id > 0 ? id : static_cast<int>(fibres.size()) + 1, 1, radius);
  for (int i = 0; i < points; ++i)
  {
    fibres.addPoint(from + (to - from) * (double(i) / (points - 1)), radius);
  }
}

/// Seven parallel cylinders, one in the middle and six around it, `pitch` apart, along z.
Fibres hexagon(double side, double radius, double pitch)
{
  Fibres fibres = emptyFibres(side);
  addStraight(fibres, { 0, 0, -side }, { 0, 0, side }, radius);
  for (int i = 0; i < 6; ++i)
  {
    const double angle = i * pi / 3;
    const Eigen::Vector3d at(pitch * std::cos(angle), pitch * std::sin(angle), 0.0);
    addStraight(fibres, at - Eigen::Vector3d(0, 0, side), at + Eigen::Vector3d(0, 0, side), radius);
  }
  return fibres;
}

/// Wavy fibres of changing radius through a cube, in all directions, overlapping here and there.
Fibres tangle(double side, int count, std::uint64_t seed)
{
  Fibres fibres = emptyFibres(side);
  RandomEngine engine = randomStream(seed, RandomStage::Directions, 99);
  const auto symmetric = [&](double scale) { return scale * (2.0 * uniform(engine) - 1.0); };
  for (int f = 0; f < count; ++f)
  {
    const Eigen::Vector3d start(symmetric(0.6 * side), symmetric(0.6 * side), -0.6 * side);
    const Eigen::Vector3d end(symmetric(0.6 * side), symmetric(0.6 * side), 0.6 * side);
    const double radius = 0.2 + 0.6 * uniform(engine);
    fibres.addFibre(f + 1, 1 + f % 2, radius);
    const int points = 9;
    const int turn = f % 3;
    for (int i = 0; i < points; ++i)
    {
      const double t = double(i) / (points - 1);
      Eigen::Vector3d p = start + t * (end - start);
      p.x() += 0.2 * std::sin(7.0 * t + f);
      p.y() += 0.2 * std::cos(5.0 * t + f);
      const Eigen::Vector3d turned(p[turn], p[(turn + 1) % 3], p[(turn + 2) % 3]);
      fibres.addPoint(turned, radius * (1.0 + symmetric(0.3)));
    }
  }
  return fibres;
}

/// Returns s of a fibre's capsules by plain search over the balls along each segment.
double searchedValue(const Fibres& fibres, std::size_t f, const Eigen::Vector3d& x)
{
  double best = -std::numeric_limits<double>::infinity();
  for (std::size_t p = fibres.offsets[f]; p + 1 < fibres.offsets[f + 1]; ++p)
  {
    const auto at = [&](double t)
    {
      const Eigen::Vector3d c = fibres.points[p] + t * (fibres.points[p + 1] - fibres.points[p]);
      return fibres.radii[p] + t * (fibres.radii[p + 1] - fibres.radii[p]) - (x - c).norm();
    };
    // Concave in t.
    double lower = 0.0;
    double upper = 1.0;
    for (int i = 0; i < 100; ++i)
    {
      const double a = lower + (upper - lower) / 3.0;
      const double b = upper - (upper - lower) / 3.0;
      (at(a) < at(b) ? lower : upper) = at(a) < at(b) ? a : b;
    }
    best = std::max({ best, at(lower), at(0.0), at(1.0) });
  }
  return best;
}

CapsuleField fieldOf(const Fibres& fibres, const FibreRadialGrowthOptions& options)
{
  return CapsuleField(
    fibres, { options.surfaceRoughness, options.seed }, Eigen::AlignedBox3d(fibres.domain.lower, fibres.domain.upper), 1e3);
}

VoxelGrid extent(VoxelGrid grid, std::array<int, 3> lower, std::array<int, 3> count)
{
  grid.lower = lower;
  grid.count = count;
  return grid;
}

double filledFraction(const LabelImage& image)
{
  const auto filled = std::count_if(image.fibreId.begin(), image.fibreId.end(), [](std::int32_t id) { return id > 0; });
  return double(filled) / double(image.fibreId.size());
}

template <typename T>
bool sameBits(const std::vector<T>& a, const std::vector<T>& b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

/// Returns the message of the Expected that `work` throws.
template <typename Expected>
std::string messageOf(const std::function<void()>& work)
{
  try
  {
    work();
  }
  catch (const Expected& error)
  {
    return error.what();
  }
  catch (const std::exception& error)
  {
    ADD_FAILURE() << "another error: " << error.what();
    return "";
  }
  ADD_FAILURE() << "no error";
  return "";
}

/// Compares every sample with f of every fibre, from the definition. Returns how many samples lie inside a fibre.
std::size_t expectMatchesDefinition(
  const Fibres& fibres, const FibreRadialGrowthOptions& options, double growth, const LabelImage& image)
{
  const CapsuleField field = fieldOf(fibres, options);
  const double gap = options.minimumGap + 2.0 * options.surfaceTolerance;
  const double band = 4.0 * image.grid.spacing;
  std::vector<double> s(fibres.size());
  std::size_t inside = 0;
  std::size_t wrong = 0;
  for (int k = 0; k < image.grid.count[2]; ++k)
  {
    for (int j = 0; j < image.grid.count[1]; ++j)
    {
      for (int i = 0; i < image.grid.count[0]; ++i)
      {
        const Eigen::Vector3d x = image.grid.position(i + image.grid.lower[0], j + image.grid.lower[1], k + image.grid.lower[2]);
        for (std::size_t r = 0; r < s.size(); ++r)
        {
          s[r] = field.value(int(r), x);
        }
        int claims = 0;
        int claimant = 0;
        double largest = -1e30;
        for (std::size_t r = 0; r < s.size(); ++r)
        {
          double other = -1e30;
          for (std::size_t q = 0; q < s.size(); ++q)
          {
            other = q == r ? other : std::max(other, s[q]);
          }
          const double f = std::min(s[r] + growth, 0.5 * (s[r] - other - gap));
          largest = std::max(largest, f);
          if (f > 0.0)
          {
            ++claims;
            claimant = fibres.fibreIds[field.fibre(int(r))];
          }
        }
        EXPECT_LE(claims, 1);
        const std::size_t at = image.grid.index(i + image.grid.lower[0], j + image.grid.lower[1], k + image.grid.lower[2]);
        const double depth = std::max(largest, -band);
        inside += claims;
        // Within rounding of the surface, either side is right.
        const bool close = std::abs(largest) < 5e-6;
        wrong += !close && (image.fibreId[at] != claimant || std::abs(image.depth[at] - depth) > 5e-6);
      }
    }
  }
  EXPECT_EQ(wrong, 0u);
  return inside;
}

TEST(CapsuleField, IsTheUnionOfTheBallsAlongTheCapsules)
{
  const Fibres fibres = tangle(6.0, 10, 1);
  FibreRadialGrowthOptions options;
  options.surfaceRoughness = 0.0;
  const CapsuleField field = fieldOf(fibres, options);
  RandomEngine engine = randomStream(2, RandomStage::Directions);
  for (int n = 0; n < 300; ++n)
  {
    const Eigen::Vector3d x(6.0 * uniform(engine) - 3.0, 6.0 * uniform(engine) - 3.0, 6.0 * uniform(engine) - 3.0);
    for (std::size_t f = 0; f < fibres.size(); ++f)
    {
      ASSERT_NEAR(field.value(int(f), x), searchedValue(fibres, f, x), 1e-7);
    }
  }
}

TEST(CapsuleField, RoughSeedsStayInsideTheCapsulesAndHoldTheirCore)
{
  const Fibres fibres = tangle(6.0, 6, 3);
  const double thickest = *std::max_element(fibres.radii.begin(), fibres.radii.end());
  for (const double roughness : { 0.1, 0.3, 0.5 })
  {
    Fibres core = fibres;
    for (double& radius : core.radii)
    {
      radius *= 1.0 - roughness;
    }
    FibreRadialGrowthOptions options;
    options.surfaceRoughness = roughness;
    const CapsuleField field = fieldOf(fibres, options);
    double largestLoss = 0.0;
    double smallestLoss = 1.0;
    RandomEngine engine = randomStream(4, RandomStage::Directions);
    for (int n = 0; n < fewerWhereSanitized(2000); ++n)
    {
      const Eigen::Vector3d x(6.0 * uniform(engine) - 3.0, 6.0 * uniform(engine) - 3.0, 6.0 * uniform(engine) - 3.0);
      for (std::size_t f = 0; f < fibres.size(); ++f)
      {
        const double loss = searchedValue(fibres, f, x) - field.value(int(f), x);
        ASSERT_GE(loss, -1e-9);
        ASSERT_GE(field.value(int(f), x), searchedValue(core, f, x) - 1e-9);
        largestLoss = std::max(largestLoss, loss / thickest);
        smallestLoss = std::min(smallestLoss, loss / thickest);
      }
    }
    // Uneven indeed: more than half of the roughness in one place, almost none in another.
    EXPECT_GT(largestLoss, 0.5 * roughness);
    EXPECT_LT(smallestLoss, 0.05 * roughness);
  }
}

// On the axis of a straight fibre the field is the seed's radius.
TEST(CapsuleField, RoughnessVariesTheCalibreSmoothly)
{
  const auto calibre = [&](int id, double roughness, std::uint64_t seed, int points)
  {
    Fibres fibres = emptyFibres(40.0);
    addStraight(fibres, { 0, 0, -20 }, { 0, 0, 20 }, 1.0, points, id);
    FibreRadialGrowthOptions options;
    options.surfaceRoughness = roughness;
    options.seed = seed;
    const CapsuleField field = fieldOf(fibres, options);
    std::vector<double> radii;
    for (double z = -19.0; z < 19.0; z += 0.05)
    {
      radii.push_back(field.value(0, { 0.0, 0.0, z }));
    }
    return radii;
  };
  for (const double roughness : { 0.0, 0.1, 0.4 })
  {
    const std::vector<double> radii = calibre(1, roughness, 1, 2);
    const double mean = std::accumulate(radii.begin(), radii.end(), 0.0) / static_cast<double>(radii.size());
    double square = 0.0;
    double step = 0.0;
    for (std::size_t i = 1; i < radii.size(); ++i)
    {
      square += (radii[i] - mean) * (radii[i] - mean);
      step = std::max(step, std::abs(radii[i] - radii[i - 1]));
    }
    const double deviation = std::sqrt(square / static_cast<double>(radii.size()));
    EXPECT_NEAR(deviation, 0.25 * roughness, 0.1 * roughness + 1e-9);
    EXPECT_LE(step, 0.4 * roughness * 0.05 + 1e-9); // at most 0.4 of the roughness per µm
    if (roughness > 0.0)
    {
      // Depends only on seed, fibre and length.
      EXPECT_NE(radii, calibre(1, roughness, 2, 2));
      EXPECT_NE(radii, calibre(2, roughness, 1, 2));
      const std::vector<double> cutDifferently = calibre(1, roughness, 1, 31);
      for (std::size_t i = 0; i < radii.size(); ++i)
      {
        EXPECT_NEAR(cutDifferently[i], radii[i], 0.15 * roughness);
      }
    }
  }
}

TEST(CapsuleField, IsOneLipschitz)
{
  const Fibres fibres = tangle(6.0, 10, 5);
  const CapsuleField field = fieldOf(fibres, FibreRadialGrowthOptions());
  RandomEngine engine = randomStream(6, RandomStage::Directions);
  const auto random = [&](double scale)
  { return Eigen::Vector3d(scale * (uniform(engine) - 0.5), scale * (uniform(engine) - 0.5), scale * (uniform(engine) - 0.5)); };
  for (int n = 0; n < 2000; ++n)
  {
    const Eigen::Vector3d x = random(6.0);
    const Eigen::Vector3d y = x + random(n % 2 == 0 ? 0.01 : 1.0);
    for (std::size_t f = 0; f < fibres.size(); ++f)
    {
      ASSERT_LE(std::abs(field.value(int(f), x) - field.value(int(f), y)), (x - y).norm() + 1e-12);
    }
  }
}

// Works for any distance of samples relative to the fibres' radii, which changes the size of shared searches.
TEST(CapsuleField, SweepsFindTheTwoLargestFields)
{
  const Fibres fibres = tangle(16.0, 60, 11);
  FibreRadialGrowthOptions options;
  options.surfaceRoughness = 0.2;
  const CapsuleField field = fieldOf(fibres, options);
  std::size_t close = 0;
  for (const double spacing : { 0.05, 0.25, 0.5, 1.0, 2.0, 7.0 })
  {
    VoxelGrid grid;
    grid.spacing = spacing;
    grid.origin = Eigen::Vector3d(-7.9, -7.8, -7.7);
    grid.count.fill(std::min(19, int(15.0 / spacing)));
    FieldRelevance relevance;
    relevance.bestReach = 0.3;
    relevance.secondReach = 0.3;
    relevance.contrast = 0.3;
    std::vector<float> best(grid.size());
    std::vector<float> second(grid.size());
    Context context;
    context.threads = 2;
    field.sweep(grid, relevance, context, 0.0, 1.0, "",
      [&](const FieldCell& cell, int)
      {
        for (int k = cell.begin[2]; k < cell.end[2]; ++k)
        {
          for (int j = cell.begin[1]; j < cell.end[1]; ++j)
          {
            for (int i = cell.begin[0]; i < cell.end[0]; ++i)
            {
              const std::size_t at = grid.index(cell.lower[0] + i, cell.lower[1] + j, cell.lower[2] + k);
              const int n = i + FieldCell::edge * (j + FieldCell::edge * k);
              best[at] = cell.best[n];
              second[at] = cell.second[n];
            }
          }
        }
      });
    for (int k = 0; k < grid.count[2]; ++k)
    {
      for (int j = 0; j < grid.count[1]; ++j)
      {
        for (int i = 0; i < grid.count[0]; ++i)
        {
          std::vector<double> fields;
          for (std::size_t rank = 0; rank < field.size(); ++rank)
          {
            fields.push_back(field.value(int(rank), grid.position(i, j, k)));
          }
          std::nth_element(fields.begin(), fields.begin() + 1, fields.end(), std::greater<double>());
          const std::size_t at = grid.index(i, j, k);
          if (fields[0] <= -relevance.bestReach)
          {
            ASSERT_LE(best[at], -relevance.bestReach + 1e-5);
            continue;
          }
          ASSERT_NEAR(best[at], fields[0], 1e-5) << spacing;
          if (fields[0] - fields[1] < relevance.contrast)
          {
            ASSERT_NEAR(second[at], fields[1], 1e-5) << spacing;
            ++close;
          }
        }
      }
    }
  }
  EXPECT_GT(close, 500u);
}

TEST(FibreRadialGrowth, MatchesTheDefinitionAtEverySample)
{
  const Fibres fibres = tangle(3.0, 9, 7);
  for (const double roughness : { 0.0, 0.2, 0.5 })
  {
    for (const double growth : { -0.1, 0.1, 0.6 })
    {
      FibreRadialGrowthOptions options;
      options.voxelSize = 0.1;
      options.surfaceRoughness = roughness;
      options.margin = 0.25;
      const LabelImage image = growFibres(fibres, options, growth, growthGrid(fibres.domain, options));
      EXPECT_GT(expectMatchesDefinition(fibres, options, growth, image), 1000u);
    }
  }
}

TEST(FibreRadialGrowth, DepthIsTheDistanceToALoneCylinder)
{
  for (int axis = 0; axis < 3; ++axis) // along x too, which crashed an earlier version
  {
    Fibres fibres = emptyFibres(6.0);
    Eigen::Vector3d from = Eigen::Vector3d::Zero();
    from[axis] = -6.0;
    addStraight(fibres, from, -from, 1.0);
    FibreRadialGrowthOptions options;
    options.voxelSize = 0.1;
    options.surfaceRoughness = 0.0;
    options.growthIterations = 3;
    EXPECT_DOUBLE_EQ(growthFor(fibres, options).growth, 3 * 0.1);
    const LabelImage image = grown(fibres, options);
    for (int k = 0; k < 60; ++k)
    {
      for (int j = 0; j < 60; ++j)
      {
        for (int i = 0; i < 60; ++i)
        {
          Eigen::Vector3d x = image.grid.position(i, j, k);
          x[axis] = 0.0;
          const double depth = 1.3 - x.norm();
          const std::size_t at = image.grid.index(i, j, k);
          ASSERT_EQ(image.fibreId[at], depth > 0.0 ? 1 : 0);
          ASSERT_NEAR(image.depth[at], std::max(depth, -0.4), 2e-6);
        }
      }
    }
    EXPECT_NEAR(filledFraction(image), pi * 1.3 * 1.3 / 36.0, 3e-3);
  }
}

TEST(FibreRadialGrowth, NeighboursKeepTheGapAlongAnyLine)
{
  // Two that touch, and two that overlap.
  for (const double distance : { 2.0, 1.7 })
  {
    Fibres fibres = emptyFibres(6.0);
    addStraight(fibres, { -0.5 * distance, 0, -6 }, { -0.5 * distance, 0, 6 }, 1.0);
    addStraight(fibres, { 0.5 * distance, 0, -6 }, { 0.5 * distance, 0, 6 }, 1.0);
    FibreRadialGrowthOptions options;
    options.voxelSize = 0.05;
    options.minimumGap = 0.06;
    options.surfaceTolerance = 0.01;
    options.growthIterations = 6;
    for (const double roughness : { 0.0, 0.2 })
    {
      options.surfaceRoughness = roughness;
      const LabelImage image = grown(fibres, options);
      const double gap = 0.08;
      // Zero crossings of either fibre's own field along lines of samples in x.
      const FibreField field({ image.grid, image.fibreId.data(), image.depth.data(), gap }, fibres.domain, true);
      int pairs = 0;
      double narrowest = 10.0;
      for (int k = 0; k < image.grid.count[2]; k += 7)
      {
        for (int j = 0; j < image.grid.count[1]; ++j)
        {
          double leftEnd = -10.0;
          double rightBegin = 10.0;
          for (int i = 0; i + 1 < image.grid.count[0]; ++i)
          {
            const double x = image.grid.position(i, j, k).x();
            const double l0 = fieldAtSample(field, 1, i, j, k);
            const double l1 = fieldAtSample(field, 1, i + 1, j, k);
            if (l0 > 0.0 && l1 <= 0.0)
            {
              leftEnd = x + 0.05 * l0 / (l0 - l1);
            }
            const double r0 = fieldAtSample(field, 2, i, j, k);
            const double r1 = fieldAtSample(field, 2, i + 1, j, k);
            if (r0 <= 0.0 && r1 > 0.0)
            {
              rightBegin = x + 0.05 * r0 / (r0 - r1);
            }
            ASSERT_LE(l0 + r0, -gap + 1e-6);
          }
          if (leftEnd > -10.0 && rightBegin < 10.0)
          {
            ++pairs;
            narrowest = std::min(narrowest, rightBegin - leftEnd);
          }
        }
      }
      EXPECT_GT(pairs, 200);
      EXPECT_GE(narrowest, gap - 1e-5);
      EXPECT_LE(narrowest, gap + 0.05);
    }
  }
}

TEST(FibreRadialGrowth, KeepsTheSymmetryOfAHexagonalBundle)
{
  const Fibres fibres = hexagon(6.0, 0.9, 1.9);
  FibreRadialGrowthOptions options;
  options.voxelSize = 0.1;
  options.surfaceRoughness = 0.0;
  options.growthIterations = 5;
  const LabelImage image = grown(fibres, options);
  const int opposite[8] = { 0, 1, 5, 6, 7, 2, 3, 4 };
  const int mirrored[8] = { 0, 1, 2, 7, 6, 5, 4, 3 };
  for (int j = 0; j < 60; ++j)
  {
    for (int i = 0; i < 60; ++i)
    {
      const std::size_t a = image.grid.index(i, j, 30);
      const std::size_t b = image.grid.index(59 - i, 59 - j, 30);
      const std::size_t c = image.grid.index(i, 59 - j, 30);
      ASSERT_NEAR(image.depth[a], image.depth[b], 2e-6);
      ASSERT_NEAR(image.depth[a], image.depth[c], 2e-6);
      if (std::abs(image.depth[a]) > 1e-5 && image.depth[a] > 0.0)
      {
        ASSERT_EQ(opposite[image.fibreId[a]], image.fibreId[b]);
        ASSERT_EQ(mirrored[image.fibreId[a]], image.fibreId[c]);
      }
    }
  }
  // The cell of the middle fibre is a hexagon, minus the gap.
  const std::size_t centre = image.grid.index(30, 30, 30);
  EXPECT_EQ(image.fibreId[centre], 1);
  EXPECT_NEAR(image.depth[centre], 0.95 - 0.015, 0.08);
}

TEST(FibreRadialGrowth, APartEqualsThatPartOfTheWholeBitForBit)
{
  Fibres fibres = tangle(5.0, 16, 8);
  FibreRadialGrowthOptions options;
  options.voxelSize = 0.1;
  options.margin = 0.3;
  options.targetFibreVolumeFraction = 0.6;
  const VoxelGrid whole = growthGrid(fibres.domain, options);
  RandomEngine engine = randomStream(9, RandomStage::Directions);
  double growth = 0.0;
  LabelImage image;
  for (int n = 0; n < 25; ++n)
  {
    if (n == 0 || n == 15)
    {
      // Later with axons that grow more slowly.
      for (std::size_t f = 0; f < fibres.size() && n > 0; f += 3)
      {
        fibres.columns.set(targetGRatioColumn.name, f, bareGRatio);
      }
      growth = growthFor(fibres, options).growth;
      image = growFibres(fibres, options, growth, whole);
    }
    std::array<int, 3> lower{};
    std::array<int, 3> count{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      lower[axis] = int(uniform(engine) * whole.count[axis]);
      count[axis] = 1 + int(uniform(engine) * (whole.count[axis] - lower[axis]));
      if (n % 5 == int(axis))
      {
        count[axis] = 1;
      }
    }
    const LabelImage part = growFibres(fibres, options, growth, extent(whole, lower, count));
    ASSERT_EQ(part.depth.size(), std::size_t(count[0]) * std::size_t(count[1]) * std::size_t(count[2]));
    for (int k = lower[2]; k < lower[2] + count[2]; ++k)
    {
      for (int j = lower[1]; j < lower[1] + count[1]; ++j)
      {
        const std::size_t a = part.grid.index(lower[0], j, k);
        const std::size_t b = image.grid.index(lower[0], j, k);
        ASSERT_EQ(std::memcmp(&part.fibreId[a], &image.fibreId[b], std::size_t(count[0]) * sizeof(std::int32_t)), 0);
        ASSERT_EQ(std::memcmp(&part.depth[a], &image.depth[b], std::size_t(count[0]) * sizeof(float)), 0);
      }
    }
  }
}

TEST(FibreRadialGrowth, GivesTheSameBitsOnAnyNumberOfThreads)
{
  const Fibres fibres = tangle(6.0, 20, 10);
  FibreRadialGrowthOptions options;
  options.targetFibreVolumeFraction = 0.6;
  const LabelImage one = grown(fibres, options, 1);
  for (const int threads : { 2, 5 })
  {
    const LabelImage many = grown(fibres, options, threads);
    EXPECT_TRUE(sameBits(one.fibreId, many.fibreId));
    EXPECT_TRUE(sameBits(one.depth, many.depth));
  }
}

TEST(FibreRadialGrowth, DoesNotDependOnHowFibresAreNumbered)
{
  const Fibres fibres = tangle(5.0, 12, 11);
  FibreRadialGrowthOptions options;
  options.surfaceRoughness = 0.0; // rough seeds are keyed by fibre id
  const LabelImage image = grown(fibres, options);
  // The same fibres in reverse order, with other ids.
  Fibres other = emptyFibres(5.0);
  for (std::size_t f = fibres.size(); f-- > 0;)
  {
    other.addFibre(100 + 7 * (fibres.fibreIds[f] % 5) + fibres.fibreIds[f] * 50, 1, fibres.targetRadii[f]);
    for (std::size_t p = fibres.offsets[f]; p < fibres.offsets[f + 1]; ++p)
    {
      other.addPoint(fibres.points[p], fibres.radii[p]);
    }
  }
  const LabelImage renamed = grown(other, options);
  EXPECT_TRUE(sameBits(image.depth, renamed.depth));
  for (std::size_t v = 0; v < image.fibreId.size(); ++v)
  {
    const int id = image.fibreId[v];
    ASSERT_EQ(renamed.fibreId[v], id == 0 ? 0 : 100 + 7 * (id % 5) + id * 50);
  }
}

TEST(FibreRadialGrowth, RoughSeedsFollowTheFibreNotItsPlaceInTheInput)
{
  const Fibres fibres = tangle(4.0, 8, 12);
  Fibres reversed = emptyFibres(4.0);
  for (std::size_t f = fibres.size(); f-- > 0;)
  {
    reversed.addFibre(fibres.fibreIds[f], 1, fibres.targetRadii[f]);
    for (std::size_t p = fibres.offsets[f]; p < fibres.offsets[f + 1]; ++p)
    {
      reversed.addPoint(fibres.points[p], fibres.radii[p]);
    }
  }
  FibreRadialGrowthOptions options;
  options.surfaceRoughness = 0.1;
  const LabelImage a = grown(fibres, options);
  const LabelImage b = grown(reversed, options);
  EXPECT_TRUE(sameBits(a.fibreId, b.fibreId));
  EXPECT_TRUE(sameBits(a.depth, b.depth));
  options.seed = 2;
  EXPECT_FALSE(sameBits(a.depth, grown(fibres, options).depth));
}

TEST(FibreRadialGrowth, MeetsATargetFraction)
{
  for (const double target : { 0.3, 0.6, 0.8, 0.93 })
  {
    for (const double voxel : { 0.1, 0.23 })
    {
      const Fibres fibres = hexagon(5.0, 0.7, 1.6);
      FibreRadialGrowthOptions options;
      options.voxelSize = voxel;
      options.surfaceRoughness = 0.2; // otherwise voxels and fibres line up, and counting voxels has a larger error than the
                                      // growth
      options.targetFibreVolumeFraction = target;
      const double growth = growthFor(fibres, options).growth;
      options.voxelSize = 0.05;
      const LabelImage image = growFibres(fibres, options, growth, growthGrid(fibres.domain, options));
      EXPECT_NEAR(filledFraction(image), target, 0.003);
    }
  }
  // Shrinks if there is too much already, for a cylinder with a known answer.
  Fibres one = emptyFibres(4.0);
  addStraight(one, { 0, 0, -4 }, { 0, 0, 4 }, 1.2);
  FibreRadialGrowthOptions options;
  options.surfaceRoughness = 0.0;
  options.targetFibreVolumeFraction = 0.15;
  EXPECT_NEAR(growthFor(one, options).growth, std::sqrt(0.15 * 16.0 / pi) - 1.2, 5e-4);
  options.targetFibreVolumeFraction = 0.5;
  EXPECT_NEAR(growthFor(one, options).growth, std::sqrt(0.5 * 16.0 / pi) - 1.2, 5e-4);
}

TEST(FibreRadialGrowth, FillsWhatItCanOfATargetThatCannotBeReached)
{
  const Fibres fibres = hexagon(5.0, 0.7, 1.6);
  FibreRadialGrowthOptions options;
  options.minimumGap = 0.2;
  options.surfaceTolerance = 0.0;
  options.targetFibreVolumeFraction = 0.99;
  const SolvedGrowth most = growthFor(fibres, options);
  const std::string remark = remarkOnGrowth(fibres, options, most);
  EXPECT_NE(
    remark.find(text("TargetFibreVolumeFraction 0.99 cannot be reached: the fibres fill ", most.fraction)), std::string::npos)
    << remark;
  EXPECT_NEAR(filledFraction(growFibres(fibres, options, most.growth, growthGrid(fibres.domain, options))), most.fraction, 0.003);
  EXPECT_LT(most.growth, 2.0) << "no more than it takes";
  // Just below it, the target is reached, by less growth.
  options.targetFibreVolumeFraction = most.fraction - 0.005;
  const SolvedGrowth reached = growthFor(fibres, options);
  EXPECT_LT(reached.growth, most.growth);
  EXPECT_EQ(remarkOnGrowth(fibres, options, reached), "");
  // Fibres that are nowhere near fill nothing.
  Fibres away = fibres;
  away.domain.lower.array() += 100.0;
  away.domain.upper.array() += 100.0;
  EXPECT_NE(messageOf<Infeasible>([&] { growthFor(away, options); }).find("no fibre into the domain"), std::string::npos);
  // A target that cuts the thinnest fibre in two is refused.
  Fibres uneven = emptyFibres(4.0);
  addStraight(uneven, { -1, 0, -4 }, { -1, 0, 4 }, 1.0);
  addStraight(uneven, { 1, 0, -4 }, { 1, 0, 4 }, 0.2);
  options.targetFibreVolumeFraction = 0.05;
  EXPECT_NE(messageOf<Infeasible>([&] { growthFor(uneven, options); }).find("severs fibre 2"), std::string::npos);
}

TEST(FibreRadialGrowth, GridFillsTheDomain)
{
  FibreRadialGrowthOptions options;
  options.voxelSize = 0.1;
  const VoxelGrid grid = growthGrid(Domain::cube(30.0), options);
  EXPECT_EQ(grid.count, (std::array<int, 3>{ { 300, 300, 300 } }));
  EXPECT_DOUBLE_EQ(grid.spacing, 0.1);
  EXPECT_TRUE(grid.origin.isApproxToConstant(-14.95, 1e-12));

  options.voxelSize = 0.7; // does not divide 10
  const VoxelGrid other = growthGrid(Domain::cube(10.0), options);
  EXPECT_EQ(other.count[0], 14);
  EXPECT_DOUBLE_EQ(other.spacing, 10.0 / 14.0);

  options.voxelSize = 0.1;
  options.margin = 0.15;
  const VoxelGrid wide = growthGrid(Domain::cube(10.0), options);
  EXPECT_EQ(wide.count[0], 104);
  EXPECT_NEAR(wide.position(2, 2, 2).x(), -4.95, 1e-12);

  options.margin = 0.0;
  Domain box = Domain::cube(10.0);
  box.upper.z() = 25.0;
  EXPECT_EQ(growthGrid(box, options).count, (std::array<int, 3>{ { 100, 100, 300 } }));
  options.voxelSize = 0.11; // 10/0.11 = 90.9, and 30/0.11 = 272.7: 91 and 273 fit
  EXPECT_EQ(growthGrid(box, options).count, (std::array<int, 3>{ { 91, 91, 273 } }));
  // With many voxels, too, none ends beside the face.
  const FibreRadialGrowthOptions fine;
  Domain large = Domain::cube(100.0);
  large.upper.x() = large.lower.x() + 1000.0;
  large.upper.z() = large.lower.z() + 100.0005;
  EXPECT_NE(messageOf<InvalidInput>([&] { growthGrid(large, fine); }).find("VoxelSize"), std::string::npos);
  box.upper.z() = -5.0 + 10.0 * std::sqrt(2.0);
  EXPECT_NE(messageOf<InvalidInput>([&] { growthGrid(box, options); }).find("VoxelSize"), std::string::npos);
}

TEST(FibreRadialGrowth, RejectsWhatItCannotWorkWith)
{
  const Fibres fibres = hexagon(5.0, 0.7, 1.6);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto message = [&](const std::function<void(FibreRadialGrowthOptions&)>& spoil)
  {
    FibreRadialGrowthOptions options;
    spoil(options);
    return messageOf<InvalidInput>([&] { growthFor(fibres, options); });
  };
  using Options = FibreRadialGrowthOptions;
  for (const double bad : { 0.0, -0.1, nan, std::numeric_limits<double>::infinity() })
  {
    EXPECT_NE(message([&](Options& o) { o.voxelSize = bad; }).find("VoxelSize"), std::string::npos);
  }
  EXPECT_NE(message([](Options& o) { o.voxelSize = 1e-12; }).find("VoxelSize"), std::string::npos);
  EXPECT_NE(message([](Options& o) { o.voxelSize = 100.0; }).find("VoxelSize"), std::string::npos);
  for (const double bad : { -0.1, 1.0, nan })
  {
    EXPECT_NE(
      message([&](Options& o) { o.targetFibreVolumeFraction = bad; }).find("TargetFibreVolumeFraction"), std::string::npos);
    EXPECT_NE(message([&](Options& o) { o.surfaceRoughness = bad; }).find("SurfaceRoughness"), std::string::npos);
  }
  for (const double bad : { -0.1, nan, 200.0, 1e300 })
  {
    EXPECT_NE(message([&](Options& o) { o.minimumGap = bad; }).find("MinimumGap"), std::string::npos);
    EXPECT_NE(message([&](Options& o) { o.surfaceTolerance = bad; }).find("SurfaceTolerance"), std::string::npos);
    EXPECT_NE(message([&](Options& o) { o.margin = bad; }).find("Margin"), std::string::npos);
  }
  EXPECT_NE(message([](Options& o) { o.growthIterations = -1; }).find("GrowthIterations"), std::string::npos);
  EXPECT_NE(message([](Options& o) { o.growthIterations = 2000000000; }).find("GrowthIterations"), std::string::npos);

  Fibres spoilt = fibres;
  spoilt.radii[3] = -1.0;
  EXPECT_NE(messageOf<InvalidInput>([&] { growthFor(spoilt, Options()); }).find("fibre 2"), std::string::npos);
  spoilt = fibres;
  spoilt.domain.periodic[2] = true;
  messageOf<InvalidInput>([&] { growthFor(spoilt, Options()); });

  const VoxelGrid whole = growthGrid(fibres.domain, Options());
  for (const VoxelGrid& part : { extent(whole, { 0, 0, 0 }, { 51, 50, 50 }), extent(whole, { -1, 0, 0 }, { 5, 5, 5 }),
         extent(whole, { 0, 0, 0 }, { 0, 5, 5 }) })
  {
    std::vector<std::int32_t> ids(1000000, -7);
    std::vector<float> depth(1000000);
    messageOf<InvalidInput>([&] { growFibres(fibres, Options(), 0.1, part, ids.data(), depth.data()); });
    EXPECT_EQ(ids[0], -7);
  }
}

TEST(FibreRadialGrowth, AGridBeyondMemoryNamesTheVoxelSize)
{
  const Fibres fibres = hexagon(30.0, 0.7, 1.6);
  FibreRadialGrowthOptions options;
  options.voxelSize = 0.001;
  const std::string message =
    messageOf<OutOfMemory>([&] { growFibres(fibres, options, 0.1, growthGrid(fibres.domain, options)); });
  EXPECT_NE(message.find("VoxelSize 0.001"), std::string::npos) << message;
}

TEST(FibreRadialGrowth, StopsWhenAsked)
{
  const Fibres fibres = hexagon(5.0, 0.7, 1.6);
  FibreRadialGrowthOptions options;
  options.voxelSize = 0.05;
  Context context;
  context.threads = 1;
  double last = -1.0;
  context.progress = [&](double fraction, const std::string&)
  {
    EXPECT_GE(fraction, last);
    last = fraction;
  };
  context.cancelled = [&] { return last > 0.3; };
  const VoxelGrid grid = growthGrid(fibres.domain, options);
  EXPECT_THROW(growFibres(fibres, options, 0.1, grid, context), Cancelled);
  EXPECT_GT(last, 0.3);
  EXPECT_LT(last, 0.9);

  options.targetFibreVolumeFraction = 0.8;
  context.threads = 2;
  context.progress = nullptr;
  context.cancelled = [] { return true; };
  EXPECT_THROW(growthFor(fibres, options, context), Cancelled);
  EXPECT_THROW(growFibres(fibres, options, 0.1, grid, context), Cancelled);
}

TEST(FibreRadialGrowth, FibresFarAwayOrLongerThanTheDomainAreNoTrouble)
{
  Fibres fibres = emptyFibres(4.0);
  addStraight(fibres, { 0, 0, -500 }, { 0, 0, 500 }, 0.8); // one segment of a millimetre
  addStraight(fibres, { 90, 0, -2 }, { 90, 0, 2 }, 0.5);
  FibreRadialGrowthOptions options;
  options.growthIterations = 2;
  const LabelImage image = grown(fibres, options);
  expectMatchesDefinition(fibres, options, 0.2, image);
  EXPECT_EQ(std::count(image.fibreId.begin(), image.fibreId.end(), 2), 0);
  // The part in the domain, which counts for a target, is the same as for a short one.
  for (const double reach : { 1.5, 500.0, 20000.0 })
  {
    Fibres one = emptyFibres(4.0);
    addStraight(one, { 0, 0, -2.0 - reach }, { 0, 0, 2.0 + reach }, 0.5);
    EXPECT_NEAR(volumeInDomain(one, 0, 1.0), pi, 0.1) << reach;
  }
  // A domain without any fibre in it is all outside.
  Fibres away = emptyFibres(4.0);
  addStraight(away, { 90, 0, -2 }, { 90, 0, 2 }, 0.5);
  const LabelImage empty = grown(away, options);
  EXPECT_EQ(filledFraction(empty), 0.0);
  EXPECT_EQ(*std::max_element(empty.depth.begin(), empty.depth.end()), -0.4f);
}

} // namespace
