// SPDX-License-Identifier: BSD-3-Clause
#include "base/JsonText.h"

namespace cactus
{

namespace
{

/// Returns a JSON text without line ends.
std::string dumped(const Json& value)
{
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

} // namespace

std::optional<Json> parsedJson(const std::string& text)
{
  bool isTooDeep = false;
  const Json::parser_callback_t watch = [&isTooDeep](int depth, Json::parse_event_t, Json&)
  {
    isTooDeep = isTooDeep || depth > deepestJson;
    return !isTooDeep;
  };
  Json value = Json::parse(text, watch, false);
  if (value.is_discarded() || isTooDeep)
  {
    return std::nullopt;
  }
  return value;
}

std::string singleLine(const Json& value)
{
  if (!value.is_structured())
  {
    return dumped(value);
  }
  std::string text = value.is_array() ? "[" : "{";
  for (const auto& [name, part] : value.items())
  {
    text += text.size() > 1 ? ", " : "";
    text += (value.is_array() ? "" : dumped(Json(name)) + ": ") + singleLine(part);
  }
  return text + (value.is_array() ? "]" : "}");
}

} // namespace cactus
