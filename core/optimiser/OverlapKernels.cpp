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

/// What neighbours contribute to a capsule.
enum Number
{
  Gradient0,
  Gradient1 = Gradient0 + 3,
  Radius0 = Gradient1 + 3,
  Radius1,
  Stiffness0,
  Stiffness1,
  Cost,
  Penetration, ///< the largest
  Overlapping, ///< how many
  Numbers = 16 ///< with some that are always zero, so that they are two times eight
};

/// Their sums and the largest, lane by lane.
struct LaneSums
{
  Doubles of[Numbers];
};

/// Adds up the lanes, and finds the largest.
CACTUS_KERNEL_INLINE void reduce(const LaneSums (&sums)[vectors], double (&totals)[Numbers], double (&maxima)[Numbers])
{
  for (int first = 0; first < Numbers; first += width)
  {
    alignas(64) double rows[width][lanes];
    const double* begins[width];
    for (int number = 0; number < width; ++number)
    {
      for (int v = 0; v < vectors; ++v)
      {
        __builtin_memcpy(rows[number] + v * width, &sums[v].of[first + number], sizeof(Doubles));
      }
      begins[number] = rows[number];
    }
    Doubles x[lanes];
    transpose(begins, x);
    const Doubles total = ((x[0] + x[1]) + (x[2] + x[3])) + ((x[4] + x[5]) + (x[6] + x[7]));
    Doubles largest = x[0];
    for (int l = 1; l < lanes; ++l)
    {
      largest = x[l] > largest ? x[l] : largest;
    }
    __builtin_memcpy(totals + first, &total, sizeof(total));
    __builtin_memcpy(maxima + first, &largest, sizeof(largest));
  }
}

/// The segment of p and those of as many neighbours q as a vector holds, and where they come closest.
struct ClosestPoints
{
  Doubles u[3];    ///< along p
  Doubles a;       ///< u·u
  Doubles v[3];    ///< along q
  Doubles w[3];    ///< from q's closest point to p's
  Doubles b;       ///< u·v
  Doubles e;       ///< v·v
  Doubles s;       ///< p's closest point, from 0 to 1 along u
  Doubles t;       ///< q's, along v
  Doubles squared; ///< w·w
  Doubles rq;      ///< radius there
  Doubles taperQ;  ///< by how much q's radius grows along v
};

/// What depends on p alone is written so that the compiler computes it once for all q.
CACTUS_KERNEL_INLINE void setSegment(const Capsule& p, ClosestPoints& pair)
{
  const Doubles zero = {};
  pair.a = zero;
  for (int axis = 0; axis < 3; ++axis)
  {
    pair.u[axis] = zero + (p.p1[axis] - p.p0[axis]);
    pair.a += pair.u[axis] * pair.u[axis];
  }
}

