// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/DirectionDistribution.h"

#include "base/Constants.h"
#include "base/Error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace cactus;

namespace
{

using cactus::degree;

std::vector<double> sample(const DirectionDistribution& distribution, int count)
{
  std::vector<double> angles;
  for (int i = 0; i < count; ++i)
  {
    RandomEngine engine = randomStream(4, RandomStage::Directions, static_cast<std::uint64_t>(i));
    angles.push_back(distribution.sampleAngle(engine));
  }
  std::sort(angles.begin(), angles.end());
  return angles;
}

} // namespace

TEST(DirectionDistribution, MeanAngleIsTheOneAsked)
{
  for (const DispersionModel model : { DispersionModel::Watson, DispersionModel::Cone })
  {
    for (const double asked : { 0.01, 1.0, 5.0, 15.0, 25.0, 45.0 })
    {
      double sum = 0.0;
      for (const double angle : sample(DirectionDistribution(model, asked), 40000))
      {
        sum += angle / degree;
      }
      EXPECT_NEAR(sum / 40000, asked, 0.012 * asked) << static_cast<int>(model);
    }
  }
}

TEST(DirectionDistribution, WatsonAnglesFollowTheirDensity)
{
  for (const double asked : { 5.0, 30.0, 45.0 })
  {
    const DirectionDistribution watson(DispersionModel::Watson, asked);
    const auto angles = sample(watson, 10000);
    // Numerically integrated density exp(κ cos²θ) sin θ, compared with the sorted sample.
    constexpr int steps = 90000;
    std::vector<double> cumulative(steps + 1, 0.0);
    for (int i = 0; i < steps; ++i)
    {
      const double angle = 90.0 * degree * (i + 0.5) / steps;
      const double cosine = std::cos(angle);
      cumulative[static_cast<std::size_t>(i) + 1] =
        cumulative[static_cast<std::size_t>(i)] + std::exp(watson.parameter() * (cosine * cosine - 1.0)) * std::sin(angle);
    }
    double worst = 0.0;
    for (std::size_t i = 0; i < angles.size(); ++i)
    {
      const auto bin = static_cast<std::size_t>(angles[i] / (90.0 * degree) * steps);
      worst = std::max(worst, std::abs(cumulative[std::min<std::size_t>(bin, steps)] / cumulative.back() - (i + 0.5) / 10000.0));
    }
    EXPECT_LT(worst, 0.0163) << asked; // the 1 % point
  }
}

TEST(DirectionDistribution, ConeIsUniformInItsCap)
{
  const DirectionDistribution cone(DispersionModel::Cone, 20.0);
  const auto angles = sample(cone, 10000);
  EXPECT_LE(angles.back(), cone.parameter());
  double worst = 0.0;
  for (std::size_t i = 0; i < angles.size(); ++i)
  {
    const double expected = (1.0 - std::cos(angles[i])) / (1.0 - std::cos(cone.parameter()));
    worst = std::max(worst, std::abs(expected - (i + 0.5) / 10000.0));
  }
  EXPECT_LT(worst, 0.0163);
}

TEST(DirectionDistribution, AnglesOutOfRangeAreRefused)
{
  for (const double asked : { 0.0, -1.0, 46.0, std::nan("") })
  {
    EXPECT_THROW(DirectionDistribution(DispersionModel::Watson, asked), InvalidInput);
  }
}
