// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

namespace cactus
{

/// The values of the two largest fields that a sweep must compute exactly. Elsewhere it may leave fibres out, so that `best` and
/// `second` are too small there. Lengths in µm; b and s are the two true values at a sample.
struct FieldRelevance
{
  /// Samples with b <= -bestReach do not matter.
  double bestReach = 0.0;
  /// s matters only where b > -secondReach …
  double secondReach = 0.0;
  /// … and where b + s > -sumReach …
  double sumReach = std::numeric_limits<double>::infinity();
  /// … and where b - s < contrast.
  double contrast = std::numeric_limits<double>::infinity();
};

} // namespace cactus
