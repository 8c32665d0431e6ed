// SPDX-License-Identifier: BSD-3-Clause
#include "io/TrkOrientation.h"

#include "base/Error.h"

#include <Eigen/SVD>

#include <algorithm>
#include <array>
#include <cmath>

namespace cactus
{

namespace
{

/// The axis of the scanner along which each axis of voxels leads, and its sense.
struct Orientation
{
  std::array<int, 3> axis{ { 0, 1, 2 } };
  std::array<double, 3> sense{ { 1.0, 1.0, 1.0 } };
};

/// Returns that of a matrix from voxels to the scanner: its nearest rotation tells which axes are closest, the strongest first.
Orientation orientationOf(const Eigen::Matrix3d& matrix)
{
  Eigen::Matrix3d directions = matrix;
  for (int voxelAxis = 0; voxelAxis < 3; ++voxelAxis)
  {
    const double length = directions.col(voxelAxis).norm();
    directions.col(voxelAxis) /= length > 0.0 ? length : 1.0;
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> parts(directions, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d nearest = parts.matrixU() * parts.matrixV().transpose();
  if (!nearest.allFinite() || parts.singularValues()[2] <= 1e-6)
  {
    throw InvalidInput("its vox_to_ras has no inverse, so that the axes of its voxels cannot be told: it is damaged");
  }
  Orientation orientation;
  std::array<bool, 3> taken{};
  for (int voxelAxis = 0; voxelAxis < 3; ++voxelAxis)
  {
    int closest = -1;
    for (int axis = 0; axis < 3; ++axis)
    {
      if (!taken[std::size_t(axis)] &&
          (closest < 0 || std::abs(nearest(axis, voxelAxis)) > std::abs(nearest(closest, voxelAxis))))
      {
        closest = axis;
      }
    }
    taken[std::size_t(closest)] = true;
    orientation.axis[std::size_t(voxelAxis)] = closest;
    orientation.sense[std::size_t(voxelAxis)] = nearest(closest, voxelAxis) < 0.0 ? -1.0 : 1.0;
  }
  return orientation;
}

/// Returns that of three letters, each of which gives an axis: L or R, A or P, S or I.
Orientation orientationOf(const std::string& order)
{
  Orientation orientation;
  std::array<bool, 3> taken{};
  for (std::size_t i = 0; i < 3; ++i)
  {
    const std::size_t place = i < order.size() ? std::string("RLAPSIrlapsi").find(order[i]) : std::string::npos;
    const std::size_t axis = place == std::string::npos ? 0 : place % 6 / 2;
    if (place == std::string::npos || order.size() != 3 || taken[axis])
    {
      throw InvalidInput("its voxel_order is '" + excerpt(order) + "': expected one letter each of LR, AP and SI");
    }
    taken[axis] = true;
    orientation.axis[i] = int(axis);
    orientation.sense[i] = place % 2 == 0 ? 1.0 : -1.0;
  }
  return orientation;
}

} // namespace

Eigen::Affine3d trkToScanner(TrkSpace space, std::vector<std::string>& remarks)
{
  if (!space.voxelSizes.allFinite() || space.voxelSizes.minCoeff() <= 0.0)
  {
    throw InvalidInput("its voxel sizes are not all above 0: it is damaged");
  }
  if (space.voxelToRas(3, 3) == 0.0)
  {
    remarks.emplace_back("its header has no vox_to_ras, which is taken as the identity");
    space.voxelToRas.setIdentity();
  }
  std::string letters = space.voxelOrder;
  letters.erase(std::remove(letters.begin(), letters.end(), ' '), letters.end());
  if (letters != space.voxelOrder && !letters.empty())
  {
    remarks.push_back("its voxel_order '" + excerpt(space.voxelOrder) + "' has blanks, which are left out");
  }
  space.voxelOrder = letters;
  if (space.voxelOrder.empty())
  {
    remarks.emplace_back("its header has no voxel_order, which is taken as LPS");
    space.voxelOrder = "LPS";
  }
  if (!space.voxelToRas.allFinite())
  {
    throw InvalidInput("its vox_to_ras holds what is no number: it is damaged");
  }
  const Orientation file = orientationOf(space.voxelOrder);
  const Orientation image = orientationOf(Eigen::Matrix3d(space.voxelToRas.topLeftCorner<3, 3>()));
  // From the file's voxels to those of vox_to_ras, as in nibabel: if axes are not only flipped but also permuted, the format does
  // not say which of the two is meant, and files follow the existing readers.
  Eigen::Affine3d turn = Eigen::Affine3d::Identity();
  turn.linear().setZero();
  for (std::size_t i = 0; i < 3; ++i)
  {
    for (std::size_t j = 0; j < 3; ++j)
    {
      if (image.axis[i] == file.axis[j])
      {
        const double sense = image.sense[i] * file.sense[j];
        turn.linear()(Eigen::Index(j), Eigen::Index(i)) = sense;
        turn.translation()[Eigen::Index(j)] = sense < 0.0 ? space.dimensions[Eigen::Index(j)] - 1.0 : 0.0;
      }
    }
  }
  Eigen::Affine3d toVoxels = Eigen::Affine3d::Identity();
  toVoxels.linear() = space.voxelSizes.cwiseInverse().asDiagonal();
  toVoxels.translation().setConstant(-0.5);
  Eigen::Affine3d toScanner;
  toScanner.matrix() = space.voxelToRas;
  toScanner.makeAffine();
  return toScanner * turn * toVoxels;
}

} // namespace cactus
