// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: a seed gives the same random numbers wherever the elementary functions have the same bits. The answers are those of
// GNU libstdc++ 12 with the same engine, which made the first substrates.
#include "base/RandomVariates.h"

#include "ElementaryFunctions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace
{

using namespace cactus;

RandomEngine stream(std::uint64_t item = 0)
{
  return randomStream(1, RandomStage::Radii, item);
}

/// The mean and variance of numbers.
std::pair<double, double> moments(const std::vector<double>& numbers)
{
  double sum = 0.0;
  double squares = 0.0;
  for (const double x : numbers)
  {
    sum += x;
    squares += x * x;
  }
  const double mean = sum / double(numbers.size());
  return { mean, squares / double(numbers.size()) - mean * mean };
}

} // namespace

TEST(RandomVariates, EngineHasKnownNumbers)
{
  RandomEngine engine = stream();
  for (const std::uint32_t known : { 0x22786bdau, 0x18eab44au, 0xb53e90b6u, 0xf8361f71u, 0x954992e6u, 0xa37e7e9eu })
  {
    EXPECT_EQ(engine(), known);
  }
  engine = randomStream(0x123456789abcdef0u, RandomStage::Directions, 0xfedcba9876543210u);
  for (const std::uint32_t known : { 0xb9b7c03cu, 0x92e7e8d3u, 0x7b9b5f81u, 0x06b410e4u, 0x0f0fbb5du, 0x8d2f8a19u })
  {
    EXPECT_EQ(engine(), known);
  }
}

TEST(RandomVariates, UniformNumbersAreKnown)
{
  RandomEngine engine = stream();
  for (const double known : { 0x1.13c35ed0c755cp-3, 0x1.6a7d216df06c3p-1, 0x1.2a9325cd46fcfp-1, 0x1.baf0a185de1a9p-1 })
  {
    EXPECT_EQ(uniform(engine), known);
  }
  engine = stream();
  for (const double known : { 0x1.8eab44a22786cp-4, 0x1.f06c3ee36a7d2p-1, 0x1.46fcfd3d2a932p-1, 0x1.de1a83bfbaf0ap-1 })
  {
    EXPECT_EQ(uniformFromZero(engine), known);
  }
}

TEST(RandomVariates, NormalNumbersAreKnown)
{
  if (const std::string names = unknownElementaryFunctions(); !names.empty())
  {
    GTEST_SKIP() << "this C library has other last digits in " << names;
  }
  RandomEngine engine = stream();
  for (const double known : { -0x1.0b872d94eda86p-1, 0x1.5ff10133765c8p-1, 0x1.6a62865d53414p-2, 0x1.e7a36b3de931p-4 })
  {
    EXPECT_EQ(normal(engine), known);
  }
  engine = stream();
  PolarNormal polarNormal;
  for (const double known :
    { 0x1.2a17ba8456f3dp-1, 0x1.7d1a532fdd7bep-3, 0x1.2e629a0c55e29p+0, -0x1.c124bf0bb3ab8p-1, -0x1.92dc7b62fb152p-1 })
  {
    EXPECT_EQ(polarNormal(engine), known);
  }
}

TEST(RandomVariates, GammaAndLognormalNumbersAreKnown)
{
  if (const std::string names = unknownElementaryFunctions(); !names.empty())
  {
    GTEST_SKIP() << "this C library has other last digits in " << names;
  }
  struct Known
  {
    double shape;
    double values[4];
  };
  const Known gammas[] = {
    { 2.4, { 0x1.82c7dd85e1b34p-1, 0x1.9b258807877b2p-1, 0x1.eda03ae03feafp-3, 0x1.283102d2a221ep-1 } },
    { 0.5, { 0x1.07e6cf4ab4a07p-2, 0x1.3b9aad28b0e07p-6, 0x1.2930b5adb3067p-19, 0x1.585c0c0f7ba72p-7 } },
    { 1.0, { 0x1.43946c5b45567p-2, 0x1.64e85121c223bp-2, 0x1.2e1d021870b58p-5, 0x1.9f596df58c57ap-3 } },
    { 30.0, { 0x1.079dfc4f9eb16p+3, 0x1.0c59fa1493aaap+3, 0x1.8b3654280e51ep+2, 0x1.e93ed039b7dfbp+2 } },
  };
  for (const Known& known : gammas)
  {
    for (std::uint64_t item = 0; item < 4; ++item)
    {
      RandomEngine engine = stream(item);
      EXPECT_EQ(gammaVariate(known.shape, 0.25, engine), known.values[item]) << known.shape << " " << item;
    }
  }
  const double lognormals[] = { 0x1.6ea89056983aep-1, 0x1.8197ce0f9bdf1p-1, 0x1.51d1648ac49dfp-2, 0x1.29b644c5e03c5p-1 };
  for (std::uint64_t item = 0; item < 4; ++item)
  {
    RandomEngine engine = stream(item);
    EXPECT_EQ(lognormalVariate(-0.625, 0.5, engine), lognormals[item]);
  }
}

// Guarantee: means and variances are those of the distributions, to five standard errors.
TEST(RandomVariates, HaveTheMomentsOfTheirDistributions)
{
  constexpr std::size_t draws = 40000;
  std::vector<double> numbers(draws);
  for (const double shape : { 0.3, 0.99, 2.4, 100.0 })
  {
    RandomEngine engine = stream();
    std::generate(numbers.begin(), numbers.end(), [&]() { return gammaVariate(shape, 0.25, engine); });
    const auto [mean, variance] = moments(numbers);
    EXPECT_NEAR(mean, shape * 0.25, 5.0 * 0.25 * std::sqrt(shape / draws));
    // The fourth central moment is (3 + 6/shape) times the variance squared.
    EXPECT_NEAR(variance, shape * 0.0625, 5.0 * shape * 0.0625 * std::sqrt((2.0 + 6.0 / shape) / draws));
    EXPECT_GE(*std::min_element(numbers.begin(), numbers.end()), 0.0);
  }
  RandomEngine engine = stream();
  PolarNormal polarNormal;
  std::generate(numbers.begin(), numbers.end(), [&]() { return polarNormal(engine); });
  const auto [mean, variance] = moments(numbers);
  EXPECT_NEAR(mean, 0.0, 5.0 / std::sqrt(draws));
  EXPECT_NEAR(variance, 1.0, 5.0 * std::sqrt(2.0 / draws));
}
