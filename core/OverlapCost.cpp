// SPDX-License-Identifier: BSD-3-Clause
#include "OverlapCost.h"

#include "SegmentDistance.h"
#include "Vectors.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace cactus
{

namespace
{

constexpr int width = 8;

/// Eight doubles that the compiler maps onto whatever vector unit there is.
typedef double Vector __attribute__((vector_size(8 * width)));
typedef long long Mask __attribute__((vector_size(8 * width)));

inline __attribute__((always_inline)) Vector select(const Mask& mask, const Vector& x, const Vector& y)
{
  return mask ? x : y;
}

inline __attribute__((always_inline)) Vector squareRoot(const Vector& x)
{
  Vector root;
  for (int l = 0; l < width; ++l)
  {
    root[l] = std::sqrt(x[l]);
  }
  return root;
}

/// Sum of the lanes, in a fixed order.
inline __attribute__((always_inline)) double sumOf(const Vector& x)
{
  return ((x[0] + x[1]) + (x[2] + x[3])) + ((x[4] + x[5]) + (x[6] + x[7]));
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

/// Adds the contributions of eight neighbours q (their eight numbers, transposed) to the sums of p.
inline __attribute__((always_inline)) void addLanes(
  const Capsule& p, const Vector (&q)[8], double margin, double tolerance, LaneSums& sums)
{
  const Vector zero = q[0] - q[0];
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
  const Vector distance = squareRoot(squared);
  const Vector lengthP = zero + std::sqrt(a[0]);
  const Vector lengthQ = squareRoot(e);
  const Vector taperP = zero + (p.r1 - p.r0);
  const Vector taperQ = q[7] - q[3];
  const Vector rp = p.r0 + s * taperP;
  const Vector rq = q[3] + t * taperQ;
  const Vector inverseSum = one / (rp + rq);
  const Vector ratio = distance * inverseSum;
  const Vector depth = margin - ratio;
  const Vector D = select(depth > zero, depth, zero);
  const Vector lengths = lengthP * lengthQ;
  const Vector scale = lengths * rp * rq;
  const Vector byLength = D * D * lengthQ * rp * rq / lengthP; // ∂F/∂|p0−p1| / |p0−p1|
  // Concentric capsules have no direction to part in: no push, the next step of their neighbours breaks the tie.
  const Vector push = -2.0 * D * scale * inverseSum / select(distance > 1e-12, distance, one);
  const Vector byRp = 2.0 * D * ratio * inverseSum * scale + D * D * lengths * rq;
  const Vector byRq = 2.0 * D * ratio * inverseSum * scale + D * D * lengths * rp;
  // Where a radius varies along its capsule, the cost also changes as the closest points slide. They satisfy
  // a·s − b·t + c = 0 and −b·s + e·t − f = 0 (whichever is not clamped); the adjoint of that system gives the slide's share.
  const Vector alongP = byRp * taperP;
  const Vector alongQ = byRq * taperQ;
  const Vector determinant = a * e - b * b;
  const Mask skew = determinant > 1e-12 * a * e;
  const Mask sFree = (s > zero) & (s < one) & skew;
  const Mask tFree = (t > zero) & (t < one) & skew;
  const Vector inverseDeterminant = select(sFree & tFree, one, zero) / select(skew, determinant, one);
  const Vector adjointS = (e * alongP + b * alongQ) * inverseDeterminant + select(sFree & ~tFree, alongP / a, zero);
  const Vector adjointT = (b * alongP + a * alongQ) * inverseDeterminant + select(tFree & ~sFree, alongQ / e, zero);

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

CACTUS_VECTOR_CLONES void evaluateCapsule(const Capsules& capsules, const std::uint32_t* neighbours, std::size_t count,
  const Capsule& p, double margin, double tolerance, CapsuleOverlap& result)
{
  // A capsule too far away to contribute anything fills the lanes that are left over.
  Capsule nothing = p;
  for (int axis = 0; axis < 3; ++axis)
  {
    nothing.p0[axis] += 1e6;
    nothing.p1[axis] = nothing.p0[axis] + 1.0;
  }
  LaneSums sums = {};
  sums.penetration -= 1.0;
  for (std::size_t n = 0; n < count; n += width)
  {
    double numbers[8][width];
    for (std::size_t l = 0; l < width; ++l)
    {
      const Capsule& q = n + l < count ? capsules.bodies[neighbours[n + l]] : nothing;
      for (int axis = 0; axis < 3; ++axis)
      {
        numbers[axis][l] = q.p0[axis];
        numbers[4 + axis][l] = q.p1[axis];
      }
      numbers[3][l] = q.r0;
      numbers[7][l] = q.r1;
    }
    Vector q[8];
    std::memcpy(&q, &numbers, sizeof(q));
    addLanes(p, q, margin, tolerance, sums);
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    result.gradient0[axis] = sumOf(sums.gradient0[axis]);
    result.gradient1[axis] = sumOf(sums.gradient1[axis]);
  }
  result.radius0 = sumOf(sums.radius0);
  result.radius1 = sumOf(sums.radius1);
  result.stiffness0 = sumOf(sums.stiffness0);
  result.stiffness1 = sumOf(sums.stiffness1);
  result.cost = sumOf(sums.cost);
  result.penetration = -1.0;
  result.overlapping = 0;
  for (int l = 0; l < width; ++l)
  {
    result.penetration = std::max(result.penetration, sums.penetration[l]);
    result.overlapping += static_cast<std::size_t>(sums.overlapping[l]);
  }
}

} // namespace

OverlapTotals evaluateOverlap(const Capsules& capsules, const NeighbourList& neighbours, double margin, double tolerance,
  int threads, std::vector<CapsuleOverlap>& result)
{
  const std::size_t count = capsules.size();
  result.resize(count);
  constexpr std::size_t blockSize = 1024;
  const std::size_t blocks = (count + blockSize - 1) / blockSize;
  std::vector<OverlapTotals> partial(blocks);
#pragma omp parallel for num_threads(threads) schedule(dynamic, 4)
  for (std::size_t block = 0; block < blocks; ++block)
  {
    OverlapTotals& mine = partial[block];
    const std::size_t end = std::min(count, (block + 1) * blockSize);
    for (std::size_t k = block * blockSize; k < end; ++k)
    {
      evaluateCapsule(capsules, neighbours.indices.data() + neighbours.offsets[k],
        neighbours.offsets[k + 1] - neighbours.offsets[k], capsules.bodies[k], margin, tolerance, result[k]);
      mine.cost += result[k].cost;
      mine.penetration = std::max(mine.penetration, result[k].penetration);
      mine.overlappingPairs += result[k].overlapping;
    }
  }
  OverlapTotals totals;
  for (const OverlapTotals& mine : partial)
  {
    totals.cost += mine.cost;
    totals.penetration = std::max(totals.penetration, mine.penetration);
    totals.overlappingPairs += mine.overlappingPairs;
  }
  totals.overlappingPairs /= 2;
  return totals;
}

} // namespace cactus
