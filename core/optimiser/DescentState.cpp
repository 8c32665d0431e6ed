// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/DescentState.h"

namespace cactus
{

namespace
{

/// Visits what a checkpoint keeps.
template <typename State, typename File>
void visitKeptState(State& state, File& file)
{
  file(state.relaxation, state.effort);
  file.parts(state.fibres.points);
  file.parts(state.fibres.radii);
  file.parts(state.velocity);
  file.parts(state.radiusVelocity);
}

} // namespace

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
  visitKeptState(*this, file);
}

void DescentState::load(CheckpointReader& file)
{
  visitKeptState(*this, file);
}

} // namespace cactus
