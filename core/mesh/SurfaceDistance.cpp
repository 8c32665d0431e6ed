// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SurfaceDistance.h"

#include "mesh/TriangleIntersection.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace cactus
{

namespace
{

using Eigen::Vector3d;

/// The heights of three points over a plane.
struct Heights
{
  std::array<double, 3> of; ///< distances from the plane, times twice the area of the triangle in it
  double rounding = 0.0;    ///< more than their largest error
  double clearance = 0.0;   ///< no more than the smallest absolute height, if all are certainly on one side; else 0
};

/// A triangle with precomputed values.
struct Facet
{
  std::array<Vector3d, 3> p;
  std::array<Vector3d, 3> edge; ///< from corner i to the next
  std::array<double, 3> edgeSquared;
  Vector3d normal; ///< as long as twice the area
  double normalSquared = 0.0;

  explicit Facet(const std::array<Vector3d, 3>& corners)
    : p(corners)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      this->edge[i] = this->p[(i + 1) % 3] - this->p[i];
      this->edgeSquared[i] = this->edge[i].squaredNorm();
    }
    this->normal = this->edge[0].cross(this->edge[1]);
    this->normalSquared = this->normal.squaredNorm();
  }

  /// Returns the heights of another triangle's corners above the plane.
  Heights heightsOf(const std::array<Vector3d, 3>& other) const
  {
    Heights heights;
    double reach = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const Vector3d r = other[i] - this->p[0];
      heights.of[i] = this->normal.dot(r);
      reach = std::max({ reach, std::fabs(r[0]), std::fabs(r[1]), std::fabs(r[2]) });
    }
    const double least = std::min({ heights.of[0], heights.of[1], heights.of[2] });
    const double most = std::max({ heights.of[0], heights.of[1], heights.of[2] });
    // Well above the rounding of a product of three differences.
    heights.rounding = 3e-14 * reach * std::max({ this->edgeSquared[0], this->edgeSquared[1], this->edgeSquared[2] });
    heights.clearance = std::max({ 0.0, least - heights.rounding, -most - heights.rounding });
    return heights;
  }
};

/// The corners and edges of a triangle that are farther from another one's plane than the limit: they are farther from all of the
/// other one, too.
struct FarParts
{
  std::array<bool, 3> corner;
  std::array<bool, 3> edge; ///< from corner i to the next

  FarParts(const Heights& heights, const Facet& plane, double squared)
  {
    std::array<int, 3> side;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const double sure = std::fabs(heights.of[i]) - heights.rounding;
      this->corner[i] = sure > 0.0 && sure * sure > 1.000001 * squared * plane.normalSquared;
      side[i] = !this->corner[i] ? 0 : heights.of[i] > 0.0 ? 1 : -1;
    }
    for (std::size_t i = 0; i < 3; ++i)
    {
      this->edge[i] = side[i] * side[(i + 1) % 3] > 0;
    }
  }
};

std::array<Vector3d, 3> cornersOf(const TriangleTree& tree, std::uint32_t triangle)
{
  return { { tree.corner(triangle, 0), tree.corner(triangle, 1), tree.corner(triangle, 2) } };
}

/// The nearest pair of points found.
struct Nearest
{
  double squared;
  double slack;  ///< µm; bound of the error of heights over planes in trees
  double beyond; ///< µm; heights beyond this certainly do not matter
  Vector3d onA = Vector3d::Zero();
  Vector3d onB = Vector3d::Zero();
  bool found = false;

  Nearest(double below, double rounding)
    : squared(below * below)
    , slack(rounding)
    , beyond(1.000001 * below + rounding)
  {
  }

  /// Takes a distance of parts that do not meet: 0 by rounding is replaced.
  void take(double distanceSquared, const Vector3d& a, const Vector3d& b)
  {
    distanceSquared = std::max(distanceSquared, 1e-300);
    if (distanceSquared < this->squared)
    {
      this->squared = distanceSquared;
      this->beyond = 1.000001 * std::sqrt(distanceSquared) + this->slack;
      this->onA = a;
      this->onB = b;
      this->found = true;
    }
  }

  /// Tells whether all corners lie beyond on one side of a plane.
  bool areBeyond(const std::array<Vector3d, 3>& corners, const TrianglePlane& plane) const
  {
    const double a = plane.height(corners[0]);
    const double b = plane.height(corners[1]);
    const double c = plane.height(corners[2]);
    return (int(std::min({ a, b, c }) > this->beyond) | int(std::max({ a, b, c }) < -this->beyond)) != 0;
  }
};

