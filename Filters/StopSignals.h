// SPDX-License-Identifier: BSD-3-Clause
// Handling of Ctrl-C, kill and the end of a batch job while a filter runs.
#pragma once

namespace cactus
{

/// While an object of this class exists, SIGINT and SIGTERM are only recorded, so that the work can end in good order; Python
/// would see them only after hours, and ParaView's log takes them for a crash. When the last object is destroyed, they are passed
/// on: the process ends, unless another handler exists. A second signal ends the process at once. The log no longer gets them:
/// otherwise, after one rank has ended like this, the other ranks, which MPI then ends, would look like crashes.
class StopSignals
{
public:
  StopSignals();
  ~StopSignals();

  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// Tells whether such a signal has arrived and is not passed on yet.
  static bool areCaught();
};

} // namespace cactus
