// SPDX-License-Identifier: BSD-3-Clause
// Vectors of one vector unit, of CACTUS_DOUBLES doubles, and what is done with them. For VectorKernelsBody.h alone.
#pragma once

#include "fibres/Capsules.h"

#include <cstddef>
#include <cstdint>

#if CACTUS_DOUBLES > 2
#include <immintrin.h>
#endif

namespace cactus
{

namespace
{

/// As many doubles and floats as fit into a vector.
constexpr int width = CACTUS_DOUBLES;
constexpr int floats = 2 * CACTUS_DOUBLES;
typedef double Vector __attribute__((vector_size(8 * width)));
typedef long long Mask __attribute__((vector_size(8 * width)));
typedef float Floats __attribute__((vector_size(4 * floats)));
typedef std::int32_t FloatMask __attribute__((vector_size(4 * floats)));
typedef float Narrow __attribute__((vector_size(4 * width)));

inline __attribute__((always_inline)) Vector select(const Mask& mask, const Vector& x, const Vector& y)
{
  return mask ? x : y;
}

inline __attribute__((always_inline)) Vector squareRoot(const Vector& x)
{
  Vector root;
  for (int l = 0; l < width; ++l)
  {
    root[l] = __builtin_sqrt(x[l]);
  }
  return root;
}

inline __attribute__((always_inline)) bool any(const Mask& mask)
{
#if CACTUS_DOUBLES == 8
  return _mm512_movepi64_mask((__m512i)mask) != 0;
#elif CACTUS_DOUBLES == 4
  return _mm256_movemask_pd((__m256d)mask) != 0;
#else
  long long bits = 0;
  for (int l = 0; l < width; ++l)
  {
    bits |= mask[l];
  }
  return bits != 0;
#endif
}

/// Lane l of q[n] becomes number n of capsule l.
inline __attribute__((always_inline)) void transpose(const Capsule* const (&capsules)[width], Vector (&q)[8])
{
#if CACTUS_DOUBLES == 8
  // Pairs of numbers two by two, then blocks of them four by four. With masks of all lanes: GCC 12 warns of the forms without.
  __m512d even[4], odd[4];
  for (int pair = 0; pair < 4; ++pair)
  {
    const __m512d first = _mm512_load_pd(capsules[2 * pair]->p0);
    const __m512d second = _mm512_load_pd(capsules[2 * pair + 1]->p0);
    even[pair] = _mm512_maskz_unpacklo_pd(0xff, first, second);
    odd[pair] = _mm512_maskz_unpackhi_pd(0xff, first, second);
  }
  for (int parity = 0; parity < 2; ++parity)
  {
    const __m512d(&x)[4] = parity == 0 ? even : odd;
    const __m512d lower01 = _mm512_maskz_shuffle_f64x2(0xff, x[0], x[1], 0x44);
    const __m512d upper01 = _mm512_maskz_shuffle_f64x2(0xff, x[0], x[1], 0xee);
    const __m512d lower23 = _mm512_maskz_shuffle_f64x2(0xff, x[2], x[3], 0x44);
    const __m512d upper23 = _mm512_maskz_shuffle_f64x2(0xff, x[2], x[3], 0xee);
    q[parity] = (Vector)_mm512_maskz_shuffle_f64x2(0xff, lower01, lower23, 0x88);
    q[2 + parity] = (Vector)_mm512_maskz_shuffle_f64x2(0xff, lower01, lower23, 0xdd);
    q[4 + parity] = (Vector)_mm512_maskz_shuffle_f64x2(0xff, upper01, upper23, 0x88);
    q[6 + parity] = (Vector)_mm512_maskz_shuffle_f64x2(0xff, upper01, upper23, 0xdd);
  }
#else
  double numbers[8][width];
  for (int l = 0; l < width; ++l)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      numbers[axis][l] = capsules[l]->p0[axis];
      numbers[4 + axis][l] = capsules[l]->p1[axis];
    }
    numbers[3][l] = capsules[l]->r0;
    numbers[7][l] = capsules[l]->r1;
  }
  __builtin_memcpy(&q, &numbers, sizeof(q));
#endif
}

inline __attribute__((always_inline)) Floats load(const float* from)
{
  Floats vector;
  __builtin_memcpy(&vector, from, sizeof(vector));
  return vector;
}

#if CACTUS_DOUBLES > 2
/// Bit l is set if lane l is.
inline __attribute__((always_inline)) unsigned bitsOf(const FloatMask& mask)
{
#if CACTUS_DOUBLES == 8
  return _mm512_movepi32_mask((__m512i)mask);
#else
  return static_cast<unsigned>(_mm256_movemask_ps((__m256)mask));
#endif
}
#endif

/// Writes those of the first `count` values whose lane is set to `found`, in their order, and returns the end of what it wrote;
/// may write up to a vector beyond that.
inline __attribute__((always_inline)) std::uint32_t* append(
  const FloatMask& mask, int count, const std::uint32_t* values, std::uint32_t* found)
{
#if CACTUS_DOUBLES == 8
  const unsigned set = bitsOf(mask) & (0xffffu >> (floats - count));
  _mm512_storeu_si512(found, _mm512_maskz_compress_epi32(static_cast<__mmask16>(set), _mm512_loadu_si512(values)));
  return found + __builtin_popcount(set);
#elif CACTUS_DOUBLES == 4
  for (unsigned set = bitsOf(mask) & (0xffu >> (floats - count)); set != 0; set &= set - 1)
  {
    *found++ = values[__builtin_ctz(set)];
  }
  return found;
#else
  for (int l = 0; l < count; ++l)
  {
    *found = values[l];
    found -= mask[l];
  }
  return found;
#endif
}

} // namespace

} // namespace cactus
