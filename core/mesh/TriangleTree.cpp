// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/TriangleTree.h"

#include <numeric>

namespace cactus
{

namespace
{

std::vector<std::uint32_t> allOf(const TriangleMesh& mesh)
{
  std::vector<std::uint32_t> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

std::vector<BoxTree::Item> itemsOf(const TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles)
{
  std::vector<BoxTree::Item> items(triangles.size());
  for (std::size_t i = 0; i < items.size(); ++i)
  {
    const auto& t = mesh.triangles[triangles[i]];
    const auto corner = [&](std::size_t c) -> const Eigen::Vector3d& { return mesh.points[std::size_t(t[c])]; };
    items[i] = { FloatBox::around(corner(0), corner(1), corner(2)), triangles[i] };
  }
  return items;
}

} // namespace

TriangleTree::TriangleTree(const TriangleMesh& mesh)
  : TriangleTree(mesh, allOf(mesh))
{
}

TriangleTree::TriangleTree(const TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles)
  : BoxTree(itemsOf(mesh, triangles))
  , Mesh(&mesh)
{
}

} // namespace cactus
