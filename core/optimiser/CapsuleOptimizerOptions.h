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
  /// Momentum: fraction of the Newton step along each coordinate; above 1.9 contacts swing up; shorter by the
  /// factor 0.6 once few pairs overlap. Adagrad: first step in µm.
  double stepSize = 1.7;
  /// Fraction of the last step that is added to the next one (Momentum only), in [0, 1).
  double momentum = 0.95;
  /// Stiffness, relative to that of a contact, of the thread that spreads a step along its fibre (Momentum only): fibres then
  /// move as a whole instead of kinking at single control points. 0 for none.
  double smoothing = 5.0;
  /// Curvature, length and compactness are multiplied by this factor in every iteration (Momentum only), so that they shape the
  /// fibres at first and cannot hold an overlap open at the end; 1 keeps them. The factor is raised to the power 2.5 once fewer
  /// pairs overlap than a twentieth of the capsules.
  double relaxation = 0.96;
  /// A bundle whose overlapping fibres would fill more than this fraction of its cuboid is widened to it (if compactness has a
  /// weight).
  double packingLimit = 0.70;
  /// The overlap cost treats capsules as thicker by this factor, so that the descent ends strictly apart.
  double safetyMargin = 1.01;
  /// Largest change of a radius, as a fraction of the input radius; 0 keeps radii.
  double radiusTolerance = 0.0;
  /// Stop after this many seconds and keep the best state; 0 for no limit.
  double timeBudget = 0.0;
  /// File for the state of the run, written at intervals and at the end; empty for none. An existing file must be a checkpoint of
  /// this run (see resume): anything else is kept, and the run does not begin.
  std::string checkpointFile;
  /// Least seconds between two checkpoints; 0 for one in every iteration.
  double checkpointInterval = 600.0;
  /// Continue from checkpointFile if it exists. It must have been written for the same fibres and the same parameters, except
  /// maximumIterations and timeBudget. The result has the same bits as that of an uninterrupted run. If false, the run starts
  /// from the beginning, and replaces its own earlier checkpoint once it has come as far.
  bool resume = false;

  static const PropertyList<CapsuleOptimizerOptions>& properties();
};

/// Throws InvalidInput naming the property that is out of range.
void validate(const CapsuleOptimizerOptions& options);

} // namespace cactus
