// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: a preset has a value for each property of its stages, which the stages accept, and a source.
#include "stages/Presets.h"

#include "base/Error.h"
#include "stages/Stages.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace
{

using Values = std::vector<std::pair<std::string, cactus::PropertyValue>>;

std::vector<std::string> names(const Values& values)
{
  std::vector<std::string> found;
  for (const auto& value : values)
  {
    found.push_back(value.first);
  }
  return found;
}

/// The properties of a stage with a preset's values in their places.
std::vector<cactus::PropertyState> statesOf(const cactus::StageDescription& stage, const Values& values)
{
  std::vector<cactus::PropertyState> states = stage.properties;
  for (const auto& [name, value] : values)
  {
    bool isThere = false;
    for (cactus::PropertyState& state : states)
    {
      if (state.facts->name == name)
      {
        EXPECT_EQ(state.value.index(), value.index()) << stage.name << "." << name;
        state.value = value;
        isThere = true;
      }
    }
    EXPECT_TRUE(isThere) << stage.name << "." << name;
  }
  return states;
}

TEST(Presets, HaveValuesThatTheirStagesAccept)
{
  std::set<std::string> known;
  for (const cactus::Preset& preset : cactus::presets())
  {
    EXPECT_TRUE(known.insert(preset.name).second) << preset.name;
    EXPECT_EQ(&cactus::presetNamed(preset.name), &preset);
    EXPECT_GT(preset.meaning.size(), 20u) << preset.name;
    EXPECT_GT(preset.source.size(), 20u) << preset.name;
    std::size_t set = 0;
    for (const cactus::StageDescription& stage : cactus::describeStages())
    {
      const Values values = cactus::presetValues(preset, stage.name);
      EXPECT_NO_THROW(cactus::validate(statesOf(stage, values))) << preset.name << ", " << stage.name;
      set += stage.name != "SubstrateProduction" ? values.size() : 0;
    }
    EXPECT_GE(set, preset.values.size()) << preset.name << " sets what no stage has";
  }
}

TEST(Presets, SetTheSamePropertiesOfAStage)
{
  for (const char* stage : { "BundleInitializer", "FibreRadialGrowth", "MyelinSurface", "SubstrateProduction" })
  {
    const Values first = cactus::presetValues(cactus::presets().front(), stage);
    EXPECT_GE(first.size(), 3u) << stage;
    for (const cactus::Preset& preset : cactus::presets())
    {
      EXPECT_EQ(names(cactus::presetValues(preset, stage)), names(first)) << preset.name << ", " << stage;
    }
  }
  EXPECT_TRUE(cactus::presetValues(cactus::presets().front(), "CapsuleOptimizer").empty());
}

TEST(Presets, OfProductionAreThoseOfGrowthAndMyelin)
{
  for (const cactus::Preset& preset : cactus::presets())
  {
    Values both = cactus::presetValues(preset, "FibreRadialGrowth");
    for (const auto& value : cactus::presetValues(preset, "MyelinSurface"))
    {
      both.push_back(value);
    }
    EXPECT_EQ(cactus::presetValues(preset, "SubstrateProduction"), both) << preset.name;
  }
}

TEST(Presets, ThatThereAreNotAreNamed)
{
  try
  {
    cactus::presetNamed("Spinal cord");
    FAIL() << "there is such a preset";
  }
  catch (const cactus::InvalidInput& error)
  {
    const std::string message = error.what();
    EXPECT_NE(message.find("\"Spinal cord\""), std::string::npos) << message;
    EXPECT_NE(message.find("\"Tutorial bundle\""), std::string::npos) << message;
  }
}

} // namespace
