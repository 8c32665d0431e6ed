// SPDX-License-Identifier: BSD-3-Clause
#include "recipe/Recipe.h"

#include "base/Error.h"
#include "io/OpenSurfaces.h"
#include "io/SubstrateFolder.h"
#include "io/TractogramFile.h"
#include "stages/StageWork.h"
#include "stages/SubstrateProduction.h"

#include <algorithm>

namespace cactus
{

namespace
{

const std::vector<std::pair<std::string, RecipeOptions>>& knownStages()
{
  static const std::vector<std::pair<std::string, RecipeOptions>> stages = { { "BundleInitializer", BundleInitializerStage() },
    { "CurvedBundles", CurvedBundlesStage() }, { "StrandReader", StrandReaderStage() },
    { "TractogramReader", TractogramReaderStage() }, { "TractFibres", TractFibresStage() },
    { "CapsuleOptimizer", CapsuleOptimizerStage() }, { "FibreRadialGrowth", FibreRadialGrowthStage() },
    { "MyelinSurface", MyelinSurfaceStage() }, { "SubstrateWriter", SubstrateWriterStage() },
    { "SubstrateProduction", SubstrateProductionStage() } };
  return stages;
}

template <typename Stage>
bool isA(const RecipeStage& stage)
{
  return std::holds_alternative<Stage>(stage.options);
}

bool givesFibres(const RecipeStage& stage)
{
  return isA<BundleInitializerStage>(stage) || isA<CurvedBundlesStage>(stage) || isA<StrandReaderStage>(stage) ||
         isA<TractFibresStage>(stage) || isA<CapsuleOptimizerStage>(stage);
}

/// Checks the sources of each input of a stage.
class InputCheck
{
public:
  InputCheck(const Recipe& recipe, const RecipeStage& stage)
    : All(recipe)
    , Stage(stage)
  {
  }

  /// Accepts only these names, each with one or several connections.
  void names(const std::vector<std::pair<std::string, bool>>& wanted) const
  {
    for (const auto& input : this->Stage.inputs)
    {
      const auto isIt = [&](const std::pair<std::string, bool>& one) { return one.first == input.first; };
      if (std::none_of(wanted.begin(), wanted.end(), isIt))
      {
        this->fail("has no input " + input.first);
      }
    }
    for (const auto& [name, mayBeSeveral] : wanted)
    {
      const std::size_t count = this->Stage.input(name).size();
      if (count == 0 || (count > 1 && !mayBeSeveral))
      {
        this->fail("takes one " + name + (mayBeSeveral ? " or several, and has none" : ", and has " + std::to_string(count)));
      }
    }
  }

  void fibresAt(const std::string& name) const
  {
    for (const RecipeSource& source : this->Stage.input(name))
    {
      this->requireFibres(name, source);
    }
  }

  void streamlinesAt(const std::string& name) const
  {
    for (const RecipeSource& source : this->Stage.input(name))
    {
      this->requireStreamlines(name, source);
    }
  }

  /// Requires an output of a stage of this kind.
  template <typename Wanted>
  void outputAt(const std::string& name, int port) const
  {
    for (const RecipeSource& source : this->Stage.input(name))
    {
      if (!source.blocks.empty() || source.port != port || !isA<Wanted>(this->All.stages[source.stage]))
      {
        this->fail("cannot take what comes in at " + name + " without ParaView: rerun it by ./cactus rerun");
      }
    }
  }

  [[noreturn]] void fail(const std::string& why) const { throw InvalidInput(this->Stage.name + ": it " + why); }

private:
  void requireStreamlines(const std::string& name, const RecipeSource& source) const
  {
    for (const RecipeSource& block : source.blocks)
    {
      this->requireStreamlines(name, block);
    }
    if (source.blocks.empty() && (source.port != 0 || !isA<TractogramReaderStage>(this->All.stages[source.stage])))
    {
      this->fail("takes streamlines of a TractogramReader at " + name + ", and not what " + this->All.stages[source.stage].name +
                 " gives: rerun it by ./cactus rerun");
    }
  }

  void requireFibres(const std::string& name, const RecipeSource& source) const
  {
    for (const RecipeSource& block : source.blocks)
    {
      this->requireFibres(name, block);
    }
    if (source.blocks.empty() && (source.port != 0 || !givesFibres(this->All.stages[source.stage])))
    {
      this->fail("takes fibres at " + name + ", which " + this->All.stages[source.stage].name + " does not give");
    }
  }

