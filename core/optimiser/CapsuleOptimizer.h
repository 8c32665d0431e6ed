// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Team.h"
#include "fibres/Fibres.h"
#include "fibres/ResampledFibres.h"
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
  Resampling resampling;         ///< of the fibres that came in
  double lengthIncrease = 0.0;   ///< by how much all fibres together have become longer, as a fraction of what came in
  std::string checkpointFailure; ///< why a checkpoint after the first could not be written; empty where all were
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

/// Moves control points (and, where allowed, radii) until no two capsules of different fibres penetrate by more than the
/// tolerance, or until iterations or time run out or they make no progress any more; then `fibres` holds the state with the
/// smallest cost of overlap. Where most control points lie nearly straight between their neighbours and radii are kept, every
/// second of these is moved alone at first, and the others with it (see CoarseFibres): rows tell of the overlap of those few
/// until all are moved. Fibres whose control points lie too densely are resampled first, see resampleDenseFibres(): their number
/// of control points changes, also for `observe`. End points slide in the plane across their bundle's axis. Same bits on any
/// number of threads. `observe`, where given, is called with each iteration's row and state, the first included. Throws
/// InvalidInput (fibres, options, a checkpoint of something else) and FileError (the checkpoint), OutOfMemory.
///
/// The processes of a team share the work: each moves some of the fibres and knows those of others that lie beside its own. All
/// are given the same fibres and options and end with the same result after the same iterations: it has the bits of a single
/// process. Any of them may stop the run; the first one has the clock and the checkpoint. Errors end all, see
/// Sharing::together(). If any process observes states, each iteration is gathered in all.
OptimisationResult optimise(Fibres& fibres, const CapsuleOptimizerOptions& options, const Context& context,
  const std::function<void(const ConvergenceRow&, const Fibres&)>& observe = {}, Team* team = nullptr);

} // namespace cactus
