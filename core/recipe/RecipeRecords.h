// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/JsonText.h"
#include "recipe/Recipe.h"

namespace cactus
{

/// Returns the recipe described by the records in a manifest's `provenance` (see base/Provenance.h): the stages that lead to the
/// last one. Throws InvalidInput, saying which stage and why, if the substrate cannot be made again from them.
Recipe recipeOfManifest(const Json& manifest);

} // namespace cactus
