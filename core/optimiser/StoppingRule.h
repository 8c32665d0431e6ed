// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "optimiser/CapsuleOptimizerOptions.h"
#include "optimiser/ConvergenceRow.h"

#include <limits>
#include <optional>
#include <tuple>

namespace cactus
{

/// Why the descent ended.
enum class StopReason
{
  Converged,
  MaximumIterations,
  Stagnated, ///< neither cost nor largest penetration fell any more
  TimeBudget,
  Stopped
};

/// The last progress of a descent: a cost, or a largest penetration, smaller by a hundredth than any before.
struct DescentProgress
{
  double lowestCost = std::numeric_limits<double>::infinity(); ///< at the last progress
  double lowestPenetration = std::numeric_limits<double>::infinity();
  int lastIteration = 0; ///< of the last progress

  void note(const ConvergenceRow& row);
};

inline auto membersOf(DescentProgress& progress)
{
  return std::tie(progress.lowestCost, progress.lowestPenetration, progress.lastIteration);
}

/// A process's report during its run.
struct Moment
{
  double seconds = 0.0; ///< on the clock of its run
  bool wantsStop = false;
};

inline auto membersOf(Moment& moment)
{
  return std::tie(moment.seconds, moment.wantsStop);
}

/// Returns why the state that was just measured is the last one; nothing if the descent continues.
std::optional<StopReason> reasonToStop(
  const ConvergenceRow& row, const DescentProgress& progress, const CapsuleOptimizerOptions& options, const Moment& moment);

/// Returns the progress of a run, from 0 to 0.99: by its iterations or by the logarithm of the largest penetration, whichever is
/// more.
double completedFraction(const ConvergenceRow& row, double firstPenetration, const CapsuleOptimizerOptions& options);

} // namespace cactus
