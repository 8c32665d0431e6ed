// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "fibres/Fibres.h"
#include "optimiser/FibreCosts.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace cactus
{

/// How the descent turns gradients into steps.
enum class DescentMethod
{
  Momentum = 0, ///< heavy ball, preconditioned with the diagonal of the Gauss–Newton Hessian
  Adagrad = 1   ///< Duchi et al. 2011, as in the paper
};

/// Parameters of the joint fibre optimisation (paper, "Joint fibre optimisation").
struct CapsuleOptimizerOptions
{
  int maximumIterations = 3000;
  /// Largest relative penetration D = 1 − d/(rp + rq) that may remain between capsules of different fibres.
  double overlapTolerance = 1e-3;
  DescentMethod method = DescentMethod::Momentum;
  /// Weights of the cost terms, by priority: overlap first.
  double overlapWeight = 1.0;
  FibreCostWeights weights;
  /// Momentum: fraction of the Newton step along each coordinate; above 1.9 contacts swing up. Adagrad: first step in µm.
  double stepSize = 1.7;
  /// Part of the last step that the next one carries on (Momentum only), in [0, 1).
  double momentum = 0.95;
  /// Stiffness, relative to that of a contact, of the thread that spreads a step along its fibre (Momentum only): fibres then
  /// move as a whole instead of kinking control point by control point. 0 for none.
  double smoothing = 5.0;
  /// Curvature, length and compactness fade by this factor in every iteration (Momentum only), so that at first they shape the
  /// fibres and at last cannot hold an overlap open; 1 keeps them.
  double relaxation = 0.96;
  /// A bundle whose overlapping fibres would fill more than this of its cuboid is widened so far (where compactness has a
  /// weight).
  double packingLimit = 0.70;
  /// The overlap cost acts as if capsules were thicker by this factor, so that the descent ends strictly apart.
  double safetyMargin = 1.01;
  /// Largest change of a radius, as a fraction of the radius that came in; 0 keeps radii as they are.
  double radiusTolerance = 0.0;
  /// Stop after this many seconds and keep the best state; 0 for no limit.
  double timeBudget = 0.0;
  /// Where to write down the state of the run every now and then, and when it ends; empty for nowhere. A file that is there must
  /// be a checkpoint of this run (see resume): anything else is kept, and refused before the run begins.
  std::string checkpointFile;
  /// Seconds between two checkpoints at least; 0 for one at every neighbour search.
  double checkpointInterval = 600.0;
  /// Go on from checkpointFile where there is one. It must have been written for the same fibres and the same parameters, but for
  /// maximumIterations and timeBudget. The result has the same bits as that of a run that was never interrupted. Where it is off,
  /// the run starts from the beginning, and replaces its own checkpoint from before once it has come as far.
  bool resume = false;
};

/// Throws InvalidInput naming the property that is out of range.
void validate(const CapsuleOptimizerOptions& options);

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
