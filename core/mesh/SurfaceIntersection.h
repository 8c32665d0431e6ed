// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"
#include "mesh/TriangleTree.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace cactus
{

// Tests whether surfaces meet, by exact predicates (see TriangleIntersection.h): no result depends on rounding, and touching in a
// single point counts as meeting.

/// Tells whether two surfaces cut or touch each other. One inside the other does not count.
bool surfacesMeet(const TriangleTree& a, const TriangleTree& b);
bool surfacesMeet(const TriangleMesh& a, const TriangleMesh& b);

/// Returns all pairs of triangles, first of `a` and second of `b`, that cut or touch each other, in increasing order.
std::vector<std::pair<std::uint32_t, std::uint32_t>> meetingTriangles(const TriangleTree& a, const TriangleTree& b);

/// Returns all pairs of a surface's own triangles that have more in common than the corners they share by index, the smaller
/// first, in increasing order. Neighbours across an edge count if one lies folded onto the other in one plane, and so do two
/// triangles of the same three corners. A flat triangle, which lies on its own edge, counts as a pair with itself. The search
/// ends after `most` pairs: n triangles in one place have n²/2.
std::vector<std::pair<std::uint32_t, std::uint32_t>> selfIntersections(
  const TriangleTree& surface, std::size_t most = std::numeric_limits<std::size_t>::max());

/// Tells whether there is any such pair.
bool meetsItself(const TriangleTree& surface);
bool meetsItself(const TriangleMesh& mesh);

} // namespace cactus
