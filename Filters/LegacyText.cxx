// SPDX-License-Identifier: BSD-3-Clause
#include "LegacyText.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace cactus
{

namespace
{

/// The reader's words have 255 characters.
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

} // namespace

std::string withoutKeywords(const std::string& json)
{
  constexpr char digits[] = "0123456789abcdef";
  const std::string_view all = json;
  std::string text;
  for (std::size_t begin = 0; begin < all.size();)
  {
    const std::size_t end = std::min(all.find(' ', begin), all.size());
    const std::size_t starts = end - begin > longestWord ? end : begin + 1; // where the reader may start a word
    for (std::size_t i = begin; i < end; ++i)
    {
      // No keyword starts with a letter that has an escape of its own.
      const bool isEscaped = i < starts && startsWithKeyword(all.substr(i));
      text += isEscaped ? std::string("\\u00") + digits[(all[i] >> 4) & 15] + digits[all[i] & 15] : std::string(1, all[i]);
    }
    text += end < all.size() ? " " : "";
    begin = end + 1;
  }
  return text;
}

} // namespace cactus
