// SPDX-License-Identifier: BSD-3-Clause
// How far long work is, and how fast it goes, in words.
#pragma once

#include <string>

namespace cactus
{

/// How fast it goes: "4.2 % an hour, ready in about 12 h 30 min", "2.5 % a minute, ready in about 30 min".
class Pace
{
public:
  /// At `seconds` of some clock, `fraction` of the work is done. Empty for as long as too little is known: in the first ten
  /// seconds, and before the first thousandth.
  std::string at(double seconds, double fraction);

private:
  bool IsBegun = false;
  double FirstSeconds = 0.0;
  double FirstFraction = 0.0;
};

/// How far it is, in a line: " 34 %  making surfaces".
std::string progressLine(double fraction, const std::string& message);

} // namespace cactus
