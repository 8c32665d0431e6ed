// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Checkpoint.h"
#include "optimiser/CapsuleOptimizerOptions.h"
#include "optimiser/OptimisationRun.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace cactus
{

/// The checkpoint file of a run. If processes share the run, the first has the file and throws its errors; all calls are
/// collective.
class OptimisationCheckpoints
{
public:
  /// Throws if the file exists and is not a checkpoint of this run, or if it cannot be written.
  OptimisationCheckpoints(const Fibres& fibres, const CapsuleOptimizerOptions& options, const Sharing& sharing);

  /// Tells whether there was a checkpoint of this run.
  bool found() const { return this->Reached >= 0; }

  /// Returns the level of the run in the checkpoint.
  OptimisationRun::Level level() const { return this->Level; }

  /// Loads the checkpoint that was found. Precondition: the run is to go on from it. Throws FileError if it is on another level.
  void load(OptimisationRun& run);

  bool due() const; ///< by the clock of the first process

  /// Writes the run, unless the existing checkpoint has come further (the same run, once more from the beginning). If a later
  /// checkpoint cannot be written, a long run continues; see failure().
  void write(const OptimisationRun& run);

  /// Returns why the last checkpoint could not be written; empty on success.
  const std::string& failure() const { return this->Failure; }

private:
  using Clock = std::chrono::steady_clock;

  const Sharing& Processes;
  std::string Path;
  double Interval;
  Clock::time_point Latest;
  std::uint64_t Print = 0;
  std::optional<CheckpointReader> File; ///< what was found, until a run is loaded from it
  int Reached = -1;                     ///< iteration of the checkpoint that was found; −1 for none
  OptimisationRun::Level Level = OptimisationRun::Fine;
  bool Written = false;
  std::string Failure;
};

} // namespace cactus
