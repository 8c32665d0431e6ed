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

/// The segments of p and of as many neighbours q as a vector holds, and where they come closest.
struct ClosestPoints
{
  Doubles u[3];    ///< along p
  Doubles v[3];    ///< along q
  Doubles w[3];    ///< from q's closest point to p's
  Doubles a;       ///< u·u
  Doubles b;       ///< u·v
  Doubles e;       ///< v·v
  Doubles s;       ///< p's closest point, from 0 to 1 along u
  Doubles t;       ///< q's, along v
  Doubles squared; ///< w·w
};

/// What depends on p alone is written so that the compiler computes it once for all q.
CACTUS_KERNEL_INLINE ClosestPoints closestPointsOf(const Capsule& p, const Doubles (&q)[8])
{
  const Doubles zero = {};
  ClosestPoints pair = {};
  Doubles r[3];
  Doubles c = zero, f = zero;
  for (int axis = 0; axis < 3; ++axis)
  {
    pair.u[axis] = zero + (p.p1[axis] - p.p0[axis]);
    pair.v[axis] = q[4 + axis] - q[axis];
    r[axis] = p.p0[axis] - q[axis];
    pair.a += pair.u[axis] * pair.u[axis];
    pair.b += pair.u[axis] * pair.v[axis];
    c += pair.u[axis] * r[axis];
    pair.e += pair.v[axis] * pair.v[axis];
    f += pair.v[axis] * r[axis];
  }
  closestParameters<Doubles>(pair.a, pair.e, pair.b, c, f, pair.s, pair.t);
  for (int axis = 0; axis < 3; ++axis)
  {
    pair.w[axis] = r[axis] + pair.s * pair.u[axis] - pair.t * pair.v[axis];
    pair.squared += pair.w[axis] * pair.w[axis];
  }
  return pair;
}

/// How the cost changes as the closest points slide, given how it changes with the radii there along p and q. The points satisfy
/// a·s − b·t + c = 0 and −b·s + e·t − f = 0 (whichever is not clamped); the adjoint of that system gives the slide's share.
CACTUS_KERNEL_INLINE void slide(
  const ClosestPoints& pair, const Doubles& alongP, const Doubles& alongQ, Doubles& adjointS, Doubles& adjointT)
{
  const Doubles zero = {};
  const Doubles one = zero + 1.0;
  const Doubles determinant = pair.a * pair.e - pair.b * pair.b;
  const DoubleMask skew = determinant > 1e-12 * pair.a * pair.e;
  const DoubleMask sFree = (pair.s > zero) & (pair.s < one) & skew;
  const DoubleMask tFree = (pair.t > zero) & (pair.t < one) & skew;
  const Doubles inverseDeterminant = select(sFree & tFree, one, zero) / select(skew, determinant, one);
  adjointS = (pair.e * alongP + pair.b * alongQ) * inverseDeterminant + select(sFree & ~tFree, alongP / pair.a, zero);
  adjointT = (pair.b * alongP + pair.a * alongQ) * inverseDeterminant + select(tFree & ~sFree, alongQ / pair.e, zero);
}

/// Adds the contributions of as many neighbours q as a vector holds (their eight numbers, transposed) to the sums of p.
CACTUS_KERNEL_INLINE void addLanes(
  const Capsule& p, const Doubles (&q)[8], double margin, double tolerance, bool tapered, LaneSums& sums)
{
  const Doubles zero = {};
  const Doubles one = zero + 1.0;
  const ClosestPoints pair = closestPointsOf(p, q);
  const Doubles taperP = zero + (p.r1 - p.r0);
  const Doubles taperQ = q[7] - q[3];
  const Doubles rp = p.r0 + pair.s * taperP;
  const Doubles rq = q[3] + pair.t * taperQ;
  // Lists reach further than contact: many have no pair to add here.
  const Doubles farthest = margin * (rp + rq);
  if (!any(pair.squared < farthest * farthest))
  {
    return;
  }
  const Doubles distance = squareRoot(pair.squared);
  const Doubles lengthP = squareRoot(pair.a);
  const Doubles lengthQ = squareRoot(pair.e);
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
  Doubles adjointS = zero;
  Doubles adjointT = zero;
  if (tapered)
  {
    slide(pair, byRp * taperP, byRq * taperQ, adjointS, adjointT);
  }
  const Doubles near0 = one - pair.s;
  const Doubles alongW0 = push * near0 + adjointS;
  const Doubles alongW1 = push * pair.s - adjointS;
  const Doubles alongU0 = -adjointS * near0 - byLength;
  const Doubles alongU1 = -adjointS * pair.s + byLength;
  const Doubles alongV0 = adjointT * near0;
  const Doubles alongV1 = adjointT * pair.s;
  for (int axis = 0; axis < 3; ++axis)
  {
    sums.gradient0[axis] += alongW0 * pair.w[axis] + alongU0 * pair.u[axis] + alongV0 * pair.v[axis];
    sums.gradient1[axis] += alongW1 * pair.w[axis] + alongU1 * pair.u[axis] + alongV1 * pair.v[axis];
  }
  sums.radius0 += byRp * near0;
  sums.radius1 += byRp * pair.s;
  const Doubles stiffness = select(depth > zero, 2.0 * scale * inverseSum * inverseSum, zero);
  sums.stiffness0 += stiffness * near0;
  sums.stiffness1 += stiffness * pair.s;
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
