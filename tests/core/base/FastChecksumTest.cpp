// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: data that differ in any byte, or in length, have different checksums.
#include "base/FastChecksum.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace
{

std::string checksum(const std::string& data)
{
  cactus::FastChecksum sum;
  sum.add(data.data(), data.size());
  return sum.digest();
}

TEST(FastChecksum, TellsEveryByteAndLength)
{
  std::set<std::string> seen;
  std::size_t count = 0;
  for (std::size_t size = 0; size < 100; ++size)
  {
    const std::string zeros(size, '\0');
    seen.insert(checksum(zeros));
    ++count;
    for (std::size_t i = 0; i < size; ++i)
    {
      for (const char bit : { '\x01', '\x40', '\x80' })
      {
        std::string changed = zeros;
        changed[i] = bit;
        seen.insert(checksum(changed));
        ++count;
      }
    }
  }
  EXPECT_EQ(seen.size(), count);
  EXPECT_EQ(checksum("cactus").size(), 16u);
}

TEST(FastChecksum, StaysTheSame)
{
  // Manifests hold such checksums: a change here needs another name there.
  EXPECT_EQ(checksum("synthetic white matter, made of fibres that keep apart"), "19d898c3105e0795");
}

} // namespace
