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
/// names. The label image and surfaces are held in memory, but by SubstrateProduction.
///
/// Threads of the context, where it gives a number, count instead of those of the stages. Progress is that of a stage, and its
/// message begins with the stage's number and name. `remark` is called with what the filters would warn of, one sentence or
/// several at a time. Throws what the stages do, FileError at once where the folder could not be written, InvalidInput
/// at once where the format's files are not to be had in the encoding, and Cancelled.
WrittenSubstrate runRecipe(const Recipe& recipe, const std::string& folder, const Context& context = {},
  const std::function<void(const std::string&)>& remark = {});

} // namespace cactus
