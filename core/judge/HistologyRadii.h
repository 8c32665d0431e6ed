// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "judge/HistologyMask.h"

#include <cstdint>
#include <vector>

namespace cactus
{

/// One axon of a mask, with its myelin.
struct MaskAxon
{
  double column = 0.0; ///< axon's centre of mass, in pixels from the middle of the first
  double row = 0.0;
  double axonArea = 0.0;      ///< µm²
  double myelinArea = 0.0;    ///< µm²
  bool touchesBorder = false; ///< the axon or its myelin is cut off

  double axonRadius() const;  ///< µm, of a circle of the axon's area
  double fibreRadius() const; ///< µm, of a circle with the area of the axon and its myelin
};

/// The axons of a mask, and their pixels.
struct MaskAxons
{
  std::vector<MaskAxon> axons;
  std::vector<std::int32_t> labels; ///< by pixel: the axon's number from 1, 0 for none
  double looseMyelin = 0.0;         ///< µm², of myelin without an axon
};

/// Finds the axons: pixels connected by sides, in the order of their first pixels. Myelin belongs to the axon to
/// which its path through myelin is shortest, over sides (1) and corners (√2); ties are broken consistently. Throws InvalidInput
/// for a mask without axons, OutOfMemory and Cancelled.
MaskAxons measureMask(const HistologyMask& mask, const Context& context = {});

} // namespace cactus
