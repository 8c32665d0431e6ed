// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: JSON on a line reads back unchanged.
#include "base/JsonText.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace
{

using cactus::Json;

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

TEST(JsonText, ReadsBackAsItWas)
{
  const std::string line = cactus::singleLine(example());
  EXPECT_EQ(line.find('\n'), std::string::npos);
  EXPECT_EQ(cactus::parsedJson(line), example());
  EXPECT_NE(line.find("\"SpacingFactor\": 1.25"), std::string::npos) << "what people look for is written plainly";
}

TEST(JsonText, RefusesWhatIsNoneOfOurs)
{
  for (const std::string& text : { std::string(), std::string("BundleInitializer 0.1.0: Side=5"), std::string("{\"a\": "),
         std::string(300, '[') + std::string(300, ']'), std::string(100000, '[') })
  {
    EXPECT_FALSE(cactus::parsedJson(text)) << text.substr(0, 40);
  }
  EXPECT_NE(cactus::singleLine(Json("\xff")).size(), 0u);
}

} // namespace
