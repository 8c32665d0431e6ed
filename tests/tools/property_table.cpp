// SPDX-License-Identifier: BSD-3-Clause
// Prints docs/properties.md from the stages' descriptions of their properties.
#include "base/Numbers.h"
#include "bundle/RadiusHistogram.h"
#include "stages/Presets.h"
#include "stages/Stages.h"

#include <cmath>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using cactus::PropertyFacts;
using cactus::PropertyState;

/// Returns a number in its most readable form: a hundred thousand is not 1e+05.
std::string shortText(double value)
{
  return value == static_cast<double>(static_cast<long long>(value)) ? std::to_string(static_cast<long long>(value))
                                                                     : cactus::exactText(value);
}

std::string allowed(const PropertyState& state)
{
  const PropertyFacts& facts = *state.facts;
  std::string text;
  for (const std::string& choice : facts.choices)
  {
    text += (text.empty() ? "" : ", ") + choice;
  }
  if (facts.range)
  {
    text = (facts.range->special ? shortText(*facts.range->special) + " or " : "") + shortText(facts.range->lowest) + " to " +
           shortText(facts.range->highest) + facts.range->unit;
  }
  return text.empty() ? (std::holds_alternative<bool>(state.value) ? "on, off" : "text") : text;
}

std::string conditionText(const cactus::PropertyCondition& condition, const cactus::StageDescription& stage)
{
  std::string text;
  std::string any = " is given";
  for (const PropertyState& other : stage.properties)
  {
    if (other.facts->name != condition.property)
    {
      continue;
    }
    any = std::holds_alternative<std::string>(other.value) ? " is given"
          : std::holds_alternative<bool>(other.value)      ? " is on"
                                                           : " is not 0";
    for (const double value : condition.values)
    {
      cactus::PropertyValue shown = static_cast<std::int64_t>(value);
      if (std::holds_alternative<double>(other.value))
      {
        shown = value;
      }
      else if (std::holds_alternative<bool>(other.value))
      {
        shown = value != 0.0;
      }
      text += (text.empty() ? "" : " or ") + cactus::valueText(*other.facts, shown);
    }
  }
  return condition.property + (text.empty() ? any : " is " + text);
}

/// Escapes what Markdown reads as its own.
std::string plainText(const std::string& text)
{
  std::string safe;
  for (const char letter : text)
  {
    safe += letter == '&'                    ? "&amp;"
            : letter == '<'                  ? "&lt;"
            : letter == '>'                  ? "&gt;"
            : letter == '*' || letter == '|' ? std::string{ '\\', letter }
                                             : std::string(1, letter);
  }
  return safe;
}

const PropertyFacts& factsOf(const cactus::PresetValue& value)
{
  static const std::vector<cactus::StageDescription> stages = cactus::describeStages();
  for (const cactus::StageDescription& stage : stages)
  {
    for (const PropertyState& state : stage.properties)
    {
      if (stage.name == value.stage && state.facts->name == value.property)
      {
        return *state.facts;
      }
    }
  }
  throw std::logic_error("no property " + value.stage + "." + value.property);
}

void printPresets()
{
  std::cout << "\n## Presets\n\n"
               "Values that belong together ([presets](presets.md)); other properties have their defaults.\n\n"
               "| preset | what it is | values | source |\n|---|---|---|---|\n";
  for (const cactus::Preset& preset : cactus::presets())
  {
    std::cout << "| " << preset.name << " | " << preset.meaning << ". |";
    std::string stage;
    for (const cactus::PresetValue& value : preset.values)
    {
      std::cout << (value.stage == stage ? ", " : (stage.empty() ? " " : "; ") + value.stage + ": ") << value.property << ' '
                << cactus::valueText(factsOf(value), value.value);
      stage = value.stage;
    }
    std::cout << " | " << preset.source << ". |\n";
  }
}

/// Rounds to two digits after the point.
std::string roundedText(double value)
{
  return cactus::exactText(std::round(100.0 * value) / 100.0);
}

void printHistograms()
{
  std::cout
    << "\n## Published radii\n\n"
       "The choices of `RadiusHistogram` ([histology](histology.md#axons-as-they-were-published)): radii of axons without their "
       "myelin, in\nfixed tissue, in µm.\n\n"
       "| histogram | mean ± deviation | effective, (⟨r⁶⟩/⟨r²⟩)^¼ | from, to | source |\n|---|---|---|---|---|\n";
  for (const cactus::RadiusHistogram& histogram : cactus::radiusHistograms())
  {
    std::cout << "| " << histogram.name << " | " << roundedText(histogram.meanRadius()) << " ± "
              << roundedText(histogram.deviation()) << " | " << roundedText(histogram.effectiveRadius()) << " | "
              << roundedText(histogram.smallestRadius()) << ", " << roundedText(histogram.largestRadius()) << " | "
              << histogram.source << ". |\n";
  }
}

void printTables()
{
  std::cout
    << "# Properties\n\n"
       "The properties of every stage, made from the descriptions in `core/` by `build/release/bin/cactus_property_table`.\n"
       "A value out of its range gives one error that names the property. A property that has no effect, because of the value\n"
       "of another one, is not checked.\n";
  for (const cactus::StageDescription& stage : cactus::describeStages())
  {
    std::cout << "\n## " << stage.name << "\n\n| property | default | allowed | meaning |\n|---|---|---|---|\n";
    for (const PropertyState& state : stage.properties)
    {
      std::string where;
      for (const cactus::PropertyCondition& condition : state.facts->conditions)
      {
        where += (where.empty() ? " *Where " : " and ") + conditionText(condition, stage);
      }
      std::cout << "| " << state.facts->name << " | " << cactus::valueText(*state.facts, state.value) << " | " << allowed(state)
                << " | " << plainText(state.facts->meaning) << where << (where.empty() ? "" : ".*") << " |\n";
    }
  }
  printPresets();
  printHistograms();
}

} // namespace

int main()
{
  printTables();
  return 0;
}
