// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/OverlapKernels.h"

#include "base/Vector.h"
#include "fibres/SegmentDistance.h"

#include <cstddef>

namespace cactus
{

namespace
{

/// Touching neighbours are summed in this many lanes, in one vector or in several: the n-th in the lane n % lanes.
constexpr int lanes = 8;
constexpr int vectors = lanes / width;

/// The sums over neighbours, in the order of CapsuleOverlap.
enum Number
{
  Gradient0,
  Radius0 = Gradient0 + 3,
  Gradient1,
  Radius1 = Gradient1 + 3,
  Stiffness0,
  Stiffness1,
  Cost,
  Overlapping, ///< number of overlapping neighbours
  Numbers
};

/// The sums lane by lane, and the largest penetrations.
struct LaneSums
{
  Doubles of[Numbers][vectors];
  Doubles deepest[vectors];
};

CACTUS_KERNEL_INLINE LaneSums noSums()
{
  LaneSums sums = {};
  for (Doubles& deepest : sums.deepest)
  {
    deepest = deepest - 1.0;
  }
  return sums;
}

void roughen(const Capsule* bodies, std::size_t count, RoughCapsule* rough)
{
  for (std::size_t k = 0; k < count; ++k)
  {
    for (int part = 0; part < lanes; part += width)
    {
      const Doubles numbers = load(&bodies[k].p0[0] + part);
      const NarrowFloats narrow = __builtin_convertvector(numbers, NarrowFloats);
      __builtin_memcpy(&rough[k].p0[0] + part, &narrow, sizeof(narrow));
    }
  }
}

/// Precomputed values of the capsules that are processed at once.
struct Subjects
{
  static constexpr std::size_t most = OverlapKernels::together;
  // In single precision.
  alignas(64) float roughU[3][most];
  alignas(64) float roughSquared[most];
  alignas(64) float roughInverse[most];
  alignas(64) float reach[most]; ///< radius, with the margin and a bound on rounding
  // In double precision.
  alignas(64) double u[3][most];    ///< along it
  alignas(64) double squared[most]; ///< u·u
  alignas(64) double inverseSquared[most];
  alignas(64) double length[most];
  alignas(64) double inverseLength[most];
};

template <bool tapered>
CACTUS_KERNEL_INLINE void prepareRough(const RoughCapsule* bodies, std::size_t count, double margin, Subjects& subjects)
{
  for (std::size_t k = 0; k < count; k += floats)
  {
    const float* rows[floats];
    for (std::size_t l = 0; l < floats; ++l)
    {
      rows[l] = bodies[k + l < count ? k + l : k].p0;
    }
    Floats p[8];
    transpose(rows, p);
    const Floats zero = {};
    Floats squared = zero;
    Floats farthest = zero;
    for (int axis = 0; axis < 3; ++axis)
    {
      const Floats u = p[4 + axis] - p[axis];
      squared += u * u;
      store(subjects.roughU[axis] + k, u);
      farthest = larger(farthest, larger(larger(p[axis], -p[axis]), larger(p[4 + axis], -p[4 + axis])));
    }
    store(subjects.roughSquared + k, squared);
    store(subjects.roughInverse + k, 1.0f / squared);
    // Coordinates are rounded by 2⁻²⁴ of themselves, which changes the distance of two axes by less than this; a neighbour's
    // coordinates are larger by no more than the bound in selectTouching allows.
    const Floats rounding = 3e-7f * farthest;
    store(subjects.reach + k, static_cast<float>(margin) * (tapered ? larger(p[3], p[7]) : p[3]) + rounding);
  }
}

CACTUS_KERNEL_INLINE void prepare(const Capsule* bodies, std::size_t count, Subjects& subjects)
{
  for (std::size_t k = 0; k < count; k += width)
  {
    const double* rows[width];
    for (std::size_t l = 0; l < width; ++l)
    {
      rows[l] = bodies[k + l < count ? k + l : k].p0;
    }
    Doubles p[8];
    transpose(rows, p);
    Doubles squared = {};
    for (int axis = 0; axis < 3; ++axis)
    {
      const Doubles u = p[4 + axis] - p[axis];
      squared += u * u;
      store(subjects.u[axis] + k, u);
    }
    const Doubles length = squareRoot(squared);
    store(subjects.squared + k, squared);
    store(subjects.inverseSquared + k, 1.0 / squared);
    store(subjects.length + k, length);
    store(subjects.inverseLength + k, 1.0 / length);
  }
}

/// Writes to `found` those neighbours of the k-th capsule that may touch it, in their order, and returns the end of the output:
/// all that touch, and hardly any others. `subject`: its index among the subjects.
template <bool tapered>
CACTUS_KERNEL_INLINE std::uint32_t* selectTouching(const ListedCapsules& capsules, std::size_t k, const Subjects& subjects,
  std::size_t subject, double margin, std::uint32_t* found)
{
  const RoughCapsule& p = capsules.rough[capsules.first + k];
  const Floats zero = {};
  Floats u[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    u[axis] = zero + subjects.roughU[axis][subject];
  }
  const Floats a = zero + subjects.roughSquared[subject];
  const Floats inverseA = zero + subjects.roughInverse[subject];
  const float reach = subjects.reach[subject];
  const auto narrowMargin = static_cast<float>(margin);
  const std::size_t end = capsules.offsets[k + 1];
  for (std::size_t n = capsules.offsets[k]; n < end; n += floats)
  {
    // Entries beyond the list belong to the next capsule, and are dropped in the end.
    constexpr std::size_t ahead = 64;
    const std::uint32_t* indices = capsules.neighbours + n;
    std::uint32_t last[floats];
    if (n + floats > capsules.neighbourCount)
    {
      for (std::size_t l = 0; l < floats; ++l)
      {
        last[l] = indices[n + l < end ? l : 0];
      }
      indices = last;
    }
    const std::uint32_t* next = capsules.neighbours + n + ahead; // prefetched from memory
    if (next + floats < capsules.neighbours + capsules.neighbourCount)
    {
      for (int l = 0; l < floats; ++l)
      {
        __builtin_prefetch(capsules.rough + next[l]);
      }
    }
    const float* rows[floats];
    for (int l = 0; l < floats; ++l)
    {
      rows[l] = &capsules.rough[indices[l]].p0[0];
    }
    Floats q[8];
    transpose(rows, q);
    Floats v[3], r[3];
    Floats b = zero, c = zero, e = zero, f = zero;
    for (int axis = 0; axis < 3; ++axis)
    {
      v[axis] = q[4 + axis] - q[axis];
      r[axis] = p.p0[axis] - q[axis];
      b += u[axis] * v[axis];
      c += u[axis] * r[axis];
      e += v[axis] * v[axis];
      f += v[axis] * r[axis];
    }
    Floats s, t;
    nearlyClosestParameters(a, inverseA, e, b, c, f, s, t);
    Floats squared = zero;
    for (int axis = 0; axis < 3; ++axis)
    {
      const Floats w = r[axis] + s * u[axis] - t * v[axis];
      squared += w * w;
    }
    const Floats limit = reach + narrowMargin * (tapered ? larger(q[3], q[7]) : q[3]);
    // The slack is twice the largest error of `squared`. Written so that it holds for NaN.
    const FloatMask near = ~(squared >= limit * limit + 2e-5f * (limit * limit + a + e));
    found = append(near, static_cast<int>(end - n < floats ? end - n : floats), indices, found);
  }
  return found;
}

/// The capsule that neighbours are compared with.
struct Subject
{
  double p0[3];
  double u[3];    ///< along it
  double squared; ///< u·u
  double inverseSquared;
  double length;
  double inverseLength;
  double r0;
  double taper; ///< growth of the radius along it
};

CACTUS_KERNEL_INLINE Subject subjectOf(const Capsule& body, const Subjects& subjects, std::size_t k)
{
  Subject subject;
  for (int axis = 0; axis < 3; ++axis)
  {
    subject.p0[axis] = body.p0[axis];
    subject.u[axis] = subjects.u[axis][k];
  }
  subject.squared = subjects.squared[k];
  subject.inverseSquared = subjects.inverseSquared[k];
  subject.length = subjects.length[k];
  subject.inverseLength = subjects.inverseLength[k];
  subject.r0 = body.r0;
  subject.taper = body.r1 - body.r0;
  return subject;
}

/// A vector of neighbours q of p, and their closest points.
struct ClosestPoints
{
  Doubles v[3];    ///< along q
  Doubles w[3];    ///< from q's closest point to p's
  Doubles b;       ///< u·v
  Doubles e;       ///< v·v
  Doubles s;       ///< p's closest point, from 0 to 1 along u
  Doubles t;       ///< q's, along v
  Doubles squared; ///< w·w
  Doubles rp;      ///< radii at the closest points
  Doubles rq;
  Doubles taperQ; ///< growth of q's radius along v
};

template <bool tapered>
CACTUS_KERNEL_INLINE ClosestPoints closestPointsOf(const Subject& p, const Doubles (&q)[8])
{
  const Doubles zero = {};
  ClosestPoints pair = {};
  Doubles r[3];
  Doubles c = {}, f = {};
  for (int axis = 0; axis < 3; ++axis)
  {
    pair.v[axis] = q[4 + axis] - q[axis];
    r[axis] = p.p0[axis] - q[axis];
    pair.b += p.u[axis] * pair.v[axis];
    c += p.u[axis] * r[axis];
    pair.e += pair.v[axis] * pair.v[axis];
    f += pair.v[axis] * r[axis];
  }
  const Doubles a = zero + p.squared;
  const Doubles inverseA = zero + p.inverseSquared;
  closestParameters<Doubles>(a, inverseA, pair.e, pair.b, c, f, pair.s, pair.t);
  for (int axis = 0; axis < 3; ++axis)
  {
    pair.w[axis] = r[axis] + pair.s * p.u[axis] - pair.t * pair.v[axis];
    pair.squared += pair.w[axis] * pair.w[axis];
  }
  if (tapered)
  {
    pair.taperQ = q[7] - q[3];
    pair.rp = p.r0 + pair.s * p.taper;
    pair.rq = q[3] + pair.t * pair.taperQ;
  }
  else
  {
    pair.rp = zero + p.r0;
    pair.rq = q[3];
  }
  return pair;
}

/// Calls visit for each number of the pairs that is needed after the touch test.
template <bool tapered, typename Pair, typename Visit>
CACTUS_KERNEL_INLINE void forEachNumber(Pair& pair, Visit&& visit)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    visit(pair.w[axis]);
  }
  visit(pair.s);
  visit(pair.squared);
  visit(pair.e);
  visit(pair.rq);
  if (tapered)
  {
    visit(pair.t);
    visit(pair.b);
    visit(pair.rp);
    visit(pair.taperQ);
    for (int axis = 0; axis < 3; ++axis)
    {
      visit(pair.v[axis]);
    }
  }
}

