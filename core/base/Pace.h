// SPDX-License-Identifier: BSD-3-Clause
// How far long work is, and how fast it goes, in words.
#pragma once

#include <optional>
#include <string>

namespace cactus
{

/// How fast it goes: "4.2 % an hour, ready in about 12 h 30 min", "2.5 % a minute, ready in about 30 min".
class Pace
{
public:
  /// At `seconds` of some clock, `fraction` of all the work is done, and `part` is at work: by the last ten to twenty minutes of
  /// that, since others go at another pace, and so does a job that was paused, or what an earlier run had done already. Empty for
  /// as long as too little is known: in the first ten seconds of a part, and before its first thousandth of all.
  std::string at(double seconds, double fraction, const std::string& part);

private:
  struct Moment
  {
    double seconds;
    double fraction;
  };

  std::string Part;
  std::optional<Moment> First; ///< by which it is told
  Moment Next{};               ///< by which it will be
};

/// How far it is, in a line: " 34 %  making surfaces".
std::string progressLine(double fraction, const std::string& message);

} // namespace cactus
