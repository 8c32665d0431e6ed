// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/OptimisationRun.h"

#include "base/Bytes.h"
#include "base/SharedCheckpoint.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cactus
{

namespace
{

/// Visits the fields one by one: a row as a whole has padding.
template <typename Row, typename Visitor>
void visit(Row& row, Visitor&& visitor)
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

OptimisationRun::OptimisationRun(Level which, Fibres& fibres, const FibreShares& shares, std::vector<BundleBox> boxes,
  const CapsuleOptimizerOptions& options, int threads)
  : level(which)
  , sharing(shares.sharing())
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

void OptimisationRun::save(const std::string& path, std::uint64_t fingerprint) const
{
  SharedCheckpointWriter file(path, { fingerprint, this->iteration }, this->sharing);
  file.put(static_cast<std::uint8_t>(this->level));
  file.put(this->rows.empty() ? this->seconds : std::max(this->seconds, this->rows.back().seconds));
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

OptimisationRun::Level OptimisationRun::levelOf(const std::string& path, std::uint64_t fingerprint)
{
  CheckpointReader file(path, fingerprint);
  std::uint8_t level = 0;
  file.get(level);
  return level == Coarse ? Coarse : Fine;
}

void OptimisationRun::load(const std::string& path, std::uint64_t fingerprint)
{
  SharedCheckpointReader file(path, fingerprint, this->sharing);
  const std::string numbers =
    file.fromFile([this](CheckpointReader& from, ByteWriter& put) { loadNumbers(from, put, this->level); });
  ByteReader get(numbers);
  get(this->iteration);
  get(this->seconds);
  get(this->bestCost);
  get(this->progress.lowestCost);
  get(this->progress.lowestPenetration);
  get(this->progress.lastIteration);
  this->rows.resize(static_cast<std::size_t>(this->iteration));
  for (ConvergenceRow& row : this->rows)
  {
    visit(row, get);
  }
  const std::size_t count = this->state.points.size();
  file.getAll(this->bestPoints, count);
  file.getAll(this->bestRadii, count);
  file.require(this->descent.couldReach(this->bestPoints, this->bestRadii));
  this->descent.load(file);
  file.finish();
}

/// Reads the values that are the same in all processes.
void OptimisationRun::loadNumbers(CheckpointReader& file, ByteWriter& put, Level expected)
{
  std::uint8_t level = 0;
  file.get(level);
  file.require(level == expected);
  file.require(file.header().iteration >= 0 && file.header().iteration <= std::numeric_limits<int>::max());
  const int next = static_cast<int>(file.header().iteration);
  double before = 0.0;
  double cost = 0.0;
  DescentProgress made;
  file.get(before);
  file.get(cost);
  file.get(made.lowestCost);
  file.get(made.lowestPenetration);
  file.get(made.lastIteration);
  file.require(std::isfinite(before) && cost >= 0.0 && made.lowestCost >= 0.0 && made.lowestPenetration >= 0.0 &&
               made.lastIteration >= 0 && made.lastIteration <= next);
  put(next);
  put(before);
  put(cost);
  put(made.lowestCost);
  put(made.lowestPenetration);
  put(made.lastIteration);
  for (int i = 0; i < next; ++i)
  {
    ConvergenceRow row;
    visit(row, [&](auto& value) { file.get(value); });
    file.require(row.iteration == i && std::isfinite(row.overlapCost) && row.maximumPenetration >= 0.0);
    visit(row, put);
  }
}

} // namespace cactus
