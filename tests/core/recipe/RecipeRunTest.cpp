// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: a recipe's run can be stopped at any time and leaves nothing, and its output is a recipe for the same substrate.
#include "recipe/RecipeRun.h"

#include "ScratchPath.h"
#include "base/Error.h"
#include "recipe/RecipeReader.h"
#include "stages/StageWork.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace
{

using namespace cactus;
using namespace cactus_testing;
namespace fs = std::filesystem;

const char* const small = R"({
  "BundleInitializer": { "Side": 3, "Border": "Walls", "FibreVolumeFraction": 0.3, "MinimumRadius": 0.4,
                         "GrownFibreVolumeFraction": 0 },
  "FibreRadialGrowth": { "VoxelSize": 0.2, "GrowthIterations": 1 } })";

class RecipeRuns : public testing::Test
{
protected:
  RecipeRuns()
    : Folder(scratchPath("recipe-run"))
  {
    fs::create_directory(this->Folder);
  }
  ~RecipeRuns() override { fs::remove_all(this->Folder); }

  std::string place(const char* name) const { return this->Folder + '/' + name; }

  const std::string Folder;
};

} // namespace

TEST_F(RecipeRuns, WritesARecipeForItself)
{
  std::vector<std::string> remarks;
  const auto remember = [&](const std::string& remark) { remarks.push_back(remark); };
  const WrittenSubstrate first = runRecipe(readRecipe(small, ""), this->place("first"), {}, remember);
  EXPECT_TRUE(first.certificate.certified());
  ASSERT_EQ(remarks.size(), 1u); // so small a substrate is left by all walkers outside
  EXPECT_NE(remarks[0].find("of the walkers of mcdc/extra.conf leave the substrate"), std::string::npos) << remarks[0];
  const std::string manifest = contentOf(this->place("first") + "/manifest.json");
  const Recipe again = readRecipe(manifest, "");
  EXPECT_EQ(again.version, CACTUS_VERSION);
  Context context;
  context.threads = 1;
  runRecipe(again, this->place("second"), context);
  EXPECT_EQ(contentOf(this->place("second") + "/manifest.json"), manifest); // it has the checksums of all files
}

TEST_F(RecipeRuns, IsStoppedAtAnyTimeAndLeavesNothing)
{
  const Recipe recipe = readRecipe(small, "");
  std::set<std::string> stages;
  for (int most = 0;; most = most * 5 / 4 + 1)
  {
    int asked = 0;
    Context context;
    context.cancelled = [&] { return ++asked > most; };
    std::string last;
    context.progress = [&](double, const std::string& message) { last = message.substr(0, message.find(':')); };
    try
    {
      runRecipe(recipe, this->place("stopped"), context);
      break;
    }
    catch (const Cancelled&)
    {
      stages.insert(last);
      EXPECT_TRUE(fs::is_empty(this->Folder)) << "stopped after " << most << " in " << last;
    }
  }
  EXPECT_TRUE(fs::exists(this->place("stopped") + "/manifest.json"));
  EXPECT_GE(stages.size(), 3u);
}

TEST_F(RecipeRuns, SaysAtOnceThatTheFolderIsNotFree)
{
  fs::create_directory(this->place("mine"));
  fs::create_directory(this->place("mine") + "/notes");
  bool hasBegun = false;
  Context context;
  context.progress = [&](double, const std::string& message) { hasBegun = hasBegun || message.substr(0, 2) == "1/"; };
  EXPECT_THROW(runRecipe(readRecipe(small, ""), this->place("mine"), context), FileError);
  EXPECT_FALSE(hasBegun);
}

TEST_F(RecipeRuns, TellsOfFibresThatStillOverlap)
{
  std::string remarks;
  const auto remember = [&](const std::string& remark) { remarks += remark + '\n'; };
  // Two bundles in one place.
  const std::string dense = R"({
    "BundleInitializer": [ { "Side": 3, "FibreVolumeFraction": 0.3, "MinimumRadius": 0.4, "GrownFibreVolumeFraction": 0, "Border": "Walls" },
                           { "Side": 3, "FibreVolumeFraction": 0.3, "MinimumRadius": 0.4, "GrownFibreVolumeFraction": 0, "Border": "Walls",
                             "CorrelationLength": 0, "Seed": 2 } ],
    "CapsuleOptimizer": OPTIMISER, "FibreRadialGrowth": { "VoxelSize": 0.2, "GrowthIterations": 0 } })";
  const auto with = [&](const char* optimiser) { return std::string(dense).replace(dense.find("OPTIMISER"), 9, optimiser); };
  runRecipe(readRecipe(with(R"({"MaximumIterations": 1})"), ""), this->place("few"), {}, remember);
  EXPECT_NE(remarks.find("overlaps remain: MaximumIterations were used up after 1 iterations"), std::string::npos) << remarks;
  remarks.clear();
  OptimisationResult leapt;
  leapt.reason = StopReason::Stagnated;
  leapt.maximumPenetration = 0.5;
  leapt.convergence.emplace_back();
  CapsuleOptimizerOptions leaps;
  leaps.method = DescentMethod::Adagrad;
  for (const std::string& remark : remarksOnOptimisation(leapt, leaps))
  {
    remember(remark);
  }
  EXPECT_NE(remarks.find("StepSize 1.7 is the first step in µm with Adagrad"), std::string::npos) << remarks;
  remarks.clear();
  runRecipe(readRecipe(with("false"), ""), this->place("none"), {}, remember);
  EXPECT_NE(remarks.find("the optimiser has not parted these fibres"), std::string::npos) << remarks;
}
