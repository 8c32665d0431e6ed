// SPDX-License-Identifier: BSD-3-Clause
// A label image for tests.
#pragma once

#include "base/Domain.h"
#include "fibres/Fibres.h"
#include "growth/FibreRadialGrowth.h"

#include <cmath>

namespace example
{

/// Three fibres that meet in the middle of a cube of 3 µm.
inline cactus::Fibres fibresThatMeet()
{
  cactus::Fibres fibres;
  fibres.domain = cactus::Domain::cube(3.0);
  for (int f = 0; f < 3; ++f)
  {
    fibres.addFibre(f + 1, 1, 0.5);
    const double angle = 2.1 * f;
    fibres.addPoint({ 0.55 * std::cos(angle), 0.55 * std::sin(angle), -2.0 }, 0.5);
    fibres.addPoint({ 0.6 * std::cos(angle + 0.3), 0.6 * std::sin(angle + 0.3), 2.0 }, 0.5);
  }
  return fibres;
}

inline cactus::LabelImage meetingFibres(const cactus::FibreRadialGrowthOptions& options)
{
  const cactus::Fibres fibres = fibresThatMeet();
  return cactus::growFibres(fibres, options, 0.3, cactus::growthGrid(fibres.domain, options));
}

} // namespace example
