// SPDX-License-Identifier: BSD-3-Clause
// Common set-up and results of growth tests.
#pragma once

#include "growth/FibreRadialGrowth.h"
#include "growth/GrowthTarget.h"

namespace cactus_testing
{

inline cactus::Fibres emptyFibres(double side)
{
  cactus::Fibres fibres;
  fibres.domain = cactus::Domain::cube(side);
  return fibres;
}

inline cactus::LabelImage grown(const cactus::Fibres& fibres, const cactus::FibreRadialGrowthOptions& options, int threads = 2)
{
  cactus::Context context;
  context.threads = threads;
  return growFibres(fibres, options, growthFor(fibres, options, context).growth, growthGrid(fibres.domain, options), context);
}

} // namespace cactus_testing