  const Recipe& All;
  const RecipeStage& Stage;
};

void checkInputs(const Recipe& recipe, const RecipeStage& stage)
{
  const InputCheck check(recipe, stage);
  if (isA<CapsuleOptimizerStage>(stage) || isA<FibreRadialGrowthStage>(stage) || isA<SubstrateProductionStage>(stage))
  {
    check.names({ { "Input", isA<CapsuleOptimizerStage>(stage) } });
    check.fibresAt("Input");
  }
  else if (isA<TractFibresStage>(stage))
  {
    check.names({ { "Input", false } });
    check.streamlinesAt("Input");
  }
  else if (isA<MyelinSurfaceStage>(stage))
  {
    check.names({ { "Input", false } });
    check.outputAt<FibreRadialGrowthStage>("Input", 0);
  }
  else if (isA<SubstrateWriterStage>(stage))
  {
    std::vector<std::pair<std::string, bool>> wanted = { { "Outer", false } };
    for (const char* name : { "Inner", "Fibres" })
    {
      if (!stage.input(name).empty())
      {
        wanted.emplace_back(name, false);
      }
    }
    check.names(wanted);
    check.outputAt<MyelinSurfaceStage>("Outer", 0);
    check.outputAt<MyelinSurfaceStage>("Inner", 1);
    check.fibresAt("Fibres");
    const bool hasInner = !stage.input("Inner").empty();
    if (hasInner && stage.input("Inner").front().stage != stage.input("Outer").front().stage)
    {
      check.fail("takes Outer and Inner of one MyelinSurface: they are those of two");
    }
  }
  else
  {
    check.names({});
  }
}

void requireUnset(bool isSet, const char* name)
{
  if (isSet)
  {
    throw InvalidInput(std::string(name) + " is of use in ParaView only: leave it out");
  }
}

void checkOptions(const BundleInitializerStage& stage)
{
  bundleOptions(stage).validate();
}

void checkOptions(const CurvedBundlesStage& stage)
{
  curvedOptions(stage).validate();
}

void checkOptions(const StrandReaderStage& stage)
{
  strandsOf(stage);
}

void checkOptions(const TractogramReaderStage& stage)
{
  if (stage.fileName.empty())
  {
    throw InvalidInput("FileName is empty: name the tractogram to read");
  }
  requireTractogram(stage.fileName);
}

void checkOptions(const TractFibresStage& stage)
{
  tractOptions(stage).validate();
}

void checkOptions(const CapsuleOptimizerStage& stage)
{
  validate(stage.options);
  requireUnset(stage.keepHistory, "KeepHistory");
  requireUnset(stage.showEvery > 0, "ShowEvery");
}

void checkOptions(const FibreRadialGrowthStage& stage)
{
  validate(stage.options);
}

void checkOptions(const MyelinSurfaceStage& stage)
{
  if (stage.meshing != Meshing::Cactus)
  {
    throw InvalidInput("Meshing by VTK filters needs ParaView: leave it at CACTUS, or run the recipe there");
  }
  requireUnset(stage.releaseInput, "ReleaseInput");
  validate(stage.options);
}

void checkOptions(const SubstrateWriterStage& stage)
{
  requireEncoding(stage.format, stage.encoding);
  requireOpenable(stage.periodicFaces, stage.format, stage.allowOpenSurfaces);
}

void checkOptions(const SubstrateProductionStage& stage)
{
  validate(productionOrder(stage, {}));
}

/// Adds the stage's name to the errors of `work`.
template <typename Work>
void of(const RecipeStage& stage, const Work& work)
{
  try
  {
    work();
  }
  catch (const InvalidInput& error)
  {
    throw InvalidInput(stage.name + ": " + error.what());
  }
}

template <typename Stage>
void checkValues(const Stage& options)
{
  validateProperties(options);
  checkOptions(options);
}

/// Checks the options of two stages together.
void checkTogether(const Recipe& recipe, const RecipeStage& stage)
{
  if (const auto* myelin = std::get_if<MyelinSurfaceStage>(&stage.options))
  {
    const RecipeStage& grown = recipe.stages[stage.input("Input").front().stage];
    requireDecimationRoom(myelin->options, std::get<FibreRadialGrowthStage>(grown.options).options.surfaceTolerance);
  }
  const auto* bundle = std::get_if<BundleInitializerStage>(&recipe.stages.front().options);
  const auto* writer = std::get_if<SubstrateWriterStage>(&stage.options);
  if (writer != nullptr && bundle != nullptr)
  {
    requireRoom(writer->format, bundle->options.domain(), writer->voxelSize);
  }
}

} // namespace

const std::vector<RecipeSource>& RecipeStage::input(const std::string& wanted) const
{
  static const std::vector<RecipeSource> none;
  const auto found = std::find_if(this->inputs.begin(), this->inputs.end(), [&](const auto& one) { return one.first == wanted; });
  return found != this->inputs.end() ? found->second : none;
}

const std::string& Recipe::folderName() const
{
  const RecipeOptions& writer = this->stages.back().options;
  const auto* production = std::get_if<SubstrateProductionStage>(&writer);
  return production != nullptr ? production->folderName : std::get<SubstrateWriterStage>(writer).folderName;
}

std::optional<RecipeOptions> recipeOptions(const std::string& name)
{
  for (const auto& [known, options] : knownStages())
  {
    if (known == name)
    {
      return options;
    }
  }
  return std::nullopt;
}

std::string recipeStageNames()
{
  std::string names;
  for (const auto& stage : knownStages())
  {
    names += (names.empty() ? "" : ", ") + stage.first;
  }
  return names;
}

void check(const Recipe& recipe)
{
  if (recipe.stages.empty() ||
      (!isA<SubstrateWriterStage>(recipe.stages.back()) && !isA<SubstrateProductionStage>(recipe.stages.back())))
  {
    throw InvalidInput("the last stage is neither SubstrateWriter nor SubstrateProduction, which write the folder");
  }
  for (const RecipeStage& stage : recipe.stages)
  {
    checkInputs(recipe, stage);
    of(stage,
      [&]
      {
        std::visit([](const auto& options) { checkValues(options); }, stage.options);
        checkTogether(recipe, stage);
      });
  }
}

} // namespace cactus
