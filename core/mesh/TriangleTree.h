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

/// A tree of boxes over a surface's triangles, for everything that asks which triangles are near something.
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

private:
  const TriangleMesh* Mesh;
};

} // namespace cactus
