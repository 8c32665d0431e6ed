// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "io/SubstrateContents.h"
#include "recipe/Recipe.h"

#include <functional>
#include <string>

namespace cactus
{

/// Runs all stages of a recipe and writes the substrate folder, with the same bits, manifest included, as the filters of these
/// names. The label image and surfaces are held in memory, except by SubstrateProduction.
///
/// If the context has a number of threads, it replaces those of the stages. Progress is that of a stage, and its message begins
/// with the stage's number and name. `remark` is called with the filters' warnings, one or several sentences at a time. Throws
/// the errors of the stages, FileError at once if the folder cannot be written, InvalidInput at once if the format's files do not
/// exist in the encoding, and Cancelled.
WrittenSubstrate runRecipe(const Recipe& recipe, const std::string& folder, const Context& context = {},
  const std::function<void(const std::string&)>& remark = {});

} // namespace cactus
