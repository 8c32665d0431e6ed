// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <vector>

namespace cactus
{

/// Voxels of one size side by side: voxel (i, j, k) extends from origin + spacing·(i, j, k) to origin + spacing·(i + 1, j + 1, k
/// + 1).
struct VoxelBoxes
{
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(); ///< µm, the lower corner of the first voxel
  double spacing = 1.0;                             ///< µm
  std::array<int, 3> count{ { 0, 0, 0 } };

  std::size_t size() const { return std::size_t(count[0]) * std::size_t(count[1]) * std::size_t(count[2]); }
  /// Returns the index of a voxel in a list of all, x fastest.
  std::size_t index(int i, int j, int k) const
  {
    return (std::size_t(k) * std::size_t(count[1]) + std::size_t(j)) * std::size_t(count[0]) + std::size_t(i);
  }
};

/// The volumes of a surface's interior in a block of voxels.
struct VoxelVolumes
{
  std::array<int, 3> lower{ { 0, 0, 0 } }; ///< the first voxel of the block
  std::array<int, 3> count{ { 0, 0, 0 } }; ///< number of voxels in the block
  std::vector<double> volumes;             ///< µm³, x fastest
};

/// Returns the exact volume (up to rounding) of a closed, outward surface in each voxel, for the block of voxels around it.
/// Volume outside all voxels does not count.
///
/// It uses the divergence theorem: triangles are cut along the voxels' faces, and each piece adds the volume between itself and
/// the far side of its row of voxels along x, signed by the side that it faces. Takes time linear in the pieces and in the block.
VoxelVolumes voxelVolumes(const TriangleMesh& mesh, const VoxelBoxes& voxels);

} // namespace cactus
