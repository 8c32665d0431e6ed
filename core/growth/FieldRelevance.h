// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

namespace cactus
{

/// Which values of the two largest fields a sweep has to get exactly right; elsewhere it may leave fibres out, so that `best` and
/// `second` come out too small there. Lengths in µm, b and s standing for the two true values at a sample.
struct FieldRelevance
{
  /// Samples with b <= -bestReach are of no interest.
  double bestReach = 0.0;
  /// s is of interest only where b > -secondReach …
  double secondReach = 0.0;
  /// … and where b + s > -sumReach …
  double sumReach = std::numeric_limits<double>::infinity();
  /// … and where b - s < contrast.
  double contrast = std::numeric_limits<double>::infinity();
};

} // namespace cactus
