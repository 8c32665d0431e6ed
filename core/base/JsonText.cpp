// SPDX-License-Identifier: BSD-3-Clause
#include "base/JsonText.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace cactus
{

namespace
{

/// The reader's words have 255 characters, and punctuation counts.
constexpr std::size_t longestWord = 200;
constexpr std::array<std::string_view, 6> keywords{ { "dimensions", "extent", "aspect_ratio", "spacing", "origin",
  "point_data" } };

bool startsWithKeyword(std::string_view text)
{
  return std::any_of(keywords.begin(), keywords.end(),
    [text](std::string_view keyword)
    {
      return text.size() >= keyword.size() && std::equal(keyword.begin(), keyword.end(), text.begin(),
                                                [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
    });
}

/// Returns a quoted text in which the reader finds no keyword.
std::string quoted(const Json& value)
{
  const std::string plain = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  const bool isLong = plain.size() > longestWord;
  constexpr char digits[] = "0123456789abcdef";
  std::string text;
  for (std::size_t i = 0; i < plain.size(); ++i)
  {
    const bool canStartWord = isLong || (i > 0 && plain[i - 1] == ' ');
    if (canStartWord && startsWithKeyword(std::string_view(plain).substr(i)))
    {
      // No keyword starts with a letter that has an escape of its own.
      text += std::string("\\u00") + digits[(plain[i] >> 4) & 15] + digits[plain[i] & 15];
      continue;
    }
    text += plain[i];
  }
  return text;
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
  if (value.is_string())
  {
    return quoted(value);
  }
  if (!value.is_structured())
  {
    return value.dump();
  }
  std::string text = value.is_array() ? "[" : "{";
  for (const auto& [name, part] : value.items())
  {
    text += text.size() > 1 ? ", " : "";
    text += (value.is_array() ? "" : quoted(Json(name)) + ": ") + singleLine(part);
  }
  return text + (value.is_array() ? "]" : "}");
}

} // namespace cactus
