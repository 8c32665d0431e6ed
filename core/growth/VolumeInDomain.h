// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"

#include <cstddef>

namespace cactus
{

/// Returns the volume (µm³) in the domain of a fibre's chain with `factor` times its radii: its cross-sections along the centre
/// line, which give the volume of a bent tube, and the two half balls at its ends.
double volumeInDomain(const Fibres& fibres, std::size_t f, double factor);

} // namespace cactus