CACTUS_KERNEL_INLINE ClosestPoints closestPointsOf(const Capsule& p, const Doubles (&q)[8])
{
  ClosestPoints pair = {};
  setSegment(p, pair);
  Doubles r[3];
  Doubles c = {}, f = {};
  for (int axis = 0; axis < 3; ++axis)
  {
    pair.v[axis] = q[4 + axis] - q[axis];
    r[axis] = p.p0[axis] - q[axis];
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
  pair.taperQ = q[7] - q[3];
  pair.rq = q[3] + pair.t * pair.taperQ;
  return pair;
}

/// The neighbours that touch, gathered from among many that do not: what ClosestPoints knows of each beside what is p's.
class TouchingPairs
{
public:
  static constexpr std::size_t batch = 4 * lanes; ///< that may be there before append()

  std::size_t size() const { return this->Size; }

  CACTUS_KERNEL_INLINE void append(const DoubleMask& touching, const ClosestPoints& pair, bool tapered)
  {
    std::size_t added = 0;
    const auto put = [&](const Doubles& x, int column) __attribute__((always_inline))
    {
      added = compress(touching, x, this->Columns[column] + this->Size);
    };
    for (int axis = 0; axis < 3; ++axis)
    {
      put(pair.w[axis], ColumnW + axis);
    }
    put(pair.s, ColumnS);
    put(pair.squared, ColumnSquared);
    put(pair.e, ColumnE);
    put(pair.rq, ColumnRq);
    if (tapered)
    {
      put(pair.t, ColumnT);
      put(pair.b, ColumnB);
      put(pair.taperQ, ColumnTaperQ);
      for (int axis = 0; axis < 3; ++axis)
      {
        put(pair.v[axis], ColumnV + axis);
      }
    }
    this->Size += added;
  }

  CACTUS_KERNEL_INLINE void get(std::size_t first, bool tapered, ClosestPoints& pair) const
  {
    const auto column = [&](int number) __attribute__((always_inline))
    {
      return load(this->Columns[number] + first);
    };
    for (int axis = 0; axis < 3; ++axis)
    {
      pair.w[axis] = column(ColumnW + axis);
    }
    pair.s = column(ColumnS);
    pair.squared = column(ColumnSquared);
    pair.e = column(ColumnE);
    pair.rq = column(ColumnRq);
    if (tapered)
    {
      pair.t = column(ColumnT);
      pair.b = column(ColumnB);
      pair.taperQ = column(ColumnTaperQ);
      for (int axis = 0; axis < 3; ++axis)
      {
        pair.v[axis] = column(ColumnV + axis);
      }
    }
  }

  /// Fills the lanes that are left over behind the last pair with some that are too far apart to contribute anything.
  CACTUS_KERNEL_INLINE void fillUp()
  {
    const Doubles zero = {};
    for (int number = 0; number < ColumnCount; ++number)
    {
      const Doubles filling = zero + (number == ColumnSquared ? 1e12 : number == ColumnE || number == ColumnRq ? 1.0 : 0.0);
      __builtin_memcpy(this->Columns[number] + this->Size, &filling, sizeof(filling));
    }
  }

  /// Leaves out the first batch.
  CACTUS_KERNEL_INLINE void dropBatch()
  {
    this->Size -= batch;
    for (int number = 0; number < ColumnCount; ++number)
    {
      const Doubles left = load(this->Columns[number] + batch);
      __builtin_memcpy(this->Columns[number], &left, sizeof(left));
    }
  }

private:
  enum Column
  {
    ColumnW,
    ColumnS = ColumnW + 3,
    ColumnSquared,
    ColumnE,
    ColumnRq,
    ColumnT, // from here on only where radii vary
    ColumnB,
    ColumnTaperQ,
    ColumnV,
    ColumnCount = ColumnV + 3
  };
  std::size_t Size = 0;
  double Columns[ColumnCount][batch + 2 * width];
};

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

/// Adds what as many touching pairs as a vector holds contribute to the sums of p.
CACTUS_KERNEL_INLINE void addLanes(
  const Capsule& p, const ClosestPoints& pair, double margin, double tolerance, bool tapered, LaneSums& sums)
{
  const Doubles zero = {};
  const Doubles one = zero + 1.0;
  const Doubles taperP = zero + (p.r1 - p.r0);
  const Doubles rp = p.r0 + pair.s * taperP;
  const Doubles& rq = pair.rq;
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
    slide(pair, byRp * taperP, byRq * pair.taperQ, adjointS, adjointT);
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
    sums.of[Gradient0 + axis] += alongW0 * pair.w[axis] + alongU0 * pair.u[axis] + alongV0 * pair.v[axis];
    sums.of[Gradient1 + axis] += alongW1 * pair.w[axis] + alongU1 * pair.u[axis] + alongV1 * pair.v[axis];
  }
  sums.of[Radius0] += byRp * near0;
  sums.of[Radius1] += byRp * pair.s;
  const Doubles stiffness = select(depth > zero, 2.0 * scale * inverseSum * inverseSum, zero);
  sums.of[Stiffness0] += stiffness * near0;
  sums.of[Stiffness1] += stiffness * pair.s;
  sums.of[Cost] += 0.5 * D * D * scale;
  const Doubles deepest = one - ratio;
  sums.of[Penetration] = deepest > sums.of[Penetration] ? deepest : sums.of[Penetration];
  sums.of[Overlapping] += select(deepest > tolerance, one, zero);
}

