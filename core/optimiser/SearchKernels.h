// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/VectorUnit.h"
#include "fibres/Capsules.h"

#include <cstddef>
#include <cstdint>

namespace cactus
{

/// The bounding boxes of what a row of cells holds, one column per number, readable up to 16 beyond the last.
struct BoxColumns
{
  const float* lower[3];
  const float* upper[3];
  const std::int32_t* cell; ///< along x, of the entry
  const std::uint32_t* key; ///< what stands for it, below 2³¹
};

/// The bounding boxes of up to eight consecutive capsules: along each axis their lower bounds, then their upper bounds with the
/// other sign, so that one comparison serves both. Where there are fewer, the bounds left over are +∞.
struct alignas(64) BoxBlock
{
  float bounds[3][16];
};

/// Capsules as selectNeighbours reads them, relative to a point near them so that single precision is enough: one column per
/// number, `stride` apart, for multiples of 16 capsules. The numbers are p0, p1, reach (largest radius included), the middle, and
/// the radius of the ball about it that holds all that is within reach.
struct NearColumns
{
  static constexpr int count = 11;
  float* numbers;
  std::size_t stride;
};

/// A box to compare them with, and the cells that tell in which of several common cells two boxes meet.
struct BoxQuery
{
  float lower[3];
  float upper[3];
  float origin[3];      ///< of the grid
  float inverseSize[3]; ///< of its cells
  float last[3];        ///< largest index along each axis
  std::int32_t y;       ///< of the row
  std::int32_t z;
  std::uint32_t skipFrom; ///< boxes with keys skipFrom … skipTo − 1 are not wanted
  std::uint32_t skipTo;
};

/// The loops in which a search for neighbours spends its time.
struct SearchKernels
{
  /// What is read or written in whole vectors is there for so many numbers beyond the last.
  static constexpr std::size_t padding = 16;

  /// Fills the columns with bodies[indices[0]] … bodies[indices[count − 1]], and what is left of the last 16 with what is far
  /// away. reach: of each body, without its radius.
  void (*gatherNear)(const Capsule* bodies, const float* reach, const std::uint32_t* indices, std::size_t count,
    const double (&origin)[3], const NearColumns& near);

  /// Writes to `found` those of indices[0 … count) within reach of p, in their order, and returns the end of what it wrote.
  /// near: the columns of the indices; p: the same numbers of p. `found` has room for 16 more than count.
  std::uint32_t* (*selectNeighbours)(const NearColumns& near, const std::uint32_t* indices, std::size_t count,
    const float (&p)[NearColumns::count], std::uint32_t* found);

  /// Writes to `found` the keys of those boxes begin … end − 1 of a row of cells that overlap the box, each in the first cell
  /// only that the two have in common, and returns the end of what it wrote. `found` has room for 16 more than there are.
  std::uint32_t* (*selectBoxes)(
    const BoxColumns& columns, std::size_t begin, std::size_t end, const BoxQuery& box, std::uint32_t* found);

  /// Writes the keys to `sorted` in increasing order; no two are the same. Takes time with the square of the count. They are
  /// readable up to 16 beyond the last.
  void (*sortKeys)(const std::uint32_t* keys, std::size_t count, std::uint32_t* sorted);

  /// Writes to `found` those capsules of runs[0] … runs[count − 1] whose boxes overlap the box, in their order, and returns the
  /// end of what it wrote. Run i has the boxes blocks[i] and starts with capsule first[i]. `found` has room for 8 per run and 8
  /// more.
  std::uint32_t* (*selectFromRuns)(const BoxBlock* blocks, const std::uint32_t* first, const std::uint32_t* runs,
    std::size_t count, const BoxQuery& box, std::uint32_t* found);
};

CACTUS_KERNEL_VERSIONS(SearchKernels);

} // namespace cactus
