// SPDX-License-Identifier: BSD-3-Clause
#include "surface/SmoothingKernels.h"

#include "base/Vector.h"

namespace cactus
{

namespace
{

CACTUS_KERNEL_INLINE FloatMask load(const std::int32_t* from)
{
  FloatMask vector;
  __builtin_memcpy(&vector, from, sizeof(vector));
  return vector;
}

CACTUS_KERNEL_INLINE bool isAnySet(const FloatMask& mask)
{
#if CACTUS_DOUBLES > 2
  return bitsOf(mask) != 0;
#else
  std::int32_t any = 0;
  for (int l = 0; l < floats; ++l)
  {
    any |= mask[l];
  }
  return any != 0;
#endif
}

/// Calls visit(n) for the places of vectors that cover `count` numbers; the last vector may cover some for the second time.
/// `count` is at least a vector's width.
template <typename Visit>
CACTUS_KERNEL_INLINE void forEachVector(int count, Visit&& visit)
{
  int n = 0;
  for (; n + floats <= count; n += floats)
  {
    visit(n);
  }
  if (n < count)
  {
    visit(count - floats);
  }
}

bool field(const std::int32_t* ids, const float* depths, int count, std::int32_t fibre, float gap, float outside, float* out)
{
  if (count < floats)
  {
    int doubtful = 0;
    for (int n = 0; n < count; ++n)
    {
      const float other = -(depths[n] + gap);
      out[n] = ids[n] == fibre || ids[n] == 0 ? depths[n] : other;
      doubtful |= int(ids[n] == 0) & int(depths[n] > outside);
    }
    return doubtful != 0;
  }
  FloatMask doubtful = {};
  forEachVector(count,
    [&](int n)
    {
      const FloatMask id = load(ids + n);
      const Floats depth = load(depths + n);
      const FloatMask isOutside = id == 0;
      store(out + n, ((id == fibre) | isOutside) ? depth : -(depth + gap));
      doubtful |= isOutside & (depth > outside);
    });
  return isAnySet(doubtful);
}

/// Smooths a vector, or a number, given its neighbours.
template <typename Number>
CACTUS_KERNEL_INLINE Number smoothed(const Number& below, const Number& here, const Number& above)
{
  return 0.5f * here + 0.25f * (below + above);
}

void smooth(std::size_t step, std::size_t size, const float* before, const float* part, float* values)
{
  std::size_t n = step;
  if (part == nullptr)
  {
    for (; n + step + floats <= size; n += floats)
    {
      store(values + n, smoothed(load(before + n - step), load(before + n), load(before + n + step)));
    }
  }
  else
  {
    for (; n + step + floats <= size; n += floats)
    {
      const Floats here = load(before + n);
      const Floats whole = smoothed(load(before + n - step), here, load(before + n + step));
      const Floats kept = load(part + n);
      store(values + n, (1.0f - kept) * here + kept * whole); // with 1 the very same bits
    }
  }
  for (; n + step < size; ++n)
  {
    const float whole = smoothed(before[n - step], before[n], before[n + step]);
    values[n] = part == nullptr ? whole : (1.0f - part[n]) * before[n] + part[n] * whole;
  }
}

} // namespace

const SmoothingKernels CACTUS_KERNELS_OF_UNIT(SmoothingKernels) = { field, smooth };

} // namespace cactus
