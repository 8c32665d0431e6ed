// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/VectorUnit.h"
#include "growth/FieldCell.h"

#include <cstddef>

namespace cactus
{

/// Cones that can matter near a block, relative to its centre: one column per number, readable and writable up to
/// FieldKernels::padding beyond the last.
struct ConeColumns
{
  enum Number
  {
    Start = 0, ///< x, y, z; see Cone
    Axis = 3,  ///< x, y, z
    Length = 6,
    Radius,
    Slope,
    Lean,
    Given,         ///< the numbers above define a cone; kernels write the others
    Field = Given, ///< of the cone, at a place
    Bound,         ///< with the gradient, an upper bound of the field around the place
    Gradient,      ///< x, y, z
    Numbers = Gradient + 3
  };

  float* of[Numbers];
  std::size_t count;
};

/// Consecutive cones of one fibre.
struct ConeGroup
{
  int rank;
  std::size_t begin;
  std::size_t end;
  // Written by kernels.
  float field;       ///< the fibre's field at a place
  std::size_t ahead; ///< the cone with that field
};

/// Cones by fibre.
struct ConeGroups
{
  ConeColumns cones;
  ConeGroup* groups; ///< by rank, increasing
  std::size_t count; ///< number of groups
};

/// FieldRelevance in single precision.
struct CellRelevance
{
  float bestReach;
  float secondReach;
  float sumReach;
  float contrast;
};

/// A place, relative to the block's centre, and a cube of samples around it.
struct SamplePlace
{
  float centre[3];
  float half;   ///< half edge of the cube of samples, with room for rounding
  float extent; ///< distance to the farthest sample, with room for rounding
};

/// The samples of one cell, relative to the block's centre, and the results.
struct alignas(64) CellSamples
{
  float position[3][FieldCell::size];
  SamplePlace place;
  float best[FieldCell::size];
  float second[FieldCell::size];
  int rank[FieldCell::size];
};

/// The loops that dominate growth. The field of a cone is 1-Lipschitz and concave, so its values at a place and at the corners of
/// a cube around it tell which fibres, and which of their cones, cannot affect any sample in the cube.
struct FieldKernels
{
  /// Arrays read in whole vectors have this many numbers beyond the last.
  static constexpr std::size_t padding = 16;

  /// Selects the cones that can matter at the samples around a place. `near` has room for all of them.
  void (*narrow)(const ConeGroups& all, const CellRelevance& relevance, const SamplePlace& place, ConeGroups& near);

  /// Computes the two largest fields at the samples of one cell, and the fibre of the largest.
  void (*evaluateCell)(const ConeGroups& all, const CellRelevance& relevance, CellSamples& samples);
};

CACTUS_KERNEL_VERSIONS(FieldKernels);

} // namespace cactus
