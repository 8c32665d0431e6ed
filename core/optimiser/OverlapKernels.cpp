// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/OverlapKernels.h"

#include "base/Vector.h"
#include "fibres/SegmentDistance.h"

namespace cactus
{

namespace
{

/// Neighbours are summed in this many lanes, in one vector or in several.
constexpr int lanes = 8;
constexpr int vectors = lanes / width;

/// What the neighbours contribute to one capsule, lane by lane.
struct LaneSums
{
  Doubles gradient0[3];
  Doubles gradient1[3];
  Doubles radius0;
  Doubles radius1;
  Doubles stiffness0;
  Doubles stiffness1;
  Doubles cost;
  Doubles penetration;
  DoubleMask overlapping;
};

/// Adds the contributions of as many neighbours q as a vector holds (their eight numbers, transposed) to the sums of p.
CACTUS_KERNEL_INLINE void addLanes(
  const Capsule& p, const Doubles (&q)[8], double margin, double tolerance, bool tapered, LaneSums& sums)
{
  // Nothing here that depends on p alone depends on q, so that it is computed once.
  const Doubles zero = {};
  const Doubles one = zero + 1.0;
  Doubles u[3], v[3], r[3], w[3];
  Doubles a = zero, b = zero, c = zero, e = zero, f = zero;
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
  Doubles s, t;
  closestParameters<Doubles>(a, e, b, c, f, s, t);
  Doubles squared = zero;
  for (int axis = 0; axis < 3; ++axis)
  {
    w[axis] = r[axis] + s * u[axis] - t * v[axis];
    squared += w[axis] * w[axis];
  }
  const Doubles taperP = zero + (p.r1 - p.r0);
  const Doubles taperQ = q[7] - q[3];
  const Doubles rp = p.r0 + s * taperP;
  const Doubles rq = q[3] + t * taperQ;
  // Lists reach further than contact: many have no pair to add here.
  const Doubles farthest = margin * (rp + rq);
  if (!any(squared < farthest * farthest))
  {
    return;
  }
  const Doubles distance = squareRoot(squared);
  const Doubles lengthP = squareRoot(a);
  const Doubles lengthQ = squareRoot(e);
  const Doubles inverseSum = one / (rp + rq);
  const Doubles ratio = distance * inverseSum;
  const Doubles depth = margin - ratio;
  const Doubles D = select(depth > zero, depth, zero);
  const Doubles lengths = lengthP * lengthQ;
  const Doubles scale = lengths * rp * rq;
  const Doubles byLength = D * D * lengthQ * rp * rq * (one / lengthP); // ∂F/∂|p0−p1| / |p0−p1|
  // Where the axes meet there is no direction to part in: no push from here, see partCoincident().
  const Doubles push = -2.0 * D * scale * inverseSum / select(distance > 1e-12, distance, one);
  const Doubles byRp = 2.0 * D * ratio * inverseSum * scale + D * D * lengths * rq;
  const Doubles byRq = 2.0 * D * ratio * inverseSum * scale + D * D * lengths * rp;
  // Where a radius varies along its capsule, the cost also changes as the closest points slide. They satisfy
  // a·s − b·t + c = 0 and −b·s + e·t − f = 0 (whichever is not clamped); the adjoint of that system gives the slide's share.
  Doubles adjointS = zero;
  Doubles adjointT = zero;
  if (tapered)
  {
    const Doubles alongP = byRp * taperP;
    const Doubles alongQ = byRq * taperQ;
    const Doubles determinant = a * e - b * b;
    const DoubleMask skew = determinant > 1e-12 * a * e;
    const DoubleMask sFree = (s > zero) & (s < one) & skew;
    const DoubleMask tFree = (t > zero) & (t < one) & skew;
    const Doubles inverseDeterminant = select(sFree & tFree, one, zero) / select(skew, determinant, one);
    adjointS = (e * alongP + b * alongQ) * inverseDeterminant + select(sFree & ~tFree, alongP / a, zero);
    adjointT = (b * alongP + a * alongQ) * inverseDeterminant + select(tFree & ~sFree, alongQ / e, zero);
  }
  const Doubles near0 = one - s;
  const Doubles alongW0 = push * near0 + adjointS;
  const Doubles alongW1 = push * s - adjointS;
  const Doubles alongU0 = -adjointS * near0 - byLength;
  const Doubles alongU1 = -adjointS * s + byLength;
  const Doubles alongV0 = adjointT * near0;
  const Doubles alongV1 = adjointT * s;
  for (int axis = 0; axis < 3; ++axis)
  {
    sums.gradient0[axis] += alongW0 * w[axis] + alongU0 * u[axis] + alongV0 * v[axis];
    sums.gradient1[axis] += alongW1 * w[axis] + alongU1 * u[axis] + alongV1 * v[axis];
  }
  sums.radius0 += byRp * near0;
  sums.radius1 += byRp * s;
  const Doubles stiffness = select(depth > zero, 2.0 * scale * inverseSum * inverseSum, zero);
  sums.stiffness0 += stiffness * near0;
  sums.stiffness1 += stiffness * s;
  sums.cost += 0.5 * D * D * scale;
  const Doubles penetration = one - ratio;
  sums.penetration = penetration > sums.penetration ? penetration : sums.penetration;
  sums.overlapping -= penetration > tolerance;
}

void evaluateCapsule(const Capsule* bodies, const std::uint32_t* neighbours, std::size_t count, const Capsule& p, double margin,
  double tolerance, bool tapered, CapsuleOverlap& result)
{
  // A capsule too far away to contribute anything fills the lanes that are left over.
  Capsule farAway = p;
  for (int axis = 0; axis < 3; ++axis)
  {
    farAway.p0[axis] += 1e6;
    farAway.p1[axis] = farAway.p0[axis] + 1.0;
  }
  LaneSums all[vectors];
  for (int v = 0; v < vectors; ++v)
  {
    LaneSums sums = {};
    sums.penetration -= 1.0;
    for (std::size_t n = std::size_t(v) * width; n < count; n += lanes)
    {
      const double* others[width];
      for (std::size_t l = 0; l < width; ++l)
      {
        others[l] = reinterpret_cast<const double*>(n + l < count ? bodies + neighbours[n + l] : &farAway);
      }
      Doubles q[8];
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
    result.gradient0[axis] = sumOf([axis](const LaneSums& sums) -> const Doubles& { return sums.gradient0[axis]; });
    result.gradient1[axis] = sumOf([axis](const LaneSums& sums) -> const Doubles& { return sums.gradient1[axis]; });
  }
  result.radius0 = sumOf([](const LaneSums& sums) -> const Doubles& { return sums.radius0; });
  result.radius1 = sumOf([](const LaneSums& sums) -> const Doubles& { return sums.radius1; });
  result.stiffness0 = sumOf([](const LaneSums& sums) -> const Doubles& { return sums.stiffness0; });
  result.stiffness1 = sumOf([](const LaneSums& sums) -> const Doubles& { return sums.stiffness1; });
  result.cost = sumOf([](const LaneSums& sums) -> const Doubles& { return sums.cost; });
  result.penetration = -1.0;
  result.overlapping = 0;
  for (int l = 0; l < lanes; ++l)
  {
    const double penetration = all[l / width].penetration[l % width];
    result.penetration = penetration > result.penetration ? penetration : result.penetration;
    result.overlapping += static_cast<std::size_t>(all[l / width].overlapping[l % width]);
  }
}

} // namespace

const OverlapKernels CACTUS_KERNELS_OF_UNIT(OverlapKernels) = { evaluateCapsule };

} // namespace cactus