/// Compares corners of `one` above or below the interior of `face`.
void cornersToFace(const Facet& one, const Facet& face, const std::array<double, 3>& heights, bool swapped, Nearest& nearest)
{
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (heights[i] * heights[i] >= nearest.squared * face.normalSquared)
    {
      continue;
    }
    const Vector3d r = one.p[i] - face.p[0];
    const double u = face.normal.dot(face.edge[0].cross(r));
    const double w = face.normal.dot(r.cross(-face.edge[2]));
    if (u >= 0.0 && w >= 0.0 && u + w <= face.normalSquared && face.normalSquared > 0.0)
    {
      const Vector3d foot = one.p[i] - (heights[i] / face.normalSquared) * face.normal;
      nearest.take((foot - one.p[i]).squaredNorm(), swapped ? foot : one.p[i], swapped ? one.p[i] : foot);
    }
  }
}

/// Compares corners of `one` with the edges of `other`, ends included.
void cornersToEdges(
  const Facet& one, const FarParts& oneFar, const Facet& other, const FarParts& otherFar, bool swapped, Nearest& nearest)
{
  for (std::size_t i = 0; i < 3; ++i)
  {
    for (std::size_t j = 0; j < 3; ++j)
    {
      if (oneFar.corner[i] || otherFar.edge[j])
      {
        continue;
      }
      const Vector3d& corner = one.p[i];
      const double length = other.edgeSquared[j];
      const double t = length > 0.0 ? std::clamp(other.edge[j].dot(corner - other.p[j]) / length, 0.0, 1.0) : 0.0;
      const Vector3d foot = other.p[j] + t * other.edge[j];
      nearest.take((foot - corner).squaredNorm(), swapped ? foot : corner, swapped ? corner : foot);
    }
  }
}

/// Compares edges whose common perpendicular has both its feet inside them; corners cover the rest.
void edgesToEdges(const Facet& a, const FarParts& farA, const Facet& b, const FarParts& farB, Nearest& nearest)
{
  for (std::size_t i = 0; i < 3; ++i)
  {
    for (std::size_t j = 0; j < 3; ++j)
    {
      if (farA.edge[i] || farB.edge[j])
      {
        continue;
      }
      const Vector3d across = a.edge[i].cross(b.edge[j]);
      const double acrossSquared = across.squaredNorm();
      const Vector3d r = b.p[j] - a.p[i];
      const double apart = across.dot(r);
      if (acrossSquared <= 0.0 || apart * apart >= nearest.squared * acrossSquared)
      {
        continue;
      }
      const double s = r.cross(b.edge[j]).dot(across) / acrossSquared;
      if (s < 0.0 || s > 1.0)
      {
        continue;
      }
      // The foot again from the other side, which corrects the rounding of s for nearly parallel edges.
      const Vector3d onA = a.p[i] + s * a.edge[i];
      const double t = std::clamp(b.edge[j].dot(onA - b.p[j]) / b.edgeSquared[j], 0.0, 1.0);
      const Vector3d onB = b.p[j] + t * b.edge[j];
      nearest.take((onA - onB).squaredNorm(), onA, onB);
    }
  }
}

/// Tells whether a plane perpendicular to the line between their middles keeps the two at least the square root of `squared`
/// apart.
bool heldApart(const std::array<Vector3d, 3>& a, const std::array<Vector3d, 3>& b, double squared)
{
  const Vector3d across = (b[0] - a[0]) + (b[1] - a[1]) + (b[2] - a[2]);
  const double lastA = std::max({ 0.0, across.dot(a[1] - a[0]), across.dot(a[2] - a[0]) });
  const double firstB = std::min({ across.dot(b[0] - a[0]), across.dot(b[1] - a[0]), across.dot(b[2] - a[0]) });
  const double between = firstB - lastA;
  return between > 0.0 && between * between > 1.000001 * squared * across.squaredNorm();
}

/// Lowers `nearest` if the two are nearer to each other.
void compare(const Facet& a, const Facet& b, Nearest& nearest)
{
  const Heights aboveA = a.heightsOf(b.p);
  const Heights aboveB = b.heightsOf(a.p);
  const auto clears = [&](const Heights& heights, const Facet& plane)
  { return heights.clearance > 0.0 && heights.clearance * heights.clearance >= nearest.squared * plane.normalSquared; };
  if (clears(aboveA, a) || clears(aboveB, b))
  {
    return;
  }
  const bool apart = aboveA.clearance > 0.0 || aboveB.clearance > 0.0;
  if (!apart && trianglesMeet(a.p, b.p))
  {
    nearest.found = true;
    nearest.squared = 0.0;
    nearest.onA = a.p[0];
    nearest.onB = b.p[0];
    return;
  }
  const FarParts farA(aboveB, b, nearest.squared);
  const FarParts farB(aboveA, a, nearest.squared);
  cornersToFace(b, a, aboveA.of, true, nearest);
  cornersToFace(a, b, aboveB.of, false, nearest);
  edgesToEdges(a, farA, b, farB, nearest);
  cornersToEdges(a, farA, b, farB, false, nearest);
  cornersToEdges(b, farB, a, farA, true, nearest);
}

struct NodePair
{
  std::uint32_t a;
  std::uint32_t b;
  float squaredDistance;
};