/// Adds what the first `count` of the pairs contribute, the n-th of them in the lane n % lanes of all sums.
CACTUS_KERNEL_INLINE void addTouching(const Capsule& p, const TouchingPairs& pairs, std::size_t count, double margin,
  double tolerance, bool tapered, LaneSums (&sums)[vectors])
{
  ClosestPoints pair = {};
  setSegment(p, pair);
  for (int v = 0; v < vectors; ++v)
  {
    for (std::size_t n = std::size_t(v) * width; n < count; n += lanes)
    {
      pairs.get(n, tapered, pair);
      addLanes(p, pair, margin, tolerance, tapered, sums[v]);
    }
  }
}

/// A capsule too far away to touch, for the lanes that are left over.
CACTUS_KERNEL_INLINE Capsule farFrom(const Capsule& p)
{
  Capsule far = p;
  for (int axis = 0; axis < 3; ++axis)
  {
    far.p0[axis] += 1e6;
    far.p1[axis] = far.p0[axis] + 1.0;
  }
  return far;
}

/// The numbers of as many capsules as a vector holds, or of the `count` that are left.
CACTUS_KERNEL_INLINE void gather(
  const Capsule* bodies, const std::uint32_t* indices, std::size_t count, const Capsule& far, Doubles (&q)[8])
{
  const double* rows[width];
  for (std::size_t l = 0; l < width; ++l)
  {
    rows[l] = reinterpret_cast<const double*>(l < count ? bodies + indices[l] : &far);
  }
  transpose(rows, q);
}

/// Lists reach further than contact: much of what they hold contributes nothing. What does is gathered first and then summed, so
/// that sums depend on which capsules touch, and not on what else is in the list.
void evaluateCapsule(const Capsule* bodies, const std::uint32_t* neighbours, std::size_t count, std::size_t known,
  const Capsule& p, double margin, double tolerance, bool tapered, CapsuleOverlap& result)
{
  constexpr std::size_t ahead = 32; // neighbours that are on their way from memory
  const Capsule far = farFrom(p);
  TouchingPairs touching;
  LaneSums all[vectors] = {};
  for (LaneSums& sums : all)
  {
    sums.of[Penetration] -= 1.0;
  }
  for (std::size_t n = 0; n < count; n += width)
  {
    for (std::size_t next = n + ahead; next < n + ahead + width && next < known; ++next)
    {
      __builtin_prefetch(bodies + neighbours[next]);
    }
    Doubles q[8];
    gather(bodies, neighbours + n, count - n, far, q);
    const ClosestPoints pair = closestPointsOf(p, q);
    const Doubles farthest = margin * (p.r0 + pair.s * (p.r1 - p.r0) + pair.rq);
    touching.append(pair.squared < farthest * farthest, pair, tapered);
    if (touching.size() >= TouchingPairs::batch)
    {
      addTouching(p, touching, TouchingPairs::batch, margin, tolerance, tapered, all);
      touching.dropBatch();
    }
  }
  touching.fillUp();
  addTouching(p, touching, touching.size(), margin, tolerance, tapered, all);
  double totals[Numbers];
  double maxima[Numbers];
  reduce(all, totals, maxima);
  for (int axis = 0; axis < 3; ++axis)
  {
    result.gradient0[axis] = totals[Gradient0 + axis];
    result.gradient1[axis] = totals[Gradient1 + axis];
  }
  result.radius0 = totals[Radius0];
  result.radius1 = totals[Radius1];
  result.stiffness0 = totals[Stiffness0];
  result.stiffness1 = totals[Stiffness1];
  result.cost = totals[Cost];
  result.penetration = maxima[Penetration];
  result.overlapping = static_cast<std::size_t>(totals[Overlapping]);
}

} // namespace

const OverlapKernels CACTUS_KERNELS_OF_UNIT(OverlapKernels) = { evaluateCapsule };

} // namespace cactus
