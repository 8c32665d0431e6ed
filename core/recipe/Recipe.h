// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "stages/Stages.h"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace cactus
{

/// Where data come from: an output of an earlier stage, or those of several in one.
struct RecipeSource
{
  std::size_t stage = 0; ///< its place among the recipe's stages
  int port = 0;
  std::vector<RecipeSource> blocks; ///< instead of these two
};

/// What is told to a stage that can be run without ParaView.
using RecipeOptions = std::variant<BundleInitializerStage, StrandReaderStage, TractogramReaderStage, TractFibresStage,
  CapsuleOptimizerStage, FibreRadialGrowthStage, MyelinSurfaceStage, SubstrateWriterStage, SubstrateProductionStage>;

struct RecipeStage
{
  std::string name; ///< that of its filter
  RecipeOptions options;
  std::vector<std::pair<std::string, std::vector<RecipeSource>>> inputs; ///< by name, a source for each connection

  /// Of the input with this name; empty where there is none.
  const std::vector<RecipeSource>& input(const std::string& wanted) const;
};

/// How a substrate is made, from its bundles to its folder.
struct Recipe
{
  std::string version;             ///< of the CACTUS that wrote it down; empty for one that was written by hand
  std::vector<RecipeStage> stages; ///< each after those that it takes from; the last one writes the folder

  /// FolderName of the last stage, which may be empty.
  const std::string& folderName() const;
};

/// A stage with its properties at their defaults; nothing for a name that no stage of a recipe has.
std::optional<RecipeOptions> recipeOptions(const std::string& name);

/// The names of all stages that a recipe may have, in the order of the chain, for messages.
std::string recipeStageNames();

/// Throws InvalidInput, naming stage and property, for stages that cannot follow each other and for values that no run would
/// take; FileError where a stage's file cannot be read.
void check(const Recipe& recipe);

} // namespace cactus
