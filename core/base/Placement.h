// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Constants.h"
#include "base/LengthUnit.h"
#include "base/Properties.h"

#include <Eigen/Core>

#include <array>

namespace cactus
{

/// Where a substrate (µm) lies in the space of an image (mm, scanner coordinates).
struct Placement
{
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity(); ///< columns: the substrate's axes in the image's space
  double scale = micrometre;                          ///< mm in the image per µm of the substrate
  Eigen::Vector3d position = Eigen::Vector3d::Zero(); ///< position of the substrate's origin (mm)

  Eigen::Vector3d toImage(const Eigen::Vector3d& point) const { return this->scale * (this->axes * point) + this->position; }
  /// The reverse, rounded to 2⁻²⁶ µm, so that points that lay in a face of the domain, or in one plane, do so again.
  Eigen::Vector3d toSubstrate(const Eigen::Vector3d& point) const;

  /// The same with lengths of the image's space in another unit than mm.
  Placement in(LengthUnit unit) const;

  /// The affine from µm to mm, row by row.
  std::array<double, 16> matrix() const;
  /// Returns the placement with this matrix. Throws InvalidInput unless it is a rotation with one scale and a position.
  static Placement of(const std::array<double, 16>& matrix);
};

/// How users say where a substrate lies.
enum class PlacementBy
{
  Position,
  Tract ///< where it lies on the tract of its TractFibres
};

/// A placement as users give it: rotated about y, then x, then z, as ParaView's Transform does, then moved.
struct PlacementOptions
{
  PlacementBy by = PlacementBy::Position;
  double positionX = 0.0; ///< mm
  double positionY = 0.0;
  double positionZ = 0.0;
  double rotationX = 0.0; ///< degrees
  double rotationY = 0.0;
  double rotationZ = 0.0;
  double scaleFactor = 1.0; ///< length in the image's space over length in the substrate

  static const PropertyList<PlacementOptions>& properties();
  /// Returns the placement by position, rotation and scale. Throws InvalidInput for options out of range.
  Placement placement() const;
};

} // namespace cactus