template <bool tapered>
CACTUS_KERNEL_INLINE double* write(const ClosestPoints& pair, double* to)
{
  forEachNumber<tapered>(
    pair, [&](const Doubles& number) __attribute__((always_inline)) {
      __builtin_memcpy(to, &number, sizeof(number));
      to += width;
    });
  return to;
}

template <bool tapered>
CACTUS_KERNEL_INLINE const double* read(const double* from, const Subject& p, ClosestPoints& pair)
{
  const Doubles zero = {};

  forEachNumber<tapered>(
    pair, [&](Doubles & number) __attribute__((always_inline)) {
      number = load(from);
      from += width;
    });
  if (!tapered)
  {
    pair.rp = zero + p.r0;
  }
  return from;
}

/// Computes the change of the cost as the closest points slide, given its change with the radii there along p and q. The points
/// satisfy a·s − b·t + c = 0 and −b·s + e·t − f = 0 (whichever is not clamped); the adjoint of that system gives the slide's
/// share.
CACTUS_KERNEL_INLINE void slide(
  const Subject& p, const ClosestPoints& pair, const Doubles& alongP, const Doubles& alongQ, Doubles& adjointS, Doubles& adjointT)
{
  const Doubles zero = {};
  const Doubles a = zero + p.squared;
  const Doubles one = zero + 1.0;
  const Doubles determinant = a * pair.e - pair.b * pair.b;
  const DoubleMask skew = determinant > 1e-12 * a * pair.e;
  const DoubleMask sFree = (pair.s > zero) & (pair.s < one) & skew;
  const DoubleMask tFree = (pair.t > zero) & (pair.t < one) & skew;
  const Doubles inverseDeterminant = select(sFree & tFree, one, zero) / select(skew, determinant, one);
  adjointS = (pair.e * alongP + pair.b * alongQ) * inverseDeterminant + select(sFree & ~tFree, alongP / a, zero);
  adjointT = (pair.b * alongP + a * alongQ) * inverseDeterminant + select(tFree & ~sFree, alongQ / pair.e, zero);
}

