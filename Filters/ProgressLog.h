// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <string>

namespace cactus
{

/// Prints a line of progress at intervals on standard error, for the log of a job or a terminal; on the first rank only.
class ProgressLog
{
public:
  /// who: the beginning of each line. The environment variable CACTUS_PROGRESS holds the seconds between two lines; throws
  /// InvalidInput if it is no whole number in progressPauses, and uses usualProgressPause if it is not set. Only the first rank
  /// reads it.
  explicit ProgressLog(std::string who);

  /// Prints "WHO:  34 %  message", if the last line, or the beginning, is long enough ago.
  void tell(double fraction, const std::string& message);

private:
  std::string Who;
  std::chrono::seconds Pause; ///< 0: no lines
  std::chrono::steady_clock::time_point LastTime;
};

} // namespace cactus
