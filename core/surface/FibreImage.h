// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "growth/LabelImage.h"
#include "surface/FibreField.h"

#include <cstdint>
#include <vector>

namespace cactus
{

/// The field of one fibre on regular samples in a box around it, for programs that contour images: in the label image,
/// neighbouring fibres are closer than a voxel.
struct FibreImage
{
  VoxelGrid grid;            ///< the samples; sample (i, j, k) lies where that of the label image does
  std::vector<float> values; ///< µm, positive inside the fibre, x fastest
};

/// Samples the field of `fibre` (see FibreField) in the box of `blocks`, which findFibres() found for it with a reach of 1 or
/// more.
///
/// If a face of the field's box cuts the fibre off, one or two layers of samples are added beyond that face. Their values let a
/// linear contour at `level` (µm) cross the face's plane, moved into the box by `inset` (µm, at most a quarter of a voxel): flat
/// caps close the contour there, with edges that are bevelled over the last voxel, since a regular grid has no sharper ones.
/// Throws InvalidInput if `blocks` is empty, `inset` out of range or `level` negative or not finite, and OutOfMemory.
FibreImage fibreImage(
  const FibreField& field, std::int32_t fibre, const std::vector<std::uint32_t>& blocks, double level = 0.0, double inset = 0.0);

} // namespace cactus
