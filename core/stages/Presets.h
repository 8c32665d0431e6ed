// SPDX-License-Identifier: BSD-3-Clause
// Values of properties that belong together: what a known tissue, or a substrate of the paper, is made with.
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

/// A substrate by its name. What size it has, and what chance makes of it (Side, Seed), is not a preset's to say.
struct Preset
{
  std::string name;
  std::string meaning;             ///< one sentence
  std::string source;              ///< where its values come from
  std::vector<PresetValue> values; ///< those that are not defaults
};

/// All presets. State files of ParaView know them by their places, counted from 1: new ones go to the end.
const std::vector<Preset>& presets();

/// The preset of that name; throws InvalidInput, with the names that there are.
const Preset& presetNamed(const std::string& name);

/// The values for a stage of all properties that any preset sets there: the default where this one says nothing. Empty for a
/// stage that no preset is for. SubstrateProduction has those of growth and surfaces, which it stands for.
std::vector<std::pair<std::string, PropertyValue>> presetValues(const Preset& preset, const std::string& stage);

} // namespace cactus
