// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace cactus
{

/// What a .trk file's header says of the space that its points are in.
struct TrkSpace
{
  Eigen::Vector3d dimensions = Eigen::Vector3d::Ones(); ///< of the image, in voxels
  Eigen::Vector3d voxelSizes = Eigen::Vector3d::Ones(); ///< mm
  Eigen::Matrix4d voxelToRas = Eigen::Matrix4d::Zero(); ///< its last number is 0 where it is not said
  std::string voxelOrder;                               ///< such as LPS; empty where it is not said
};

/// The map from a file's millimetres, which count from the corner of the first voxel along the voxel order's axes, to those of
/// the scanner (RAS), which `voxelToRas` has the centres of voxels in. What is not said is assumed as nibabel does, and `remarks`
/// get a sentence for each. Throws InvalidInput where the axes cannot be told.
Eigen::Affine3d trkToScanner(TrkSpace space, std::vector<std::string>& remarks);

} // namespace cactus
