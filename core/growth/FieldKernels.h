// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/VectorUnit.h"
#include "growth/FieldCell.h"

#include <cstddef>

namespace cactus
{

/// The cones that can matter in one block of samples, relative to the block's centre: one column per number (see Cone), readable
/// up to 16 beyond the last.
struct ConeColumns
{
  const float* start[3];
  const float* axis[3];
  const float* length;
  const float* radius;
  const float* slope;
  const float* lean;
  float* atCentre; ///< written by the kernel: the cone's field at the cell's centre; writable as far
  std::size_t count;
};

/// Consecutive cones of one fibre.
struct ConeGroup
{
  int rank;
  std::size_t begin;
  std::size_t end;
  float atCentre; ///< written by the kernel: the fibre's field at the cell's centre
};

/// FieldRelevance in single precision.
struct CellRelevance
{
  float bestReach;
  float secondReach;
  float sumReach;
  float contrast;
};

/// The samples of one cell, relative to the block's centre, and what comes out.
struct alignas(64) CellSamples
{
  float position[3][FieldCell::size];
  float centre[3];
  float extent; ///< distance from the cell's centre to its farthest sample, with room for rounding
  float best[FieldCell::size];
  float second[FieldCell::size];
  int rank[FieldCell::size];
};

/// The loop in which growth spends its time.
struct FieldKernels
{
  /// What is read in whole vectors is there for so many numbers beyond the last.
  static constexpr std::size_t padding = 16;

  /// The two largest fields at the samples of one cell, and whose the largest is. Fields are 1-Lipschitz, so their values at the
  /// cell's centre tell which fibres, and which of their cones, can make no difference at any of its samples; the rest is
  /// evaluated.
  void (*evaluateCell)(
    const ConeColumns& cones, ConeGroup* groups, std::size_t groupCount, const CellRelevance& relevance, CellSamples& samples);
};

CACTUS_KERNEL_VERSIONS(FieldKernels);

} // namespace cactus
