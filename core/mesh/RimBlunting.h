// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/EditableSurface.h"

namespace cactus
{

/// Blunts rims of caps at which wall and cap meet so sharply, as where a fibre grazes a face of the box, that hardly any
/// direction is within 75° of the normals of all triangles at a point: the wall is cut within `depth` (µm) of the face, and the
/// point moves in the face, into its cap, until the wall above the cut is steep enough.
///
/// The surface becomes smaller, in that layer alone, and keeps its topology. Points of held faces stay, and a point moves no
/// further than the limits of the triangles at it allow; no triangle turns by more than 70°. Precondition: closed manifold.
void bluntRims(EditableSurface& surface, double depth, const TriangleLimits& limits);

} // namespace cactus
