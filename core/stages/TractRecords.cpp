// SPDX-License-Identifier: BSD-3-Clause
#include "stages/TractRecords.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "base/JsonText.h"

#include <algorithm>
#include <optional>

namespace cactus
{

namespace
{

/// Appends the records of a filter among those of an origin.
void appendRecords(const DataOrigin& origin, const std::string& filter, std::vector<Json>& records)
{
  for (const std::string& text : origin.records)
  {
    Json record = parsedJson(text).value_or(Json());
    if (record.is_object() && record.value("filter", "") == filter)
    {
      records.push_back(std::move(record));
    }
  }
  for (const DataOrigin& part : origin.parts)
  {
    appendRecords(part, filter, records);
  }
}

std::vector<Json> recordsOf(const std::string& filter, const InputOrigins& inputs)
{
  std::vector<Json> records;
  for (const auto& input : inputs)
  {
    for (const DataOrigin& origin : input.second)
    {
      appendRecords(origin, filter, records);
    }
  }
  return records;
}

bool isInMillimetres(const Json& record)
{
  return record.at("properties").at("LengthUnit").get<std::string>() == "Millimetre";
}

bool isReadInMillimetres(const DataOrigin& origin)
{
  if (origin.records.empty())
  {
    return !origin.parts.empty() && std::all_of(origin.parts.begin(), origin.parts.end(), isReadInMillimetres);
  }
  const Json last = parsedJson(origin.records.back()).value_or(Json());
  return last.is_object() && last.value("filter", "") == "TractogramReader" && isInMillimetres(last);
}

} // namespace

TractFibresStage askedOfTract(TractFibresStage stage, const InputOrigins& inputs)
{
  if (stage.options.lengthUnit != TractUnit::AsRead)
  {
    return stage;
  }
  std::optional<TractUnit> unit;
  for (const Json& record : recordsOf("TractogramReader", inputs))
  {
    try
    {
      const TractUnit own = isInMillimetres(record) ? TractUnit::Millimetre : TractUnit::Micrometre;
      if (unit.value_or(own) != own)
      {
        throw InvalidInput("the streamlines come from TractogramReaders with different LengthUnits: give all the same");
      }
      unit = own;
    }
    catch (const Json::exception&)
    {
      throw InvalidInput("the record of TractogramReader does not say the unit of the streamlines: give LengthUnit");
    }
  }
  stage.options.lengthUnit = unit.value_or(TractUnit::Micrometre);
  return stage;
}

bool areStreamlinesInMillimetres(const InputOrigins& inputs)
{
  for (const auto& input : inputs)
  {
    if (std::any_of(input.second.begin(), input.second.end(), isReadInMillimetres))
    {
      return true;
    }
  }
  return false;
}

Placement placementOnTract(const InputOrigins& inputs)
{
  std::optional<Placement> found;
  for (const Json& record : recordsOf("TractFibres", inputs))
  {
    Placement placement;
    try
    {
      placement.scale = micrometre / record.at("properties").at("ScaleFactor").get<double>();
      const double unit = isInMillimetres(record) ? 1.0 : micrometre;
      for (int axis = 0; axis < 3; ++axis)
      {
        placement.position[axis] = unit * record.at("reached").at("Middle").at(std::size_t(axis)).get<double>();
      }
    }
    catch (const Json::exception&)
    {
      throw InvalidInput("the record of TractFibres does not say where on the tract the substrate lies: give Place By position");
    }
    if (found && (found->position != placement.position || found->scale != placement.scale))
    {
      throw InvalidInput("the data come from several TractFibres, which lie at different places: place each by itself");
    }
    found = placement;
  }
  if (!found)
  {
    throw InvalidInput("the data do not come from TractFibres, so there is no tract to place them on: give Place By position");
  }
  return *found;
}

} // namespace cactus