/// Adds the contributions of a vector of touching pairs to the v-th vector of the sums of p.
template <bool tapered>
CACTUS_KERNEL_INLINE void addLanes(const Subject& p, const ClosestPoints& pair, const OverlapTerms& terms, int v, LaneSums& sums)
{
  const Doubles zero = {};
  const Doubles one = zero + 1.0;
  const Doubles& rp = pair.rp;
  const Doubles& rq = pair.rq;
  const Doubles distance = squareRoot(pair.squared);
  const Doubles lengthQ = squareRoot(pair.e);
  const Doubles inverseSum = one / (rp + rq);
  const Doubles ratio = distance * inverseSum;
  const Doubles depth = terms.margin - ratio;
  const Doubles D = select(depth > zero, depth, zero);
  const Doubles lengths = p.length * lengthQ;
  const Doubles scale = lengths * rp * rq;
  const Doubles byLength = D * D * lengthQ * rp * rq * p.inverseLength; // ∂F/∂|p0−p1| / |p0−p1|
  // Where the axes meet there is no direction to part in: the push is zero here, see partCoincident().
  const Doubles push = -2.0 * D * scale * inverseSum / select(distance > 1e-12, distance, one);
  const Doubles byRp = 2.0 * D * ratio * inverseSum * scale + D * D * lengths * rq;
  const Doubles byRq = 2.0 * D * ratio * inverseSum * scale + D * D * lengths * rp;
  Doubles adjointS = zero;
  Doubles adjointT = zero;
  if (tapered)
  {
    slide(p, pair, byRp * p.taper, byRq * pair.taperQ, adjointS, adjointT);
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
    sums.of[Gradient0 + axis][v] += alongW0 * pair.w[axis] + alongU0 * p.u[axis] + alongV0 * pair.v[axis];
    sums.of[Gradient1 + axis][v] += alongW1 * pair.w[axis] + alongU1 * p.u[axis] + alongV1 * pair.v[axis];
  }
  sums.of[Radius0][v] += byRp * near0;
  sums.of[Radius1][v] += byRp * pair.s;
  const Doubles stiffness = select(depth > zero, 2.0 * scale * inverseSum * inverseSum, zero);
  sums.of[Stiffness0][v] += stiffness * near0;
  sums.of[Stiffness1][v] += stiffness * pair.s;
  sums.of[Cost][v] += 0.5 * D * D * scale;
  const Doubles deepest = one - ratio;
  sums.deepest[v] = deepest > sums.deepest[v] ? deepest : sums.deepest[v];
  sums.of[Overlapping][v] += select(deepest > terms.tolerance, one, zero);
}

