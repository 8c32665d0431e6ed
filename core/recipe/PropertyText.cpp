// SPDX-License-Identifier: BSD-3-Clause
#include "recipe/PropertyText.h"

#include "base/Error.h"
#include "base/Limits.h"
#include "base/Numbers.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <vector>

namespace cactus
{

namespace
{

[[noreturn]] void failValue(const PropertyFacts& facts, const Json& value, const std::string& wanted)
{
  throw InvalidInput(facts.name + " is " + excerpt(singleLine(value)) + ": give " + wanted);
}

std::int64_t choiceFrom(const PropertyFacts& facts, const Json& value)
{
  std::string wanted;
  for (std::size_t i = 0; i < facts.choices.size(); ++i)
  {
    if (value == Json(facts.choices[i]) || value == Json(i))
    {
      return static_cast<std::int64_t>(i);
    }
    wanted += (i == 0 ? "\"" : i + 1 < facts.choices.size() ? ", \"" : " or \"") + facts.choices[i] + '"';
  }
  failValue(facts, value, wanted);
}

std::int64_t wholeFrom(const PropertyFacts& facts, const Json& value)
{
  constexpr double exact = 9007199254740992.0; // up to this, a double has every whole number
  const double number = value.is_number() ? value.get<double>() : std::nan("");
  if (!(std::abs(number) <= exact) || number != std::floor(number))
  {
    failValue(facts, value, "a whole number");
  }
  return static_cast<std::int64_t>(number);
}

bool isNumbers(const Json& value)
{
  return value.is_array() && std::all_of(value.begin(), value.end(), [](const Json& one) { return one.is_number(); });
}

/// Returns a text or, for one of numbers, its numbers as text.
std::string textFrom(const PropertyFacts& facts, const Json& value)
{
  if (value.is_string())
  {
    return value.get<std::string>();
  }
  const bool isTable = facts.name == "RadiusTable" || facts.name == "OrientationHarmonics" || facts.name == "OrientationPeaks";
  if (!isTable || !isNumbers(value))
  {
    failValue(facts, value, isTable ? "a text or a list of numbers" : "a text");
  }
  std::string numbers;
  for (const Json& number : value)
  {
    numbers += (numbers.empty() ? "" : " ") + exactText(number.get<double>());
  }
  return numbers;
}

std::string inLowerCase(std::string text)
{
  std::transform(
    text.begin(), text.end(), text.begin(), [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return text;
}

/// Returns the edit distance of two texts: letters to be changed, added or left out.
std::size_t differenceOf(const std::string& a, const std::string& b)
{
  std::vector<std::size_t> before(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j)
  {
    before[j] = j;
  }
  for (std::size_t i = 1; i <= a.size(); ++i)
  {
    std::vector<std::size_t> now{ i };
    for (std::size_t j = 1; j <= b.size(); ++j)
    {
      const std::size_t changed = before[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      now.push_back(std::min({ changed, before[j] + 1, now[j - 1] + 1 }));
    }
    before = std::move(now);
  }
  return before.back();
}

bool isOffered(const PropertyFacts& facts, bool onlyResult)
{
  return facts.use == PropertyUse::Result || (facts.use == PropertyUse::Run && !onlyResult);
}

/// Returns a suggestion for a wrong name, as the end of a message.
template <typename Stage>
std::string likelyName(const std::string& wrong, bool onlyResult)
{
  constexpr std::size_t mostSlips = 3;
  constexpr std::size_t longestName = 100;
  std::string likely;
  std::size_t fewest = mostSlips + 1;
  for (const auto& property : Stage::properties().all())
  {
    const std::size_t slips = wrong.size() < longestName && isOffered(property.facts, onlyResult)
                                ? differenceOf(inLowerCase(wrong), inLowerCase(property.facts.name))
                                : fewest;
    if (slips < fewest)
    {
      fewest = slips;
      likely = property.facts.name;
    }
  }
  return likely.empty() ? "" : ": is it " + likely + '?';
}

template <typename Stage>
void setIn(Stage& stage, const std::string& name, const Json& value, bool onlyResult)
{
  const auto* property = Stage::properties().find(name);
  if (property == nullptr || !isOffered(property->facts, onlyResult))
  {
    throw InvalidInput("there is no property " + excerpt(name) + likelyName<Stage>(name, onlyResult));
  }
  property->set(stage, propertyValue(property->facts, property->get(stage), value));
}

} // namespace

PropertyValue propertyValue(const PropertyFacts& facts, const PropertyValue& like, const Json& value)
{
  if (!facts.choices.empty())
  {
    return choiceFrom(facts, value);
  }
  if (std::holds_alternative<bool>(like))
  {
    if (!value.is_boolean())
    {
      failValue(facts, value, "true or false");
    }
    return value.get<bool>();
  }
  if (std::holds_alternative<std::string>(like))
  {
    return textFrom(facts, value);
  }
  if (const auto* numbers = std::get_if<std::vector<double>>(&like))
  {
    if (!isNumbers(value) || value.size() != numbers->size())
    {
      failValue(facts, value, "a list of " + std::to_string(numbers->size()) + " numbers");
    }
    return value.get<std::vector<double>>();
  }
  if (!value.is_number())
  {
    failValue(facts, value, "a number");
  }
  // Checked before it is assigned to a member, which may be too small for it.
  if (facts.range)
  {
    requireWithin(facts.name.c_str(), value.get<double>(), *facts.range, facts.advice.c_str());
  }
  if (std::holds_alternative<std::int64_t>(like))
  {
    return wholeFrom(facts, value);
  }
  return value.get<double>();
}

void setProperty(RecipeOptions& options, const std::string& name, const Json& value, bool onlyResult)
{
  std::visit([&](auto& stage) { setIn(stage, name, value, onlyResult); }, options);
}

} // namespace cactus
