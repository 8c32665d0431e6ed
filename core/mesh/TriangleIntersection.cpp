// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/TriangleIntersection.h"

#include "mesh/ExactPredicates.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cactus
{

namespace
{

using Eigen::Vector3d;
using Corners = TriangleCorners;

/// Returns an axis along which the triangle is not projected to a line; −1 if it is a line.
int viewOf(const Corners& t)
{
  for (int axis = 2; axis >= 0; --axis)
  {
    if (orientationAlong(axis, *t[0], *t[1], *t[2]) != 0)
    {
      return axis;
    }
  }
  return -1;
}

/// Tells, for points on one line, whether p lies between q and r, or on one of them.
bool between(const Vector3d& p, const Vector3d& q, const Vector3d& r)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (p[axis] < std::min(q[axis], r[axis]) || p[axis] > std::max(q[axis], r[axis]))
    {
      return false;
    }
  }
  return true;
}

/// Tells, in a plane seen along `view`, whether the closed segments p–q and r–s have a point in common.
bool segmentsMeet(int view, const Vector3d& p, const Vector3d& q, const Vector3d& r, const Vector3d& s)
{
  const int atR = orientationAlong(view, p, q, r);
  const int atS = orientationAlong(view, p, q, s);
  const int atP = orientationAlong(view, r, s, p);
  const int atQ = orientationAlong(view, r, s, q);
  if (atR * atS < 0 && atP * atQ < 0)
  {
    return true;
  }
  return (atR == 0 && between(r, p, q)) || (atS == 0 && between(s, p, q)) || (atP == 0 && between(p, r, s)) ||
         (atQ == 0 && between(q, r, s));
}

/// Tells the same in space.
bool segmentsMeet(const Vector3d& p, const Vector3d& q, const Vector3d& r, const Vector3d& s)
{
  if (orientation(p, q, r, s) != 0)
  {
    return false;
  }
  for (const Corners& t : { Corners{ { &p, &q, &r } }, Corners{ { &p, &q, &s } }, Corners{ { &r, &s, &p } } })
  {
    const int view = viewOf(t);
    if (view >= 0)
    {
      return segmentsMeet(view, p, q, r, s);
    }
  }
  // All on one line.
  return between(p, r, s) || between(q, r, s) || between(r, p, q);
}

/// Tells whether p, in the plane of a triangle that is not flat, lies in the triangle.
bool inTriangle(int view, const Vector3d& p, const Corners& t)
{
  const int s0 = orientationAlong(view, *t[0], *t[1], p);
  const int s1 = orientationAlong(view, *t[1], *t[2], p);
  const int s2 = orientationAlong(view, *t[2], *t[0], p);
  return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
}

/// Tells whether the closed segment p–q meets a triangle that is not flat, given the signs of p and q relative to the triangle's
/// plane.
bool segmentMeets(const Vector3d& p, int atP, const Vector3d& q, int atQ, const Corners& t)
{
  if (atP == atQ && atP != 0)
  {
    return false;
  }
  if (atP == 0 && atQ == 0)
  {
    const int view = viewOf(t);
    return inTriangle(view, p, t) || segmentsMeet(view, p, q, *t[0], *t[1]) || segmentsMeet(view, p, q, *t[1], *t[2]) ||
           segmentsMeet(view, p, q, *t[2], *t[0]);
  }
  // The line through p and q crosses the plane in one point of the segment, and passes all edges of the triangle on the same
  // side.
  const int s0 = orientation(p, q, *t[0], *t[1]);
  const int s1 = orientation(p, q, *t[1], *t[2]);
  if (s0 * s1 < 0)
  {
    return false;
  }
  const int s2 = orientation(p, q, *t[2], *t[0]);
  return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
}

std::array<int, 3> sidesOf(const Corners& a, const Corners& plane)
{
  std::array<int, 3> sides;
  for (std::size_t i = 0; i < 3; ++i)
  {
    sides[i] = orientation(*plane[0], *plane[1], *plane[2], *a[i]);
  }
  return sides;
}

bool allOnOneSide(const std::array<int, 3>& sides)
{
  return sides[0] != 0 && sides[0] == sides[1] && sides[1] == sides[2];
}

/// Tells whether, seen from `origin`, all of `b` certainly lies further in direction `across` than all of `a`: by far more than
/// rounding. This decides most cases without exact predicates.
template <std::size_t corners>
bool clearlyBehind(const Vector3d& origin, const Vector3d& across, const std::array<const Vector3d*, corners>& a,
  const std::array<const Vector3d*, corners>& b)
{
  double last = -std::numeric_limits<double>::infinity();
  double first = std::numeric_limits<double>::infinity();
  double reach = 0.0;
  for (std::size_t i = 0; i < corners; ++i)
  {
    const Vector3d toA = *a[i] - origin;
    const Vector3d toB = *b[i] - origin;
    last = std::max(last, across.dot(toA));
    first = std::min(first, across.dot(toB));
    reach = std::max({ reach, std::fabs(toA[0]), std::fabs(toA[1]), std::fabs(toA[2]), std::fabs(toB[0]), std::fabs(toB[1]),
      std::fabs(toB[2]) });
  }
  const double rounding = 1e-14 * reach * (std::fabs(across[0]) + std::fabs(across[1]) + std::fabs(across[2]));
  if constexpr (corners == 2)
  {
    return last < -rounding && first > rounding; // with the origin between them
  }
  return first - last > rounding;
}

