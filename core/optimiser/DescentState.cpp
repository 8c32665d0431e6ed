// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/DescentState.h"

#include "base/Bytes.h"

#include <cstddef>
#include <string>

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

void DescentState::save(SharedCheckpointWriter& file) const
{
  file.putAll(this->fibres.points);
  file.putAll(this->fibres.radii);
  file.putAll(this->velocity);
  file.putAll(this->radiusVelocity);
  file.put(this->relaxation);
  file.put(this->effort.pairEvaluations);
  file.put(this->effort.neighbourSearches);
  file.put(this->effort.evaluationSeconds);
  file.put(this->effort.searchSeconds);
}

void DescentState::load(SharedCheckpointReader& file)
{
  const std::size_t count = this->fibres.points.size();
  file.getAll(this->fibres.points, count);
  file.getAll(this->fibres.radii, count);
  file.getAll(this->velocity, count);
  file.getAll(this->radiusVelocity, this->radiusVelocity.size());
  const auto visit = [this](auto& visitor)
  {
    visitor(this->relaxation);
    visitor(this->effort.pairEvaluations);
    visitor(this->effort.neighbourSearches);
    visitor(this->effort.evaluationSeconds);
    visitor(this->effort.searchSeconds);
  };
  const std::string numbers = file.fromFile(
    [&](CheckpointReader& from, ByteWriter& put)
    {
      const auto read = [&](auto& value) { from.get(value); };
      visit(read);
      visit(put);
    });
  ByteReader get(numbers);
  visit(get);
}

} // namespace cactus
