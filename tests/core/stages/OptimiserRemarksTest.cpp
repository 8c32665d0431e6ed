// SPDX-License-Identifier: BSD-3-Clause
// What the user of an optimisation is told.
#include "stages/StageWork.h"

#include <gtest/gtest.h>

#include <string>

namespace
{

using cactus::OptimisationResult;

std::string remarksOn(const OptimisationResult& result)
{
  std::string all;
  for (const std::string& remark : cactus::remarksOnOptimisation(result, {}))
  {
    all += remark + '\n';
  }
  return all;
}

} // namespace

TEST(OptimiserRemarks, NothingIsSaidOfWhatWentWell)
{
  OptimisationResult result;
  result.lengthIncrease = 0.05;
  EXPECT_EQ(remarksOn(result), "");
}

TEST(OptimiserRemarks, ResamplingAndLongerFibresAreTold)
{
  OptimisationResult result;
  result.resampling = { 3, 0.0125 };
  result.lengthIncrease = 0.231;
  const std::string told = remarksOn(result);
  EXPECT_NE(told.find("3 fibres have control points closer together"), std::string::npos) << told;
  EXPECT_NE(told.find("0.0125 µm"), std::string::npos) << told;
  EXPECT_NE(told.find("23 % longer"), std::string::npos) << told;
  EXPECT_NE(told.find("LengthWeight"), std::string::npos) << told;
}

TEST(OptimiserRemarks, OverlapsThatStayComeFirst)
{
  OptimisationResult result;
  result.reason = cactus::StopReason::Stagnated;
  result.maximumPenetration = 0.1;
  result.lengthIncrease = 0.231;
  result.convergence.emplace_back();
  const std::string told = remarksOn(result);
  EXPECT_NE(told.find("overlaps remain"), std::string::npos) << told;
  EXPECT_NE(told.find("fibres that were not made here need more room"), std::string::npos) << told;
  EXPECT_EQ(told.find("longer (LengthIncrease)"), std::string::npos) << told;
}
