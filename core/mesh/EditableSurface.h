// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/CappedSurface.h"
#include "mesh/TriangleShape.h"

#include <cstdint>
#include <vector>

namespace cactus
{

/// A closed surface whose edges can be collapsed, flipped and split while it stays a closed 2-manifold of the same topology.
///
/// A corner is number 3 · triangle + place of a point in a triangle. Those of a point are linked in a list:
///
///     for (std::int32_t c = surface.firstCorner(p); c >= 0; c = surface.nextCorner(c))
///
/// Triangles that a collapse removes stay in their place, dead, until compact().
class EditableSurface
{
public:
  /// Works on the surface in place; nobody else may change it before compact().
  explicit EditableSurface(CappedSurface& surface);

  std::size_t pointCount() const { return this->First.size(); }
  std::size_t triangleCount() const { return this->Next.size() / 3; }
  std::size_t aliveCount() const { return this->Alive; }

  const Eigen::Vector3d& at(std::int32_t point) const { return this->Points[point]; }
  std::uint8_t facesOf(std::int32_t point) const { return this->Faces[point]; }
  const std::array<std::int32_t, 3>& cornersOf(std::size_t triangle) const { return this->Triangles[triangle]; }
  /// Returns the outward normal of a triangle, as long as twice its area: the product of the edges at its first corner.
  const Eigen::Vector3d& normalOf(std::size_t triangle) const { return this->Normals[triangle]; }
  /// As TriangleShape has it.
  double flatnessOf(std::size_t triangle) const
  {
    const auto& t = this->cornersOf(triangle);
    return shapeOf(this->at(t[0]), this->at(t[1]), this->at(t[2])).flatness;
  }
  bool isDead(std::size_t triangle) const { return this->cornersOf(triangle)[0] < 0; }
  bool isDeadPoint(std::int32_t point) const { return this->firstCorner(point) < 0; }
  bool isCap(const std::array<std::int32_t, 3>& corners) const
  {
    return (this->Faces[corners[0]] & this->Faces[corners[1]] & this->Faces[corners[2]]) != 0;
  }

  /// Tells whether a point, or the edge between two triangles, is part of a rim in a held face, see CappedSurface.
  bool isHeldRim(std::int32_t point) const;
  bool isHeldRim(std::int32_t a, std::int32_t b) const;
  bool hasHeldFaces() const { return this->Surface.held != 0; }
  bool isToStay(std::int32_t point) const { return this->Surface.isToStay(point); }

  /// Returns the other two points of a corner's triangle, in its orientation.
  std::array<std::int32_t, 2> oppositeEdge(std::int32_t corner) const
  {
    const auto& corners = this->cornersOf(std::size_t(corner) / 3);
    const std::size_t i = std::size_t(corner) % 3;
    return { { corners[i == 2 ? 0 : i + 1], corners[i == 0 ? 2 : i - 1] } };
  }

  /// Tells whether a triangle at u or v, given by the edge opposite to that corner, remains when u and v are merged.
  static bool outlivesCollapse(const std::array<std::int32_t, 2>& edge, std::int32_t u, std::int32_t v)
  {
    return edge[0] != u && edge[0] != v && edge[1] != u && edge[1] != v;
  }

  std::int32_t firstCorner(std::int32_t point) const { return this->First[std::size_t(point)]; }
  std::int32_t nextCorner(std::int32_t corner) const { return this->Next[std::size_t(corner)]; }

  /// Calls visit(corner, point) for the corners of u and then those of v, until it returns true. Returns whether it did. A
  /// triangle at both comes twice.
  template <typename Visit>
  bool visitCornersAt(std::int32_t u, std::int32_t v, Visit&& visit) const;

  /// Tells whether two points are the ends of an edge.
  bool areLinked(std::int32_t u, std::int32_t v) const;
  /// Returns how many triangles meet at a point.
  int valence(std::int32_t point) const;
  /// Returns the triangle that runs through an edge from `from` to `to`. Throws std::logic_error if there is none, as in a
  /// surface that is not closed.
  std::size_t triangleAlong(std::int32_t from, std::int32_t to) const;
  /// Tells whether an edge can be collapsed: the common neighbours of both ends are just the two opposite points of the edge's
  /// triangles, and the surface is no tetrahedron.
  bool isCollapsible(std::int32_t u, std::int32_t v);

  /// Merges u and v into u, at `place`. Precondition: isCollapsible().
  void collapse(std::int32_t u, std::int32_t v, const Eigen::Vector3d& place);
  /// Replaces the common edge of two triangles, a to b in `one` and b to a in `other`, by the edge between their opposite points.
  /// Precondition: these are not linked.
  void flip(std::size_t one, std::size_t other, std::int32_t a, std::int32_t b);
  /// Halves the edge of two points, and its triangles, by a new point at `place`, which lies on the faces of the box that both
  /// lie on. Returns that point.
  std::int32_t split(std::int32_t a, std::int32_t b, const Eigen::Vector3d& place);
  /// Replaces the triangles of a disc, whose border is `loop` in their sense, by a fan about a new point at `place`, which lies
  /// on the faces of the box that all of them lie on. Returns that point.
  std::int32_t fan(const std::vector<std::size_t>& disc, const std::vector<std::int32_t>& loop, const Eigen::Vector3d& place);
  void move(std::int32_t point, const Eigen::Vector3d& place);
  /// Removes dead triangles and points. Points are numbered by their first use; the object must not be used afterwards.
  void compact();

  /// Returns the corner of a triangle that is neither of two others.
  std::int32_t thirdCorner(std::size_t triangle, std::int32_t a, std::int32_t b) const;

private:
  std::int32_t addPoint(const Eigen::Vector3d& place, std::uint8_t faces);
  std::size_t addTriangle(const std::array<std::int32_t, 3>& corners);
  /// Where things lie now. To be called whenever one of the surface's vectors has grown.
  void locate();
  void findNormal(std::size_t triangle);
  void findNormalsAt(std::int32_t point);
  void link(std::size_t triangle);
  void unlink(std::size_t triangle);
  void unlink(std::int32_t point, std::int32_t corner);

  CappedSurface& Surface;
  // Addresses of the surface's vectors, for tight loops; see locate().
  Eigen::Vector3d* Points = nullptr;
  std::array<std::int32_t, 3>* Triangles = nullptr;
  std::uint8_t* Faces = nullptr;
  std::vector<Eigen::Vector3d> Normals; ///< per triangle
  std::vector<std::int32_t> First;      ///< per point, one of its corners, or -1
  std::vector<std::int32_t> Next;       ///< per corner, the next one of the same point, or -1
  std::vector<int> Mark;                ///< per point, used by isCollapsible()
  int MarkValue = 0;
  std::size_t Alive;
};

template <typename Visit>
bool EditableSurface::visitCornersAt(std::int32_t u, std::int32_t v, Visit&& visit) const
{
  for (const std::int32_t point : { u, v })
  {
    for (std::int32_t c = this->firstCorner(point); c >= 0; c = this->nextCorner(c))
    {
      if (visit(c, point))
      {
        return true;
      }
    }
  }
  return false;
}

} // namespace cactus
