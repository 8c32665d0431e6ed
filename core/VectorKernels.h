// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Capsules.h"
#include "OverlapCost.h"

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
  const std::uint64_t* key; ///< what stands for it
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
};

/// The loops over pairs of capsules, and of boxes, in which an optimisation spends its time. They are compiled once for each
/// vector unit of x86-64, with vectors of the width that it has; vectors wider than that make the compiler take them apart number
/// by number. Contraction is off and sums are taken in the same order in each, so all give the same bits.
struct VectorKernels
{
  /// Half the cost and the whole gradient of capsule p against bodies[neighbours[0]] … bodies[neighbours[count − 1]], see
  /// evaluateOverlap. `tapered`: whether any radius varies along its capsule; the result is the same if it is true for nothing.
  void (*evaluateCapsule)(const Capsule* bodies, const std::uint32_t* neighbours, std::size_t count, const Capsule& p,
    double margin, double tolerance, bool tapered, CapsuleOverlap& result);

  /// Writes to `found` those of indices[0 … count) within reach of p, in their order, and returns the end of what it wrote.
  /// columns: p0, p1 and reach (largest radius included) of each index, one column per number, single precision, readable up to
  /// the next multiple of 16 where what fills up is far away; p: the same of p. `found` has room for 16 more than count.
  std::uint32_t* (*selectNeighbours)(
    const float* const (&columns)[7], const std::uint32_t* indices, std::size_t count, const float (&p)[7], std::uint32_t* found);

  /// Writes to `found` the keys of those boxes begin … end − 1 of a row of cells that overlap the box, each in the first cell
  /// only that the two have in common, and returns the end of what it wrote. `found` has room for 16 more than there are.
  std::uint64_t* (*selectBoxes)(
    const BoxColumns& columns, std::size_t begin, std::size_t end, const BoxQuery& box, std::uint64_t* found);
};

/// The best of them that this machine can run.
const VectorKernels& vectorKernels();

extern const VectorKernels portableKernels;
#if defined(__x86_64__)
extern const VectorKernels x86V3Kernels; ///< AVX2
extern const VectorKernels x86V4Kernels; ///< AVX-512
#endif

} // namespace cactus
