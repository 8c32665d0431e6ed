// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace cactus
{

/// A triangle surface (µm). Corners run counter-clockwise seen from outside, so that normals point outward.
struct TriangleMesh
{
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
};

/// Tells whether two meshes are the same, to the bit.
inline bool areSame(const TriangleMesh& a, const TriangleMesh& b)
{
  return a.triangles == b.triangles && a.points == b.points;
}

} // namespace cactus
