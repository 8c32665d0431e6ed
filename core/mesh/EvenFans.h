// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/CappedSurface.h"

namespace cactus
{

/// Makes the triangles around each vertex so even that the sum of their area normals is at most 75° off each of them. At the rim
/// of a cap the long triangles of a wall outweigh the small ones of the cap, or the reverse: a reader that works with vertex
/// normals then takes the lighter side for one that is turned inside out.
///
/// Where wall and cap meet too sharply for that, the rim is blunted down to `rimDepth` (µm; 0 for not at all), see bluntRims: the
/// surface becomes a little smaller. Then caps become fans about their centroids and edges within them are flipped where that
/// helps, edges that end at such a vertex are cut, and triangles at it split into three: all of that leaves every point of the
/// surface where it is, but for the rounding of new points. What is made has no squared edge ratio above
/// `largestSquaredEdgeRatio`, no height below 1 nm and no angle below `smallestAngle` (degrees) unless the triangle that it is
/// cut from has one; it is flatter than flattestTriangle only where nothing else helps. Where the triangles at a vertex face too
/// many ways, as along a sharp crease, the angle becomes as small as cuts make it. Points may be numbered anew; the result
/// depends on the input alone. Precondition: closed manifold.
void evenFans(CappedSurface& surface, double largestSquaredEdgeRatio, double smallestAngle, double rimDepth);

} // namespace cactus
