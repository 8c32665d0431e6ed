// SPDX-License-Identifier: BSD-3-Clause
// The progress and speed of long work, in words.
#pragma once

#include <optional>
#include <string>

namespace cactus
{

/// The speed of long work: "4.2 % an hour, ready in about 12 h 30 min", "2.5 % a minute, ready in about 30 min".
class Pace
{
public:
  /// Returns the speed when, at `seconds` of some clock, `fraction` of all the work is done and `part` is running. It is measured
  /// over the last ten to twenty minutes of that part: other parts have another speed, as have a paused job and work that an
  /// earlier run had done. Empty while too little is known: in the first ten seconds of a part, before a thousandth of all the
  /// work is done in it, and in the first 4 % of all the work.
  std::string at(double seconds, double fraction, const std::string& part);

private:
  struct Moment
  {
    double seconds;
    double fraction;
  };

  std::string Part;
  std::optional<Moment> First; ///< the start of the measured interval
  Moment Next{};               ///< the start of the next interval
};

/// Returns the progress as one line: " 34 %  making surfaces".
std::string progressLine(double fraction, const std::string& message);

} // namespace cactus
