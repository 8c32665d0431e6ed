// SPDX-License-Identifier: BSD-3-Clause
// Values of properties that belong together, for a known tissue or a substrate of the paper.
#pragma once

#include "base/Properties.h"

#include <string>
#include <utility>
#include <vector>

namespace cactus
{

struct PresetValue
{
  std::string stage;
  std::string property;
  PropertyValue value;
};

/// A named substrate. A preset sets neither its size nor its random numbers (Side, Seed).
struct Preset
{
  std::string name;
  std::string meaning;             ///< one sentence
  std::string source;              ///< origin of its values
  std::vector<PresetValue> values; ///< those that differ from defaults
};

/// Returns all presets. State files of ParaView identify them by position, from 1: new ones go to the end.
const std::vector<Preset>& presets();

/// Returns the preset of that name; throws InvalidInput, with the existing names.
const Preset& presetNamed(const std::string& name);

/// Returns the values for a stage of all properties that any preset sets there: the default if this preset does not set one.
/// Empty for a stage without presets. SubstrateProduction has those of growth and surfaces, which it stands for.
std::vector<std::pair<std::string, PropertyValue>> presetValues(const Preset& preset, const std::string& stage);

} // namespace cactus
