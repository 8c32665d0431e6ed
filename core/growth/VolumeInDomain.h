// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"

#include <cstddef>

namespace cactus
{

/// Volume (µm³) that a fibre's chain fills in the domain with `factor` times its radii: its cross-sections along the centre line,
/// which is what a bent tube holds, and the two half balls at its ends.
double volumeInDomain(const Fibres& fibres, std::size_t f, double factor);

} // namespace cactus
