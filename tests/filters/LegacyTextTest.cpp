// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: VTK's reader of legacy image files finds none of its keywords in JSON that is stored as field data.
#include "LegacyText.h"

#include <gtest/gtest.h>

#include <cctype>
#include <string>

namespace
{

/// Tells whether that reader takes a word of the text for a keyword: it reads up to white space, but at most 255 characters.
bool hasKeyword(const std::string& text)
{
  std::size_t i = 0;
  while (i < text.size())
  {
    if (std::isspace(static_cast<unsigned char>(text[i])) != 0)
    {
      ++i;
      continue;
    }
    std::string word;
    for (; i < text.size() && word.size() < 255 && std::isspace(static_cast<unsigned char>(text[i])) == 0; ++i)
    {
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(text[i])));
    }
    for (const char* keyword : { "dimensions", "extent", "aspect_ratio", "spacing", "origin", "point_data" })
    {
      if (word.rfind(keyword, 0) == 0)
      {
        return true;
      }
    }
  }
  return false;
}

/// Returns a line of JSON with all keywords, within texts and long words, and as names.
std::string example()
{
  return "{\"SpacingFactor\": 1.25, \"origin\": \"Spacing and ORIGIN, extent\\tand \\\"dimensions\\\" \\\\origin\", "
         "\"path\": \"/data/my spacing/" +
         std::string(180, 'x') + "/spacing/of/" + std::string(300, 'y') +
         "/ExtentOrigin\", \"numbers\": [0.1, 0.1], \"nested\": {\"a\": null, \"b\": true}}";
}

/// Returns a text in which the escapes of letters are letters again.
std::string unescaped(std::string text)
{
  for (std::size_t at = text.find("\\u00"); at != std::string::npos; at = text.find("\\u00", at))
  {
    text.replace(at, 6, 1, static_cast<char>(std::stoi(text.substr(at + 4, 2), nullptr, 16)));
  }
  return text;
}

TEST(LegacyText, HoldsNoKeywordOfLegacyFiles)
{
  const std::string line = cactus::withoutKeywords(example());
  EXPECT_TRUE(hasKeyword("a Spacing"));
  EXPECT_TRUE(hasKeyword(example())) << "as it would be on its own";
  EXPECT_FALSE(hasKeyword(line));
  EXPECT_EQ(unescaped(line), example());
  EXPECT_NE(line.find("\"SpacingFactor\": 1.25"), std::string::npos) << "what people look for is written plainly";
  // Each text of a binary file follows its length, and the one before.
  EXPECT_FALSE(hasKeyword("{\"id\": 1}xx" + line));
}

} // namespace
