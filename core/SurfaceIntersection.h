// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "TriangleMesh.h"

namespace cactus
{

/// Whether two surfaces cut or touch each other. Triangles are compared where their bounding boxes meet (sorted along the longest
/// axis). In double precision with a safety margin: what is closer than rounding can tell counts as touching, so false is sure.
/// One surface inside the other does not count.
bool surfacesMeet(const TriangleMesh& a, const TriangleMesh& b);

/// Whether a surface cuts or touches itself, other than triangles that share a corner, which are left out.
bool meetsItself(const TriangleMesh& mesh);

} // namespace cactus
