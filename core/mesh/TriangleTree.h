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
  Eigen::Vector3d normal; ///< as long as 1, or 0 where the triangle is too thin to have one for sure
  double offset;          ///< of the triangle along it, µm

  TrianglePlane(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

  /// µm; 0 where there is no normal.
  double height(const Eigen::Vector3d& point) const { return this->normal.dot(point) - this->offset; }
};

/// A tree of boxes over a surface's triangles, for everything that asks which triangles are near something. With the planes of
/// the triangles, which tell most of those apart whose boxes are near each other: 32 bytes more a triangle.
class TriangleTree : public BoxTree
{
public:
  /// Over all triangles of `mesh`, which has to outlive the tree and stay as it is; its indices have to be valid.
  explicit TriangleTree(const TriangleMesh& mesh);
  /// Over some of them.
  TriangleTree(const TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles);

  const TriangleMesh& mesh() const { return *this->Mesh; }
  const Eigen::Vector3d& corner(std::uint32_t triangle, int i) const
  {
    return this->Mesh->points[std::size_t(this->Mesh->triangles[triangle][std::size_t(i)])];
  }
  /// Of the triangles in order().
  const std::vector<TrianglePlane>& planes() const { return this->Planes; }

private:
  std::vector<TrianglePlane> Planes;
  const TriangleMesh* Mesh;
};

/// What heights of corners of one surface over the planes() of another one, or of the same, may be wrong by, at most (µm). More
/// than a millionth of a distance beside that is safe for corners far away.
double heightError(const TriangleTree& a, const TriangleTree& b);

} // namespace cactus
