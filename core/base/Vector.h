// SPDX-License-Identifier: BSD-3-Clause
// The vectors that all kernels are written in (see base/VectorUnit.h): those of one vector unit, in its full width.
//
// They are the compiler's own vector types (GCC and Clang), so that kernels read like formulas: + - * / and comparisons work lane
// by lane, a scalar on one side stands for all lanes, and `mask ? a : b` selects. Only operations that these types lack are
// written for each unit, below.
//
// Every unit gives the same bits: a lane computes what a scalar would, since each operation is rounded correctly and contraction
// to fused multiply-add is off for the whole library. Kernels sum over lanes in an order that does not depend on the width.
//
// A file that is compiled for one unit must not emit an inline function that others share: the linker might choose the version
// for a unit that the machine lacks. So every function that kernels call is forced inline, and kernels use neither Eigen nor the
// containers of the standard library. tests/core/kernel_symbols.py checks it.
//
// CMake defines CACTUS_DOUBLES, the doubles in a vector, and CACTUS_VECTOR_UNIT, the prefix of the unit's table names.
#pragma once

#include <cstddef>
#include <cstdint>

#if CACTUS_DOUBLES > 2
#include <immintrin.h>
#endif

#define CACTUS_KERNEL_INLINE inline __attribute__((always_inline))

/// The name of a table of kernels for this unit, as CACTUS_KERNEL_VERSIONS declares it.
#define CACTUS_JOIN_NAMES(unit, table) unit##table
#define CACTUS_JOIN(unit, table) CACTUS_JOIN_NAMES(unit, table)
#define CACTUS_KERNELS_OF_UNIT(table) CACTUS_JOIN(CACTUS_VECTOR_UNIT, table)

