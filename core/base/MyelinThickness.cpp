// SPDX-License-Identifier: BSD-3-Clause
#include "base/MyelinThickness.h"

#include "base/Error.h"

namespace cactus
{

double logLinearGRatio(double outerDiameter)
{
  if (!(outerDiameter > 0.0) || !std::isfinite(outerDiameter))
  {
    throw InvalidInput("a fibre's diameter must be positive");
  }
  double lower = smallestGRatio * outerDiameter;
  double upper = largestGRatio * outerDiameter;
  if (logLinearOuterDiameter(lower) >= outerDiameter)
  {
    return smallestGRatio;
  }
  if (logLinearOuterDiameter(upper) <= outerDiameter)
  {
    return largestGRatio;
  }
  while (upper - lower > 1e-12 * outerDiameter)
  {
    const double middle = 0.5 * (lower + upper);
    (logLinearOuterDiameter(middle) < outerDiameter ? lower : upper) = middle;
  }
  return 0.5 * (lower + upper) / outerDiameter;
}

} // namespace cactus
