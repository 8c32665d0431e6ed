// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: parts are contiguous, hold each element once, and differ in weight by less than the heaviest element.
#include "base/EvenParts.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <numeric>
#include <vector>

TEST(EvenParts, AreStretchesOfAboutTheSameWeight)
{
  std::vector<double> weights;
  for (int i = 0; i < 100; ++i)
  {
    weights.push_back(i % 10 == 0 ? 0.0 : 1.0 + i % 7);
  }
  const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (const std::size_t parts : { 1, 2, 3, 7, 250 })
  {
    const std::vector<std::size_t> begins = cactus::evenParts(weights, parts);
    ASSERT_EQ(begins.size(), parts + 1);
    EXPECT_EQ(begins.front(), 0u);
    EXPECT_EQ(begins.back(), weights.size());
    for (std::size_t p = 0; p < parts; ++p)
    {
      ASSERT_LE(begins[p], begins[p + 1]);
      double weight = 0.0;
      for (std::size_t i = begins[p]; i < begins[p + 1]; ++i)
      {
        weight += weights[i];
      }
      EXPECT_NEAR(weight, all / double(parts), 7.0);
    }
  }
}

TEST(EvenParts, TakeFewThingsAndNoWeights)
{
  EXPECT_EQ(cactus::evenParts({}, 3), (std::vector<std::size_t>{ 0, 0, 0, 0 }));
  EXPECT_EQ(cactus::evenParts({ 0.0, 0.0 }, 2), (std::vector<std::size_t>{ 0, 2, 2 }));
  EXPECT_EQ(cactus::evenParts({ 1.0, 1.0 }, 2), (std::vector<std::size_t>{ 0, 1, 2 }));
}
