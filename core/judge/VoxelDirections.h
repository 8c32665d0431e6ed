// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"
#include "mesh/VoxelVolumes.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace cactus
{

/// A fibre's directions in each voxel of a block: means over the directions d of its centre line.
struct VoxelDirections
{
  std::vector<Eigen::Matrix3d> tensors;       ///< of d·dᵀ (trace 1)
  std::vector<std::vector<double>> harmonics; ///< of harmonicsAt(d); empty without an order, and without a fibre
};

/// Averages over the part of the centre line in the voxel; if it does not pass through the voxel, uses the segment closest to the
/// voxel's middle. Only voxels in which `block` has a volume above 0 are computed. `order` of spherical harmonics; below 0 for
/// none.
VoxelDirections voxelDirections(
  const Fibres& fibres, std::size_t fibre, const VoxelBoxes& voxels, const VoxelVolumes& block, int order = -1);

} // namespace cactus
