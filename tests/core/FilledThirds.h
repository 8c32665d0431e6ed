// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"

#include <array>

/// Returns the fractions that capsules fill of the lower, the middle and the upper third of the domain.
inline std::array<double, 3> filledThirds(const cactus::Fibres& fibres)
{
  std::array<double, 3> filled{};
  const double height = fibres.domain.size().z() / 3.0;
  for (int third = 0; third < 3; ++third)
  {
    cactus::Fibres part = fibres;
    part.domain.lower.z() = fibres.domain.lower.z() + height * third;
    part.domain.upper.z() = part.domain.lower.z() + height;
    filled.at(std::size_t(third)) = capsuleVolumeInDomain(part) / part.domain.volume();
  }
  return filled;
}
