// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: the most recently used entries are kept, and no more than the limit.
#include "base/RecentThings.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>

namespace
{

using cactus::RecentThings;

TEST(RecentThings, KeepsThoseUsedLast)
{
  RecentThings<int> things(2);
  for (const int key : { 1, 2 })
  {
    things.keep(std::uint64_t(key), std::make_shared<int>(key));
  }
  EXPECT_EQ(*things.find(1), 1);
  things.keep(3, std::make_shared<int>(3)); // 2 was used before 1
  EXPECT_EQ(things.find(2), nullptr);
  EXPECT_EQ(*things.find(1), 1);
  EXPECT_EQ(*things.find(3), 3);
  things.keep(3, std::make_shared<int>(4));
  EXPECT_EQ(*things.find(3), 3);
}

} // namespace
