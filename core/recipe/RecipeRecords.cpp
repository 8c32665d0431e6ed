// SPDX-License-Identifier: BSD-3-Clause
#include "recipe/RecipeRecords.h"

#include "base/Error.h"
#include "base/Numbers.h"
#include "base/PosixFile.h"
#include "recipe/PropertyText.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace cactus
{

namespace
{

const Json nothing;

/// Returns a member of an object, or null.
const Json& memberOf(const Json& object, const char* name)
{
  const auto found = object.is_object() ? object.find(name) : object.end();
  return object.is_object() && found != object.end() ? *found : nothing;
}

std::string textOf(const Json& object, const char* name)
{
  const Json& member = memberOf(object, name);
  return member.is_string() ? member.get<std::string>() : "";
}

/// Returns the path that a property of this value named when `file` was read: that file, or a folder that contains it.
std::string namedBy(const std::string& value, const std::string& file)
{
  const std::filesystem::path name = (std::filesystem::path(value) / "").parent_path().filename();
  std::filesystem::path named = file;
  while (named.filename() != name && named.has_relative_path())
  {
    named = named.parent_path();
  }
  return named.has_relative_path() ? named.string() : file;
}

[[noreturn]] void failDamaged(const std::string& where)
{
  throw InvalidInput("the provenance is damaged: " + where);
}

/// Reads the records of a provenance from the last one backwards.
class RecordReader
{
public:
  explicit RecordReader(const Json& records)
    : Records(records)
  {
    for (std::size_t i = 0; i < records.size(); ++i)
    {
      if (!records[i].is_object())
      {
        throw InvalidInput("it says how the substrate was made in words only, as those of CACTUS before 0.2.0 do: write a recipe "
                           "with these values");
      }
      this->PlaceOf[textOf(records[i], "id")] = i;
    }
  }

  Recipe read()
  {
    this->want(this->Records.size() - 1);
    Recipe recipe;
    for (const std::size_t place : this->Wanted) // in their order
    {
      this->StageOf[place] = recipe.stages.size();
      recipe.stages.push_back(this->stage(place));
    }
    return recipe;
  }

private:
  std::string filterOf(std::size_t place) const { return textOf(this->Records[place], "filter"); }

  /// Marks the record and all its sources.
  void want(std::size_t place)
  {
    if (!this->Wanted.insert(place).second)
    {
      return;
    }
    for (const auto& [name, references] : memberOf(this->Records[place], "inputs").items())
    {
      for (const Json& reference : references)
      {
        this->wantSource(reference, place, name + " of " + this->filterOf(place));
      }
    }
  }

  void wantSource(const Json& reference, std::size_t consumer, const std::string& where)
  {
    if (!memberOf(reference, "filter").is_null())
    {
      throw InvalidInput(
        "a " + excerpt(textOf(reference, "filter")) + " was at work before input " + where + ", whose values nobody has kept");
    }
    const Json& blocks = memberOf(reference, "blocks");
    if (blocks.is_array())
    {
      for (const Json& block : blocks)
      {
        this->wantSource(block, consumer, where);
      }
      return;
    }
    const auto found = this->PlaceOf.find(textOf(reference, "stage"));
    if (found == this->PlaceOf.end())
    {
      throw InvalidInput("where input " + where + " came from is not known");
    }
    if (!memberOf(reference, "changed").is_null())
    {
      throw InvalidInput("the data at input " + where + " were changed after " + this->filterOf(found->second) +
                         " by something that nobody has kept");
    }
    if (found->second >= consumer)
    {
      failDamaged("input " + where + " comes from a later stage");
    }
    this->want(found->second);
  }

  RecipeSource source(const Json& reference) const
  {
    RecipeSource source;
    const Json& blocks = memberOf(reference, "blocks");
    if (blocks.is_array())
    {
      for (const Json& block : blocks)
      {
        source.blocks.push_back(this->source(block));
      }
      return source;
    }
    const Json& port = memberOf(reference, "port");
    source.stage = this->StageOf.at(this->PlaceOf.at(textOf(reference, "stage")));
    source.port = port == Json(1) ? 1 : 0;
    return source;
  }

  RecipeStage stage(std::size_t place) const
  {
    const Json& record = this->Records[place];
    const std::string name = textOf(record, "filter");
    std::optional<RecipeOptions> options = recipeOptions(name);
    if (!options)
    {
      throw InvalidInput("there is no stage " + excerpt(name) +
                         " that could be run without ParaView (./cactus rerun may): there are " + recipeStageNames());
    }
    RecipeStage stage{ name, std::move(*options), {} };
    try
    {
      setProperties(stage.options, record);
    }
    catch (const InvalidInput& error)
    {
      throw InvalidInput(name + ": " + error.what());
    }
    for (const auto& [input, references] : memberOf(record, "inputs").items())
    {
      stage.inputs.emplace_back(input, std::vector<RecipeSource>());
      for (const Json& reference : references)
      {
        stage.inputs.back().second.push_back(this->source(reference));
      }
    }
    return stage;
  }

  static void setProperties(RecipeOptions& options, const Json& record)
  {
    for (const auto& [name, value] : memberOf(record, "properties").items())
    {
      setProperty(options, name, value, true);
    }
    // What there was before 0.3.0.
    const std::string filter = textOf(record, "filter");
    const bool isBundle = filter == "BundleInitializer";
    const auto lacks = [&](const char* name) { return memberOf(memberOf(record, "properties"), name).is_null(); };
    if (isBundle && lacks("Border"))
    {
      setProperty(options, "Border", Json("Walls"), true);
    }
    if ((isBundle || filter == "TractFibres") && lacks("CalibreVariation"))
    {
      setProperty(options, "CalibreVariation", Json(0), true);
    }
    if ((isBundle || filter == "TractFibres" || filter == "CurvedBundles") && lacks("SectionAxisRatio"))
    {
      setProperty(options, "SectionAxisRatio", Json(1), true);
    }
    const Json& reached = memberOf(record, "reached");
    if (memberOf(reached, "IsResult") == Json(false))
    {
      throw InvalidInput("the substrate was made of a state on its way (KeepHistory), which is not kept");
    }
    if (textOf(reached, "Ended") == "TimeBudget" || textOf(reached, "Ended") == "Stopped")
    {
      // The clock and the user stop elsewhere the next time.
      setProperty(options, "MaximumIterations", memberOf(reached, "Iterations"), true);
      setProperty(options, "TimeBudget", Json(0), true);
    }
    for (const Json& file : memberOf(record, "files"))
    {
      const std::string path = textOf(file, "path");
      std::error_code error;
      if (!std::filesystem::is_regular_file(path, error))
      {
        throw InvalidInput(path + ", which it has read, is missing: put it back there");
      }
      if (sha256OfFile(path) != textOf(file, "sha256"))
      {
        throw InvalidInput(path + ", which it has read, is another file than it was (its SHA-256 was " + textOf(file, "sha256") +
                           "): put the old one there");
      }
      const std::string property = textOf(file, "property");
      const std::string value = textOf(memberOf(record, "properties"), property.c_str());
      setProperty(options, property, Json(namedBy(value, path)), true);
    }
  }

  const Json& Records;
  std::map<std::string, std::size_t> PlaceOf; ///< index of a record, by its id
  std::set<std::size_t> Wanted;
  std::map<std::size_t, std::size_t> StageOf; ///< index in the recipe, by that of the record
};

} // namespace

Recipe recipeOfManifest(const Json& manifest)
{
  const Json& records = memberOf(manifest, "provenance");
  if (!records.is_array() || records.empty())
  {
    throw InvalidInput("its provenance does not say how the substrate was made");
  }
  constexpr std::size_t mostRecords = 1000; // they are followed by recursion
  if (records.size() > mostRecords)
  {
    failDamaged("it has " + std::to_string(records.size()) + " stages");
  }
  Recipe recipe = RecordReader(records).read();
  recipe.version = textOf(manifest, "version");
  if (recipe.version.empty())
  {
    recipe.version = textOf(records.back(), "version");
  }
  return recipe;
}

} // namespace cactus
