// SPDX-License-Identifier: BSD-3-Clause
#include "base/Properties.h"

#include "base/Error.h"
#include "base/Numbers.h"

#include <algorithm>

namespace cactus
{

namespace
{

double numberOf(const PropertyValue& value)
{
  if (const auto* whole = std::get_if<std::int64_t>(&value))
  {
    return static_cast<double>(*whole);
  }
  if (const auto* isOn = std::get_if<bool>(&value))
  {
    return *isOn ? 1.0 : 0.0;
  }
  return std::get<double>(value);
}

bool isChoice(const PropertyFacts& facts, const PropertyValue& value)
{
  const auto place = std::get<std::int64_t>(value);
  return place >= 0 && place < static_cast<std::int64_t>(facts.choices.size());
}

void requireChoice(const PropertyFacts& facts, const PropertyValue& value)
{
  if (isChoice(facts, value))
  {
    return;
  }
  std::string message = facts.name + " has no choice " + std::to_string(std::get<std::int64_t>(value)) + ": use ";
  for (std::size_t i = 0; i < facts.choices.size(); ++i)
  {
    message += i == 0 ? "" : i + 1 < facts.choices.size() ? ", " : " or ";
    message += facts.choices[i] + " (" + std::to_string(i) + ")";
  }
  throw InvalidInput(message + facts.advice);
}

bool isGiven(const PropertyValue& value)
{
  const auto* text = std::get_if<std::string>(&value);
  return text != nullptr ? !text->empty() : numberOf(value) != 0.0;
}

bool hasOneOf(const PropertyValue& value, const std::vector<double>& values)
{
  return std::find(values.begin(), values.end(), numberOf(value)) != values.end();
}

bool holds(const PropertyCondition& condition, const std::vector<PropertyState>& states)
{
  const auto other = std::find_if(
    states.begin(), states.end(), [&](const PropertyState& state) { return state.facts->name == condition.property; });
  return other != states.end() && hasEffect(*other->facts, states) &&
         (condition.values.empty() ? isGiven(other->value) : hasOneOf(other->value, condition.values));
}

} // namespace

bool hasEffect(const PropertyFacts& facts, const std::vector<PropertyState>& states)
{
  return std::all_of(facts.conditions.begin(), facts.conditions.end(),
    [&](const PropertyCondition& condition) { return holds(condition, states); });
}

void validate(const std::vector<PropertyState>& states)
{
  for (const PropertyState& state : states)
  {
    const PropertyFacts& facts = *state.facts;
    if (!hasEffect(facts, states))
    {
      continue;
    }
    if (facts.range)
    {
      requireWithin(facts.name.c_str(), numberOf(state.value), *facts.range, facts.advice.c_str());
    }
    if (!facts.choices.empty())
    {
      requireChoice(facts, state.value);
    }
  }
}

std::string valueText(const PropertyFacts& facts, const PropertyValue& value)
{
  if (!facts.choices.empty() && isChoice(facts, value))
  {
    return facts.choices[static_cast<std::size_t>(std::get<std::int64_t>(value))];
  }
  if (const auto* isOn = std::get_if<bool>(&value))
  {
    return *isOn ? "on" : "off";
  }
  if (const auto* text = std::get_if<std::string>(&value))
  {
    return text->empty() ? "(none)" : *text;
  }
  if (const auto* numbers = std::get_if<std::vector<double>>(&value))
  {
    std::string text;
    for (const double number : *numbers)
    {
      text += (text.empty() ? "" : " ") + exactText(number);
    }
    return text.empty() ? "(none)" : text;
  }
  const auto* whole = std::get_if<std::int64_t>(&value);
  return whole != nullptr ? std::to_string(*whole) : exactText(std::get<double>(value));
}

} // namespace cactus
