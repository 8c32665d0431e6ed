// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SurfaceIntersection.h"

#include "mesh/TriangleIntersection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace cactus
{

namespace
{

using Eigen::Vector3d;
using PointNumbers = std::array<std::int32_t, 3>;

/// Tells whether a triangle certainly touches the plane of another one only in shared corners, and is otherwise on one side.
bool touchesInShared(const std::array<double, 3>& heights, double slack, const std::array<bool, 3>& isShared)
{
  // Branch-free, since branches would often be mispredicted.
  bool isAbove = false;
  bool isBelow = false;
  bool isClear = true;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const bool above = heights[i] > slack;
    const bool below = heights[i] < -slack;
    isAbove |= above;
    isBelow |= below;
    isClear &= above | below | isShared[i];
  }
  return isClear & (isAbove != isBelow);
}

/// Tells whether two triangles of one mesh certainly have nothing in common but corners that they share by index.
bool areApart(const TriangleMesh& mesh, const PointNumbers& s, const TrianglePlane& planeS, const PointNumbers& t,
  const TrianglePlane& planeT, double slack)
{
  std::array<bool, 3> inS;
  std::array<bool, 3> inT;
  std::array<double, 3> aboveS;
  std::array<double, 3> aboveT;
  for (std::size_t i = 0; i < 3; ++i)
  {
    inS[i] = (int(t[i] == s[0]) | int(t[i] == s[1]) | int(t[i] == s[2])) != 0;
    inT[i] = (int(s[i] == t[0]) | int(s[i] == t[1]) | int(s[i] == t[2])) != 0;
    aboveS[i] = planeS.height(mesh.points[std::size_t(t[i])]);
    aboveT[i] = planeT.height(mesh.points[std::size_t(s[i])]);
  }
  return touchesInShared(aboveS, slack, inS) || touchesInShared(aboveT, slack, inT);
}

/// Calls found(first, second) for the pairs of selfIntersections(), until it returns true.
template <typename Found>
bool visitSelfIntersections(const TriangleTree& surface, Found&& found)
{
  const TriangleMesh& mesh = surface.mesh();
  const std::vector<std::uint32_t>& order = surface.order();
  const std::vector<TrianglePlane>& planes = surface.planes();
  std::vector<char> flat(order.size(), 0);
  for (std::size_t place = 0; place < order.size(); ++place)
  {
    if (planes[place].normal.isZero(0.0) && isFlat(cornersOf(mesh, order[place])))
    {
      flat[place] = 1;
      if (found(order[place], order[place]))
      {
        return true;
      }
    }
  }
  const double slack = heightError(surface, surface);
  return visitOverlappingPlaces(surface, surface,
    [&](std::uint32_t m, std::uint32_t n)
    {
      const std::uint32_t s = order[m];
      const std::uint32_t t = order[n];
      return !areApart(mesh, mesh.triangles[s], planes[m], mesh.triangles[t], planes[n], slack) && !flat[m] && !flat[n] &&
             meetElsewhere(mesh, s, t) && found(std::min(s, t), std::max(s, t));
    });
}

/// Tells whether all corners of a triangle are certainly on one side of a plane.
bool isBeside(const TriangleCorners& corners, const TrianglePlane& plane, double slack)
{
  const double a = plane.height(*corners[0]);
  const double b = plane.height(*corners[1]);
  const double c = plane.height(*corners[2]);
  return std::min({ a, b, c }) > slack || std::max({ a, b, c }) < -slack;
}

/// Calls found(triangle of a, triangle of b) for those that meet, until it returns true.
template <typename Found>
bool visitMeetings(const TriangleTree& a, const TriangleTree& b, Found&& found)
{
  const double slack = heightError(a, b);
  return visitOverlappingPlaces(a, b,
    [&](std::uint32_t m, std::uint32_t n)
    {
      const std::uint32_t s = a.order()[m];
      const std::uint32_t t = b.order()[n];
      const TriangleCorners cornersA = cornersOf(a.mesh(), s);
      const TriangleCorners cornersB = cornersOf(b.mesh(), t);
      return !isBeside(cornersA, b.planes()[n], slack) && !isBeside(cornersB, a.planes()[m], slack) &&
             trianglesMeet(cornersA, cornersB) && found(s, t);
    });
}

} // namespace

bool surfacesMeet(const TriangleTree& a, const TriangleTree& b)
{
  return visitMeetings(a, b, [](std::uint32_t, std::uint32_t) { return true; });
}

bool surfacesMeet(const TriangleMesh& a, const TriangleMesh& b)
{
  return surfacesMeet(TriangleTree(a), TriangleTree(b));
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> meetingTriangles(const TriangleTree& a, const TriangleTree& b)
{
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  visitMeetings(a, b,
    [&pairs](std::uint32_t s, std::uint32_t t)
    {
      pairs.emplace_back(s, t);
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