/// Loads the numbers of consecutive capsules of a list.
CACTUS_KERNEL_INLINE void gather(const Capsule* bodies, const std::uint32_t* indices, Doubles (&q)[8])
{
  const double* rows[width];
  for (int l = 0; l < width; ++l)
  {
    rows[l] = &bodies[indices[l]].p0[0];
  }
  transpose(rows, q);
}

/// Removes those of the first `width` numbers whose bit is set, and returns how many of `count` are left.
CACTUS_KERNEL_INLINE std::size_t remove(unsigned bits, std::uint32_t* numbers, std::size_t count)
{
  std::size_t left = 0;
  for (std::size_t n = 0; n < count; ++n)
  {
    numbers[left] = numbers[n];
    left += n >= width || (bits >> n & 1u) == 0 ? 1 : 0;
  }
  return left;
}

/// Writes the numbers that are summed over touching neighbours, a vector of neighbours at a time, the last one padded with
/// others. `touching` holds `count` neighbours that may touch, followed by any valid indices; the few that do not touch are
/// removed, since sums must not depend on the rest of a list. Returns the end of the output.
template <bool tapered>
CACTUS_KERNEL_INLINE double* writeTouching(
  const Capsule* bodies, const Subject& p, std::uint32_t* touching, std::size_t count, const OverlapTerms& terms, double* to)
{
  const Doubles zero = {};
  DoubleMask lane;
  for (int l = 0; l < width; ++l)
  {
    lane[l] = l;
  }
  for (std::size_t n = 0; n < count;)
  {
    Doubles q[8];
    gather(bodies, touching + n, q);
    ClosestPoints pair = closestPointsOf<tapered>(p, q);
    const DoubleMask isThere = lane < static_cast<long long>(count - n);
    const Doubles farthest = terms.margin * (pair.rp + pair.rq);
    const DoubleMask isApart = isThere & ~(pair.squared < farthest * farthest);
    const unsigned apart = bitsOf(isApart);
    if (apart != 0)
    {
      count = n + remove(apart, touching + n, count - n);
      continue;
    }
    // A distant neighbour contributes nothing.
    pair.squared = select(isThere, pair.squared, zero + 1e12);
    to = write<tapered>(pair, to);
    n += width;
  }
  return to;
}

