// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "fibres/Fibres.h"
#include "optimiser/CapsuleOptimizerOptions.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace cactus
{

/// One row of the convergence table, measured at the start of an iteration.
struct ConvergenceRow
{
  int iteration = 0;
  double overlapCost = 0.0;
  double maximumPenetration = 0.0;
  std::size_t overlappingPairs = 0;
  double curvatureCost = 0.0;
  double lengthCost = 0.0;
  double radiusCost = 0.0;
  double compactnessCost = 0.0;
  double seconds = 0.0;
};

/// Why the descent ended.
enum class StopReason
{
  Converged,
  MaximumIterations,
  Stagnated, ///< neither cost nor largest penetration fell any more
  TimeBudget,
  Stopped
};

struct OptimisationResult
{
  StopReason reason = StopReason::Converged;
  std::string checkpointFailure; ///< why a checkpoint after the first could not be written; empty where all were
  std::vector<ConvergenceRow> convergence;
  /// Of the fibres handed back, measured afresh over all neighbours.
  double maximumPenetration = 0.0;
  std::size_t overlappingPairs = 0; ///< above the tolerance
  std::vector<double> overlap;      ///< per control point, largest D there
  /// What the descent did: pairs of capsules evaluated (each counted from both sides), neighbour searches, and seconds in each.
  double pairEvaluations = 0.0;
  int neighbourSearches = 0;
  double evaluationSeconds = 0.0;
  double searchSeconds = 0.0;
};

/// Moves control points (and, where allowed, radii) until no two capsules of different fibres penetrate by more than the
/// tolerance, or until iterations, time or patience run out; then `fibres` holds the state with the smallest largest penetration.
/// End points slide in the plane across their bundle's axis. Same bits on any number of threads. `observe`, where given, is
/// called with each iteration's state, the first included. Throws InvalidInput (fibres, options, a checkpoint of something else)
/// and FileError (the checkpoint), OutOfMemory.
OptimisationResult optimise(Fibres& fibres, const CapsuleOptimizerOptions& options, const Context& context,
  const std::function<void(int iteration, const Fibres&)>& observe = {});

} // namespace cactus
