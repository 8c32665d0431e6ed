// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: a recipe has the values of its text, defaults included, and no value that a stage would refuse is accepted.
#include "recipe/RecipeReader.h"

#include "ScratchPath.h"
#include "base/Error.h"
#include "base/Sha256.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace
{

using namespace cactus;

std::vector<std::string> stageNames(const Recipe& recipe)
{
  std::vector<std::string> names;
  for (const RecipeStage& stage : recipe.stages)
  {
    names.push_back(stage.name);
  }
  return names;
}

template <typename Stage>
const Stage& stageIn(const Recipe& recipe, std::size_t place)
{
  return std::get<Stage>(recipe.stages.at(place).options);
}

std::string refusal(const std::string& text)
{
  try
  {
    readRecipe(text, "");
  }
  catch (const InvalidInput& error)
  {
    return error.what();
  }
  return "none";
}

} // namespace

TEST(RecipeReader, NothingIsTheDefaultChain)
{
  const Recipe recipe = readRecipe("{}", "");
  EXPECT_EQ(stageNames(recipe), (std::vector<std::string>{ "BundleInitializer", "CapsuleOptimizer", "FibreRadialGrowth",
                                  "MyelinSurface", "SubstrateWriter" }));
  EXPECT_EQ(stageIn<BundleInitializerStage>(recipe, 0).options.side, BundleInitializerOptions().side);
  EXPECT_EQ(stageIn<FibreRadialGrowthStage>(recipe, 2).options.targetFibreVolumeFraction, -1.0);
  EXPECT_EQ(recipe.stages[4].input("Inner").at(0).port, 1);
  EXPECT_EQ(recipe.stages[4].input("Fibres").at(0).stage, 1u);
  EXPECT_EQ(recipe.folderName(), "");
  EXPECT_EQ(recipe.version, "");
}

TEST(RecipeReader, ValuesArriveAsTheyStand)
{
  const Recipe recipe = readRecipe(R"({ // a remark
    "BundleInitializer": { "Side": 20, "Seed": 2147483647, "RadiusDistribution": "Table", "RadiusTable": [0.5, 0.1e1],
                           "DispersionModel": "Harmonics", "OrientationHarmonics": [1, 0, 0, 0.25, 0, 0] },
    "CapsuleOptimizer": { "TrimToDomain": false, "MaximumIterations": 7.0, "CheckpointFile": "run.checkpoint" },
    "MyelinSurface": { "GRatioModel": 2, "GRatio": 0.65 },
    "SubstrateWriter": { "Format": "Disimpy", "FolderName": "/out/here" } })",
    "/in/there");
  const auto& bundle = stageIn<BundleInitializerStage>(recipe, 0);
  EXPECT_EQ(bundle.options.side, 20.0);
  EXPECT_EQ(bundle.options.seed, 2147483647u);
  EXPECT_EQ(bundle.radiusTable, "0.5 1");
  EXPECT_EQ(bundle.orientationHarmonics, "1 0 0 0.25 0 0");
  const auto& optimiser = stageIn<CapsuleOptimizerStage>(recipe, 1);
  EXPECT_FALSE(optimiser.trimToDomain);
  EXPECT_EQ(optimiser.options.maximumIterations, 7);
  EXPECT_EQ(optimiser.options.checkpointFile, "/in/there/run.checkpoint");
  EXPECT_EQ(stageIn<MyelinSurfaceStage>(recipe, 3).options.model, GRatioModel(2));
  EXPECT_EQ(stageIn<SubstrateWriterStage>(recipe, 4).format, SubstrateFormat::Disimpy);
  EXPECT_EQ(recipe.folderName(), "/out/here");
}

