// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "optimiser/CapsuleOptimizerOptions.h"
#include "optimiser/OptimisationRun.h"

#include <chrono>
#include <cstdint>
#include <string>

namespace cactus
{

/// The file in which a run is written down every now and then, and what was in it before. Where processes share the run, the
/// first has the file, and throws what is said here; all come to each call.
class OptimisationCheckpoints
{
public:
  /// Throws where the file is there and not a checkpoint of this run, and where it cannot be written.
  OptimisationCheckpoints(const Fibres& fibres, const CapsuleOptimizerOptions& options, const Sharing& sharing);

  /// Whether there was a checkpoint of this run.
  bool found() const { return this->Reached >= 0; }

  /// On which level the run was that is in it.
  OptimisationRun::Level level() const { return this->Level; }

  /// Precondition: the run is on that level.
  void load(OptimisationRun& run) const;

  bool due() const; ///< by the clock of the first process

  /// Writes the run down, unless what is there has come further (the same run, from the beginning once more). That a later
  /// checkpoint cannot be written is no reason to give up a long run: it is noted, see failure().
  void write(const OptimisationRun& run);

  /// Why the last checkpoint could not be written; empty where it could.
  const std::string& failure() const { return this->Failure; }

private:
  void requireAlike(const CapsuleOptimizerOptions& options) const;

  using Clock = std::chrono::steady_clock;

  const Sharing& Processes;
  std::string Path;
  double Interval;
  Clock::time_point Latest;
  std::uint64_t Print = 0;
  std::int64_t Reached = -1; ///< iteration of the checkpoint that was there; −1 for none
  OptimisationRun::Level Level = OptimisationRun::Fine;
  bool Written = false;
  std::string Failure;
};

} // namespace cactus
