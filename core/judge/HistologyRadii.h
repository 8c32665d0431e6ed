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
  double column = 0.0; ///< of the axon's centre of mass, in pixels from the middle of the first
  double row = 0.0;
  double axonArea = 0.0;      ///< µm²
  double myelinArea = 0.0;    ///< µm²
  bool touchesBorder = false; ///< the axon or its myelin: it is cut off

  double axonRadius() const;  ///< µm, of a circle of the axon's area
  double fibreRadius() const; ///< µm, of a circle of the axon's area and its myelin's
};

/// What of a mask belongs to which axon.
struct MaskAxons
{
  std::vector<MaskAxon> axons;
  std::vector<std::int32_t> labels; ///< by pixel: the axon's number from 1, 0 for none
  double looseMyelin = 0.0;         ///< µm², of myelin that no axon is in
};

/// Axons are pixels that hang together by sides or corners, in the order of their first pixels. Myelin belongs to the axon to
/// which its way through myelin is shortest, over sides (1) and corners (√2); of two at the same distance always to the same one.
/// Throws InvalidInput for a mask without axons, OutOfMemory and Cancelled.
MaskAxons measureMask(const HistologyMask& mask, const Context& context = {});

} // namespace cactus
