// SPDX-License-Identifier: BSD-3-Clause
// The pair loops of VectorKernels.h for one vector unit. Included once by each source file that is compiled for one, with
// CACTUS_DOUBLES the doubles in a vector and CACTUS_KERNELS the name to define. Such a file must not leave behind an inline
// function that others share, since the linker might take the version for a machine that is not there: nothing here calls one
// that is not forced inline.
#include "SegmentDistance.h"
#include "VectorKernels.h"

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

/// Neighbours are summed in this many lanes, in one vector or in several.
constexpr int lanes = 8;
constexpr int vectors = lanes / width;

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

/// Writes those of the first `count` values whose lane is set to `found`, in their order, and returns the end of what it wrote;
/// may write up to a vector beyond that.
template <typename Value>
inline __attribute__((always_inline)) Value* append(const FloatMask& mask, int count, const Value* values, Value* found)
{
#if CACTUS_DOUBLES == 8
  const unsigned set = _mm512_movepi32_mask((__m512i)mask) & (0xffffu >> (floats - count));
  if (sizeof(Value) == 4)
  {
    _mm512_storeu_si512(found, _mm512_maskz_compress_epi32(static_cast<__mmask16>(set), _mm512_loadu_si512(values)));
    return found + __builtin_popcount(set);
  }
  for (unsigned half = 0; half < 2; ++half)
  {
    const unsigned mine = (set >> (8 * half)) & 0xffu;
    _mm512_storeu_si512(found, _mm512_maskz_compress_epi64(static_cast<__mmask8>(mine), _mm512_loadu_si512(values + 8 * half)));
    found += __builtin_popcount(mine);
  }
  return found;
#elif CACTUS_DOUBLES == 4
  for (unsigned set = static_cast<unsigned>(_mm256_movemask_ps((__m256)mask)) & (0xffu >> (floats - count)); set != 0;
       set &= set - 1)
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

/// What the neighbours contribute to one capsule, lane by lane.
struct LaneSums
{
  Vector gradient0[3];
  Vector gradient1[3];
  Vector radius0;
  Vector radius1;
  Vector stiffness0;
  Vector stiffness1;
  Vector cost;
  Vector penetration;
  Mask overlapping;
};

/// Adds the contributions of as many neighbours q as a vector holds (their eight numbers, transposed) to the sums of p.
inline __attribute__((always_inline)) void addLanes(
  const Capsule& p, const Vector (&q)[8], double margin, double tolerance, bool tapered, LaneSums& sums)
{
  // Nothing here that depends on p alone depends on q, so that it is computed once.
  const Vector zero = {};
  const Vector one = zero + 1.0;
  Vector u[3], v[3], r[3], w[3];
  Vector a = zero, b = zero, c = zero, e = zero, f = zero;
  for (int axis = 0; axis < 3; ++axis)
  {
    u[axis] = zero + (p.p1[axis] - p.p0[axis]);
    v[axis] = q[4 + axis] - q[axis];
    r[axis] = p.p0[axis] - q[axis];
    a += u[axis] * u[axis];
    b += u[axis] * v[axis];
    c += u[axis] * r[axis];
    e += v[axis] * v[axis];
    f += v[axis] * r[axis];
  }
  Vector s, t;
  closestParameters<Vector>(a, e, b, c, f, s, t);
  Vector squared = zero;
  for (int axis = 0; axis < 3; ++axis)
  {
    w[axis] = r[axis] + s * u[axis] - t * v[axis];
    squared += w[axis] * w[axis];
  }
  const Vector taperP = zero + (p.r1 - p.r0);
  const Vector taperQ = q[7] - q[3];
  const Vector rp = p.r0 + s * taperP;
  const Vector rq = q[3] + t * taperQ;
  // Lists reach further than contact: many have no pair to add here.
  const Vector farthest = margin * (rp + rq);
  if (!any(squared < farthest * farthest))
  {
    return;
  }
  const Vector distance = squareRoot(squared);
  const Vector lengthP = squareRoot(a);
  const Vector lengthQ = squareRoot(e);
  const Vector inverseSum = one / (rp + rq);
  const Vector ratio = distance * inverseSum;
  const Vector depth = margin - ratio;
  const Vector D = select(depth > zero, depth, zero);
  const Vector lengths = lengthP * lengthQ;
  const Vector scale = lengths * rp * rq;
  const Vector byLength = D * D * lengthQ * rp * rq * (one / lengthP); // ∂F/∂|p0−p1| / |p0−p1|
  // Concentric capsules have no direction to part in: no push, the next step of their neighbours breaks the tie.
  const Vector push = -2.0 * D * scale * inverseSum / select(distance > 1e-12, distance, one);
  const Vector byRp = 2.0 * D * ratio * inverseSum * scale + D * D * lengths * rq;
  const Vector byRq = 2.0 * D * ratio * inverseSum * scale + D * D * lengths * rp;
  // Where a radius varies along its capsule, the cost also changes as the closest points slide. They satisfy
  // a·s − b·t + c = 0 and −b·s + e·t − f = 0 (whichever is not clamped); the adjoint of that system gives the slide's share.
  Vector adjointS = zero;
  Vector adjointT = zero;
  if (tapered)
  {
    const Vector alongP = byRp * taperP;
    const Vector alongQ = byRq * taperQ;
    const Vector determinant = a * e - b * b;
    const Mask skew = determinant > 1e-12 * a * e;
    const Mask sFree = (s > zero) & (s < one) & skew;
    const Mask tFree = (t > zero) & (t < one) & skew;
    const Vector inverseDeterminant = select(sFree & tFree, one, zero) / select(skew, determinant, one);
    adjointS = (e * alongP + b * alongQ) * inverseDeterminant + select(sFree & ~tFree, alongP / a, zero);
    adjointT = (b * alongP + a * alongQ) * inverseDeterminant + select(tFree & ~sFree, alongQ / e, zero);
  }
  const Vector near0 = one - s;
  const Vector alongW0 = push * near0 + adjointS;
  const Vector alongW1 = push * s - adjointS;
  const Vector alongU0 = -adjointS * near0 - byLength;
  const Vector alongU1 = -adjointS * s + byLength;
  const Vector alongV0 = adjointT * near0;
  const Vector alongV1 = adjointT * s;
  for (int axis = 0; axis < 3; ++axis)
  {
    sums.gradient0[axis] += alongW0 * w[axis] + alongU0 * u[axis] + alongV0 * v[axis];
    sums.gradient1[axis] += alongW1 * w[axis] + alongU1 * u[axis] + alongV1 * v[axis];
  }
  sums.radius0 += byRp * near0;
  sums.radius1 += byRp * s;
  const Vector stiffness = select(depth > zero, 2.0 * scale * inverseSum * inverseSum, zero);
  sums.stiffness0 += stiffness * near0;
  sums.stiffness1 += stiffness * s;
  sums.cost += 0.5 * D * D * scale;
  const Vector penetration = one - ratio;
  sums.penetration = penetration > sums.penetration ? penetration : sums.penetration;
  sums.overlapping -= penetration > tolerance;
}

void evaluateCapsule(const Capsule* bodies, const std::uint32_t* neighbours, std::size_t count, const Capsule& p, double margin,
  double tolerance, bool tapered, CapsuleOverlap& result)
{
  // A capsule too far away to contribute anything fills the lanes that are left over.
  Capsule nothing = p;
  for (int axis = 0; axis < 3; ++axis)
  {
    nothing.p0[axis] += 1e6;
    nothing.p1[axis] = nothing.p0[axis] + 1.0;
  }
  LaneSums all[vectors];
  for (int v = 0; v < vectors; ++v)
  {
    LaneSums sums = {};
    sums.penetration -= 1.0;
    for (std::size_t n = std::size_t(v) * width; n < count; n += lanes)
    {
      const Capsule* others[width];
      for (std::size_t l = 0; l < width; ++l)
      {
        others[l] = n + l < count ? bodies + neighbours[n + l] : &nothing;
      }
      Vector q[8];
      transpose(others, q);
      addLanes(p, q, margin, tolerance, tapered, sums);
    }
    all[v] = sums;
  }
  const auto sumOf = [&](auto&& member) __attribute__((always_inline))
  {
    double x[lanes];
    for (int l = 0; l < lanes; ++l)
    {
      x[l] = member(all[l / width])[l % width];
    }
    return ((x[0] + x[1]) + (x[2] + x[3])) + ((x[4] + x[5]) + (x[6] + x[7]));
  };
  for (int axis = 0; axis < 3; ++axis)
  {
    result.gradient0[axis] = sumOf([axis](const LaneSums& sums) -> const Vector& { return sums.gradient0[axis]; });
    result.gradient1[axis] = sumOf([axis](const LaneSums& sums) -> const Vector& { return sums.gradient1[axis]; });
  }
  result.radius0 = sumOf([](const LaneSums& sums) -> const Vector& { return sums.radius0; });
  result.radius1 = sumOf([](const LaneSums& sums) -> const Vector& { return sums.radius1; });
  result.stiffness0 = sumOf([](const LaneSums& sums) -> const Vector& { return sums.stiffness0; });
  result.stiffness1 = sumOf([](const LaneSums& sums) -> const Vector& { return sums.stiffness1; });
  result.cost = sumOf([](const LaneSums& sums) -> const Vector& { return sums.cost; });
  result.penetration = -1.0;
  result.overlapping = 0;
  for (int l = 0; l < lanes; ++l)
  {
    const double penetration = all[l / width].penetration[l % width];
    result.penetration = penetration > result.penetration ? penetration : result.penetration;
    result.overlapping += static_cast<std::size_t>(all[l / width].overlapping[l % width]);
  }
}

std::uint32_t* selectNeighbours(
  const float* const (&columns)[7], const std::uint32_t* indices, std::size_t count, const float (&p)[7], std::uint32_t* found)
{
  const Floats zero = {};
  for (std::size_t n = 0; n < count; n += floats)
  {
    Floats q[7];
    for (int number = 0; number < 7; ++number)
    {
      __builtin_memcpy(&q[number], columns[number] + n, sizeof(Floats));
    }
    Floats a = zero, b = zero, c = zero, e = zero, f = zero;
    Floats u[3], v[3], r[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      u[axis] = zero + (p[3 + axis] - p[axis]);
      v[axis] = q[3 + axis] - q[axis];
      r[axis] = p[axis] - q[axis];
      a += u[axis] * u[axis];
      b += u[axis] * v[axis];
      c += u[axis] * r[axis];
      e += v[axis] * v[axis];
      f += v[axis] * r[axis];
    }
    Floats s, t;
    closestParameters<Floats, float>(a, e, b, c, f, s, t);
    Floats squared = zero;
    for (int axis = 0; axis < 3; ++axis)
    {
      const Floats w = r[axis] + s * u[axis] - t * v[axis];
      squared += w * w;
    }
    const Floats limit = p[6] + q[6];
    // The errors of single precision in squared are below 10⁻⁶ of these squares, also where segments are nearly parallel: s may
    // then be off, but the distance hardly depends on it.
    const FloatMask near = squared < limit * limit + 1e-5f * (limit * limit + a + e);
    found = append(near, floats, indices + n, found);
  }
  return found;
}

std::uint64_t* selectBoxes(
  const BoxColumns& columns, std::size_t begin, std::size_t end, const BoxQuery& box, std::uint64_t* found)
{
  const Floats zero = {};
  const FloatMask none = {};
  for (std::size_t n = begin; n < end; n += floats)
  {
    FloatMask cellX;
    __builtin_memcpy(&cellX, columns.cell + n, sizeof(FloatMask));
    FloatMask taken = none == none;
    for (int axis = 0; axis < 3; ++axis)
    {
      Floats lower, upper;
      __builtin_memcpy(&lower, columns.lower[axis] + n, sizeof(Floats));
      __builtin_memcpy(&upper, columns.upper[axis] + n, sizeof(Floats));
      const Floats from = zero + box.lower[axis];
      const Floats last = zero + box.last[axis];
      // As CellGrid::cellOf.
      const Floats common = lower > from ? lower : from;
      Floats cell = (common - box.origin[axis]) * box.inverseSize[axis];
      cell = cell > zero ? cell : zero;
      cell = cell < last ? cell : last;
      const FloatMask index = __builtin_convertvector(cell, FloatMask);
      const FloatMask wanted = axis == 0 ? cellX : axis == 1 ? none + box.y : none + box.z;
      taken &= (lower <= zero + box.upper[axis]) & (from <= upper) & (index == wanted);
    }
    found = append(taken, static_cast<int>(end - n < floats ? end - n : floats), columns.key + n, found);
  }
  return found;
}

} // namespace

const VectorKernels CACTUS_KERNELS = { evaluateCapsule, selectNeighbours, selectBoxes };

} // namespace cactus