TEST(RecipeReader, SeveralSourcesGoToOneOptimiser)
{
  const Recipe recipe = readRecipe(R"({ "BundleInitializer": [ {"Seed": 1}, {"Seed": 2, "Direction": [1, 0, 0.5]} ],
                    "SubstrateProduction": {"Seed": 5} })",
    "");
  EXPECT_EQ(stageNames(recipe),
    (std::vector<std::string>{ "BundleInitializer", "BundleInitializer", "CapsuleOptimizer", "SubstrateProduction" }));
  EXPECT_EQ(stageIn<BundleInitializerStage>(recipe, 1).options.seed, 2u);
  EXPECT_EQ(stageIn<BundleInitializerStage>(recipe, 1).options.direction, Eigen::Vector3d(1.0, 0.0, 0.5));
  EXPECT_EQ(recipe.stages[2].input("Input").size(), 2u);
  EXPECT_EQ(stageIn<SubstrateProductionStage>(recipe, 3).surfaces.seed, 5u);
}

TEST(RecipeReader, WithoutOptimiserSeveralSourcesAreBlocks)
{
  const Recipe recipe = readRecipe(R"({ "BundleInitializer": [ {}, {"Seed": 2} ], "CapsuleOptimizer": false })", "");
  ASSERT_EQ(recipe.stages.size(), 5u);
  const std::vector<RecipeSource>& input = recipe.stages[2].input("Input");
  ASSERT_EQ(input.size(), 1u);
  ASSERT_EQ(input[0].blocks.size(), 2u);
  EXPECT_EQ(input[0].blocks[1].stage, 1u);
}

TEST(RecipeReader, NumbersThatAMemberCannotHoldAreRefused)
{
  EXPECT_EQ(refusal(R"({"BundleInitializer": {"NumberOfBundles": 4294967297}})"),
    "BundleInitializer: NumberOfBundles is 4294967297: give 1 to 2; for more bundles use DispersionModel Peaks, or connect "
    "several sources, each with its Direction, to one CapsuleOptimizer");
  for (const char* wrong : { "1", "[1, 0]", "[1, 0, 0, 0]", "[1, 0, \"0\"]" })
  {
    EXPECT_EQ(refusal(R"({"BundleInitializer": {"Direction": )" + std::string(wrong) + "}}"),
      "BundleInitializer: Direction is " + std::string(wrong) + ": give a list of 3 numbers");
  }
  EXPECT_EQ(refusal(R"({"SubstrateWriter": {"Format": 99}})").substr(0, 46), "SubstrateWriter: Format is 99: give \"MC/DC\", \"");
  EXPECT_EQ(refusal(R"({"SubstrateWriter": {"Format": -1}})").substr(0, 36), "SubstrateWriter: Format is -1: give ");
  EXPECT_EQ(refusal(R"({"BundleInitializer": {"Seed": true}})"), "BundleInitializer: Seed is true: give a number");
}

TEST(RecipeReader, NamesTheLikelyProperty)
{
  EXPECT_EQ(
    refusal(R"({"FibreRadialGrowth": {"Voxelsize": 1}})"), "FibreRadialGrowth: there is no property Voxelsize: is it VoxelSize?");
  EXPECT_EQ(refusal(R"({"FibreRadialGrowth": {"GRatio": 1}})"), "FibreRadialGrowth: there is no property GRatio");
}

TEST(RecipeReader, CurvedBundlesAreASource)
{
  const Recipe recipe = readRecipe(R"({ "CurvedBundles": {"Shape": "Kiss", "KissDistance": 6}, "SubstrateProduction": {} })", "");
  EXPECT_EQ(stageNames(recipe), (std::vector<std::string>{ "CurvedBundles", "CapsuleOptimizer", "SubstrateProduction" }));
  const auto& options = stageIn<CurvedBundlesStage>(recipe, 0).options;
  EXPECT_EQ(options.shape, BundleShape::Kiss);
  EXPECT_EQ(options.kissDistance, 6.0);
  EXPECT_NE(
    refusal(R"({"CurvedBundles": {"BendRadius": 16}})").find("CurvedBundles: BendRadius 16 µm is too sharp here: give 24"),
    std::string::npos);
}

