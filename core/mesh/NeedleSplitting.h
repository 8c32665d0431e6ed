// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/CappedSurface.h"

namespace cactus
{

/// Halves the longest edges of triangles whose longest and shortest squared edges have a ratio above `largest` (more than 16),
/// and of the resulting triangles, until none has. The shape of the surface does not change. Precondition: the surface is closed
/// and no edge has zero length.
void splitNeedles(CappedSurface& surface, double largest);

} // namespace cactus
