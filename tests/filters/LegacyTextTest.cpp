// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: VTK's reader of legacy image files finds none of its keywords in JSON that is stored as field data.
#include "LegacyText.h"
#include "base/JsonText.h"

#include <gtest/gtest.h>

#include <cctype>
#include <string>
#include <vector>

namespace
{

using cactus::Json;

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

Json example()
{
  Json value;
  value["SpacingFactor"] = 1.25;
  value["origin"] = "Spacing and ORIGIN, extent\tand \"dimensions\" \\origin";
  value["path"] = "/data/my spacing/" + std::string(180, 'x') + "/spacing/of/" + std::string(300, 'y') + "/ExtentOrigin";
  value["numbers"] = std::vector<double>(400, 0.1);
  value["nested"] = { { "a", nullptr }, { "b", true }, { "c", Json::array() }, { "d", Json::object() } };
  value["name"] = "Größe µm";
  return value;
}

TEST(LegacyText, HoldsNoKeywordOfLegacyFiles)
{
  const std::string line = cactus::withoutKeywords(cactus::singleLine(example()));
  EXPECT_TRUE(hasKeyword("a Spacing"));
  EXPECT_TRUE(hasKeyword(example().dump())) << "as it would be on its own";
  EXPECT_FALSE(hasKeyword(line));
  EXPECT_EQ(cactus::parsedJson(line), example());
  EXPECT_NE(line.find("\"SpacingFactor\": 1.25"), std::string::npos) << "what people look for is written plainly";
  // Each text of a binary file follows its length, and the one before.
  EXPECT_FALSE(hasKeyword(cactus::singleLine(Json::object({ { "id", 1 } })) + "xx" + line));
}

} // namespace
