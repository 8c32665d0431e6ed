// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/OptimisationRun.h"

#include "base/Checkpoint.h"

#include <cmath>

namespace cactus
{

namespace
{

/// One by one: a row as a whole has a gap.
template <typename Row, typename Visitor>
void visit(Row& row, const Visitor& visitor)
{
  visitor(row.iteration);
  visitor(row.overlapCost);
  visitor(row.maximumPenetration);
  visitor(row.overlappingPairs);
  visitor(row.curvatureCost);
  visitor(row.lengthCost);
  visitor(row.radiusCost);
  visitor(row.compactnessCost);
  visitor(row.seconds);
}

} // namespace

OptimisationRun::OptimisationRun(Fibres& fibres, const CapsuleOptimizerOptions& options, int threads)
  : state(fibres)
  , descent(fibres, options, threads)
  , bestPoints(fibres.points)
  , bestRadii(fibres.radii)
{
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

void OptimisationRun::save(const std::string& path, std::uint64_t fingerprint) const
{
  CheckpointWriter file(path, { fingerprint, this->iteration });
  file.put(this->seconds);
  file.put(this->bestCost);
  file.put(this->progress.lowestCost);
  file.put(this->progress.lowestPenetration);
  file.put(this->progress.lastIteration);
  for (const ConvergenceRow& row : this->rows)
  {
    visit(row, [&](const auto& value) { file.put(value); });
  }
  file.putAll(this->bestPoints);
  file.putAll(this->bestRadii);
  this->descent.save(file);
  file.commit();
}

void OptimisationRun::load(const std::string& path, std::uint64_t fingerprint)
{
  const auto count = static_cast<std::int64_t>(this->state.points.size());
  CheckpointReader file(path, fingerprint);
  file.require(file.header().iteration >= 0 && file.header().iteration <= std::numeric_limits<int>::max());
  this->iteration = static_cast<int>(file.header().iteration);
  file.get(this->seconds);
  file.get(this->bestCost);
  file.get(this->progress.lowestCost);
  file.get(this->progress.lowestPenetration);
  file.get(this->progress.lastIteration);
  file.require(std::isfinite(this->seconds) && this->bestCost >= 0.0 && this->progress.lowestCost >= 0.0 &&
               this->progress.lowestPenetration >= 0.0 && this->progress.lastIteration >= 0 &&
               this->progress.lastIteration <= this->iteration);
  for (int i = 0; i < this->iteration; ++i)
  {
    ConvergenceRow row;
    visit(row, [&](auto& value) { file.get(value); });
    file.require(row.iteration == i && std::isfinite(row.overlapCost) && row.maximumPenetration >= 0.0);
    this->rows.push_back(row);
  }
  file.getAll(this->bestPoints, count);
  file.getAll(this->bestRadii, count);
  file.require(this->descent.couldReach(this->bestPoints, this->bestRadii));
  this->descent.load(file);
  file.finish();
}

} // namespace cactus
