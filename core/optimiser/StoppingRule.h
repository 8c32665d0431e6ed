// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "optimiser/CapsuleOptimizerOptions.h"
#include "optimiser/ConvergenceRow.h"

#include <limits>
#include <optional>

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

/// When a descent last made progress: a cost, or a largest penetration, smaller by a hundredth than any before.
struct DescentProgress
{
  double lowestCost = std::numeric_limits<double>::infinity(); ///< at the last step forward
  double lowestPenetration = std::numeric_limits<double>::infinity();
  int lastIteration = 0; ///< that made any

  void note(const ConvergenceRow& row);
};

/// What a process has to say of its run while it goes on.
struct Moment
{
  double seconds = 0.0; ///< on the clock of its run
  bool wantsStop = false;
};

/// Why the state that was just measured is the last one; nothing where it is not.
std::optional<StopReason> reasonToStop(
  const ConvergenceRow& row, const DescentProgress& progress, const CapsuleOptimizerOptions& options, const Moment& moment);

/// How far a run has come, from 0 to 0.99: by its iterations or by the logarithm of the largest penetration, whichever is more.
double completedFraction(const ConvergenceRow& row, double firstPenetration, const CapsuleOptimizerOptions& options);

} // namespace cactus
