// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Team.h"
#include "fibres/Fibres.h"
#include "optimiser/CapsuleOptimizerOptions.h"
#include "optimiser/ConvergenceRow.h"
#include "optimiser/StoppingRule.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace cactus
{

struct OptimisationResult
{
  StopReason reason = StopReason::Converged;
  std::string checkpointFailure; ///< why a checkpoint after the first could not be written; empty if all were
  std::vector<ConvergenceRow> convergence;
  /// For the returned fibres, measured afresh over all neighbours.
  double maximumPenetration = 0.0;
  std::size_t overlappingPairs = 0; ///< above the tolerance
  std::vector<double> overlap;      ///< per control point, largest D there
  /// Effort of the descent: pairs of capsules evaluated (each counted from both sides), neighbour searches, and seconds in each.
  double pairEvaluations = 0.0;
  int neighbourSearches = 0;
  double evaluationSeconds = 0.0;
  double searchSeconds = 0.0;
};

/// Moves control points (and, if allowed, radii) until no two capsules of different fibres penetrate by more than the tolerance,
/// or until iterations or time run out or there is no more progress; in the latter cases `fibres` receives the state with the
/// smallest overlap cost. If most control points lie nearly straight between their neighbours and radii are kept, at first only
/// every second of these moves and takes the others along (see CoarseFibres); rows then count the overlap of these few until all
/// move. End points slide in the plane across their bundle's axis. Gives the same bits on any number of threads. `observe`, if
/// given, is called with each iteration's row and state, the first included. Throws InvalidInput (fibres, options, a checkpoint
/// of another run), FileError (the checkpoint) and OutOfMemory.
///
/// The processes of a team share the work: each moves some of the fibres and knows those of others that lie beside its own. All
/// are given the same fibres and options and end with the same result after the same iterations: it has the bits of a single
/// process. Any of them may stop the run; the first one has the clock and the checkpoint. Errors end all, see
/// Sharing::together(). If any process observes states, each iteration is gathered in all.
OptimisationResult optimise(Fibres& fibres, const CapsuleOptimizerOptions& options, const Context& context,
  const std::function<void(const ConvergenceRow&, const Fibres&)>& observe = {}, Team* team = nullptr);

} // namespace cactus
