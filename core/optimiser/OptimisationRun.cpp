// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/OptimisationRun.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cactus
{

namespace
{

/// Visits what a checkpoint keeps beside the descent.
template <typename Run, typename File>
void visitKeptRun(Run& run, File& file)
{
  file(run.seconds, run.bestCost, run.progress, run.rows);
  file.parts(run.bestPoints);
  file.parts(run.bestRadii);
}

} // namespace

OptimisationRun::OptimisationRun(Level which, Fibres& fibres, const FibreShares& shares, std::vector<BundleBox> boxes,
  const CapsuleOptimizerOptions& options, int threads)
  : level(which)
  , state(fibres)
  , descent(fibres, shares, std::move(boxes), options, threads)
  , bestPoints(fibres.points)
  , bestRadii(fibres.radii)
{
}

void OptimisationRun::takeOver(OptimisationRun& coarse, const CoarseFibres& fewer)
{
  const DescentState& from = coarse.descent.state();
  this->descent.takeOver(from, fewer.refine(from.fibres.points, this->state.points), fewer.interpolate(from.velocity));
  this->bestPoints = this->state.points;
  this->iteration = coarse.iteration;
  this->seconds = coarse.seconds;
  this->rows = std::move(coarse.rows);
}

void OptimisationRun::note(const ConvergenceRow& row, double tolerance)
{
  if (row.overlapCost < this->bestCost || row.maximumPenetration <= tolerance)
  {
    this->bestCost = row.overlapCost;
    this->bestPoints = this->state.points;
    this->bestRadii = this->state.radii;
  }
  this->progress.note(row);
}

void OptimisationRun::save(CheckpointWriter& file) const
{
  visitKeptRun(*this, file);
  this->descent.save(file);
}

void OptimisationRun::load(CheckpointReader& file)
{
  visitKeptRun(*this, file);
  int next = 0;
  for (const ConvergenceRow& row : this->rows)
  {
    file.require(row.iteration == next++ && std::isfinite(row.overlapCost) && row.maximumPenetration >= 0.0);
    this->seconds = std::max(this->seconds, row.seconds);
  }
  const DescentProgress& made = this->progress;
  file.require(next == this->iteration && std::isfinite(this->seconds) && this->bestCost >= 0.0 && made.lowestCost >= 0.0 &&
               made.lowestPenetration >= 0.0 && made.lastIteration >= 0 && made.lastIteration <= next);
  file.require(this->descent.couldReach(this->bestPoints, this->bestRadii));
  this->descent.load(file);
}

} // namespace cactus
