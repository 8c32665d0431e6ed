// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SurfaceIntersection.h"

#include "mesh/TriangleIntersection.h"

#include <algorithm>

namespace cactus
{

namespace
{

/// Calls found(first, second) for the pairs of selfIntersections(), until it returns true.
template <typename Found>
bool visitSelfIntersections(const TriangleTree& surface, Found&& found)
{
  const TriangleMesh& mesh = surface.mesh();
  std::vector<char> flat(mesh.triangles.size(), 0);
  for (const std::uint32_t triangle : surface.order())
  {
    if (isFlat(cornersOf(mesh, triangle)))
    {
      flat[triangle] = 1;
      if (found(triangle, triangle))
      {
        return true;
      }
    }
  }
  return visitOverlaps(surface, surface,
    [&](std::uint32_t s, std::uint32_t t)
    { return !flat[s] && !flat[t] && meetElsewhere(mesh, s, t) && found(std::min(s, t), std::max(s, t)); });
}

} // namespace

bool surfacesMeet(const TriangleTree& a, const TriangleTree& b)
{
  return visitOverlaps(
    a, b, [&](std::uint32_t s, std::uint32_t t) { return trianglesMeet(cornersOf(a.mesh(), s), cornersOf(b.mesh(), t)); });
}

bool surfacesMeet(const TriangleMesh& a, const TriangleMesh& b)
{
  return surfacesMeet(TriangleTree(a), TriangleTree(b));
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> meetingTriangles(const TriangleTree& a, const TriangleTree& b)
{
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  visitOverlaps(a, b,
    [&](std::uint32_t s, std::uint32_t t)
    {
      if (trianglesMeet(cornersOf(a.mesh(), s), cornersOf(b.mesh(), t)))
      {
        pairs.emplace_back(s, t);
      }
      return false;
    });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> selfIntersections(const TriangleTree& surface, std::size_t most)
{
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  visitSelfIntersections(surface,
    [&pairs, most](std::uint32_t s, std::uint32_t t)
    {
      pairs.emplace_back(s, t);
      return pairs.size() >= most;
    });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

bool meetsItself(const TriangleTree& surface)
{
  return visitSelfIntersections(surface, [](std::uint32_t, std::uint32_t) { return true; });
}

bool meetsItself(const TriangleMesh& mesh)
{
  return meetsItself(TriangleTree(mesh));
}

} // namespace cactus
