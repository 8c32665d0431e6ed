// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cactus
{

/// Triangles between points of a rectangle that contain given edges: a constrained Delaunay triangulation (points one after the
/// other, Lawson 1977; edges by flips, Sloan 1993). Whether a point is left or right of a line or on it is decided exactly, so
/// that the triangles always fill the rectangle without gaps or overlaps; they are Delaunay up to rounding.
class PlaneTriangulation
{
public:
  using Triangle = std::array<std::int32_t, 3>;

  /// Starts with the corners of the box around `lower` and `upper`, which are points 0 to 3, counter-clockwise from `lower`.
  PlaneTriangulation(const Eigen::Vector2d& lower, const Eigen::Vector2d& upper);

  /// Adds a point, and returns its number: that of an existing point at the same place, if there is one. Adding points close to
  /// the previous one is fastest. Throws InvalidInput for one outside the box.
  std::int32_t insert(const Eigen::Vector2d& point);

  /// Makes the line between two points an edge. Throws InvalidInput if it crosses another such edge or runs through a point.
  void insertEdge(std::int32_t from, std::int32_t to);

  /// Returns all triangles, counter-clockwise.
  const std::vector<Triangle>& triangles() const { return this->Corners; }

private:
  /// An edge of a triangle, by the corner opposite to it.
  struct Edge
  {
    std::int32_t triangle;
    int opposite;
  };

  int turn(std::int32_t a, std::int32_t b, std::int32_t c) const;
  bool isInCircle(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) const;
  std::int32_t triangleWith(const Eigen::Vector3d& point);
  int placeOf(std::int32_t triangle, std::int32_t point) const;
  int placeBeside(std::int32_t triangle, std::int32_t neighbour) const;
  void set(std::int32_t triangle, const Triangle& corners, const Triangle& neighbours, const std::array<bool, 3>& fixed);
  void relink(std::int32_t triangle, std::int32_t from, std::int32_t to);
  void splitTriangle(std::int32_t triangle, std::int32_t point);
  void splitEdge(Edge edge, std::int32_t point);
  void flip(Edge edge);
  bool isConvex(Edge edge) const;
  void makeDelaunay(std::vector<Edge>& edges);
  std::vector<std::int32_t> trianglesAt(std::int32_t point) const;
  bool fixIfThere(std::int32_t from, std::int32_t to);
  std::vector<std::array<std::int32_t, 2>> edgesAcross(std::int32_t from, std::int32_t to) const;
  std::vector<Edge> edgesBetween(std::int32_t from, std::int32_t to) const;

  std::vector<Eigen::Vector3d> Points; ///< with 0 as third coordinate
  std::vector<Triangle> Corners;
  std::vector<Triangle> Neighbours;       ///< per corner, the triangle across the edge opposite to it, or -1
  std::vector<std::array<bool, 3>> Fixed; ///< per corner, whether the edge opposite to it is fixed
  std::vector<std::int32_t> TriangleOf;   ///< per point, one of its triangles
  std::int32_t Recent = 0;                ///< start of the search for a point
};

} // namespace cactus
