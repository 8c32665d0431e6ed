// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace cactus
{

/// Returns a number rounded to single precision. It goes through memory, because g++ 12 omits the rounding where its -O3
/// vectorises two of them (-ftree-slp-vectorize).
inline double inSinglePrecision(double value)
{
  const volatile float rounded = static_cast<float>(value);
  return rounded;
}

} // namespace cactus
