// SPDX-License-Identifier: BSD-3-Clause
// Images in NIfTI-1 and NIfTI-2: one file, or a header beside its voxels. The format is that of nifti1.h and nifti2.h
// (https://nifti.nimh.nih.gov).
#pragma once

#include "base/Context.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace cactus
{

/// The type of an image's numbers.
enum class NiftiNumber
{
  Int8,
  UInt8,
  Int16,
  UInt16,
  Int32,
  UInt32,
  Int64,
  UInt64,
  Float32,
  Float64
};

/// What the header of an image says. The image has its voxels as in the file: i, j, k along its three axes.
struct NiftiHeader
{
  std::array<std::size_t, 3> size{ { 1, 1, 1 } };
  std::size_t volumes = 1;  ///< of a series, times the numbers of a vector
  std::size_t channels = 1; ///< numbers of a voxel that stand side by side: 3 or 4 of a colour, 2 of a complex number
  NiftiNumber stored = NiftiNumber::UInt8;
  bool isSwapped = false;   ///< its byte order is not this machine's
  bool hasOwnFile = false;  ///< the voxels are in a second file
  std::uint64_t offset = 0; ///< of the voxels, from the beginning of their file
  double slope = 1.0;       ///< a value is slope times the number stored, plus the intercept
  double intercept = 0.0;
  Eigen::Affine3d toScanner = Eigen::Affine3d::Identity(); ///< from i, j, k to mm, x to the right, y to the front, z up

  std::size_t voxels() const { return size[0] * size[1] * size[2]; }
  std::size_t numbersPerVoxel() const { return volumes * channels; }
  bool isScaled() const { return slope != 1.0 || intercept != 0.0; }
  /// The type of its values: that of the numbers stored, unless they are scaled; then Float32, or Float64 for numbers of more
  /// than 16 bits but Float32.
  NiftiNumber valueType() const;
  double valueBytes() const; ///< of all values
};

/// A grid of the same voxels whose axes are those of the file in another order, some of them reversed, so that the first one
/// leads to the right as much as any does, the second to the front and the third up. Its axes form a right-handed system.
struct NiftiGrid
{
  std::array<int, 3> fileAxis{};     ///< axis of the file along each axis
  std::array<bool, 3> isReversed{};  ///< whether it leads backwards
  std::array<std::size_t, 3> size{}; ///< voxels
  Eigen::Vector3d origin, spacing;   ///< middle of its first voxel, edges of a voxel; mm
  Eigen::Matrix3d axes;              ///< columns: directions of the axes, of length 1

  explicit NiftiGrid(const NiftiHeader& header);
};

/// Tells by the content whether the file is such an image, or the header or the voxels of one. A damaged .nii counts, too, if its
/// name has no other dots: the reader then says what is wrong.
bool isNifti(const std::string& path);

/// Returns what these bytes, the beginning of a file called `name`, say. The place is that of the s-form or, where its code is 0,
/// of the q-form, as in nibabel and MRtrix. Throws FileError for a header that cannot be true, and for images that say nothing of
/// their place, have numbers of another type or more than five dimensions.
NiftiHeader parseNiftiHeader(const std::string& bytes, const std::string& name);

/// Reads the header of a file, packed by gzip or not: of an image, or of the header or the voxels of one in two files. Throws
/// FileError as above, and if the file does not hold all voxels.
NiftiHeader readNiftiHeader(const std::string& path);

/// Reads all values, the numbers of each voxel side by side, volumes one after the other, in the order of the grid. `to` has room
/// for voxels() * numbersPerVoxel() numbers of valueType(). Throws FileError and Cancelled.
void readNiftiValues(const std::string& path, const NiftiHeader& header, const NiftiGrid& grid, void* to, const Context& context);

} // namespace cactus
