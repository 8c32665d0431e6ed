// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: the pace is that since the beginning, whatever had been done before, and is told once it is known, in numbers of two
// digits; a line of progress is one line.
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

TEST(Pace, IsToldInMinutesOfShortWorkAndNotAtAllOfShorter)
{
  cactus::Pace pace;
  EXPECT_EQ(pace.at(0.0, 0.0), "");
  EXPECT_EQ(pace.at(3600.0, 0.99), "99 % an hour, ready in about 1 min");
  EXPECT_EQ(pace.at(3600.0, 0.996), "1.7 % a minute, ready in about 1 min");
  EXPECT_EQ(pace.at(60.0, 0.1), "10 % a minute, ready in about 9 min");
  EXPECT_EQ(pace.at(30.0, 0.75), "ready in about 1 min");
}

TEST(Pace, HasOneLineForHowFarItIs)
{
  EXPECT_EQ(cactus::progressLine(0.0, "looking"), "  0 %  looking");
  EXPECT_EQ(cactus::progressLine(0.3499, "making a\tb\r\n\033[2Jc\177"), " 34 %  making a b   [2Jc ");
  EXPECT_EQ(cactus::progressLine(1.0, "µm"), "100 %  µm");
  EXPECT_EQ(cactus::progressLine(7.0, ""), "100 %  ");
  EXPECT_EQ(cactus::progressLine(-1.0, ""), "  0 %  ");
}

} // namespace
