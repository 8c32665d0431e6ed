// SPDX-License-Identifier: BSD-3-Clause
#include "base/Provenance.h"

#include "base/JsonText.h"
#include "base/PosixFile.h"
#include "base/Sha256.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>

namespace cactus
{

namespace
{

constexpr std::size_t idDigits = 16;

/// Parses a stage's record; nothing for any other text.
std::optional<Json> recordFrom(const std::string& text)
{
  std::optional<Json> record = parsedJson(text);
  const bool isRecord = record && record->is_object() && record->contains("id") && (*record)["id"].is_string() &&
                        record->contains("filter") && (*record)["filter"].is_string();
  return isRecord ? record : std::nullopt;
}

Json jsonOf(const PropertyValue& value)
{
  return std::visit([](const auto& held) { return Json(held); }, value);
}

Json propertiesOf(const std::vector<PropertyState>& states)
{
  Json properties = Json::object();
  for (const auto& [facts, value] : states)
  {
    if (facts->use == PropertyUse::Result && hasEffect(*facts, states))
    {
      properties[facts->name] = facts->choices.empty() ? jsonOf(value) : Json(valueText(*facts, value));
    }
  }
  return properties;
}

Json filesOf(const std::vector<FileRead>& files)
{
  Json all = Json::array();
  for (const FileRead& file : files)
  {
    all.push_back({ { "property", file.property }, { "path", std::filesystem::absolute(file.path).string() },
      { "sha256", sha256OfFile(file.path) } });
  }
  return all;
}

/// Collects the records of all stages that an input comes from, each once, without their notes on an output.
class Ancestors
{
public:
  /// Returns the reference to the data for the record of the stage that receives them.
  Json add(const DataOrigin& origin)
  {
    if (!origin.parts.empty())
    {
      return this->addParts(origin);
    }
    Json reference = Json::object();
    for (const std::string& text : origin.records)
    {
      std::optional<Json> record = recordFrom(text);
      if (!record)
      {
        this->insert("text " + text, text);
        reference = Json::object();
        continue;
      }
      reference = { { "stage", (*record)["id"] } };
      if (record->contains("output") && (*record)["output"].is_object())
      {
        // Anything else that others may have written there could be nested more deeply than the parser accepts.
        for (const char* name : { "port", "checksum" })
        {
          const auto known = (*record)["output"].find(name);
          if (known != (*record)["output"].end() && known->is_primitive())
          {
            reference[name] = *known;
          }
        }
        record->erase("output");
      }
      this->insert("stage " + (*record)["id"].get<std::string>(), singleLine(*record));
    }
    if (origin.isChanged && !reference.empty())
    {
      reference["changed"] = true;
    }
    if (!origin.filter.empty())
    {
      reference = { { "filter", origin.filter }, { "inputs", Json::array() } };
    }
    return reference;
  }

  Provenance take() { return std::move(this->Records); }

private:
  Json addParts(const DataOrigin& origin)
  {
    Json parts = Json::array();
    for (const DataOrigin& part : origin.parts)
    {
      parts.push_back(this->add(part));
    }
    if (!origin.filter.empty())
    {
      return { { "filter", origin.filter }, { "inputs", std::move(parts) } };
    }
    const bool isOne = std::all_of(parts.begin(), parts.end(), [&](const Json& part) { return part == parts.front(); });
    // Blocks that all come from one output are recorded as that output.
    return isOne ? parts.front() : Json{ { "blocks", std::move(parts) } };
  }

  void insert(const std::string& key, std::string record)
  {
    if (this->Known.insert(key).second)
    {
      this->Records.push_back(std::move(record));
    }
  }

  Provenance Records;
  std::set<std::string> Known;
};

} // namespace

bool DataOrigin::isKnown() const
{
  return (!this->records.empty() && recordFrom(this->records.back())) ||
         std::any_of(this->parts.begin(), this->parts.end(), [](const DataOrigin& part) { return part.isKnown(); });
}

Provenance provenanceOf(const StageRecord& stage)
{
  Ancestors ancestors;
  Json inputs = Json::object();
  for (const auto& [name, data] : stage.inputs)
  {
    inputs[name] = Json::array();
    for (const DataOrigin& origin : data)
    {
      inputs[name].push_back(ancestors.add(origin));
    }
  }
  Json record;
  record["id"] = "";
  record["filter"] = stage.filter;
  record["version"] = CACTUS_VERSION;
  record["properties"] = propertiesOf(stage.properties);
  if (!stage.reached.empty())
  {
    record["reached"] = Json::object();
    for (const auto& [name, value] : stage.reached)
    {
      record["reached"][name] = jsonOf(value);
    }
  }
  if (!stage.files.empty())
  {
    record["files"] = filesOf(stage.files);
  }
  record["inputs"] = std::move(inputs);
  record["id"] = sha256(singleLine(record)).substr(0, idDigits);
  Provenance all = ancestors.take();
  all.push_back(singleLine(record));
  return all;
}

Provenance provenanceOfOutput(Provenance stages, int output, const std::string& checksum)
{
  std::optional<Json> last = stages.empty() ? std::nullopt : recordFrom(stages.back());
  if (last)
  {
    (*last)["output"] = { { "port", output }, { "checksum", checksum } };
    stages.back() = singleLine(*last);
  }
  return stages;
}

std::string checksumOf(const Provenance& records)
{
  const std::optional<Json> last = records.empty() ? std::nullopt : recordFrom(records.back());
  if (!last || !last->contains("output") || !(*last)["output"].is_object())
  {
    return "";
  }
  const auto checksum = (*last)["output"].find("checksum");
  return checksum != (*last)["output"].end() && checksum->is_string() ? checksum->get<std::string>() : "";
}

} // namespace cactus
