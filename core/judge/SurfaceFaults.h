// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Domain.h"
#include "surface/MyelinSurface.h"

#include <vector>

namespace cactus
{

/// Marks (isFlawed) exactly those fibres whose surfaces the certificate finds at fault (see certify()): one that is not closed,
/// meets itself, another fibre's or its own other surface, or is nearer than `minimumGap` (µm) to another fibre. For surfaces
/// that were made without a guarantee (see SurfaceFilters). The pairs are in increasing order of fibres. Throws Cancelled.
void markFaults(std::vector<FibreSurfacePair>& pairs, const Domain& domain, double minimumGap, const Context& context = {});

} // namespace cactus