/// Calls visit(place in a, corners of the triangle there, place in b, corners there) for pairs that may be nearer than `nearest`,
/// which visit() may lower, the likely nearest first, until it returns true.
template <typename Visit>
void visitNear(const TriangleTree& a, const TriangleTree& b, const Nearest& nearest, Visit&& visit)
{
  std::array<NodePair, 2 * TriangleTree::maximumDepth + 4> stack;
  std::size_t height = 0;
  if (!a.empty() && !b.empty())
  {
    stack[height++] = { 0, 0, a.nodes()[0].box.squaredDistance(b.nodes()[0].box) };
  }
  while (height > 0)
  {
    const NodePair pair = stack[--height];
    if (pair.squaredDistance > nearest.squared)
    {
      continue;
    }
    // Branch-free, since branches would be mispredicted half the time.
    const TriangleTree::Node& p = a.nodes()[pair.a];
    const TriangleTree::Node& q = b.nodes()[pair.b];
    if (!p.isLeaf() || !q.isLeaf())
    {
      const bool partA = !p.isLeaf() && (q.isLeaf() || p.longestSide >= q.longestSide);
      const std::uint32_t child = partA ? p.first : q.first;
      const TriangleTree::Node* children = (partA ? a : b).nodes().data() + child;
      const FloatBox& whole = (partA ? q : p).box;
      const float first = children[0].box.squaredDistance(whole);
      const float second = children[1].box.squaredDistance(whole);
      const std::uint32_t nearer = child + (second < first ? 1 : 0);
      const std::uint32_t farther = 2 * child + 1 - nearer;
      stack[height] = { partA ? farther : pair.a, partA ? pair.b : farther, std::max(first, second) };
      height += stack[height].squaredDistance <= nearest.squared ? 1 : 0;
      stack[height] = { partA ? nearer : pair.a, partA ? pair.b : nearer, std::min(first, second) };
      height += stack[height].squaredDistance <= nearest.squared ? 1 : 0;
      continue;
    }
    for (std::uint32_t m = p.first; m < p.first + p.count; ++m)
    {
      const FloatBox& box = a.boxes()[m];
      if (box.squaredDistance(q.box) > nearest.squared)
      {
        continue;
      }
      const std::array<Vector3d, 3> cornersA = cornersOf(a, a.order()[m]);
      std::array<std::uint32_t, TriangleTree::leafSize> kept;
      std::size_t count = 0;
      for (std::uint32_t n = q.first; n < q.first + q.count; ++n)
      {
        kept[count] = n;
        count += std::size_t(
          int(box.squaredDistance(b.boxes()[n]) <= nearest.squared) & int(!nearest.areBeyond(cornersA, b.planes()[n])));
      }
      for (std::size_t i = 0; i < count; ++i)
      {
        const std::uint32_t n = kept[i];
        const std::array<Vector3d, 3> cornersB = cornersOf(b, b.order()[n]);
        if (box.squaredDistance(b.boxes()[n]) <= nearest.squared && !nearest.areBeyond(cornersB, a.planes()[m]) &&
            !heldApart(cornersA, cornersB, nearest.squared) && visit(m, cornersA, n, cornersB))
        {
          return;
        }
      }
    }
  }
}

} // namespace

SurfaceGap smallestGap(const TriangleTree& a, const TriangleTree& b, double below)
{
  Nearest nearest(below, heightError(a, b));
  SurfaceGap gap;
  visitNear(a, b, nearest,
    [&](std::uint32_t m, const std::array<Vector3d, 3>& cornersA, std::uint32_t n, const std::array<Vector3d, 3>& cornersB)
    {
      const double before = nearest.squared;
      compare(Facet(cornersA), Facet(cornersB), nearest);
      if (nearest.squared < before)
      {
        gap.triangleA = a.order()[m];
        gap.triangleB = b.order()[n];
      }
      return nearest.found && nearest.squared == 0.0;
    });
  if (nearest.found)
  {
    gap.distance = std::sqrt(nearest.squared);
    gap.pointA = nearest.onA;
    gap.pointB = nearest.onB;
  }
  return gap;
}

std::vector<std::uint32_t> trianglesNear(const TriangleTree& a, const TriangleTree& b, double distance)
{
  std::vector<char> isNear(a.mesh().triangles.size(), 0);
  const Nearest none(distance, heightError(a, b));
  visitNear(a, b, none,
    [&](std::uint32_t m, const std::array<Vector3d, 3>& cornersA, std::uint32_t, const std::array<Vector3d, 3>& cornersB)
    {
      const std::uint32_t s = a.order()[m];
      if (!isNear[s])
      {
        Nearest nearest = none;
        compare(Facet(cornersA), Facet(cornersB), nearest);
        isNear[s] = nearest.found ? 1 : 0;
      }
      return false;
    });
  std::vector<std::uint32_t> triangles;
  for (std::size_t s = 0; s < isNear.size(); ++s)
  {
    if (isNear[s])
    {
      triangles.push_back(static_cast<std::uint32_t>(s));
    }
  }
  return triangles;
}

} // namespace cactus