template <bool tapered>
CACTUS_KERNEL_INLINE void sumTouching(
  const Subject& p, const double* from, const double* end, const OverlapTerms& terms, CapsuleOverlap& result)
{
  LaneSums sums = noSums();
  for (int v = 0; from < end; v = v + 1 < vectors ? v + 1 : 0)
  {
    ClosestPoints pair = {};
    from = read<tapered>(from, p, pair);
    addLanes<tapered>(p, pair, terms, v, sums);
  }
  double totals[Numbers];
  sumLanes(sums.of, totals);
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
  result.penetration = largestLane(sums.deepest);
  result.overlapping = static_cast<std::size_t>(totals[Overlapping]);
}

/// Works in three steps, each for all capsules, so that no capsule waits for another one's numbers.
template <bool tapered>
CACTUS_KERNEL_INLINE void evaluateAll(const ListedCapsules& capsules, std::size_t begin, std::size_t end,
  const OverlapTerms& terms, const OverlapKernels::Room& room, CapsuleOverlap* results)
{
  const std::size_t count = end - begin;
  const Capsule* bodies = capsules.bodies + capsules.first + begin;
  Subjects subjects;
  prepareRough<tapered>(capsules.rough + capsules.first + begin, count, terms.margin, subjects);
  prepare(bodies, count, subjects);
  std::uint32_t* touching[OverlapKernels::together + 1] = { room.touching };
  for (std::size_t k = 0; k < count; ++k)
  {
    touching[k + 1] = selectTouching<tapered>(capsules, begin + k, subjects, k, terms.margin, touching[k]);
  }
  double* pairs[OverlapKernels::together + 1] = { room.lanes->numbers };
  for (std::size_t k = 0; k < count; ++k)
  {
    const auto found = static_cast<std::size_t>(touching[k + 1] - touching[k]);
    pairs[k + 1] =
      writeTouching<tapered>(capsules.bodies, subjectOf(bodies[k], subjects, k), touching[k], found, terms, pairs[k]);
  }
  for (std::size_t k = 0; k < count; ++k)
  {
    sumTouching<tapered>(subjectOf(bodies[k], subjects, k), pairs[k], pairs[k + 1], terms, results[k]);
  }
}

/// Lists reach further than contact: most of their entries contribute nothing. The entries that may contribute are found in
/// single precision, and only those are evaluated.
void evaluateCapsules(const ListedCapsules& capsules, std::size_t begin, std::size_t end, const OverlapTerms& terms,
  const OverlapKernels::Room& room, CapsuleOverlap* results)
{
  if (terms.tapered)
  {
    evaluateAll<true>(capsules, begin, end, terms, room, results);
  }
  else
  {
    evaluateAll<false>(capsules, begin, end, terms, room, results);
  }
}

} // namespace

const OverlapKernels CACTUS_KERNELS_OF_UNIT(OverlapKernels) = { roughen, evaluateCapsules };

} // namespace cactus
