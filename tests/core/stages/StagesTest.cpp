// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: all stages describe all of their properties, and start from values that they accept.
#include "stages/Stages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace
{

TEST(Stages, DescribeTheirProperties)
{
  const auto stages = cactus::describeStages();
  EXPECT_EQ(stages.size(), 19u);
  for (const cactus::StageDescription& stage : stages)
  {
    EXPECT_NO_THROW(cactus::validate(stage.properties)) << stage.name;
    std::set<std::string> names;
    for (const auto& [facts, value] : stage.properties)
    {
      const std::string what = stage.name + "." + facts->name;
      EXPECT_TRUE(names.insert(facts->name).second) << what;
      EXPECT_GT(facts->meaning.size(), 8u) << what;
      EXPECT_EQ(facts->meaning.back(), '.') << what;
      EXPECT_NE(facts->use, cactus::PropertyUse::Code) << what;
      const bool isNumber = facts->choices.empty() && value.index() >= 1 && value.index() <= 2;
      EXPECT_EQ(facts->range.has_value(), isNumber) << what;
      if (facts->range)
      {
        EXPECT_LT(facts->range->lowest, facts->range->highest) << what;
      }
    }
    for (const auto& state : stage.properties)
    {
      for (const cactus::PropertyCondition& condition : state.facts->conditions)
      {
        EXPECT_EQ(names.count(condition.property), 1u) << stage.name << "." << state.facts->name;
      }
    }
  }
}

} // namespace
