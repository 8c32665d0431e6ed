// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/PlaneTriangulation.h"

#include "base/Error.h"
#include "mesh/ExactPredicates.h"

#include <algorithm>
#include <cmath>
#include <deque>

namespace cactus
{

namespace
{

constexpr int acrossPlane = 2; ///< the axis across the plane

int after(int corner)
{
  return (corner + 1) % 3;
}

int before(int corner)
{
  return (corner + 2) % 3;
}

} // namespace

PlaneTriangulation::PlaneTriangulation(const Eigen::Vector2d& lower, const Eigen::Vector2d& upper)
  : Points{ { lower[0], lower[1], 0.0 }, { upper[0], lower[1], 0.0 }, { upper[0], upper[1], 0.0 }, { lower[0], upper[1], 0.0 } }
  , Corners(2)
  , Neighbours(2)
  , Fixed(2)
  , TriangleOf(4, 0)
{
  this->set(0, { { 0, 1, 2 } }, { { -1, 1, -1 } }, { { false, false, false } });
  this->set(1, { { 0, 2, 3 } }, { { -1, -1, 0 } }, { { false, false, false } });
}

std::int32_t PlaneTriangulation::insert(const Eigen::Vector2d& place)
{
  const Eigen::Vector3d point(place[0], place[1], 0.0);
  const std::int32_t triangle = this->triangleWith(point);
  const Triangle corners = this->Corners[std::size_t(triangle)];
  for (const std::int32_t corner : corners)
  {
    if (this->Points[std::size_t(corner)] == point)
    {
      return corner;
    }
  }
  const auto number = static_cast<std::int32_t>(this->Points.size());
  this->Points.push_back(point);
  this->TriangleOf.push_back(triangle);
  for (int i = 0; i < 3; ++i)
  {
    if (this->turn(corners[std::size_t(after(i))], corners[std::size_t(before(i))], number) == 0)
    {
      this->splitEdge({ triangle, i }, number);
      return number;
    }
  }
  this->splitTriangle(triangle, number);
  return number;
}

void PlaneTriangulation::insertEdge(std::int32_t from, std::int32_t to)
{
  if (this->fixIfThere(from, to))
  {
    return;
  }
  const auto found = this->edgesAcross(from, to);
  std::deque<std::array<std::int32_t, 2>> across(found.begin(), found.end());
  std::vector<std::array<std::int32_t, 2>> made;
  while (!across.empty())
  {
    const auto [a, b] = across.front();
    across.pop_front();
    const Edge edge = this->edgesBetween(a, b).front();
    if (!this->isConvex(edge))
    {
      across.push_back({ { a, b } }); // possible once other edges are flipped
      continue;
    }
    const std::int32_t one = this->Corners[std::size_t(edge.triangle)][std::size_t(edge.opposite)];
    const std::int32_t next = this->Neighbours[std::size_t(edge.triangle)][std::size_t(edge.opposite)];
    const std::int32_t other = this->Corners[std::size_t(next)][std::size_t(this->placeBeside(next, edge.triangle))];
    this->flip(edge);
    const bool isAtEnd = one == from || one == to || other == from || other == to;
    if (!isAtEnd && this->turn(from, to, one) * this->turn(from, to, other) < 0)
    {
      across.push_back({ { one, other } });
    }
    else
    {
      made.push_back({ { one, other } });
    }
  }
  this->fixIfThere(from, to);
  for (const auto& [a, b] : made)
  {
    std::vector<Edge> edges = this->edgesBetween(a, b); // it may have been flipped since
    this->makeDelaunay(edges);
  }
}

/// Returns 1 if a, b, c run counter-clockwise, -1 if clockwise, 0 if they lie on one line.
int PlaneTriangulation::turn(std::int32_t a, std::int32_t b, std::int32_t c) const
{
  return orientationAlong(acrossPlane, this->Points[std::size_t(a)], this->Points[std::size_t(b)], this->Points[std::size_t(c)]);
}

/// Tells whether d lies clearly inside the circle through a, b, c, which run counter-clockwise.
bool PlaneTriangulation::isInCircle(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) const
{
  const Eigen::Vector3d& origin = this->Points[std::size_t(d)];
  const Eigen::Vector3d p = this->Points[std::size_t(a)] - origin;
  const Eigen::Vector3d q = this->Points[std::size_t(b)] - origin;
  const Eigen::Vector3d r = this->Points[std::size_t(c)] - origin;
  const double qr[2] = { q[0] * r[1], q[1] * r[0] };
  const double rp[2] = { r[0] * p[1], r[1] * p[0] };
  const double pq[2] = { p[0] * q[1], p[1] * q[0] };
  const double value = p.squaredNorm() * (qr[0] - qr[1]) + q.squaredNorm() * (rp[0] - rp[1]) + r.squaredNorm() * (pq[0] - pq[1]);
  const double size = p.squaredNorm() * (std::fabs(qr[0]) + std::fabs(qr[1])) +
                      q.squaredNorm() * (std::fabs(rp[0]) + std::fabs(rp[1])) +
                      r.squaredNorm() * (std::fabs(pq[0]) + std::fabs(pq[1]));
  constexpr double bound = 2e-15; // bound of its rounding (Shewchuk 1997); edges within it are left alone, so that flips end
  return value > bound * size;
}

/// Finds a triangle that contains a point, inside or on its border, by a walk from the last one found.
std::int32_t PlaneTriangulation::triangleWith(const Eigen::Vector3d& point)
{
  const auto wayOut = [&](std::int32_t t)
  {
    const Triangle& corners = this->Corners[std::size_t(t)];
    for (int i = 0; i < 3; ++i)
    {
      const Eigen::Vector3d& a = this->Points[std::size_t(corners[std::size_t(after(i))])];
      const Eigen::Vector3d& b = this->Points[std::size_t(corners[std::size_t(before(i))])];
      if (orientationAlong(acrossPlane, a, b, point) < 0)
      {
        return i;
      }
    }
    return -1;
  };
  std::int32_t triangle = this->Recent;
  // Among triangles that are not Delaunay, a walk may be cyclic.
  for (std::size_t step = 0; step < this->Corners.size(); ++step)
  {
    const int i = wayOut(triangle);
    if (i < 0)
    {
      this->Recent = triangle;
      return triangle;
    }
    triangle = this->Neighbours[std::size_t(triangle)][std::size_t(i)];
    if (triangle < 0)
    {
      throw InvalidInput(
        text("the point ", point[0], " ", point[1], " lies outside the rectangle that is to be cut into triangles"));
    }
  }
  for (std::size_t t = 0; t < this->Corners.size(); ++t)
  {
    if (wayOut(static_cast<std::int32_t>(t)) < 0)
    {
      return static_cast<std::int32_t>(t);
    }
  }
  throw InvalidInput("a point lies outside the rectangle that is to be cut into triangles");
}

int PlaneTriangulation::placeOf(std::int32_t triangle, std::int32_t point) const
{
  const Triangle& corners = this->Corners[std::size_t(triangle)];
  return static_cast<int>(std::find(corners.begin(), corners.end(), point) - corners.begin());
}

int PlaneTriangulation::placeBeside(std::int32_t triangle, std::int32_t neighbour) const
{
  const Triangle& neighbours = this->Neighbours[std::size_t(triangle)];
  return static_cast<int>(std::find(neighbours.begin(), neighbours.end(), neighbour) - neighbours.begin());
}

void PlaneTriangulation::set(
  std::int32_t triangle, const Triangle& corners, const Triangle& neighbours, const std::array<bool, 3>& fixed)
{
  this->Corners[std::size_t(triangle)] = corners;
  this->Neighbours[std::size_t(triangle)] = neighbours;
  this->Fixed[std::size_t(triangle)] = fixed;
  for (const std::int32_t corner : corners)
  {
    this->TriangleOf[std::size_t(corner)] = triangle;
  }
}

/// Replaces neighbour `from` of a triangle, if there is one, by `to`.
void PlaneTriangulation::relink(std::int32_t triangle, std::int32_t from, std::int32_t to)
{
  if (triangle >= 0)
  {
    this->Neighbours[std::size_t(triangle)][std::size_t(this->placeBeside(triangle, from))] = to;
  }
}

void PlaneTriangulation::splitTriangle(std::int32_t triangle, std::int32_t point)
{
  const Triangle corners = this->Corners[std::size_t(triangle)];
  const Triangle neighbours = this->Neighbours[std::size_t(triangle)];
  const std::array<bool, 3> fixed = this->Fixed[std::size_t(triangle)];
  const auto first = static_cast<std::int32_t>(this->Corners.size());
  const Triangle parts{ { triangle, first, first + 1 } }; // each at the edge opposite to a corner
  this->Corners.resize(this->Corners.size() + 2);
  this->Neighbours.resize(this->Corners.size());
  this->Fixed.resize(this->Corners.size());
  std::vector<Edge> edges;
  for (int i = 0; i < 3; ++i)
  {
    const auto j = std::size_t(after(i));
    const auto k = std::size_t(before(i));
    const std::int32_t part = parts[std::size_t(i)];
    this->relink(neighbours[std::size_t(i)], triangle, part);
    this->set(part, { { point, corners[j], corners[k] } }, { { neighbours[std::size_t(i)], parts[j], parts[k] } },
      { { fixed[std::size_t(i)], false, false } });
    edges.push_back({ part, 0 });
  }
  this->makeDelaunay(edges);
}

void PlaneTriangulation::splitEdge(Edge edge, std::int32_t point)
{
  std::vector<Edge> edges;
  const std::int32_t other = this->Neighbours[std::size_t(edge.triangle)][std::size_t(edge.opposite)];
  const int beside = other < 0 ? 0 : this->placeBeside(other, edge.triangle);
  const auto first = static_cast<std::int32_t>(this->Corners.size());
  const std::int32_t added = other < 0 ? 1 : 2;
  this->Corners.resize(this->Corners.size() + std::size_t(added));
  this->Neighbours.resize(this->Corners.size());
  this->Fixed.resize(this->Corners.size());
  // In each triangle the part before the point keeps its index, the part behind it is new; `far` is the other triangle's part at
  // the end of the edge.
  const auto halve = [&](std::int32_t t, int top, std::int32_t fresh, std::int32_t farOfStart, std::int32_t farOfEnd)
  {
    const Triangle corners = this->Corners[std::size_t(t)];
    const Triangle neighbours = this->Neighbours[std::size_t(t)];
    const std::array<bool, 3> fixed = this->Fixed[std::size_t(t)];
    const auto i = std::size_t(top);
    const auto j = std::size_t(after(top));
    const auto k = std::size_t(before(top));
    this->relink(neighbours[j], t, fresh);
    this->set(
      t, { { corners[i], corners[j], point } }, { { farOfStart, fresh, neighbours[k] } }, { { fixed[i], false, fixed[k] } });
    this->set(
      fresh, { { corners[i], point, corners[k] } }, { { farOfEnd, neighbours[j], t } }, { { fixed[i], fixed[j], false } });
    edges.push_back({ t, 2 });
    edges.push_back({ fresh, 1 });
  };
  // The edge's start in the one triangle is its end in the other.
  halve(edge.triangle, edge.opposite, first, other < 0 ? -1 : first + 1, other);
  if (other >= 0)
  {
    halve(other, beside, first + 1, first, edge.triangle);
  }
  this->makeDelaunay(edges);
}

/// Replaces an edge by the one between the two corners opposite to it. Precondition: isConvex().
void PlaneTriangulation::flip(Edge edge)
{
  const std::int32_t one = edge.triangle;
  const auto i = std::size_t(edge.opposite);
  const auto j = std::size_t(after(edge.opposite));
  const auto k = std::size_t(before(edge.opposite));
  const std::int32_t other = this->Neighbours[std::size_t(one)][i];
  const int beside = this->placeBeside(other, one);
  const auto u = std::size_t(beside);
  const auto v = std::size_t(after(beside));
  const auto w = std::size_t(before(beside));
  const Triangle p = this->Corners[std::size_t(one)];
  const Triangle q = this->Corners[std::size_t(other)];
  const Triangle pn = this->Neighbours[std::size_t(one)];
  const Triangle qn = this->Neighbours[std::size_t(other)];
  const std::array<bool, 3> pf = this->Fixed[std::size_t(one)];
  const std::array<bool, 3> qf = this->Fixed[std::size_t(other)];
  // p[j] is q[w], and p[k] is q[v].
  this->relink(pn[j], one, other);
  this->relink(qn[v], other, one);
  this->set(one, { { p[i], p[j], q[u] } }, { { qn[v], other, pn[k] } }, { { qf[v], false, pf[k] } });
  this->set(other, { { q[u], q[v], p[i] } }, { { pn[j], one, qn[w] } }, { { pf[j], false, qf[w] } });
}

/// Tells whether the two triangles at an edge form a convex quadrilateral.
bool PlaneTriangulation::isConvex(Edge edge) const
{
  const Triangle& p = this->Corners[std::size_t(edge.triangle)];
  const std::int32_t other = this->Neighbours[std::size_t(edge.triangle)][std::size_t(edge.opposite)];
  const std::int32_t top = p[std::size_t(edge.opposite)];
  const std::int32_t start = p[std::size_t(after(edge.opposite))];
  const std::int32_t end = p[std::size_t(before(edge.opposite))];
  const std::int32_t bottom = this->Corners[std::size_t(other)][std::size_t(this->placeBeside(other, edge.triangle))];
  return this->turn(top, start, bottom) > 0 && this->turn(bottom, end, top) > 0;
}

/// Flips edges, and those around them, until all are Delaunay or fixed.
void PlaneTriangulation::makeDelaunay(std::vector<Edge>& edges)
{
  while (!edges.empty())
  {
    const Edge edge = edges.back();
    edges.pop_back();
    const auto i = std::size_t(edge.opposite);
    const std::int32_t other = this->Neighbours[std::size_t(edge.triangle)][i];
    if (other < 0 || this->Fixed[std::size_t(edge.triangle)][i])
    {
      continue;
    }
    const Triangle& p = this->Corners[std::size_t(edge.triangle)];
    const std::int32_t bottom = this->Corners[std::size_t(other)][std::size_t(this->placeBeside(other, edge.triangle))];
    if (this->isInCircle(p[0], p[1], p[2], bottom) && this->isConvex(edge))
    {
      this->flip(edge);
      edges.insert(edges.end(), { { edge.triangle, 0 }, { edge.triangle, 2 }, { other, 0 }, { other, 2 } });
    }
  }
}

std::vector<std::int32_t> PlaneTriangulation::trianglesAt(std::int32_t point) const
{
  const std::int32_t first = this->TriangleOf[std::size_t(point)];
  std::vector<std::int32_t> found{ first };
  for (const bool isForward : { true, false })
  {
    for (std::int32_t t = first;;)
    {
      const int i = this->placeOf(t, point);
      t = this->Neighbours[std::size_t(t)][std::size_t(isForward ? after(i) : before(i))];
      if (t < 0)
      {
        break;
      }
      if (t == first)
      {
        return found;
      }
      found.push_back(t);
    }
  }
  return found;
}

/// Fixes an edge. Returns false if there is none between these points.
bool PlaneTriangulation::fixIfThere(std::int32_t from, std::int32_t to)
{
  const std::vector<Edge> edges = this->edgesBetween(from, to);
  for (const Edge& edge : edges)
  {
    this->Fixed[std::size_t(edge.triangle)][std::size_t(edge.opposite)] = true;
  }
  return !edges.empty();
}

/// Returns the edges that the line between two points crosses.
std::vector<std::array<std::int32_t, 2>> PlaneTriangulation::edgesAcross(std::int32_t from, std::int32_t to) const
{
  const auto refuse = [] { throw InvalidInput("two outlines on a face of the domain cross or touch each other"); };
  Edge edge{ -1, 0 };
  for (const std::int32_t t : this->trianglesAt(from))
  {
    const int i = this->placeOf(t, from);
    const Triangle& corners = this->Corners[std::size_t(t)];
    const int right = this->turn(from, to, corners[std::size_t(after(i))]);
    const int left = this->turn(from, to, corners[std::size_t(before(i))]);
    if (right < 0 && left > 0)
    {
      edge = { t, i };
    }
  }
  if (edge.triangle < 0)
  {
    refuse(); // along another edge, through a point
  }
  std::vector<std::array<std::int32_t, 2>> across;
  for (;;)
  {
    const Triangle& corners = this->Corners[std::size_t(edge.triangle)];
    const std::int32_t right = corners[std::size_t(after(edge.opposite))];
    const std::int32_t left = corners[std::size_t(before(edge.opposite))];
    const std::int32_t next = this->Neighbours[std::size_t(edge.triangle)][std::size_t(edge.opposite)];
    if (next < 0 || this->Fixed[std::size_t(edge.triangle)][std::size_t(edge.opposite)])
    {
      refuse();
    }
    across.push_back({ { right, left } });
    const std::int32_t beyond = this->Corners[std::size_t(next)][std::size_t(this->placeBeside(next, edge.triangle))];
    if (beyond == to)
    {
      return across;
    }
    const int side = this->turn(from, to, beyond);
    if (side == 0)
    {
      refuse();
    }
    // Continues through the edge of the next triangle whose ends lie on both sides.
    edge = { next, this->placeOf(next, side > 0 ? left : right) };
  }
}

/// Returns that edge as seen from its triangles; none if it does not exist.
std::vector<PlaneTriangulation::Edge> PlaneTriangulation::edgesBetween(std::int32_t from, std::int32_t to) const
{
  std::vector<Edge> edges;
  for (const std::int32_t t : this->trianglesAt(from))
  {
    const int end = this->placeOf(t, to);
    if (end < 3)
    {
      edges.push_back({ t, 3 - end - this->placeOf(t, from) });
    }
  }
  return edges;
}

} // namespace cactus
