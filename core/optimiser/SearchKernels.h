// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/VectorUnit.h"
#include "fibres/Capsules.h"

#include <cstddef>
#include <cstdint>

namespace cactus
{

/// The bounding boxes of the entries of a row of cells, one column per number, readable up to 16 beyond the last.
struct BoxColumns
{
  const float* lower[3];
  const float* upper[3];
  const std::int32_t* cell; ///< the entry's cell along x
  const std::uint32_t* key; ///< the entry's run, below 2³¹
};

/// The bounding boxes of up to eight consecutive capsules: along each axis their lower bounds, then their negated upper bounds,
/// so that one comparison serves both. Unused bounds are +∞.
struct alignas(64) BoxBlock
{
  float bounds[3][16];
};

/// Capsules as read by selectNeighbours, relative to a nearby point so that single precision suffices: one column per number,
/// `stride` apart, for multiples of 16 capsules. The numbers are p0, p1, reach (largest radius included), the middle, and the
/// radius of the ball about it that holds everything within reach.
struct NearColumns
{
  static constexpr int count = 11;
  float* numbers;
  std::size_t stride;
};

/// A box to compare entries with, and the grid's geometry, which selects the first of the common cells of two boxes.
struct BoxQuery
{
  float lower[3];
  float upper[3];
  float origin[3];      ///< of the grid
  float inverseSize[3]; ///< of its cells
  float last[3];        ///< largest index along each axis
  std::int32_t y;       ///< of the row
  std::int32_t z;
  std::uint32_t skipFrom; ///< boxes with keys skipFrom … skipTo − 1 are skipped
  std::uint32_t skipTo;
};

/// The loops that dominate a search for neighbours.
struct SearchKernels
{
  /// Arrays read or written in whole vectors have this many numbers beyond the last.
  static constexpr std::size_t padding = 16;

  /// Fills the columns with bodies[indices[0]] … bodies[indices[count − 1]], and the rest of the last 16 with capsules far away.
  /// reach: per body, without its radius.
  void (*gatherNear)(const Capsule* bodies, const float* reach, const std::uint32_t* indices, std::size_t count,
    const double (&origin)[3], const NearColumns& near);

  /// Writes to `found` those of indices[0 … count) within reach of p, in their order, and returns the end of the output. near:
  /// the columns of the indices; p: the same numbers of p. `found` has room for 16 more than count.
  std::uint32_t* (*selectNeighbours)(const NearColumns& near, const std::uint32_t* indices, std::size_t count,
    const float (&p)[NearColumns::count], std::uint32_t* found);

  /// Writes to `found` the keys of those boxes begin … end − 1 of a row of cells that overlap the box, each only in the first
  /// cell that the two have in common, and returns the end of the output. `found` has room for 16 more than there are.
  std::uint32_t* (*selectBoxes)(
    const BoxColumns& columns, std::size_t begin, std::size_t end, const BoxQuery& box, std::uint32_t* found);

  /// Writes the keys, which are distinct, to `sorted` in increasing order. Takes quadratic time. They are readable up to 16
  /// beyond the last.
  void (*sortKeys)(const std::uint32_t* keys, std::size_t count, std::uint32_t* sorted);

  /// Writes to `found` those capsules of runs[0] … runs[count − 1] whose boxes overlap the box, in their order, and returns the
  /// end of the output. Run i has the boxes blocks[i] and starts with capsule first[i]. `found` has room for 8 per run and 8
  /// more.
  std::uint32_t* (*selectFromRuns)(const BoxBlock* blocks, const std::uint32_t* first, const std::uint32_t* runs,
    std::size_t count, const BoxQuery& box, std::uint32_t* found);
};

CACTUS_KERNEL_VERSIONS(SearchKernels);

} // namespace cactus
