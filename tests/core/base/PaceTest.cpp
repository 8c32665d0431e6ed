// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: the pace is that since the beginning, whatever had been done before, and is told once it is known.
#include "base/Pace.h"

#include <gtest/gtest.h>

namespace
{

TEST(Pace, CountsFromWhereItBegan)
{
  cactus::Pace pace;
  EXPECT_EQ(pace.at(1000.0, 0.5), "");
  EXPECT_EQ(pace.at(1009.0, 0.6), "");
  EXPECT_EQ(pace.at(1020.0, 0.5005), "");
  EXPECT_EQ(pace.at(4600.0, 0.6), "10 % an hour, ready in about 4 h 0 min");
  EXPECT_EQ(pace.at(8200.0, 0.98), "24 % an hour, ready in about 5 min");
}

} // namespace