/// The corners that two triangles of one mesh share by index, as places in each.
struct SharedCorners
{
  std::size_t count = 0;
  std::array<std::size_t, 3> inFirst{};
  std::array<std::size_t, 3> inSecond{};

  SharedCorners(const std::array<std::int32_t, 3>& first, const std::array<std::int32_t, 3>& second)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      for (std::size_t j = 0; j < 3; ++j)
      {
        if (first[i] == second[j] && this->count < 3)
        {
          this->inFirst[this->count] = i;
          this->inSecond[this->count++] = j;
        }
      }
    }
  }
};

/// Tells whether two triangles that share one corner, number i of `a` and j of `b`, meet elsewhere. Any further intersection
/// reaches from there to the opposite edge of one of them.
bool meetBesideCorner(const Corners& a, std::size_t i, const Corners& b, std::size_t j)
{
  const std::array<const Vector3d*, 2> edgeA{ { a[(i + 1) % 3], a[(i + 2) % 3] } };
  const std::array<const Vector3d*, 2> edgeB{ { b[(j + 1) % 3], b[(j + 2) % 3] } };
  if (clearlyBehind(*a[i], (*edgeB[0] - *edgeA[0]) + (*edgeB[1] - *edgeA[1]), edgeA, edgeB))
  {
    return false;
  }
  const auto meets = [](const std::array<const Vector3d*, 2>& edge, const Corners& t)
  {
    return segmentMeets(
      *edge[0], orientation(*t[0], *t[1], *t[2], *edge[0]), *edge[1], orientation(*t[0], *t[1], *t[2], *edge[1]), t);
  };
  return meets(edgeA, b) || meets(edgeB, a);
}

/// Tells whether two triangles that share two corners lie folded onto each other in one plane.
bool meetBesideEdge(const Corners& a, const Corners& b, const SharedCorners& shared)
{
  const Vector3d& u = *a[shared.inFirst[0]];
  const Vector3d& v = *a[shared.inFirst[1]];
  const Vector3d& apexA = *a[3 - shared.inFirst[0] - shared.inFirst[1]];
  const Vector3d& apexB = *b[3 - shared.inSecond[0] - shared.inSecond[1]];
  if (orientation(u, v, apexA, apexB) != 0)
  {
    return false;
  }
  const int view = viewOf(a);
  return orientationAlong(view, u, v, apexA) == orientationAlong(view, u, v, apexB);
}

} // namespace

bool isFlat(const Corners& t)
{
  return viewOf(t) < 0;
}

bool segmentMeets(const Vector3d& p, const Vector3d& q, const Corners& t)
{
  if (isFlat(t))
  {
    return segmentsMeet(p, q, *t[0], *t[1]) || segmentsMeet(p, q, *t[1], *t[2]) || segmentsMeet(p, q, *t[2], *t[0]);
  }
  return segmentMeets(p, orientation(*t[0], *t[1], *t[2], p), q, orientation(*t[0], *t[1], *t[2], q), t);
}

bool trianglesMeet(const Corners& a, const Corners& b)
{
  if (clearlyBehind(*a[0], (*b[0] - *a[0]) + (*b[1] - *a[1]) + (*b[2] - *a[2]), a, b))
  {
    return false;
  }
  const std::array<int, 3> sidesA = sidesOf(a, b);
  if (allOnOneSide(sidesA))
  {
    return false;
  }
  const std::array<int, 3> sidesB = sidesOf(b, a);
  if (allOnOneSide(sidesB))
  {
    return false;
  }
  if (isFlat(a) || isFlat(b))
  {
    // A flat triangle is the union of its edges.
    const Corners& flat = isFlat(a) ? a : b;
    const Corners& other = isFlat(a) ? b : a;
    return segmentMeets(*flat[0], *flat[1], other) || segmentMeets(*flat[1], *flat[2], other) ||
           segmentMeets(*flat[2], *flat[0], other);
  }
  // An edge of one meets the other one.
  for (std::size_t i = 0; i < 3; ++i)
  {
    const std::size_t j = (i + 1) % 3;
    if (segmentMeets(*a[i], sidesA[i], *a[j], sidesA[j], b) || segmentMeets(*b[i], sidesB[i], *b[j], sidesB[j], a))
    {
      return true;
    }
  }
  return false;
}

bool trianglesMeet(const std::array<Vector3d, 3>& a, const std::array<Vector3d, 3>& b)
{
  return trianglesMeet(TriangleCorners{ { &a[0], &a[1], &a[2] } }, TriangleCorners{ { &b[0], &b[1], &b[2] } });
}

bool meetElsewhere(const TriangleMesh& mesh, std::uint32_t first, std::uint32_t second)
{
  const SharedCorners shared(mesh.triangles[first], mesh.triangles[second]);
  const Corners a = cornersOf(mesh, first);
  const Corners b = cornersOf(mesh, second);
  switch (shared.count)
  {
  case 0:
    return trianglesMeet(a, b);
  case 1:
    return meetBesideCorner(a, shared.inFirst[0], b, shared.inSecond[0]);
  case 2:
    return meetBesideEdge(a, b, shared);
  default:
    return true;
  }
}

} // namespace cactus