namespace cactus
{

namespace
{

/// The number of doubles and of floats in a vector.
constexpr int width = CACTUS_DOUBLES;
constexpr int floats = 2 * CACTUS_DOUBLES;
typedef double Doubles __attribute__((vector_size(8 * width)));
typedef long long DoubleMask __attribute__((vector_size(8 * width)));
typedef float Floats __attribute__((vector_size(4 * floats)));
typedef std::int32_t FloatMask __attribute__((vector_size(4 * floats)));
typedef float NarrowFloats __attribute__((vector_size(4 * width))); ///< as many as there are doubles

CACTUS_KERNEL_INLINE Doubles select(const DoubleMask& mask, const Doubles& x, const Doubles& y)
{
  return mask ? x : y;
}

CACTUS_KERNEL_INLINE Doubles squareRoot(const Doubles& x)
{
  Doubles root;
  for (int l = 0; l < width; ++l)
  {
    root[l] = __builtin_sqrt(x[l]);
  }
  return root;
}

CACTUS_KERNEL_INLINE Floats squareRoot(const Floats& x)
{
  Floats root;
  for (int l = 0; l < floats; ++l)
  {
    root[l] = __builtin_sqrtf(x[l]);
  }
  return root;
}

CACTUS_KERNEL_INLINE Floats larger(const Floats& x, const Floats& y)
{
  return x > y ? x : y;
}

CACTUS_KERNEL_INLINE Floats smaller(const Floats& x, const Floats& y)
{
  return x < y ? x : y;
}

/// Bit l is set if lane l is.
CACTUS_KERNEL_INLINE unsigned bitsOf(const DoubleMask& mask)
{
#if CACTUS_DOUBLES == 8
  return _mm512_movepi64_mask((__m512i)mask);
#elif CACTUS_DOUBLES == 4
  return static_cast<unsigned>(_mm256_movemask_pd((__m256d)mask));
#else
  unsigned bits = 0;
  for (int l = 0; l < width; ++l)
  {
    bits |= static_cast<unsigned>(mask[l] & 1) << l;
  }
  return bits;
#endif
}

CACTUS_KERNEL_INLINE Doubles load(const double* from)
{
  Doubles vector;
  __builtin_memcpy(&vector, from, sizeof(vector));
  return vector;
}

/// Lane l of columns[n] becomes number n of row l. Rows are aligned to 64 bytes.
CACTUS_KERNEL_INLINE void transpose(const double* const (&rows)[width], Doubles (&columns)[8])
{
#if CACTUS_DOUBLES == 8
  // Pairs of numbers two by two, then blocks of them four by four. The masks have all lanes: GCC 12 warns about the forms
  // without.
  __m512d even[4], odd[4];
  for (int pair = 0; pair < 4; ++pair)
  {
    const __m512d first = _mm512_load_pd(rows[2 * pair]);
    const __m512d second = _mm512_load_pd(rows[2 * pair + 1]);
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
    columns[parity] = (Doubles)_mm512_maskz_shuffle_f64x2(0xff, lower01, lower23, 0x88);
    columns[2 + parity] = (Doubles)_mm512_maskz_shuffle_f64x2(0xff, lower01, lower23, 0xdd);
    columns[4 + parity] = (Doubles)_mm512_maskz_shuffle_f64x2(0xff, upper01, upper23, 0x88);
    columns[6 + parity] = (Doubles)_mm512_maskz_shuffle_f64x2(0xff, upper01, upper23, 0xdd);
  }
#else
  double numbers[8][width];
  for (int l = 0; l < width; ++l)
  {
    for (int n = 0; n < 8; ++n)
    {
      numbers[n][l] = rows[l][n];
    }
  }
  __builtin_memcpy(&columns, &numbers, sizeof(columns));
#endif
}

/// Lane l of columns[n] becomes number n of row l. Rows are aligned to 32 bytes.
CACTUS_KERNEL_INLINE void transpose(const float* const (&rows)[floats], Floats (&columns)[8])
{
#if CACTUS_DOUBLES == 8
  // Puts two rows in a vector; four by four within quarters, then the quarters of a column together. The masks have all lanes, as
  // above.
  const auto twoRows = [&](int first, int second) __attribute__((always_inline))
  {
    const __m512 lower = _mm512_castps256_ps512(_mm256_load_ps(rows[first]));
    return _mm512_maskz_insertf32x8(0xffff, lower, _mm256_load_ps(rows[second]), 1);
  };
  __m512 quarters[2][4];
  for (int half = 0; half < 2; ++half)
  {
    __m512 x[4];
    for (int l = 0; l < 4; ++l)
    {
      x[l] = twoRows(8 * half + l, 8 * half + l + 4);
    }
    const __m512d lower01 = _mm512_castps_pd(_mm512_maskz_unpacklo_ps(0xffff, x[0], x[1]));
    const __m512d lower23 = _mm512_castps_pd(_mm512_maskz_unpacklo_ps(0xffff, x[2], x[3]));
    const __m512d upper01 = _mm512_castps_pd(_mm512_maskz_unpackhi_ps(0xffff, x[0], x[1]));
    const __m512d upper23 = _mm512_castps_pd(_mm512_maskz_unpackhi_ps(0xffff, x[2], x[3]));
    quarters[half][0] = _mm512_castpd_ps(_mm512_maskz_unpacklo_pd(0xff, lower01, lower23));
    quarters[half][1] = _mm512_castpd_ps(_mm512_maskz_unpackhi_pd(0xff, lower01, lower23));
    quarters[half][2] = _mm512_castpd_ps(_mm512_maskz_unpacklo_pd(0xff, upper01, upper23));
    quarters[half][3] = _mm512_castpd_ps(_mm512_maskz_unpackhi_pd(0xff, upper01, upper23));
  }
  for (int n = 0; n < 4; ++n)
  {
    columns[n] = (Floats)_mm512_maskz_shuffle_f32x4(0xffff, quarters[0][n], quarters[1][n], 0x88);
    columns[4 + n] = (Floats)_mm512_maskz_shuffle_f32x4(0xffff, quarters[0][n], quarters[1][n], 0xdd);
  }
#else
  float numbers[8][floats];
  for (int l = 0; l < floats; ++l)
  {
    for (int n = 0; n < 8; ++n)
    {
      numbers[n][l] = rows[l][n];
    }
  }
  __builtin_memcpy(&columns, &numbers, sizeof(columns));
#endif
}

/// Sets totals[n] to the sum of the eight lanes of x[n], taken two by two: ((0 + 1) + (2 + 3)) + ((4 + 5) + (6 + 7)). `count` is
/// a multiple of four.
template <int count>
CACTUS_KERNEL_INLINE void sumLanes(const Doubles (&x)[count][8 / width], double (&totals)[count])
{
#if CACTUS_DOUBLES == 8
  const auto pairs = [&](int n) __attribute__((always_inline))
  {
    const __m512d even = _mm512_maskz_unpacklo_pd(0xff, (__m512d)x[n][0], (__m512d)x[n + 1][0]);
    const __m512d odd = _mm512_maskz_unpackhi_pd(0xff, (__m512d)x[n][0], (__m512d)x[n + 1][0]);
    return (Doubles)even + (Doubles)odd;
  };
  const auto join = [](const Doubles& a, const Doubles& b) __attribute__((always_inline))
  {
    const __m512d even = _mm512_maskz_shuffle_f64x2(0xff, (__m512d)a, (__m512d)b, 0x88);
    const __m512d odd = _mm512_maskz_shuffle_f64x2(0xff, (__m512d)a, (__m512d)b, 0xdd);
    return (Doubles)even + (Doubles)odd;
  };
  for (int n = 0; n < count; n += 8)
  {
    const bool isWhole = n + 4 < count;
    const Doubles first = join(pairs(n), pairs(n + 2));
    const Doubles all = join(first, isWhole ? join(pairs(isWhole ? n + 4 : n), pairs(isWhole ? n + 6 : n)) : first);
    __builtin_memcpy(totals + n, &all, isWhole ? sizeof(all) : sizeof(all) / 2);
  }
#else
  for (int n = 0; n < count; ++n)
  {
    double lanes[8];
    __builtin_memcpy(lanes, x[n], sizeof(lanes));
    totals[n] = ((lanes[0] + lanes[1]) + (lanes[2] + lanes[3])) + ((lanes[4] + lanes[5]) + (lanes[6] + lanes[7]));
  }
#endif
}

/// Returns the largest of eight lanes.
CACTUS_KERNEL_INLINE double largestLane(const Doubles (&x)[8 / width])
{
#if CACTUS_DOUBLES == 8
  const __m512d all = (__m512d)x[0];
  const __m256d four = _mm256_max_pd(_mm512_maskz_extractf64x4_pd(0xf, all, 0), _mm512_maskz_extractf64x4_pd(0xf, all, 1));
  const __m128d two = _mm_max_pd(_mm256_castpd256_pd128(four), _mm256_extractf128_pd(four, 1));
  return _mm_cvtsd_f64(_mm_max_pd(two, _mm_unpackhi_pd(two, two)));
#else
  double lanes[8];
  __builtin_memcpy(lanes, x, sizeof(lanes));
  double largest = lanes[0];
  for (const double lane : lanes)
  {
    largest = lane > largest ? lane : largest;
  }
  return largest;
#endif
}

CACTUS_KERNEL_INLINE Floats load(const float* from)
{
  Floats vector;
  __builtin_memcpy(&vector, from, sizeof(vector));
  return vector;
}

/// Bit l is set if lane l is.
CACTUS_KERNEL_INLINE unsigned bitsOf(const FloatMask& mask)
{
#if CACTUS_DOUBLES == 8
  return _mm512_movepi32_mask((__m512i)mask);
#elif CACTUS_DOUBLES == 4
  return static_cast<unsigned>(_mm256_movemask_ps((__m256)mask));
#else
  unsigned bits = 0;
  for (int l = 0; l < floats; ++l)
  {
    bits |= static_cast<unsigned>(mask[l] & 1) << l;
  }
  return bits;
#endif
}

CACTUS_KERNEL_INLINE void store(double* to, const Doubles& vector)
{
  __builtin_memcpy(to, &vector, sizeof(vector));
}

CACTUS_KERNEL_INLINE void store(float* to, const Floats& vector)
{
  __builtin_memcpy(to, &vector, sizeof(vector));
}

/// Writes those of the first `count` values whose lane is set to `found`, in order, and returns the end of the output; may write
/// up to a vector beyond it.
CACTUS_KERNEL_INLINE std::uint32_t* append(const FloatMask& mask, int count, const std::uint32_t* values, std::uint32_t* found)
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
