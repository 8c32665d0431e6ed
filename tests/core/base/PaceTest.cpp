// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: the reported speed is that of the last minutes, whatever was done before and however long it stood still. It is
// reported once it is known, in numbers of two digits; a line of progress is one line.
#include "base/Pace.h"

#include <gtest/gtest.h>

namespace
{

TEST(Pace, CountsFromWhereItBegan)
{
  cactus::Pace pace;
  EXPECT_EQ(pace.at(1000.0, 0.5, "a"), "");
  EXPECT_EQ(pace.at(1009.0, 0.6, "a"), "");
  EXPECT_EQ(pace.at(1020.0, 0.5005, "a"), "");
  EXPECT_EQ(pace.at(1360.0, 0.51, "a"), "10 % an hour, ready in about 4 h 54 min");
  EXPECT_EQ(pace.at(1540.0, 0.98, "a"), "5.3 % a minute, ready in about 1 min");
}

TEST(Pace, IsThatOfThePartAtWork)
{
  cactus::Pace pace;
  EXPECT_EQ(pace.at(0.0, 0.3, "looking"), "");
  EXPECT_EQ(pace.at(360.0, 0.31, "looking"), "10 % an hour, ready in about 6 h 54 min");
  EXPECT_EQ(pace.at(361.0, 0.4, "making"), "") << "what an earlier run had made";
  EXPECT_EQ(pace.at(721.0, 0.42, "making"), "20 % an hour, ready in about 2 h 54 min");
}

TEST(Pace, IsNotToldOfTheShortPartsAtTheBeginning)
{
  cactus::Pace pace;
  EXPECT_EQ(pace.at(0.0, 0.0, "looking"), "");
  EXPECT_EQ(pace.at(360.0, 0.01, "looking"), "") << "which would be 9 h 54 min";
  EXPECT_EQ(pace.at(370.0, 0.035, "making"), "");
  EXPECT_EQ(pace.at(730.0, 0.045, "making"), "10 % an hour, ready in about 9 h 33 min");
}

TEST(Pace, ForgetsThatItStoodStill)
{
  cactus::Pace pace;
  double fraction = 0.1;
  double seconds = 0.0;
  const auto goOn = [&](double until)
  {
    std::string told;
    for (; seconds < until; seconds += 30.0)
    {
      told = pace.at(seconds, fraction += 30.0 / 36000.0, "making");
    }
    return told;
  };
  EXPECT_EQ(goOn(3600.0).substr(0, 12), "10 % an hour");
  seconds += 20000.0;
  EXPECT_NE(goOn(seconds + 60.0).substr(0, 12), "10 % an hour");
  EXPECT_EQ(goOn(seconds + 1300.0).substr(0, 12), "10 % an hour");
}

TEST(Pace, IsToldInMinutesOfShortWorkAndNotAtAllOfShorter)
{
  cactus::Pace pace;
  EXPECT_EQ(pace.at(0.0, 0.0, ""), "");
  EXPECT_EQ(pace.at(600.0, 0.165, ""), "99 % an hour, ready in about 51 min");
  EXPECT_EQ(pace.at(600.0, 0.17, ""), "1.7 % a minute, ready in about 49 min");
  EXPECT_EQ(pace.at(60.0, 0.1, ""), "10 % a minute, ready in about 9 min");
  EXPECT_EQ(pace.at(30.0, 0.75, ""), "ready in about 1 min");
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
