// SPDX-License-Identifier: BSD-3-Clause
#include "growth/FieldKernels.h"

#include "base/Vector.h"

namespace cactus
{

namespace
{

constexpr float nowhere = -1e30f;
/// Slack for the rounding of bounds, as a fraction of a cell's extent and in µm.
constexpr float boundSlack = 1e-4f;
constexpr float leastSlack = 1e-5f;

using Columns = ConeColumns;

/// Numbers of one cone, or of a vector of cones.
template <typename Number>
struct ConeNumbers
{
  Number start[3];
  Number axis[3];
  Number length;
  Number radius;
  Number slope;
  Number lean;
};

/// Calls take(n) for each number n.
template <typename Number, typename Take>
CACTUS_KERNEL_INLINE ConeNumbers<Number> numbersOf(const Take& take)
{
  return { { take(Columns::Start), take(Columns::Start + 1), take(Columns::Start + 2) },
    { take(Columns::Axis), take(Columns::Axis + 1), take(Columns::Axis + 2) }, take(Columns::Length), take(Columns::Radius),
    take(Columns::Slope), take(Columns::Lean) };
}

CACTUS_KERNEL_INLINE ConeNumbers<Floats> conesAt(const Columns& cones, std::size_t c)
{
  return numbersOf<Floats>([&](int n) __attribute__((always_inline)) { return load(cones.of[n] + c); });
}

CACTUS_KERNEL_INLINE ConeNumbers<float> coneAt(const Columns& cones, std::size_t c)
{
  return numbersOf<float>([&](int n) __attribute__((always_inline)) { return cones.of[n][c]; });
}

/// Lane by lane, the field of cones at positions (see coneValue()) and the ball that gives it.
struct NearestBall
{
  Floats offset[3]; ///< from the ball's centre to the position
  Floats distance;  ///< length of the offset
  Floats field;

