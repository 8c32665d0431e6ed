// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cactus
{

/// A regular grid of cubic voxels, x fastest. Sample (i, j, k) lies at origin + spacing · (i, j, k), the centre of its voxel, so
/// that a face of the domain lies half a voxel outside the outermost samples.
struct VoxelGrid
{
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(); ///< µm, the position of sample (0, 0, 0)
  double spacing = 0.1;                             ///< µm
  std::array<int, 3> lower{ { 0, 0, 0 } };          ///< index of the first sample held, per axis
  std::array<int, 3> count{ { 0, 0, 0 } };          ///< number of samples held, per axis

  std::size_t size() const { return std::size_t(count[0]) * std::size_t(count[1]) * std::size_t(count[2]); }
  std::size_t index(int i, int j, int k) const
  {
    return std::size_t(i - lower[0]) +
           std::size_t(count[0]) * (std::size_t(j - lower[1]) + std::size_t(count[1]) * std::size_t(k - lower[2]));
  }
  Eigen::Vector3d position(int i, int j, int k) const { return origin + spacing * Eigen::Vector3d(i, j, k); }
  /// Returns the box (µm) of the samples, of which there is at least one.
  Eigen::AlignedBox3d box() const
  {
    return Eigen::AlignedBox3d(position(lower[0], lower[1], lower[2]),
      position(lower[0] + count[0] - 1, lower[1] + count[1] - 1, lower[2] + count[2] - 1));
  }
};

/// The fibre of each voxel, and its depth in the fibre.
///
/// With `gap` the distance that growth kept between neighbours, the pair gives every fibre i a field on the grid: depth where
/// fibreId is i, and -(depth + gap) where another fibre is. Where fibreId is 0, depth is the largest of all fields; it is not
/// positive. There, a depth above -gap/2 belongs to one fibre, the nearest, and all others have at most -(depth + gap); a lower
/// depth stands for all fibres. The fields of two fibres sum to at most -gap at every sample, so their zero surfaces cannot meet.
/// See FibreField.
struct LabelImage
{
  VoxelGrid grid;
  std::vector<std::int32_t> fibreId; ///< 0 is extra-axonal
  std::vector<float> depth;          ///< µm, positive inside a fibre; never more than the distance to its outer surface
};

/// A view of a label image, or of a part of it; see LabelImage for the meaning of its numbers.
struct LabelImageView
{
  VoxelGrid grid;
  const std::int32_t* fibreId = nullptr;
  const float* depth = nullptr;
  double gap = 0.0; ///< µm, distance that growth kept between two fibres; see FibreRadialGrowthOptions::gap
};

} // namespace cactus
