// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/SearchKernels.h"

#include "base/Vector.h"
#include "fibres/SegmentDistance.h"

namespace cactus
{

namespace
{

/// Appends those capsules n … n + floats − 1 of the columns whose lane is set to the kept ones, up to the reach, and returns the
/// new size; may write up to a vector beyond it.
template <std::size_t room>
CACTUS_KERNEL_INLINE std::size_t keep(const FloatMask& mask, const NearColumns& near, const std::uint32_t* indices, std::size_t n,
  float (&kept)[7][room], std::uint32_t (&keptIndices)[room], std::size_t size)
{
#if CACTUS_DOUBLES == 8
  const unsigned set = bitsOf(mask);
  const auto lanesSet = static_cast<__mmask16>(set);
  for (int number = 0; number < 7; ++number)
  {
    const float* column = near.numbers + std::size_t(number) * near.stride + n;
    _mm512_storeu_ps(kept[number] + size, _mm512_maskz_compress_ps(lanesSet, _mm512_loadu_ps(column)));
  }
  _mm512_storeu_si512(keptIndices + size, _mm512_maskz_compress_epi32(lanesSet, _mm512_loadu_si512(indices + n)));
  return size + static_cast<std::size_t>(__builtin_popcount(set));
#else
  const auto take = [&](int lane) __attribute__((always_inline))
  {
    const std::size_t place = n + static_cast<std::size_t>(lane);
    for (int number = 0; number < 7; ++number)
    {
      kept[number][size] = near.numbers[std::size_t(number) * near.stride + place];
    }
    keptIndices[size++] = indices[place];
  };
#if CACTUS_DOUBLES == 4
  for (unsigned set = bitsOf(mask); set != 0; set &= set - 1)
  {
    take(__builtin_ctz(set));
  }
#else
  for (int l = 0; l < floats; ++l)
  {
    if (mask[l])
    {
      take(l);
    }
  }
#endif
  return size;
#endif
}

void gatherNear(const Capsule* bodies, const float* reach, const std::uint32_t* indices, std::size_t count,
  const double (&origin)[3], const NearColumns& near)
{
  Capsule away = {};
  for (int axis = 0; axis < 3; ++axis)
  {
    away.p0[axis] = 1e9;
    away.p1[axis] = 1.001e9;
  }
  const std::size_t padded = (count + 15) / 16 * 16;
  float* reaches = near.numbers + 6 * near.stride;
  for (std::size_t n = 0; n < padded; ++n)
  {
    reaches[n] = n < count ? reach[indices[n]] : 0.0f;
  }
  for (std::size_t n = 0; n < padded; n += width)
  {
    const double* capsules[width];
    for (std::size_t l = 0; l < width; ++l)
    {
      capsules[l] = reinterpret_cast<const double*>(n + l < count ? bodies + indices[n + l] : &away);
    }
    Doubles q[8];
    transpose(capsules, q);
    NarrowFloats limit;
    __builtin_memcpy(&limit, reaches + n, sizeof(NarrowFloats));
    limit += __builtin_convertvector(q[3] > q[7] ? q[3] : q[7], NarrowFloats);
    NarrowFloats numbers[NearColumns::count];
    Doubles squared = {};
    for (int axis = 0; axis < 3; ++axis)
    {
      const Doubles u = q[4 + axis] - q[axis];
      squared += u * u;
      numbers[axis] = __builtin_convertvector(q[axis] - origin[axis], NarrowFloats);
      numbers[3 + axis] = __builtin_convertvector(q[4 + axis] - origin[axis], NarrowFloats);
      numbers[7 + axis] = 0.5f * (numbers[axis] + numbers[3 + axis]);
    }
    numbers[6] = limit;
    numbers[10] = limit + __builtin_convertvector(0.5 * squareRoot(squared), NarrowFloats);
    for (int number = 0; number < NearColumns::count; ++number)
    {
      __builtin_memcpy(near.numbers + std::size_t(number) * near.stride + n, &numbers[number], sizeof(NarrowFloats));
    }
  }
}

/// Tells which of the capsules n … n + floats − 1 of the columns have bounding balls that meet that of p: most candidates do not.
CACTUS_KERNEL_INLINE FloatMask ballsMeet(const NearColumns& near, std::size_t n, const float (&p)[NearColumns::count])
{
  Floats q[4];
  for (int number = 0; number < 4; ++number)
  {
    q[number] = load(near.numbers + std::size_t(7 + number) * near.stride + n);
  }
  Floats squared = {};
  for (int axis = 0; axis < 3; ++axis)
  {
    const Floats w = p[7 + axis] - q[axis];
    squared += w * w;
  }
  // The slack is ten times that of the exact test.
  const Floats limit = p[10] + q[3];
  return squared < 1.0001f * (limit * limit);
}

/// Tells which of the capsules q (their numbers up to the reach) are within reach of p.
CACTUS_KERNEL_INLINE FloatMask areClose(const Floats (&q)[7], const float (&p)[NearColumns::count])
{
  const Floats zero = {};
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
  nearlyClosestParameters(a, 1.0f / a, e, b, c, f, s, t);
  Floats squared = zero;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Floats w = r[axis] + s * u[axis] - t * v[axis];
    squared += w * w;
  }
  const Floats limit = p[6] + q[6];
  // The slack is twice the largest error of `squared`.
  return squared < limit * limit + 2e-5f * (limit * limit + a + e);
}

std::uint32_t* selectNeighbours(const NearColumns& near, const std::uint32_t* indices, std::size_t count,
  const float (&p)[NearColumns::count], std::uint32_t* found)
{
  // Candidates whose balls meet are compacted, so that the exact test has full vectors.
  constexpr std::size_t most = 256;
  float kept[7][most + floats];
  std::uint32_t keptIndices[most + floats];
  for (std::size_t begin = 0; begin < count; begin += most)
  {
    const std::size_t end = count - begin < most ? count : begin + most;
    std::size_t size = 0;
    for (std::size_t n = begin; n < end; n += floats)
    {
      size = keep(ballsMeet(near, n, p), near, indices, n, kept, keptIndices, size);
    }
    for (std::size_t n = 0; n < size; n += floats)
    {
      Floats q[7];
      for (int number = 0; number < 7; ++number)
      {
        q[number] = load(kept[number] + n);
      }
      found = append(areClose(q, p), static_cast<int>(size - n < floats ? size - n : floats), keptIndices + n, found);
    }
  }
  return found;
}

std::uint32_t* selectBoxes(
  const BoxColumns& columns, std::size_t begin, std::size_t end, const BoxQuery& box, std::uint32_t* found)
{
  const Floats zero = {};
  const FloatMask none = {};
  for (std::size_t n = begin; n < end; n += floats)
  {
    FloatMask cellX, key;
    __builtin_memcpy(&cellX, columns.cell + n, sizeof(FloatMask));
    __builtin_memcpy(&key, columns.key + n, sizeof(FloatMask));
    FloatMask taken = (key < static_cast<std::int32_t>(box.skipFrom)) | (key >= static_cast<std::int32_t>(box.skipTo));
    for (int axis = 0; axis < 3; ++axis)
    {
      const Floats lower = load(columns.lower[axis] + n);
      const Floats upper = load(columns.upper[axis] + n);
      const Floats from = zero + box.lower[axis];
      const Floats last = zero + box.last[axis];
      // As in RunGrid::cellOf.
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

void sortKeys(const std::uint32_t* keys, std::size_t count, std::uint32_t* sorted)
{
  // A key's rank is the number of smaller keys.
  for (std::size_t n = 0; n < count; n += floats)
  {
    FloatMask mine;
    __builtin_memcpy(&mine, keys + n, sizeof(FloatMask));
    FloatMask smaller = {};
    for (std::size_t other = 0; other < count; ++other)
    {
      smaller += mine > static_cast<std::int32_t>(keys[other]);
    }
    const std::size_t left = count - n < floats ? count - n : floats;
    for (std::size_t l = 0; l < left; ++l)
    {
      sorted[-smaller[l]] = keys[n + l];
    }
  }
}

std::uint32_t* selectFromRuns(const BoxBlock* blocks, const std::uint32_t* first, const std::uint32_t* runs, std::size_t count,
  const BoxQuery& box, std::uint32_t* found)
{
  BoxBlock bounds;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int l = 0; l < 8; ++l)
    {
      bounds.bounds[axis][l] = box.upper[axis];
      bounds.bounds[axis][8 + l] = -box.lower[axis];
    }
  }
  constexpr int parts = 16 / floats;
  Floats most[3][parts];
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int part = 0; part < parts; ++part)
    {
      most[axis][part] = load(bounds.bounds[axis] + part * floats);
    }
  }
  for (std::size_t run = 0; run < count; ++run)
  {
    const BoxBlock& block = blocks[runs[run]];
    FloatMask within[parts];
    for (int part = 0; part < parts; ++part)
    {
      within[part] = load(block.bounds[0] + part * floats) <= most[0][part];
      within[part] &= load(block.bounds[1] + part * floats) <= most[1][part];
      within[part] &= load(block.bounds[2] + part * floats) <= most[2][part];
    }
    const std::uint32_t start = first[runs[run]];
#if CACTUS_DOUBLES == 8
    const unsigned bounded = bitsOf(within[0]);
    const unsigned set = bounded & (bounded >> 8);
    const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    const __m256i numbers = _mm256_add_epi32(lane, _mm256_set1_epi32(static_cast<int>(start)));
    _mm256_storeu_si256((__m256i*)found, _mm256_maskz_compress_epi32(static_cast<__mmask8>(set), numbers));
    found += __builtin_popcount(set);
#else
    for (int part = 0; part < parts / 2; ++part)
    {
      const FloatMask taken = within[part] & within[parts / 2 + part];
      std::uint32_t numbers[floats];
      for (int l = 0; l < floats; ++l)
      {
        numbers[l] = start + static_cast<std::uint32_t>(part * floats + l);
      }
      found = append(taken, floats, numbers, found);
    }
#endif
  }
  return found;
}

} // namespace

const SearchKernels CACTUS_KERNELS_OF_UNIT(
  SearchKernels) = { gatherNear, selectNeighbours, selectBoxes, sortKeys, selectFromRuns };

} // namespace cactus
