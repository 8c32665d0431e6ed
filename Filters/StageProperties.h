// SPDX-License-Identifier: BSD-3-Clause
// FilterProperties of a given stage.
#pragma once

#include "FilterProperties.h"
#include "base/Properties.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace cactus
{

template <typename Stage>
class StageProperties : public FilterProperties
{
public:
  bool changeNumber(const char* name, double value) override { return this->change(name, value); }
  bool changeWhole(const char* name, int value) override { return this->change(name, std::int64_t(value)); }
  bool changeSwitch(const char* name, bool value) override { return this->change(name, value); }
  bool changeText(const char* name, const char* value) override
  {
    return this->change(name, std::string(value != nullptr ? value : ""));
  }
  bool changeVector(const char* name, const double value[3]) override
  {
    return this->change(name, std::vector<double>(value, value + 3));
  }
  double number(const char* name) const override { return std::get<double>(this->value(name)); }
  int whole(const char* name) const override { return static_cast<int>(std::get<std::int64_t>(this->value(name))); }
  bool isOn(const char* name) const override { return std::get<bool>(this->value(name)); }
  const char* text(const char* name) const override
  {
    std::string& shown = this->Shown[name];
    shown = std::get<std::string>(this->value(name));
    return shown.empty() ? nullptr : shown.c_str();
  }
  void getVector(const char* name, double value[3]) const override
  {
    const auto vector = std::get<std::vector<double>>(this->value(name));
    std::copy_n(vector.begin(), 3, value);
  }
  void print(std::ostream& out, vtkIndent indent) const override
  {
    for (const PropertyState& state : Stage::properties().states(this->Values))
    {
      if (state.facts->use != PropertyUse::Code)
      {
        out << indent << state.facts->name << ": " << valueText(*state.facts, state.value) << '\n';
      }
    }
  }

  const Stage& values() const { return this->Values; }

private:
  using Property = typename PropertyList<Stage>::Property;

  static const Property& property(const char* name)
  {
    const Property* found = Stage::properties().find(name);
    if (found == nullptr)
    {
      throw std::logic_error(std::string("no property is called ") + name);
    }
    return *found;
  }
  PropertyValue value(const char* name) const { return property(name).get(this->Values); }
  bool change(const char* name, PropertyValue to)
  {
    const Property& one = property(name);
    if (one.get(this->Values) == to)
    {
      return false;
    }
    one.set(this->Values, to);
    return true;
  }

  Stage Values;
  mutable std::map<std::string, std::string> Shown; ///< texts that were returned
};

template <typename Stage>
std::unique_ptr<FilterProperties> makeProperties()
{
  return std::make_unique<StageProperties<Stage>>();
}

/// Returns the values of a filter's properties, unchecked.
template <typename Stage>
const Stage& stageOf(const std::unique_ptr<FilterProperties>& properties)
{
  return dynamic_cast<const StageProperties<Stage>&>(*properties).values();
}

/// Returns the properties that a result depends on, but those in `others`: a line each.
template <typename Stage>
std::string valuesForResult(const Stage& stage, const std::set<std::string>& others = {})
{
  std::string values;
  for (const PropertyState& state : Stage::properties().states(stage))
  {
    if (state.facts->use != PropertyUse::Run && others.count(state.facts->name) == 0)
    {
      values += state.facts->name + ' ' + valueText(*state.facts, state.value) + '\n';
    }
  }
  return values;
}

} // namespace cactus