TEST(RecipeReader, AnEmptyListIsNoSource)
{
  const auto refuses = [](const std::string& text, const std::string& name)
  { EXPECT_EQ(refusal(text), name + " is an empty list: leave it out, or say what to make"); };
  refuses(R"({"BundleInitializer": []})", "BundleInitializer");
  refuses(R"({"StrandReader": []})", "StrandReader");
  refuses(R"({"TractogramReader": {"FileName": "a.tck"}, "TractFibres": []})", "TractFibres");
  refuses(R"({"TractogramReader": [], "TractFibres": {}})", "TractogramReader");
}

TEST(RecipeReader, FilesAreThoseThatWereRead)
{
  const auto folder = std::filesystem::path(cactus_testing::scratchPath("recipe-files")) / "tract.trx";
  std::filesystem::create_directories(folder);
  const std::string file = (folder / "positions.3.float32").string();
  std::ofstream(file) << "abc";
  const auto manifest = [](const std::string& path)
  {
    return R"({"provenance": [{"id": "a", "filter": "TractogramReader", "properties": {"FileName": "tract.trx"}, "files": [)"
           R"({"property": "FileName", "path": ")" +
           path + R"(", "sha256": ")" + sha256("abc") +
           R"("}]}, {"id": "b", "filter": "TractFibres", "properties": {}, "inputs": {"Input": [{"stage": "a"}]}}, )"
           R"({"id": "c", "filter": "SubstrateProduction", "properties": {}, "inputs": {"Input": [{"stage": "b"}]}}]})";
  };
  // For a folder, relative to its former files, and not to the working directory.
  EXPECT_EQ(stageIn<TractogramReaderStage>(readRecipe(manifest(file), ""), 0).fileName, folder.string());
  EXPECT_NE(refusal(manifest("/dev/null")).find("is missing"), std::string::npos);
  std::filesystem::remove_all(folder.parent_path());
}

TEST(RecipeReader, RecordsInARingOrWithoutEndAreRefused)
{
  const std::string stage =
    R"({"id": "a", "filter": "CapsuleOptimizer", "properties": {}, "inputs": {"Input": [{"stage": "a"}]}})";
  EXPECT_EQ(refusal(R"({"provenance": [)" + stage + "]}"),
    "the provenance is damaged: input Input of CapsuleOptimizer comes from a later stage");
  std::string many = stage;
  for (int i = 0; i < 2000; ++i)
  {
    many += ", " + stage;
  }
  EXPECT_EQ(refusal(R"({"provenance": [)" + many + "]}"), "the provenance is damaged: it has 2001 stages");
}

TEST(RecipeReader, PresetsGiveWhatTheRecipeDoesNotSay)
{
  const std::string preset = R"("Preset": "Histological target b")";
  const Recipe recipe = readRecipe("{" + preset + R"(, "BundleInitializer": {"Side": 12, "MeanDispersion": 8}})", "");
  const auto& bundle = stageIn<BundleInitializerStage>(recipe, 0).options;
  EXPECT_EQ(bundle.side, 12.0);
  EXPECT_EQ(bundle.meanDispersion, 8.0);
  EXPECT_EQ(bundle.grownFibreVolumeFraction, 0.68);
  const auto& myelin = stageIn<MyelinSurfaceStage>(recipe, 3).options;
  EXPECT_EQ(myelin.model, GRatioModel::TargetAxonVolumeFraction);
  EXPECT_EQ(myelin.targetAxonVolumeFraction, 0.25);

  const Recipe large = readRecipe("{" + preset + R"(, "SubstrateProduction": {}, "BundleInitializer": [{}, {"Seed": 2}]})", "");
  EXPECT_EQ(stageIn<BundleInitializerStage>(large, 1).options.grownFibreVolumeFraction, 0.68);
  EXPECT_EQ(stageIn<SubstrateProductionStage>(large, 3).surfaces.targetAxonVolumeFraction, 0.25);

  EXPECT_NE(refusal(R"({"Preset": "Spinal cord"})").find("there is no preset"), std::string::npos);
  EXPECT_NE(refusal(R"({"Preset": 3})").find("Preset is 3: give the name of a preset"), std::string::npos);
}