  /// Finds the ball. A cone of constant radius (`isEven`) needs one root less.
  template <bool isEven, typename Position, typename Number>
  CACTUS_KERNEL_INLINE static NearestBall of(const ConeNumbers<Number>& cone, const Position (&at)[3])
  {
    const Floats zero = {};
    const Floats dx = at[0] - cone.start[0];
    const Floats dy = at[1] - cone.start[1];
    const Floats dz = at[2] - cone.start[2];
    const Floats foot = dx * cone.axis[0] + (dy * cone.axis[1] + dz * cone.axis[2]);
    const Floats ex = dx - foot * cone.axis[0];
    const Floats ey = dy - foot * cone.axis[1];
    const Floats ez = dz - foot * cone.axis[2];
    const Floats distance2 = ex * ex + (ey * ey + ez * ez);
    const Floats centre = isEven ? foot : foot + cone.lean * squareRoot(distance2);
    const Floats along = smaller(larger(centre, zero), zero + cone.length);
    const Floats rest = along - foot;
    const Floats distance = squareRoot(distance2 + rest * rest);
    return { { ex - rest * cone.axis[0], ey - rest * cone.axis[1], ez - rest * cone.axis[2] }, distance,
      cone.radius + cone.slope * along - distance };
  }
};

/// Writes each cone's field at a place, and a bound around it: a concave function lies below its tangents, so at an offset from
/// the place it is below Bound + Gradient · offset. Near a cone's axis the gradient is inaccurate, and only the 1-Lipschitz bound
/// is used.
CACTUS_KERNEL_INLINE void evaluateAt(const Columns& cones, const SamplePlace& place)
{
  const Floats zero = {};
  const float slack = boundSlack * place.extent + leastSlack;
  for (std::size_t c = 0; c < cones.count; c += floats)
  {
    const NearestBall ball = NearestBall::of<false>(conesAt(cones, c), place.centre);
    const FloatMask isFar = ball.distance > zero + place.extent;
    const Floats steepness = isFar ? -1.0f / ball.distance : zero;
    store(cones.of[Columns::Field] + c, ball.field);
    store(cones.of[Columns::Bound] + c, ball.field + (isFar ? zero + slack : zero + (slack + place.extent)));
    for (int axis = 0; axis < 3; ++axis)
    {
      store(cones.of[Columns::Gradient + axis] + c, steepness * ball.offset[axis]);
    }
  }
}

constexpr int corners = 8;
/// Whole vectors; lanes beyond the corners repeat them.
constexpr int cornerLanes = floats > corners ? floats : corners;

/// The side of the place that each corner lies on, along each axis.
alignas(64) constexpr float cornerSigns[3][2 * corners] = { { -1, 1, -1, 1, -1, 1, -1, 1, -1, 1, -1, 1, -1, 1, -1, 1 },
  { -1, -1, 1, 1, -1, -1, 1, 1, -1, -1, 1, 1, -1, -1, 1, 1 }, { -1, -1, -1, -1, 1, 1, 1, 1, -1, -1, -1, -1, 1, 1, 1, 1 } };

/// A cone's field at the corners of the cube around a place.
struct alignas(64) AtCorners
{
  float field[cornerLanes];
};

CACTUS_KERNEL_INLINE AtCorners fieldAtCorners(const Columns& cones, std::size_t c, const SamplePlace& place)
{
  const ConeNumbers<float> cone = coneAt(cones, c);
  AtCorners result;
  for (int i = 0; i < cornerLanes; i += floats)
  {
    const auto along = [&](int axis) __attribute__((always_inline))
    {
      return place.centre[axis] + place.half * load(cornerSigns[axis] + i);
    };
    const Floats at[3] = { along(0), along(1), along(2) };
    store(result.field + i, NearestBall::of<false>(cone, at).field);
  }
  return result;
}

/// Tells which of the cones from c on may be above a concave function somewhere in the cube, given its values at the corners.
CACTUS_KERNEL_INLINE FloatMask mayExceed(const Columns& cones, std::size_t c, const SamplePlace& place, const AtCorners& least)
{
  // A tangent minus a concave function is convex, so it is largest at a corner.
  Floats step[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    step[axis] = place.half * load(cones.of[Columns::Gradient + axis] + c);
  }
  const Floats bound = load(cones.of[Columns::Bound] + c);
  FloatMask above = {};
  for (int corner = 0; corner < corners; ++corner)
  {
    const Floats x = (corner & 1) != 0 ? bound + step[0] : bound - step[0];
    const Floats xy = (corner & 2) != 0 ? x + step[1] : x - step[1];
    const Floats xyz = (corner & 4) != 0 ? xy + step[2] : xy - step[2];
    above |= xyz > Floats{} + least.field[corner];
  }
  return above;
}

/// The fibres, and their cones, that can matter in the cube around a place.
class Relevant
{
public:
  /// Evaluates each cone at the place.
  CACTUS_KERNEL_INLINE Relevant(const ConeGroups& all, const CellRelevance& relevance, const SamplePlace& place)
    : All(all)
    , Place(place)
    , Relevance(relevance)
  {
    evaluateAt(all.cones, place);
    for (std::size_t g = 0; g < all.count; ++g)
    {
      ConeGroup& group = all.groups[g];
      group.ahead = group.begin;
      group.field = nowhere;
      for (std::size_t c = group.begin; c < group.end; ++c)
      {
        const float field = all.cones.of[Columns::Field][c];
        group.ahead = field > group.field ? c : group.ahead;
        group.field = field > group.field ? field : group.field;
      }
      if (group.field > this->Best)
      {
        this->Second = this->Best;
        this->RunnerUp = this->First;
        this->Best = group.field;
        this->First = g;
      }
      else if (group.field > this->Second)
      {
        this->Second = group.field;
        this->RunnerUp = g;
      }
    }
    if (all.count > 2)
    {
      // The second largest field is nowhere below the smaller one of any two.
      this->OfFirst = fieldAtCorners(all.cones, all.groups[this->First].ahead, place);
      this->OfRunnerUp = fieldAtCorners(all.cones, all.groups[this->RunnerUp].ahead, place);
      for (int i = 0; i < cornerLanes; i += floats)
      {
        store(this->Lesser.field + i, smaller(load(this->OfFirst.field + i), load(this->OfRunnerUp.field + i)));
      }
    }
  }

  /// Calls visit(c) for the relevant cones of a group.
  template <typename Visit>
  CACTUS_KERNEL_INLINE void forEachOf(std::size_t g, const Visit& visit) const
  {
    const ConeGroup& group = this->All.groups[g];
    if (!this->matters(group.field))
    {
      return;
    }
    const Columns& cones = this->All.cones;
    const bool isOfTwo = g == this->First || g == this->RunnerUp;
    const AtCorners ahead = !isOfTwo || this->All.count <= 2 ? fieldAtCorners(cones, group.ahead, this->Place)
                            : g == this->First               ? this->OfFirst
                                                             : this->OfRunnerUp;
    for (std::size_t c = group.begin; c < group.end; c += floats)
    {
      unsigned set = bitsOf(mayExceed(cones, c, this->Place, ahead));
      set |= group.ahead - c < floats ? 1u << (group.ahead - c) : 0u; // false if that is before c
      set &= isOfTwo ? ~0u : bitsOf(mayExceed(cones, c, this->Place, this->Lesser));
      set &= group.end - c < floats ? (1u << (group.end - c)) - 1u : ~0u;
      for (; set != 0; set &= set - 1)
      {
        visit(c + std::size_t(__builtin_ctz(set)));
      }
    }
  }

private:
  /// Tells whether a fibre with this field at the place can be one of the two largest that matter.
  CACTUS_KERNEL_INLINE bool matters(float field) const
  {
    const float extent = this->Place.extent;
    const float twice = 2.0f * extent;
    const bool mayBeBest = field + twice >= this->Best && field + extent > -this->Relevance.bestReach;
    const bool mayBeSecond = this->Best + extent > -this->Relevance.secondReach && field + twice >= this->Second &&
                             field + this->Best + twice > -this->Relevance.sumReach &&
                             field + twice >= this->Best - this->Relevance.contrast;
    return mayBeBest || mayBeSecond;
  }

