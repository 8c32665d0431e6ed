// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "bundle/Circles.h"

namespace cactus
{

/// How relaxCircles() moves circles and when it stops.
struct RelaxationOptions
{
  int maximumIterations = 20000;
  /// Radii are taken larger by this fraction while moving, so that the true circles come apart after finitely many steps.
  double clearance = 2e-5;
  /// Circles count as jammed once the net forces are this small relative to the contact forces.
  double jammedBalance = 1e-4;
};

/// Result of relaxCircles().
struct Relaxation
{
  bool separated = false;      ///< no two circles overlap
  double largestOverlap = 0.0; ///< max 1 − d/(ri + rj) over all pairs, or 0
  int iterations = 0;
};

/// Moves the circles apart until no two overlap, each staying inside its rectangle, or coming in again on the other side if that
/// repeats, which has to be four times as wide as the largest of them at least: harmonic repulsion of overlapping pairs,
/// minimised with FIRE (Bitzek et al., Phys. Rev. Lett. 97, 170201, 2006) on neighbour lists with a skin. Circles that do not
/// overlap at the start stay in place. Gives the same bits on any number of threads. If the circles jam or the iterations run
/// out, the result says so, and the centres are the last ones. Throws Cancelled.
Relaxation relaxCircles(Circles& circles, const RelaxationOptions& options = {}, const Context& context = {});

} // namespace cactus
