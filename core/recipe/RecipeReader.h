// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "recipe/Recipe.h"

#include <string>

namespace cactus
{

/// Reads a recipe (JSON), in either of two forms. By hand, the properties of stages by their names, in which line comments (//)
/// may stand:
///
///   { "BundleInitializer": { "Side": 20 }, "FibreRadialGrowth": { "VoxelSize": 0.1 }, "MyelinSurface": { "GRatio": 0.7 } }
///
/// A stage that is not named has its defaults, or the values of a preset, which "Preset" names (see stages/Presets.h);
/// BundleInitializer may be a list of several, or StrandReader stand in its place;
/// CapsuleOptimizer is left out where it is `false`; SubstrateProduction stands for growth, surfaces and writer. Or with
/// `provenance`, the list of records that a substrate's manifest.json has: those stages with those inputs, and no property that
/// records do not keep, as a manifest may come from anybody. An optimisation that the clock or the user ended is one of as many
/// iterations. Files that the stages read have to be as they were.
///
/// Relative paths in the text are taken from `folder`, or from where the process is if that is empty. The recipe is checked (see
/// check()). Throws InvalidInput, naming line, stage or property, also for a name that there is not and one that stands twice.
Recipe readRecipe(const std::string& text, const std::string& folder);

} // namespace cactus
