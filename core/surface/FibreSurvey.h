// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Sharing.h"
#include "surface/FibreField.h"

#include <cstdint>
#include <map>
#include <vector>

namespace cactus
{

/// What one look at a label image tells of a fibre.
struct FoundFibre
{
  double depths = 0.0;               ///< µm, sum over its samples
  double samples = 0.0;              ///< how many they are
  std::vector<std::uint32_t> blocks; ///< of the field's lattice, increasing
};

/// By FibreId.
using FoundFibres = std::map<std::int32_t, FoundFibre>;

/// The fibres of a field, each with the blocks that have a node which belongs to it or has one at most `reach` nodes away, from 0
/// to limits::smoothingIterations. Each sample is looked at once, in pieces that a source of samples makes at once; what they
/// hold is put together in their order, so that the result does not depend on threads or processes, which share the work and get
/// all of it. Throws InvalidInput for a negative FibreId, a Depth that is not finite, beyond limits::coordinate or does not fit
/// its FibreId, and Cancelled.
FoundFibres findFibres(const FibreField& field, int reach, const Context& context = {}, const Sharing& sharing = Sharing());

} // namespace cactus
