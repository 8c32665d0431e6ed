// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/JsonText.h"
#include "base/Properties.h"
#include "recipe/Recipe.h"

#include <string>

namespace cactus
{

/// The value of a property as a recipe has it: a choice by its name or number, a switch as true or false, a table of radii also
/// as a list of numbers. `like` is a value of the property's type. Throws InvalidInput, naming the property and what it may be.
PropertyValue propertyValue(const PropertyFacts& facts, const PropertyValue& like, const Json& value);

/// Sets a property of a stage. With `onlyResult` there are only those that a record keeps. Throws InvalidInput for a name that
/// there is not, and as propertyValue() does.
void setProperty(RecipeOptions& options, const std::string& name, const Json& value, bool onlyResult);

} // namespace cactus