  const ConeGroups& All;
  const SamplePlace& Place;
  const CellRelevance& Relevance;
  float Best = nowhere;
  float Second = nowhere;
  std::size_t First = 0;    ///< group of the largest field at the place
  std::size_t RunnerUp = 0; ///< group of the second largest
  // Only with further groups:
  AtCorners OfFirst; ///< of the cone with the largest field there
  AtCorners OfRunnerUp;
  AtCorners Lesser; ///< the smaller of the two
};

void narrow(const ConeGroups& all, const CellRelevance& relevance, const SamplePlace& place, ConeGroups& near)
{
  const Relevant relevant(all, relevance, place);
  std::size_t kept = 0;
  near.count = 0;
  for (std::size_t g = 0; g < all.count; ++g)
  {
    ConeGroup& same = near.groups[near.count];
    same.rank = all.groups[g].rank;
    same.begin = kept;
    relevant.forEachOf(
      g, [&](std::size_t c) __attribute__((always_inline)) {
        for (int n = 0; n < Columns::Given; ++n)
        {
          near.cones.of[n][kept] = all.cones.of[n][c];
        }
        ++kept;
      });
    same.end = kept;
    near.count += kept > same.begin ? 1 : 0;
  }
  near.cones.count = kept;
}

/// Merges one cone's field into that of its fibre.
template <bool isEven>
CACTUS_KERNEL_INLINE void evaluateCone(
  const ConeNumbers<float>& cone, const CellSamples& samples, float (&field)[FieldCell::size])
{
  for (int i = 0; i < FieldCell::size; i += floats)
  {
    const Floats at[3] = { load(samples.position[0] + i), load(samples.position[1] + i), load(samples.position[2] + i) };
    store(field + i, larger(NearestBall::of<isEven>(cone, at).field, load(field + i)));
  }
}

/// Merges one fibre's field into the two largest.
CACTUS_KERNEL_INLINE void merge(int rank, const float (&field)[FieldCell::size], CellSamples& samples)
{
  for (int i = 0; i < FieldCell::size; i += floats)
  {
    const Floats best = load(samples.best + i);
    const Floats mine = load(field + i);
    FloatMask ranks;
    __builtin_memcpy(&ranks, samples.rank + i, sizeof(ranks));
    ranks = mine > best ? FloatMask{} + rank : ranks;
    __builtin_memcpy(samples.rank + i, &ranks, sizeof(ranks));
    store(samples.second + i, larger(load(samples.second + i), smaller(best, mine)));
    store(samples.best + i, larger(mine, best));
  }
}

void evaluateCell(const ConeGroups& all, const CellRelevance& relevance, CellSamples& samples)
{
  const Relevant relevant(all, relevance, samples.place);
  for (int i = 0; i < FieldCell::size; ++i)
  {
    samples.best[i] = nowhere;
    samples.second[i] = nowhere;
    samples.rank[i] = -1;
  }
  alignas(64) float field[FieldCell::size];
  for (std::size_t g = 0; g < all.count; ++g)
  {
    bool isAny = false;
    relevant.forEachOf(
      g, [&](std::size_t c) __attribute__((always_inline)) {
        const Floats none = Floats{} + nowhere;
        for (int i = 0; !isAny && i < FieldCell::size; i += floats)
        {
          store(field + i, none);
        }
        isAny = true;
        const ConeNumbers<float> cone = coneAt(all.cones, c);
        if (cone.slope == 0.0f && cone.lean == 0.0f)
        {
          evaluateCone<true>(cone, samples, field);
        }
        else
        {
          evaluateCone<false>(cone, samples, field);
        }
      });
    if (isAny)
    {
      merge(all.groups[g].rank, field, samples);
    }
  }
}

} // namespace

const FieldKernels CACTUS_KERNELS_OF_UNIT(FieldKernels) = { narrow, evaluateCell };

} // namespace cactus
