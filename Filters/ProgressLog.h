// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>

namespace cactus
{

/// What the log of a job, or who waits in a terminal, sees of long work: a line of progress now and then on standard error, from
/// the first rank.
class ProgressLog
{
public:
  /// who: what lines begin with. Throws InvalidInput where the environment variable CACTUS_PROGRESS, seconds between two lines,
  /// holds no whole number of progressPauses; usualProgressPause where it is not set. The first rank alone reads it.
  explicit ProgressLog(std::string who);

  /// "WHO:  34 %  message", if the last line, or the beginning, is as long ago.
  void tell(double fraction, const std::string& message);

private:
  std::string Who;
  std::chrono::seconds Pause; ///< 0: no lines
  std::chrono::steady_clock::time_point LastTime;
};

} // namespace cactus
