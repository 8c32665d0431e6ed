// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Properties.h"
#include "optimiser/FibreCosts.h"

#include <string>

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
  /// fibres and at last cannot hold an overlap open; 1 keeps them. By its 2.5th power once fewer pairs overlap than a twentieth
  /// of the capsules.
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
  /// Seconds between two checkpoints at least; 0 for one at every iteration.
  double checkpointInterval = 600.0;
  /// Go on from checkpointFile where there is one. It must have been written for the same fibres and the same parameters, but for
  /// maximumIterations and timeBudget. The result has the same bits as that of a run that was never interrupted. Where it is off,
  /// the run starts from the beginning, and replaces its own checkpoint from before once it has come as far.
  bool resume = false;

  static const PropertyList<CapsuleOptimizerOptions>& properties();
};

/// Throws InvalidInput naming the property that is out of range.
void validate(const CapsuleOptimizerOptions& options);

} // namespace cactus
