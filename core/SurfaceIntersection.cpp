// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceIntersection.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace cactus
{

namespace
{

using Eigen::Vector3d;

struct Corners
{
  std::array<Vector3d, 3> p;
  Vector3d lower;
  Vector3d upper;
  std::array<std::int32_t, 3> index;
};

std::vector<Corners> sortedCorners(const TriangleMesh& mesh, int axis)
{
  std::vector<Corners> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles)
  {
    Corners c;
    for (std::size_t i = 0; i < 3; ++i)
    {
      c.p[i] = mesh.points[std::size_t(t[i])];
    }
    c.lower = c.p[0].cwiseMin(c.p[1]).cwiseMin(c.p[2]);
    c.upper = c.p[0].cwiseMax(c.p[1]).cwiseMax(c.p[2]);
    c.index = t;
    triangles.push_back(c);
  }
  std::stable_sort(
    triangles.begin(), triangles.end(), [axis](const Corners& a, const Corners& b) { return a.lower[axis] < b.lower[axis]; });
  return triangles;
}

/// Sign of the volume of the tetrahedron a b c d; 0 where rounding could have changed it.
int orientation(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d)
{
  const Vector3d ad = a - d;
  const Vector3d bd = b - d;
  const Vector3d cd = c - d;
  const double volume = ad.dot(bd.cross(cd));
  const double bound = 1e-14 * (ad.norm() * bd.norm() * cd.norm());
  return volume > bound ? 1 : volume < -bound ? -1 : 0;
}

/// Whether one of the edges of `one` has all of `others` on its far side, in the plane that they share. An edge whose triangle is
/// no more than the edge has two far sides. Touching does not count as overlap here: flat caps are full of neighbours.
template <typename Points>
bool separates(const Corners& one, const Points& others, const Vector3d& normal)
{
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Vector3d outward = (one.p[(i + 1) % 3] - one.p[i]).cross(normal);
    const double own = outward.dot(one.p[(i + 2) % 3] - one.p[i]);
    double least = std::numeric_limits<double>::infinity();
    for (const Vector3d& p : others)
    {
      const double side = outward.dot(p - one.p[i]);
      least = std::min(least, own > 0.0 ? -side : side);
    }
    if (least >= 0.0)
    {
      return true;
    }
  }
  return false;
}

bool overlapInPlane(const Corners& a, const Corners& b)
{
  const Vector3d normal = (b.p[1] - b.p[0]).cross(b.p[2] - b.p[0]);
  return !separates(a, b.p, normal) && !separates(b, a.p, normal);
}

/// The same for the segment from p to q.
bool overlapInPlane(const Vector3d& p, const Vector3d& q, const Corners& t)
{
  const Vector3d normal = (t.p[1] - t.p[0]).cross(t.p[2] - t.p[0]);
  const Vector3d across = (q - p).cross(normal);
  const double sides[3] = { across.dot(t.p[0] - p), across.dot(t.p[1] - p), across.dot(t.p[2] - p) };
  const auto range = std::minmax_element(sides, sides + 3);
  return *range.first < 0.0 && *range.second > 0.0 && !separates(t, std::array<Vector3d, 2>{ p, q }, normal);
}

bool edgeMeetsTriangle(const Vector3d& p, const Vector3d& q, const Corners& t)
{
  const int atP = orientation(t.p[0], t.p[1], t.p[2], p);
  const int atQ = orientation(t.p[0], t.p[1], t.p[2], q);
  if (atP == atQ && atP != 0)
  {
    return false;
  }
  if (atP == 0 && atQ == 0)
  {
    return overlapInPlane(p, q, t);
  }
  // The line through p and q passes the triangle's edges all on the same side.
  const int s0 = orientation(p, q, t.p[0], t.p[1]);
  const int s1 = orientation(p, q, t.p[1], t.p[2]);
  const int s2 = orientation(p, q, t.p[2], t.p[0]);
  return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
}

bool meet(const Corners& a, const Corners& b)
{
  if ((a.lower.array() > b.upper.array()).any() || (b.lower.array() > a.upper.array()).any())
  {
    return false;
  }
  std::array<int, 3> side;
  for (std::size_t i = 0; i < 3; ++i)
  {
    side[i] = orientation(b.p[0], b.p[1], b.p[2], a.p[i]);
  }
  if (side[0] == side[1] && side[1] == side[2])
  {
    return side[0] == 0 && overlapInPlane(a, b);
  }
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (edgeMeetsTriangle(a.p[i], a.p[(i + 1) % 3], b) || edgeMeetsTriangle(b.p[i], b.p[(i + 1) % 3], a))
    {
      return true;
    }
  }
  return false;
}

bool shareCorner(const Corners& a, const Corners& b)
{
  for (const std::int32_t i : a.index)
  {
    if (i == b.index[0] || i == b.index[1] || i == b.index[2])
    {
      return true;
    }
  }
  return false;
}

int longestAxis(const TriangleMesh& mesh)
{
  Vector3d lower = mesh.points.front();
  Vector3d upper = mesh.points.front();
  for (const Vector3d& p : mesh.points)
  {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
  int axis = 0;
  (upper - lower).maxCoeff(&axis);
  return axis;
}

/// Sweeps along the axis: each triangle is compared with those of `others` that start before it ends.
template <typename Skip>
bool anyMeet(const std::vector<Corners>& triangles, const std::vector<Corners>& others, int axis, Skip skip)
{
  double longest = 0.0;
  for (const Corners& other : others)
  {
    longest = std::max(longest, other.upper[axis] - other.lower[axis]);
  }
  std::size_t first = 0;
  for (const Corners& triangle : triangles)
  {
    while (first < others.size() && others[first].lower[axis] < triangle.lower[axis] - longest)
    {
      ++first;
    }
    for (std::size_t n = first; n < others.size() && others[n].lower[axis] <= triangle.upper[axis]; ++n)
    {
      if (!skip(triangle, others[n]) && meet(triangle, others[n]))
      {
        return true;
      }
    }
  }
  return false;
}

} // namespace

bool surfacesMeet(const TriangleMesh& a, const TriangleMesh& b)
{
  if (a.triangles.empty() || b.triangles.empty())
  {
    return false;
  }
  const int axis = longestAxis(a);
  return anyMeet(sortedCorners(a, axis), sortedCorners(b, axis), axis, [](const Corners&, const Corners&) { return false; });
}

bool meetsItself(const TriangleMesh& mesh)
{
  if (mesh.triangles.empty())
  {
    return false;
  }
  const int axis = longestAxis(mesh);
  const std::vector<Corners> triangles = sortedCorners(mesh, axis);
  return anyMeet(triangles, triangles, axis, shareCorner);
}

} // namespace cactus
