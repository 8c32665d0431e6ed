// SPDX-License-Identifier: BSD-3-Clause
#include "recipe/RecipeReader.h"

#include "base/Error.h"
#include "base/JsonText.h"
#include "base/Numbers.h"
#include "recipe/PropertyText.h"
#include "recipe/RecipeRecords.h"
#include "stages/Presets.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace cactus
{

namespace
{

/// Rejects, while a text is parsed, duplicate names in one object, the first of which would be lost, and too deep nesting.
class ParseWatch
{
public:
  bool operator()(int depth, Json::parse_event_t event, const Json& value)
  {
    constexpr int deepest = deepestJson + 8; // a manifest holds records
    if (depth > deepest)
    {
      throw InvalidInput("it is nested more deeply than any recipe");
    }
    if (event == Json::parse_event_t::object_start)
    {
      this->Names.emplace_back();
    }
    else if (event == Json::parse_event_t::object_end)
    {
      this->Names.pop_back();
    }
    else if (event == Json::parse_event_t::key && !this->Names.back().insert(value.get<std::string>()).second)
    {
      throw InvalidInput(excerpt(singleLine(value)) + " stands twice: give several as a list");
    }
    return true;
  }

private:
  std::vector<std::set<std::string>> Names; ///< one set for each open object
};

Json parsedRecipe(const std::string& text)
{
  ParseWatch watch;
  try
  {
    return Json::parse(
      text, [&watch](int depth, Json::parse_event_t event, Json& value) { return watch(depth, event, value); }, true, true);
  }
  catch (const Json::exception& error)
  {
    // "[json.exception.parse_error.101] parse error at line 3, column 5: …"
    const std::string message = error.what();
    const std::size_t end = message.find("] ");
    throw InvalidInput("it is no JSON: " + (end == std::string::npos ? message : message.substr(end + 2)));
  }
}

/// Builds the stages of a hand-written recipe, in the order of the chain.
class NamedStages
{
public:
  NamedStages(const Json& recipe, const std::string& folder)
    : Text(recipe)
    , Folder(folder)
  {
  }

  Recipe read()
  {
    this->takePreset();
    this->requireKnownNames();
    this->addSources();
    const bool isParted = !this->has("CapsuleOptimizer") || this->Text["CapsuleOptimizer"] != Json(false);
    if (isParted)
    {
      const std::size_t optimiser =
        this->add("CapsuleOptimizer", this->values("CapsuleOptimizer"), { { "Input", this->Fibres } });
      this->Fibres = { { optimiser, 0, {} } };
    }
    else if (this->Fibres.size() > 1)
    {
      this->Fibres = { { 0, 0, this->Fibres } };
    }
    this->has("SubstrateProduction") ? this->addProduction() : this->addFilters();
    return std::move(this->Made);
  }

private:
  using Inputs = std::vector<std::pair<std::string, std::vector<RecipeSource>>>;

  bool has(const char* name) const { return this->Text.contains(name); }

  Json values(const char* name) const { return this->has(name) ? this->Text[name] : Json::object(); }

  void takePreset()
  {
    if (this->has(presetName))
    {
      const Json& name = this->Text[presetName];
      if (!name.is_string())
      {
        throw InvalidInput(std::string(presetName) + " is " + excerpt(singleLine(name)) + ": give the name of a preset");
      }
      this->Start = &presetNamed(name.get<std::string>());
    }
  }

  void requireKnownNames() const
  {
    for (const auto& entry : this->Text.items())
    {
      if (entry.key() != presetName && !recipeOptions(entry.key()))
      {
        throw InvalidInput("there is no stage " + excerpt(entry.key()) + " in a recipe: use " + recipeStageNames());
      }
    }
    for (const char* name : { "FibreRadialGrowth", "MyelinSurface", "SubstrateWriter" })
    {
      if (this->has("SubstrateProduction") && this->has(name))
      {
        throw InvalidInput(std::string(name) + " and SubstrateProduction, which stands for it, are both given: leave one out");
      }
    }
  }

  std::size_t add(const std::string& name, const Json& values, Inputs inputs)
  {
    if (!values.is_object())
    {
      throw InvalidInput(name + " is " + excerpt(singleLine(values)) + ": give its properties in braces, {\"NAME\": value}");
    }
    RecipeStage stage{ name, *recipeOptions(name), std::move(inputs) };
    if (this->Start != nullptr)
    {
      for (const auto& [property, value] : presetValues(*this->Start, name))
      {
        setProperty(stage.options, property, std::visit([](const auto& one) { return Json(one); }, value), false);
      }
    }
    for (const auto& [property, value] : values.items())
    {
      try
      {
        setProperty(stage.options, property, this->located(property, value), false);
      }
      catch (const InvalidInput& error)
      {
        throw InvalidInput(name + ": " + error.what());
      }
    }
    this->Made.stages.push_back(std::move(stage));
    return this->Made.stages.size() - 1;
  }

  /// Resolves the value of a property that names a file or folder relative to the recipe.
  Json located(const std::string& property, const Json& value) const
  {
    static const std::set<std::string> paths = { "FileName", "RadiusTableFile", "CheckpointFile", "FolderName" };
    if (paths.count(property) == 0 || !value.is_string() || value == Json("") || this->Folder.empty())
    {
      return value;
    }
    return (std::filesystem::path(this->Folder) / value.get<std::string>()).string();
  }

  /// Adds a stage for each element of a list, or a single one; none if the recipe does not name it.
  std::vector<RecipeSource> addAll(const std::string& name, const Inputs& inputs)
  {
    const Json values = this->has(name.c_str()) ? this->Text[name] : Json::array();
    const Json several = values.is_array() ? values : Json::array({ values });
    if (several.empty() && this->has(name.c_str()))
    {
      throw InvalidInput(name + " is an empty list: leave it out, or say what to make");
    }
    std::vector<RecipeSource> made;
    for (const Json& one : several)
    {
      made.push_back({ this->add(name, one, inputs), 0, {} });
    }
    return made;
  }

  void addSources()
  {
    for (const auto& entry : this->Text.items())
    {
      if (entry.key() == "BundleInitializer" || entry.key() == "CurvedBundles" || entry.key() == "StrandReader")
      {
        const std::vector<RecipeSource> made = this->addAll(entry.key(), {});
        this->Fibres.insert(this->Fibres.end(), made.begin(), made.end());
      }
    }
    this->addTracts();
    if (this->Fibres.empty())
    {
      this->Fibres.push_back({ this->add("BundleInitializer", Json::object(), {}), 0, {} });
    }
  }

  /// Adds streamlines, and fibres that follow them.
  void addTracts()
  {
    if (this->has("TractogramReader") != this->has("TractFibres"))
    {
      throw InvalidInput(this->has("TractFibres") ? "TractFibres has no streamlines to follow: name a file in TractogramReader"
                                                  : "TractogramReader gives streamlines, which nothing follows: add TractFibres");
    }
    std::vector<RecipeSource> streamlines = this->addAll("TractogramReader", {});
    if (streamlines.size() > 1)
    {
      streamlines = { { 0, 0, streamlines } };
    }
    const std::vector<RecipeSource> made = this->addAll("TractFibres", { { "Input", streamlines } });
    this->Fibres.insert(this->Fibres.end(), made.begin(), made.end());
  }

  void addProduction() { this->add("SubstrateProduction", this->values("SubstrateProduction"), { { "Input", this->Fibres } }); }

  void addFilters()
  {
    const std::size_t growth = this->add("FibreRadialGrowth", this->values("FibreRadialGrowth"), { { "Input", this->Fibres } });
    const std::size_t surfaces =
      this->add("MyelinSurface", this->values("MyelinSurface"), { { "Input", { { growth, 0, {} } } } });
    this->add("SubstrateWriter", this->values("SubstrateWriter"),
      { { "Outer", { { surfaces, 0, {} } } }, { "Inner", { { surfaces, 1, {} } } }, { "Fibres", this->Fibres } });
  }

  static constexpr const char* presetName = "Preset";
  const Json& Text;
  const std::string& Folder;
  const Preset* Start = nullptr; ///< the preset whose values stages have if the recipe sets none
  Recipe Made;
  std::vector<RecipeSource> Fibres; ///< sources of the next stage
};

} // namespace

Recipe readRecipe(const std::string& text, const std::string& folder)
{
  const Json content = parsedRecipe(text);
  if (!content.is_object())
  {
    throw InvalidInput("it is no recipe: give the properties of stages by their names, {\"BundleInitializer\": {\"Side\": 20}}");
  }
  Recipe recipe = content.contains("provenance") ? recipeOfManifest(content) : NamedStages(content, folder).read();
  check(recipe);
  return recipe;
}

} // namespace cactus
