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

/// Three points over a plane.
struct Heights
{
  std::array<double, 3> of; ///< distances from the plane, times twice the area of the triangle in it
  double clearance = 0.0;   ///< no more than the least of them in size, where all are on one side for sure; else 0
};

/// A triangle with what is asked of it again and again.
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

  /// Another triangle's corners above the plane.
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
    const double rounding = 3e-14 * reach * std::max({ this->edgeSquared[0], this->edgeSquared[1], this->edgeSquared[2] });
    heights.clearance = std::max({ 0.0, least - rounding, -most - rounding });
    return heights;
  }
};

std::array<Vector3d, 3> cornersOf(const TriangleTree& tree, std::uint32_t triangle)
{
  return { { tree.corner(triangle, 0), tree.corner(triangle, 1), tree.corner(triangle, 2) } };
}

/// The nearest of what has been seen.
struct Nearest
{
  double squared;
  Vector3d onA = Vector3d::Zero();
  Vector3d onB = Vector3d::Zero();
  bool found = false;

  /// For parts that do not meet: what rounding makes 0 is not.
  void take(double distanceSquared, const Vector3d& a, const Vector3d& b)
  {
    distanceSquared = std::max(distanceSquared, 1e-300);
    if (distanceSquared < this->squared)
    {
      this->squared = distanceSquared;
      this->onA = a;
      this->onB = b;
      this->found = true;
    }
  }
};

/// Corners of `one` above or below the inside of `face`.
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

/// Corners of `one` against the edges of `other`, ends included.
void cornersToEdges(const Facet& one, const Facet& other, bool swapped, Nearest& nearest)
{
  for (const Vector3d& corner : one.p)
  {
    for (std::size_t j = 0; j < 3; ++j)
    {
      const double length = other.edgeSquared[j];
      const double t = length > 0.0 ? std::clamp(other.edge[j].dot(corner - other.p[j]) / length, 0.0, 1.0) : 0.0;
      const Vector3d foot = other.p[j] + t * other.edge[j];
      nearest.take((foot - corner).squaredNorm(), swapped ? foot : corner, swapped ? corner : foot);
    }
  }
}

/// Edges whose common perpendicular has both its feet inside them; the rest is corners'.
void edgesToEdges(const Facet& a, const Facet& b, Nearest& nearest)
{
  for (std::size_t i = 0; i < 3; ++i)
  {
    for (std::size_t j = 0; j < 3; ++j)
    {
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
      // The foot once more from the other side, which makes up for the rounding of s where the edges are nearly parallel.
      const Vector3d onA = a.p[i] + s * a.edge[i];
      const double t = std::clamp(b.edge[j].dot(onA - b.p[j]) / b.edgeSquared[j], 0.0, 1.0);
      const Vector3d onB = b.p[j] + t * b.edge[j];
      nearest.take((onA - onB).squaredNorm(), onA, onB);
    }
  }
}

/// Whether a plane square to what joins their middles keeps the two at least the square root of `squared` apart.
bool heldApart(const std::array<Vector3d, 3>& a, const std::array<Vector3d, 3>& b, double squared)
{
  const Vector3d across = (b[0] - a[0]) + (b[1] - a[1]) + (b[2] - a[2]);
  const double lastA = std::max({ 0.0, across.dot(a[1] - a[0]), across.dot(a[2] - a[0]) });
  const double firstB = std::min({ across.dot(b[0] - a[0]), across.dot(b[1] - a[0]), across.dot(b[2] - a[0]) });
  const double between = firstB - lastA;
  return between > 0.0 && between * between > 1.000001 * squared * across.squaredNorm();
}

