// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/DescentState.h"

#include <cstdint>

namespace cactus
{

DescentState::DescentState(Fibres& given, bool withRadii)
  : fibres(given)
  , velocity(given.points.size(), Eigen::Vector3d::Zero())
  , radiusVelocity(withRadii ? given.points.size() : 0, 0.0)
  , speed(given.points.size(), 0.0f)
  , push(given.points.size(), 0.0f)
  , displacement(given.points.size())
  , allowance(given.points.size())
{
}

void DescentState::save(CheckpointWriter& file) const
{
  file.putAll(this->fibres.points);
  file.putAll(this->fibres.radii);
  file.putAll(this->velocity);
  file.putAll(this->radiusVelocity);
  file.putAll(this->speed);
  file.putAll(this->push);
  file.put(this->relaxation);
  file.put(this->leastAllowance);
  file.put(this->stepsSinceSearch);
  file.put(this->effort.pairEvaluations);
  file.put(this->effort.neighbourSearches);
  file.put(this->effort.evaluationSeconds);
  file.put(this->effort.searchSeconds);
  // The order of a list decides how its sums are rounded.
  file.put(static_cast<std::uint8_t>(this->searchDue()));
  if (!this->searchDue())
  {
    file.putAll(this->neighbours.offsets);
    file.putAll(this->neighbours.indices);
    file.putAll(this->displacement);
    file.putAll(this->allowance);
  }
}

void DescentState::load(CheckpointReader& file)
{
  const auto count = static_cast<std::int64_t>(this->fibres.points.size());
  const auto capsules = count - static_cast<std::int64_t>(this->fibres.size());
  file.getAll(this->fibres.points, count);
  file.getAll(this->fibres.radii, count);
  file.getAll(this->velocity, count);
  file.getAll(this->radiusVelocity, static_cast<std::int64_t>(this->radiusVelocity.size()));
  file.getAll(this->speed, count);
  file.getAll(this->push, count);
  file.get(this->relaxation);
  file.get(this->leastAllowance);
  file.get(this->stepsSinceSearch);
  file.get(this->effort.pairEvaluations);
  file.get(this->effort.neighbourSearches);
  file.get(this->effort.evaluationSeconds);
  file.get(this->effort.searchSeconds);
  std::uint8_t due = 0;
  file.get(due);
  file.require(due <= 1);
  this->exceeded = due == 1;
  if (!this->exceeded)
  {
    file.getAll(this->neighbours.offsets, capsules + 1);
    file.getAll(this->neighbours.indices);
    file.getAll(this->displacement, count);
    file.getAll(this->allowance, count);
  }
}

} // namespace cactus
