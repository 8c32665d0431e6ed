// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"

#include <cstddef>
#include <vector>

namespace cactus
{

/// Cuts off the parts of fibres outside the domain (paper, implementation details of the joint optimisation: "we trim the
/// optimised fibre trajectories"). It keeps the capsules that come within their own radius of touching the domain, so that the
/// domain stays filled to its faces when fibres grow by up to their radius. A fibre that leaves and comes back becomes several,
/// unless it comes back so near that the pieces could meet: the longest piece keeps the FibreId, the others get new ones above
/// the largest. Fibres wholly outside are removed. Nothing is cut off beyond periodic faces. `kept`, if given, receives for each
/// remaining control point its index in `fibres`.
Fibres trimToDomain(const Fibres& fibres, std::vector<std::size_t>* kept = nullptr);

} // namespace cactus
