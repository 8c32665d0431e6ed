// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "mesh/VoxelVolumes.h"

#include <cstddef>
#include <vector>

namespace cactus
{

/// Into how many pieces a label of voxels falls.
struct LabelPieces
{
  std::size_t voxels = 0;    ///< with the label
  std::size_t pieces = 0;    ///< of voxels that are connected across faces
  std::size_t connected = 0; ///< voxels in the largest piece of each owner

  /// Part of the voxels that walkers can reach from the largest piece of their owner; 1 without voxels.
  double connectedShare() const { return this->voxels > 0 ? double(this->connected) / double(this->voxels) : 1.0; }
};

/// Counts the pieces of the voxels with `hasLabel`. Voxels of different owners are not connected; an empty `owner` is one owner
/// of all. Mirroring or repeating the voxels at the domain's faces joins a voxel with itself or is not looked at. Throws
/// OutOfMemory and Cancelled.
LabelPieces labelPieces(
  const VoxelBoxes& voxels, const std::vector<bool>& hasLabel, const std::vector<int>& owner = {}, const Context& context = {});

} // namespace cactus
