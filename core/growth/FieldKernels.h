// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/VectorUnit.h"
#include "growth/FieldCell.h"

#include <cstddef>

namespace cactus
{

/// Cones that can matter somewhere, relative to the centre of a block: one column per number, readable and writable up to
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
    Given,         ///< so many numbers say what a cone is; kernels write the others
    Field = Given, ///< of the cone, at a place
    Bound,         ///< with the gradient: what the field is below around the place
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
  float field;       ///< the fibre's at a place
  std::size_t ahead; ///< the cone that has it
};

/// Cones by fibre.
struct ConeGroups
{
  ConeColumns cones;
  ConeGroup* groups; ///< by rank, increasing
  std::size_t count; ///< of groups
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
  float half;   ///< along each axis, how far the samples reach, with room for rounding
  float extent; ///< distance to the farthest sample, likewise
};

/// The samples of one cell, relative to the block's centre, and what comes out.
struct alignas(64) CellSamples
{
  float position[3][FieldCell::size];
  SamplePlace place;
  float best[FieldCell::size];
  float second[FieldCell::size];
  int rank[FieldCell::size];
};

/// The loops in which growth spends its time. The field of a cone is 1-Lipschitz and concave, so what it is at a place and at the
/// corners of a cube around that tells which fibres, and which of their cones, can make no difference at any sample in the cube.
struct FieldKernels
{
  /// What is read in whole vectors is there for so many numbers beyond the last.
  static constexpr std::size_t padding = 16;

  /// Those of some cones that can matter at the samples around a place. `near` has room for all of them.
  void (*narrow)(const ConeGroups& all, const CellRelevance& relevance, const SamplePlace& place, ConeGroups& near);

  /// The two largest fields at the samples of one cell, and whose the largest is.
  void (*evaluateCell)(const ConeGroups& all, const CellRelevance& relevance, CellSamples& samples);
};

CACTUS_KERNEL_VERSIONS(FieldKernels);

} // namespace cactus
