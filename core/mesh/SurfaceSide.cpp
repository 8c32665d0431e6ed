// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SurfaceSide.h"

#include "mesh/ExactPredicates.h"
#include "mesh/TriangleIntersection.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace cactus
{

namespace
{

using Eigen::Vector3d;

/// The crossings of a line segment with triangles: their number, whether its start lies on one, whether a crossing is ambiguous.
struct Crossings
{
  std::size_t count = 0;
  bool startsOn = false;
  bool unclear = false;

  void cross(const Vector3d& p, const Vector3d& q, const TriangleCorners& t)
  {
    const int atP = orientation(*t[0], *t[1], *t[2], p);
    if (atP == 0)
    {
      this->startsOn = this->startsOn || segmentMeets(p, p, t);
      if (this->startsOn || isFlat(t))
      {
        return; // a flat triangle lies on edges of its neighbours
      }
    }
    const int atQ = orientation(*t[0], *t[1], *t[2], q);
    if (atP == atQ && atP != 0)
    {
      return;
    }
    const int s0 = orientation(p, q, *t[0], *t[1]);
    const int s1 = orientation(p, q, *t[1], *t[2]);
    const int s2 = orientation(p, q, *t[2], *t[0]);
    if (s0 * s1 < 0 || s1 * s2 < 0 || s2 * s0 < 0)
    {
      return;
    }
    if (s0 == 0 || s1 == 0 || s2 == 0 || atP == 0 || atQ == 0)
    {
      this->unclear = true; // through an edge, or along the plane
      return;
    }
    ++this->count;
  }
};

/// Returns a point beyond the lower end of x, a different one for each attempt.
Vector3d farPoint(const Vector3d& point, const Vector3d& lower, double size, int attempt)
{
  const double turn = 0.6180339887498949 * attempt;
  const double lift = 0.7548776662466927 * attempt;
  return { lower[0] - 0.1 * size - 1.0, point[1] + 0.2 * size * (turn - std::floor(turn) - 0.5),
    point[2] + 0.2 * size * (lift - std::floor(lift) - 0.5) };
}

} // namespace

Side sideOf(const TriangleTree& surface, const Vector3d& point)
{
  if (surface.empty())
  {
    return Side::Outside;
  }
  const FloatBox& box = surface.nodes()[0].box;
  const Vector3d lower(box.lower[0], box.lower[1], box.lower[2]);
  const Vector3d upper(box.upper[0], box.upper[1], box.upper[2]);
  if ((point.array() < lower.array()).any() || (point.array() > upper.array()).any())
  {
    return Side::Outside;
  }
  const double size = (upper - lower).maxCoeff();
  // Tries different points until the line meets no edge. A few are enough; a point from which every line meets an edge would lie
  // on the surface.
  for (int attempt = 1;; ++attempt)
  {
    const Vector3d far = farPoint(point, lower, size, attempt);
    const FloatBox reach = FloatBox::around(point, far, far);
    Crossings crossings;
    visitEntries(
      surface, [&reach](const FloatBox& node) { return node.overlaps(reach); },
      [&](std::uint32_t triangle)
      {
        crossings.cross(point, far, cornersOf(surface.mesh(), triangle));
        return crossings.startsOn;
      });
    if (crossings.startsOn)
    {
      return Side::On;
    }
    if (!crossings.unclear)
    {
      return crossings.count % 2 == 1 ? Side::Inside : Side::Outside;
    }
  }
}

} // namespace cactus
