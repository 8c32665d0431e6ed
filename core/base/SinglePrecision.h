// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace cactus
{

/// A number rounded to single precision. It goes through memory, since g++ 12 leaves such rounding out where its -O3 puts two of
/// them into a vector (-ftree-slp-vectorize).
inline double inSinglePrecision(double value)
{
  const volatile float rounded = static_cast<float>(value);
  return rounded;
}

} // namespace cactus
