// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

namespace cactus
{

/// Returns the weights of the four coefficients around a place of a uniform cubic B-spline, in order; t: where the place lies
/// between the knots of its interval, from 0 to 1.
inline std::array<double, 4> cubicSplineWeights(double t)
{
  return { { (1.0 - t) * (1.0 - t) * (1.0 - t) / 6.0, (4.0 + t * t * (3.0 * t - 6.0)) / 6.0,
    (1.0 + 3.0 * t * (1.0 + t * (1.0 - t))) / 6.0, t * t * t / 6.0 } };
}

} // namespace cactus
