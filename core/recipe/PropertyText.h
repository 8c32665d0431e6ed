// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/JsonText.h"
#include "base/Properties.h"
#include "recipe/Recipe.h"

#include <string>

namespace cactus
{

/// Reads the value of a property in a recipe: a choice by its name or number, a switch as true or false, a table of radii also as
/// a list of numbers. `like` is a value of the property's type. Throws InvalidInput, naming the property and its possible values.
PropertyValue propertyValue(const PropertyFacts& facts, const PropertyValue& like, const Json& value);

/// Sets a property of a stage. With `onlyResult`, only properties that a record keeps are accepted. Throws InvalidInput for an
/// unknown name, and as propertyValue() does.
void setProperty(RecipeOptions& options, const std::string& name, const Json& value, bool onlyResult);

} // namespace cactus
