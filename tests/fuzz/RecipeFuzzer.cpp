// SPDX-License-Identifier: BSD-3-Clause
// Any bytes as a recipe: no fault, and an accepted one could run: its stages lead to a writer, each from earlier ones.
#include "recipe/RecipeReader.h"

#include "Fuzzing.h"
#include "base/Error.h"

namespace
{

void promiseEarlier(const std::vector<cactus::RecipeSource>& sources, std::size_t place)
{
  for (const cactus::RecipeSource& source : sources)
  {
    promise(!source.blocks.empty() || source.stage < place, "a stage takes from earlier ones");
    promiseEarlier(source.blocks, place);
  }
}

} // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv)
{
  writeSeeds(*argc, *argv,
    { "{}", R"({"BundleInitializer": [{"Side": 20, "RadiusTable": [0.5, 1]}, {}], "CapsuleOptimizer": false})",
      R"({"TractogramReader": [{"FileName": "x.tck"}, {"FileName": "y.trx"}], "TractFibres": [{"Side": 5}, {}]})",
      R"({"CurvedBundles": [{"Shape": "Fan", "FanAngle": 60}, {"Shape": "Kiss", "KissDistance": 5}], "CapsuleOptimizer": false})",
      R"({"StrandReader": {"FileName": "x"}, "SubstrateProduction": {"GRatioModel": "Constant", "Seed": 1e3}} // end)",
      R"({"format": "CACTUS substrate folder", "version": "0.2.0", "provenance": [
        {"id": "a", "filter": "BundleInitializer", "properties": {"Side": 5}, "inputs": {}},
        {"id": "b", "filter": "CapsuleOptimizer", "properties": {}, "reached": {"Ended": "Stopped", "Iterations": 3},
         "inputs": {"Input": [{"blocks": [{"stage": "a", "port": 0}, {"stage": "a"}]}]}},
        {"id": "c", "filter": "SubstrateProduction", "properties": {}, "inputs": {"Input": [{"stage": "b", "port": 0}]}}]})" });
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  try
  {
    const cactus::Recipe recipe = cactus::readRecipe(std::string(reinterpret_cast<const char*>(data), size), "/nowhere");
    promise(!recipe.stages.empty() && recipe.folderName().size() <= size + 10, "a recipe ends in a writer");
    for (std::size_t i = 0; i < recipe.stages.size(); ++i)
    {
      for (const auto& input : recipe.stages[i].inputs)
      {
        promiseEarlier(input.second, i);
      }
    }
  }
  catch (const cactus::Error&)
  {
    return 0;
  }
  return 0;
}
