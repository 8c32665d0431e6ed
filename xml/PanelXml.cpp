// SPDX-License-Identifier: BSD-3-Clause
#include "PanelXml.h"

#include "base/Error.h"
#include "base/Numbers.h"

#include <algorithm>
#include <cstdint>
#include <regex>
#include <set>
#include <variant>

namespace cactus
{

namespace
{

/// Escapes what XML reads as its own, in texts and attributes.
std::string escaped(const std::string& text)
{
  std::string safe;
  for (const char letter : text)
  {
    safe += letter == '&'   ? "&amp;"
            : letter == '<' ? "&lt;"
            : letter == '>' ? "&gt;"
            : letter == '"' ? "&quot;"
                            : std::string(1, letter);
  }
  return safe;
}

/// Returns a number without an exponent if it is whole: ParaView would read a whole 1e+07 as 1.
std::string numberText(double value)
{
  const auto whole = static_cast<std::int64_t>(value);
  return value == static_cast<double>(whole) ? std::to_string(whole) : exactText(value);
}

/// What ParaView calls the type of a property.
std::string typeName(const PropertyValue& value)
{
  const bool isReal = std::holds_alternative<double>(value) || std::holds_alternative<std::vector<double>>(value);
  return isReal ? "Double" : std::holds_alternative<std::string>(value) ? "String" : "Int";
}

std::string defaultText(const PropertyValue& value)
{
  if (const auto* isOn = std::get_if<bool>(&value))
  {
    return *isOn ? "1" : "0";
  }
  if (const auto* whole = std::get_if<std::int64_t>(&value))
  {
    return std::to_string(*whole);
  }
  if (const auto* numbers = std::get_if<std::vector<double>>(&value))
  {
    std::string all;
    for (const double number : *numbers)
    {
      all += (all.empty() ? "" : " ") + numberText(number);
    }
    return all;
  }
  const auto* number = std::get_if<double>(&value);
  return number != nullptr ? numberText(*number) : escaped(std::get<std::string>(value));
}

std::string domains(const PropertyState& state, bool hasSlider)
{
  const PropertyFacts& facts = *state.facts;
  if (facts.range)
  {
    const std::string domain = "<" + typeName(state.value) + "RangeDomain name=";
    const std::string least = " min=\"" + numberText(facts.range->smallest()) + "\"";
    const std::string both = least + " max=\"" + numberText(facts.range->highest) + "\"/>";
    // The panel takes the last domain, and shows a slider if it has two ends.
    return hasSlider ? domain + "\"range\"" + both : domain + "\"limits\"" + both + domain + "\"range\"" + least + "/>";
  }
  if (std::holds_alternative<bool>(state.value))
  {
    return "<BooleanDomain name=\"bool\"/>";
  }
  std::string entries;
  for (std::size_t i = 0; i < facts.choices.size(); ++i)
  {
    entries += "<Entry value=\"" + std::to_string(i) + "\" text=\"" + escaped(facts.choices[i]) + "\"/>";
  }
  return entries.empty() ? "" : "<EnumerationDomain name=\"enum\">" + entries + "</EnumerationDomain>";
}

const PropertyState& stateOf(const StageDescription& stage, const std::string& property)
{
  const auto found = std::find_if(
    stage.properties.begin(), stage.properties.end(), [&](const PropertyState& state) { return state.facts->name == property; });
  if (found == stage.properties.end())
  {
    throw InvalidInput(text(stage.name, " has no property ", property, ": add it to its description, or correct the name"));
  }
  return *found;
}

/// Returns what shows a property where a condition holds.
std::string decorator(const PropertyCondition& condition, const StageDescription& stage)
{
  std::string values;
  for (const double value : condition.values)
  {
    values += (values.empty() ? "" : " ") + numberText(value);
  }
  const std::string none = std::holds_alternative<std::string>(stateOf(stage, condition.property).value) ? "" : "0";
  return "<PropertyWidgetDecorator type=\"GenericDecorator\" mode=\"visibility\" property=\"" + condition.property + "\" " +
         (condition.values.empty()        ? "value=\"" + none + "\" inverse=\"1"
           : condition.values.size() == 1 ? "value=\"" + values
                                          : "values=\"" + values) +
         "\"/>";
}

/// Returns what shows a property where all its conditions hold.
std::string decorators(const PropertyFacts& facts, const StageDescription& stage)
{
  std::string all;
  for (const PropertyCondition& condition : facts.conditions)
  {
    all += decorator(condition, stage);
  }
  return facts.conditions.size() < 2 ? all
                                     : "<PropertyWidgetDecorator type=\"CompositeDecorator\"><Expression type=\"and\">" + all +
                                         "</Expression></PropertyWidgetDecorator>";
}

/// Returns ParaView's element of a property, with further attributes and children.
std::string element(const PropertyState& state, const StageDescription& stage, std::string attributes, std::string children)
{
  const PropertyFacts& facts = *state.facts;
  const std::string slider = " slider=\"1\"";
  const std::size_t asked = attributes.find(slider);
  if (asked != std::string::npos)
  {
    attributes.erase(asked, slider.size());
  }
  const std::string shown = decorators(facts, stage);
  const std::string hints = "<Hints>";
  if (!shown.empty() && children.find(hints) == std::string::npos)
  {
    children += hints + "</Hints>";
  }
  if (!shown.empty())
  {
    children.insert(children.find(hints) + hints.size(), shown);
  }
  const std::string tag = typeName(state.value) + "VectorProperty";
  const auto* numbers = std::get_if<std::vector<double>>(&state.value);
  return "<" + tag + " name=\"" + facts.name + "\" command=\"Set" + facts.name + "\" number_of_elements=\"" +
         std::to_string(numbers != nullptr ? numbers->size() : 1) + "\" default_values=\"" + defaultText(state.value) + "\"" +
         attributes + ">" + domains(state, asked != std::string::npos) + "<Documentation>" + escaped(facts.meaning) +
         "</Documentation>" + children + "</" + tag + ">";
}

/// Returns null for a class that belongs to no stage.
const StageDescription* stageOf(const std::string& className, const std::vector<StageDescription>& stages)
{
  const auto found =
    std::find_if(stages.begin(), stages.end(), [&](const StageDescription& stage) { return className == "vtk" + stage.name; });
  return found != stages.end() ? &*found : nullptr;
}

void requireStage(const StageDescription* stage, const std::string& property)
{
  if (stage == nullptr)
  {
    throw InvalidInput("StageProperty " + property + " is in no proxy of a stage's class: move it into one");
  }
}

/// Throws for a property of the stage that is not among `given`.
void requireAll(const StageDescription& stage, const std::set<std::string>& given)
{
  for (const PropertyState& state : stage.properties)
  {
    if (given.count(state.facts->name) == 0)
    {
      throw InvalidInput(
        stage.name + " lacks <StageProperty name=\"" + state.facts->name + "\"/>: add it where the panel shows it");
    }
  }
}

} // namespace

std::string panelXml(const std::string& text, const std::vector<StageDescription>& stages)
{
  static const std::regex piece(R"xml(<\w+Proxy name="(\w+)" class="(\w+)"|(</\w+Proxy>)|(<PropertyGroup)|(</PropertyGroup>)|)xml"
                                R"xml(<StageProperty name="(\w+)"((?: \w+="[^"]*")*)(?:/>|>([\s\S]*?)</StageProperty>)|)xml"
                                R"xml(<Property name="(\w+)" command=[^>]*>[\s\S]*?</Property>)xml");
  std::string whole;
  std::string proxy;
  const StageDescription* stage = nullptr;
  std::set<std::string> given;
  std::size_t group = std::string::npos; // where it begins in `whole`
  auto rest = text.begin();
  for (std::sregex_iterator found(text.begin(), text.end(), piece); found != std::sregex_iterator(); ++found)
  {
    const std::smatch& match = *found;
    whole.append(rest, match[0].first);
    rest = match[0].second;
    std::string made = match[0];
    if (match[1].matched)
    {
      proxy = match[1];
      stage = stageOf(match[2], stages);
      given.clear();
    }
    else if (match[3].matched)
    {
      if (stage != nullptr && stage->name == proxy)
      {
        requireAll(*stage, given);
      }
      stage = nullptr;
    }
    else if (match[4].matched)
    {
      group = whole.size();
    }
    else if (match[5].matched)
    {
      group = std::string::npos;
    }
    else if (match[6].matched)
    {
      const std::string name = match[6];
      requireStage(stage, name);
      if (!given.insert(name).second)
      {
        throw InvalidInput(proxy + " has StageProperty " + name + " twice: remove one");
      }
      made = element(stateOf(*stage, name), *stage, match[7], match[8]);
    }
    const std::string property = match[6].matched ? match[6] : match[9];
    if (group != std::string::npos && !property.empty())
    {
      whole.insert(group, made + '\n');
      group += made.size() + 1;
      made = "<Property name=\"" + property + "\"/>";
    }
    whole += made;
  }
  whole.append(rest, text.end());
  const std::size_t unread = whole.find("<StageProperty");
  if (unread != std::string::npos)
  {
    throw InvalidInput("cannot read " + whole.substr(unread, 60) + ": give the name first, and all attributes in one line");
  }
  return whole;
}

} // namespace cactus
