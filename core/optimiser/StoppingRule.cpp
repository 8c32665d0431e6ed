// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/StoppingRule.h"

#include <algorithm>
#include <cmath>

namespace cactus
{

namespace
{

/// The least progress that counts, and the iterations that a descent may go on without it.
constexpr double progressShare = 0.01;
constexpr int stagnationIterations = 200;

} // namespace

void DescentProgress::note(const ConvergenceRow& row)
{
  constexpr double share = 1.0 - progressShare;
  if (row.overlapCost < share * this->lowestCost || row.maximumPenetration < share * this->lowestPenetration)
  {
    this->lastIteration = row.iteration;
    this->lowestCost = std::min(this->lowestCost, row.overlapCost);
    this->lowestPenetration = std::min(this->lowestPenetration, row.maximumPenetration);
  }
}

std::optional<StopReason> reasonToStop(
  const ConvergenceRow& row, const DescentProgress& progress, const CapsuleOptimizerOptions& options, const Moment& moment)
{
  if (row.maximumPenetration <= options.overlapTolerance)
  {
    return StopReason::Converged;
  }
  if (row.iteration >= options.maximumIterations)
  {
    return StopReason::MaximumIterations;
  }
  if (row.iteration - progress.lastIteration >= stagnationIterations)
  {
    return StopReason::Stagnated;
  }
  if (moment.wantsStop)
  {
    return StopReason::Stopped;
  }
  if (options.timeBudget > 0.0 && moment.seconds >= options.timeBudget)
  {
    return StopReason::TimeBudget;
  }
  return std::nullopt;
}

double completedFraction(const ConvergenceRow& row, double firstPenetration, const CapsuleOptimizerOptions& options)
{
  const double byIterations = double(row.iteration) / std::max(1, options.maximumIterations);
  const double toGo = std::log(std::max(row.maximumPenetration / options.overlapTolerance, 1.0));
  const double all = std::log(std::max(firstPenetration / options.overlapTolerance, 2.0));
  return std::clamp(std::max(byIterations, 1.0 - toGo / all), 0.0, 0.99);
}

} // namespace cactus
