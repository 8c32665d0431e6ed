// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/JsonText.h"
#include "recipe/Recipe.h"

namespace cactus
{

/// The recipe that the records in a manifest's `provenance` are (see base/Provenance.h): those stages that the last one comes
/// from. Throws InvalidInput, saying which stage and why, where the substrate cannot be made again from them.
Recipe recipeOfManifest(const Json& manifest);

} // namespace cactus
