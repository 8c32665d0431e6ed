// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/TriangleTree.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>

namespace cactus
{

namespace
{

/// Twice a triangle's area over its longest edge squared: below this a normal may be wrong by more than 1e-9.
constexpr double leastRatio = 1e-4;

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

TrianglePlane::TrianglePlane(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
  : normal((b - a).cross(c - a))
{
  const double longest = std::max({ (b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm() });
  const double length = this->normal.norm();
  this->normal *= length > leastRatio * longest ? 1.0 / length : 0.0;
  this->offset = this->normal.dot(a);
}

TriangleTree::TriangleTree(const TriangleMesh& mesh)
  : TriangleTree(mesh, allOf(mesh))
{
}

TriangleTree::TriangleTree(const TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles)
  : BoxTree(itemsOf(mesh, triangles))
  , Mesh(&mesh)
{
  this->Planes.reserve(this->order().size());
  for (const std::uint32_t triangle : this->order())
  {
    this->Planes.emplace_back(this->corner(triangle, 0), this->corner(triangle, 1), this->corner(triangle, 2));
  }
}

double heightError(const TriangleTree& a, const TriangleTree& b)
{
  double error = 0.0;
  for (const TriangleTree* tree : { &a, &b })
  {
    if (!tree->empty())
    {
      const BoxTree::Node& root = tree->nodes()[0];
      error += 1e-9 * root.longestSide + 1e-14 * root.box.lower.abs().max(root.box.upper.abs()).maxCoeff();
    }
  }
  return error;
}

} // namespace cactus