/// Lowers `nearest` where the two are nearer to each other.
void compare(const Facet& a, const std::array<Vector3d, 3>& cornersB, Nearest& nearest)
{
  const Heights aboveA = a.heightsOf(cornersB);
  if (aboveA.clearance > 0.0 && aboveA.clearance * aboveA.clearance >= nearest.squared * a.normalSquared)
  {
    return;
  }
  if (heldApart(a.p, cornersB, nearest.squared))
  {
    return;
  }
  const Facet b(cornersB);
  const Heights aboveB = b.heightsOf(a.p);
  if (aboveB.clearance > 0.0 && aboveB.clearance * aboveB.clearance >= nearest.squared * b.normalSquared)
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
  cornersToFace(b, a, aboveA.of, true, nearest);
  cornersToFace(a, b, aboveB.of, false, nearest);
  edgesToEdges(a, b, nearest);
  cornersToEdges(a, b, false, nearest);
  cornersToEdges(b, a, true, nearest);
}

struct NodePair
{
  std::uint32_t a;
  std::uint32_t b;
  float squaredDistance;
};

/// Calls visit(triangle of a, its facet, triangle of b, its corners) for pairs that may be nearer than the square root of
/// bound(), the likely nearest first, until it returns true.
template <typename Bound, typename Visit>
void visitNear(const TriangleTree& a, const TriangleTree& b, Bound&& bound, Visit&& visit)
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
    if (pair.squaredDistance > bound())
    {
      continue;
    }
    const TriangleTree::Node& p = a.nodes()[pair.a];
    const TriangleTree::Node& q = b.nodes()[pair.b];
    if (!p.isLeaf() || !q.isLeaf())
    {
      const bool partA = !p.isLeaf() && (q.isLeaf() || p.box.longestSide() >= q.box.longestSide());
      const std::uint32_t child = partA ? p.first : q.first;
      NodePair first = partA ? NodePair{ child, pair.b, 0.0F } : NodePair{ pair.a, child, 0.0F };
      NodePair second = partA ? NodePair{ child + 1, pair.b, 0.0F } : NodePair{ pair.a, child + 1, 0.0F };
      first.squaredDistance = a.nodes()[first.a].box.squaredDistance(b.nodes()[first.b].box);
      second.squaredDistance = a.nodes()[second.a].box.squaredDistance(b.nodes()[second.b].box);
      const bool inOrder = first.squaredDistance <= second.squaredDistance;
      stack[height++] = inOrder ? second : first;
      stack[height++] = inOrder ? first : second;
      continue;
    }
    for (std::uint32_t m = p.first; m < p.first + p.count; ++m)
    {
      const std::uint32_t s = a.order()[m];
      const FloatBox& box = a.boxes()[m];
      if (box.squaredDistance(q.box) > bound())
      {
        continue;
      }
      const Facet facet(cornersOf(a, s));
      for (std::uint32_t n = q.first; n < q.first + q.count; ++n)
      {
        const std::uint32_t t = b.order()[n];
        if (box.squaredDistance(b.boxes()[n]) <= bound() && visit(s, facet, t, cornersOf(b, t)))
        {
          return;
        }
      }
    }
  }
}

} // namespace

SurfaceGap triangleGap(const std::array<Vector3d, 3>& a, const std::array<Vector3d, 3>& b, double below)
{
  Nearest nearest{ below * below };
  compare(Facet(a), b, nearest);
  SurfaceGap gap;
  if (nearest.found)
  {
    gap.distance = std::sqrt(nearest.squared);
    gap.pointA = nearest.onA;
    gap.pointB = nearest.onB;
  }
  return gap;
}

SurfaceGap smallestGap(const TriangleTree& a, const TriangleTree& b, double below)
{
  Nearest nearest{ below * below };
  SurfaceGap gap;
  visitNear(
    a, b, [&nearest] { return nearest.squared; },
    [&](std::uint32_t s, const Facet& facetA, std::uint32_t t, const std::array<Vector3d, 3>& cornersB)
    {
      const double before = nearest.squared;
      compare(facetA, cornersB, nearest);
      if (nearest.squared < before)
      {
        gap.triangleA = s;
        gap.triangleB = t;
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
  const double squared = distance * distance;
  visitNear(
    a, b, [squared] { return squared; },
    [&](std::uint32_t s, const Facet& facetA, std::uint32_t, const std::array<Vector3d, 3>& cornersB)
    {
      if (!isNear[s])
      {
        Nearest nearest{ squared };
        compare(facetA, cornersB, nearest);
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
