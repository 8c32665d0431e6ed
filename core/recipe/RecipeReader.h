// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "recipe/Recipe.h"

#include <string>

namespace cactus
{

/// Reads a recipe (JSON), in one of two forms. The hand-written form has the properties of stages by their names, with optional
/// line comments (//):
///
///   { "BundleInitializer": { "Side": 20 }, "FibreRadialGrowth": { "VoxelSize": 0.1 }, "MyelinSurface": { "GRatio": 0.7 } }
///
/// A missing stage has its defaults, or the values of a preset, which "Preset" names (see stages/Presets.h); BundleInitializer
/// may be a list of several, or be replaced by CurvedBundles or StrandReader; CapsuleOptimizer is left out if it is `false`;
/// SubstrateProduction stands for growth, surfaces and writer. The other form has `provenance`, the list of records in a
/// substrate's manifest.json: those stages with those inputs. It sets no property that records do not keep, since a manifest may
/// come from anybody. An optimisation that the clock or the user ended becomes one of as many iterations. Files that the stages
/// read have to be unchanged.
///
/// Relative paths in the text are relative to `folder`, or to the working directory if that is empty. The recipe is checked (see
/// check()). Throws InvalidInput, naming line, stage or property, also for unknown and duplicate names.
Recipe readRecipe(const std::string& text, const std::string& folder);

} // namespace cactus
