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

/// The source of data: an output of an earlier stage, or those of several in one.
struct RecipeSource
{
  std::size_t stage = 0; ///< its index among the recipe's stages
  int port = 0;
  std::vector<RecipeSource> blocks; ///< used instead of these two
};

/// The options of a stage that can be run without ParaView.
using RecipeOptions =
  std::variant<BundleInitializerStage, CurvedBundlesStage, StrandReaderStage, TractogramReaderStage, TractFibresStage,
    CapsuleOptimizerStage, FibreRadialGrowthStage, MyelinSurfaceStage, SubstrateWriterStage, SubstrateProductionStage>;

struct RecipeStage
{
  std::string name; ///< name of its filter
  RecipeOptions options;
  std::vector<std::pair<std::string, std::vector<RecipeSource>>> inputs; ///< by name, a source for each connection

  /// Returns the input with this name; empty if there is none.
  const std::vector<RecipeSource>& input(const std::string& wanted) const;
};

/// The instructions for making a substrate, from its bundles to its folder.
struct Recipe
{
  std::string version;             ///< of the CACTUS that wrote it; empty if written by hand
  std::vector<RecipeStage> stages; ///< each after its sources; the last one writes the folder

  /// Returns FolderName of the last stage, possibly empty.
  const std::string& folderName() const;
};

/// Returns a stage with its properties at their defaults; nothing for an unknown name.
std::optional<RecipeOptions> recipeOptions(const std::string& name);

/// Returns the names of all possible stages, in the order of the chain, for messages.
std::string recipeStageNames();

/// Throws InvalidInput, naming stage and property, for stages that cannot follow each other and for values that no run would
/// accept; FileError if a stage's file cannot be read.
void check(const Recipe& recipe);

} // namespace cactus
