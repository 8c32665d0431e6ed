// SPDX-License-Identifier: BSD-3-Clause
// Guarantees: values are read back from their bytes with the same bits, whatever they consist of; missing bytes are told.
#include "base/Bytes.h"

#include "base/Error.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace
{

using namespace cactus;

enum class KeptColour
{
  Red,
  Green
};

struct KeptPart
{
  double number = 0.0;
  KeptColour colour = KeptColour::Red;
  std::vector<std::string> words;
  int left = 7; ///< is not kept
};

auto membersOf(KeptPart& part)
{
  return std::tie(part.number, part.colour, part.words);
}

struct KeptWhole
{
  std::map<std::int32_t, KeptPart> parts;
  std::array<std::uint8_t, 3> ends{ {} };
  std::vector<Eigen::Vector3d> points;
  bool isGood = false;
};

auto membersOf(KeptWhole& whole)
{
  return std::tie(whole.parts, whole.ends, whole.points, whole.isGood);
}

TEST(Bytes, ComeBackAsTheyWere)
{
  ByteWriter put;
  put(std::int8_t(-3));
  put(std::numeric_limits<double>::denorm_min());
  put(std::string("a\0b", 3));
  put(std::vector<float>{ 1.5F, -0.0F });
  const std::string bytes = put.bytes();
  ByteReader get(bytes);
  EXPECT_EQ(get.get<std::int8_t>(), -3);
  EXPECT_EQ(get.get<double>(), std::numeric_limits<double>::denorm_min());
  EXPECT_EQ(get.get<std::string>(), std::string("a\0b", 3));
  std::vector<float> numbers;
  get(numbers);
  EXPECT_EQ(numbers, (std::vector<float>{ 1.5F, -0.0F }));
  EXPECT_TRUE(get.isAtEnd());
  // A truncated message is detected anywhere: also a count beyond the memory.
  for (std::size_t size = 0; size < bytes.size(); ++size)
  {
    const std::string cut = bytes.substr(0, size);
    ByteReader from(cut);
    const auto all = [&]
    {
      from.get<std::int8_t>();
      from.get<double>();
      from.get<std::string>();
      from(numbers);
    };
    EXPECT_THROW(all(), FileError) << size;
  }
}

TEST(Bytes, HoldWhatConsistsOfSuchValues)
{
  KeptWhole whole;
  whole.parts[-3] = { -0.0, KeptColour::Green, { "one", "", std::string("\0a", 2) }, 8 };
  whole.parts[5].number = std::numeric_limits<double>::quiet_NaN();
  whole.ends = { { 1, 2, 255 } };
  whole.points = { { 0.1, 1e-320, -5.0 }, { 1.0, 2.0, 3.0 } };
  whole.isGood = true;
  const std::string bytes = bytesOf(whole, 0.25F);
  KeptWhole found;
  found.parts[9].number = 1.0; // is no more
  float more = 0.0F;
  getAll(bytes, found, more);
  ASSERT_EQ(found.parts.size(), 2u);
  const KeptPart& first = found.parts.at(-3);
  EXPECT_TRUE(first.number == 0.0 && std::signbit(first.number));
  EXPECT_EQ(first.colour, KeptColour::Green);
  EXPECT_EQ(first.words, whole.parts.at(-3).words);
  EXPECT_EQ(first.left, 7);
  EXPECT_TRUE(std::isnan(found.parts.at(5).number));
  EXPECT_EQ(found.ends, whole.ends);
  EXPECT_EQ(found.points, whole.points);
  EXPECT_TRUE(found.isGood);
  EXPECT_EQ(more, 0.25F);
  EXPECT_EQ(bytesOf(found, more), bytes);
  for (std::size_t length = 0; length < bytes.size(); ++length)
  {
    EXPECT_THROW(getAll(bytes.substr(0, length), found, more), FileError) << length;
  }
}

} // namespace
