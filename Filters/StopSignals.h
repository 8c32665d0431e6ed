// SPDX-License-Identifier: BSD-3-Clause
// Ctrl-C, kill and the end of a batch job while a filter is at work.
#pragma once

namespace cactus
{

/// While one lives, SIGINT and SIGTERM do not reach who waits for them, such as Python, which would hear of them only after
/// hours, or ParaView's log, which takes them for a crash: they are noted, for the work to end in good order. When the last one
/// goes, they are passed on: the process ends, unless somebody else waits for them. A second signal ends the process at once. The
/// log does not get them any more: where one rank has ended so, it would have the others, which MPI then ends, look like crashes.
class StopSignals
{
public:
  StopSignals();
  ~StopSignals();

  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// Whether such a signal has come, and is not passed on yet.
  static bool areCaught();
};

} // namespace cactus
