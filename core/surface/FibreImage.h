// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "growth/LabelImage.h"
#include "surface/FibreField.h"

#include <cstdint>
#include <vector>

namespace cactus
{

/// The field of one fibre on regular samples in a box around it: what a program that contours images needs, since in the label
/// image neighbours are nearer to each other than a voxel is wide.
struct FibreImage
{
  VoxelGrid grid;            ///< the samples held; sample (i, j, k) lies where that of the label image does
  std::vector<float> values; ///< µm, positive inside the fibre, x fastest
};

/// Samples the field of `fibre` (as FibreField gives it) in the box of `blocks`, which findFibres() found for it with
/// a reach of 1 or more.
///
/// Where the fibre is cut off by a face of the field's box, one or two layers of samples are added beyond that face, with values
/// that let a linear contour at `level` (µm) cross the face's plane, moved into the box by `inset` (µm, at most a quarter of a
/// voxel): the contour is closed by flat caps there, with edges that are bevelled over the last voxel, as a regular grid has no
/// sharper ones. Throws InvalidInput where `blocks` is empty, `inset` out of range or `level` negative or not finite, and
/// OutOfMemory.
FibreImage fibreImage(
  const FibreField& field, std::int32_t fibre, const std::vector<std::uint32_t>& blocks, double level = 0.0, double inset = 0.0);

} // namespace cactus
