// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/BoxTree.h"
#include "mesh/TriangleMesh.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cactus
{

/// The plane of a triangle.
struct TrianglePlane
{
  Eigen::Vector3d normal; ///< unit normal, or 0 if the triangle is too thin for a reliable one
  double offset;          ///< of the triangle along the normal, µm

  TrianglePlane(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

  /// Returns the height (µm) above the plane; 0 without a normal.
  double height(const Eigen::Vector3d& point) const { return this->normal.dot(point) - this->offset; }
};

/// A tree of boxes over a surface's triangles, which finds those near something. It also holds the planes of the triangles, which
/// separate most pairs whose boxes are near each other: 32 bytes more per triangle.
class TriangleTree : public BoxTree
{
public:
  /// Includes all triangles of `mesh`, which has to outlive the tree unchanged; its indices have to be valid.
  explicit TriangleTree(const TriangleMesh& mesh);
  /// Includes some of the triangles.
  TriangleTree(const TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles);

  const TriangleMesh& mesh() const { return *this->Mesh; }
  const Eigen::Vector3d& corner(std::uint32_t triangle, int i) const
  {
    return this->Mesh->points[std::size_t(this->Mesh->triangles[triangle][std::size_t(i)])];
  }
  /// Returns the planes of the triangles in order().
  const std::vector<TrianglePlane>& planes() const { return this->Planes; }

private:
  std::vector<TrianglePlane> Planes;
  const TriangleMesh* Mesh;
};

/// Returns an upper bound (µm) of the error of heights of one surface's corners over the planes() of another one, or of the same.
/// For corners far away, add a millionth of their distance.
double heightError(const TriangleTree& a, const TriangleTree& b);

} // namespace cactus
