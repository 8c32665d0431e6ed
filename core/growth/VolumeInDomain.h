// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"

#include <cstddef>

namespace cactus
{

/// Returns the volume (µm³) in the domain of a fibre's chain with `factor` times its radii: its cross-sections along the centre
/// line, which give the volume of a bent tube, and the two half balls at its ends. `samples` is the number of points on a
/// cross-section by which its part in the domain is found.
double volumeInDomain(const Fibres& fibres, std::size_t f, double factor, int samples = 96);

} // namespace cactus
