// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace cactus
{

/// The space of a .trk file's points, from its header.
struct TrkSpace
{
  Eigen::Vector3d dimensions = Eigen::Vector3d::Ones(); ///< of the image, in voxels
  Eigen::Vector3d voxelSizes = Eigen::Vector3d::Ones(); ///< mm
  Eigen::Matrix4d voxelToRas = Eigen::Matrix4d::Zero(); ///< its last number is 0 if it is missing
  std::string voxelOrder;                               ///< such as LPS, with blanks or not; empty if missing
};

/// Returns the map from a file's millimetres, from the corner of the first voxel along the voxel order's axes, to those of the
/// scanner (RAS), in which `voxelToRas` gives the centres of voxels. Missing values are assumed as in nibabel, with a sentence in
/// `remarks` for each. Throws InvalidInput if the axes cannot be determined.
Eigen::Affine3d trkToScanner(TrkSpace space, std::vector<std::string>& remarks);

} // namespace cactus
