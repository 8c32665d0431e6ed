// SPDX-License-Identifier: BSD-3-Clause
#include "growth/FieldKernels.h"

#include "base/Vector.h"

namespace cactus
{

namespace
{

constexpr float nowhere = -1e30f;

/// Numbers of one cone, or of as many as a vector holds.
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

/// The field of cones at positions, lane by lane; see coneValue(). What is everywhere as thick (`isEven`) takes a root less.
template <bool isEven, typename Position, typename Number>
CACTUS_KERNEL_INLINE Floats fieldOf(const ConeNumbers<Number>& cone, const Position (&at)[3])
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
  return cone.radius + cone.slope * along - squareRoot(distance2 + rest * rest);
}

/// Writes each cone's field at the cell's centre.
CACTUS_KERNEL_INLINE void evaluateCentre(const ConeColumns& cones, const float (&centre)[3])
{
  for (std::size_t c = 0; c < cones.count; c += floats)
  {
    ConeNumbers<Floats> cone;
    for (int axis = 0; axis < 3; ++axis)
    {
      cone.start[axis] = load(cones.start[axis] + c);
      cone.axis[axis] = load(cones.axis[axis] + c);
    }
    cone.length = load(cones.length + c);
    cone.radius = load(cones.radius + c);
    cone.slope = load(cones.slope + c);
    cone.lean = load(cones.lean + c);
    store(cones.atCentre + c, fieldOf<false>(cone, centre));
  }
}

/// Takes one cone's field into that of its fibre.
template <bool isEven>
CACTUS_KERNEL_INLINE void evaluateCone(
  const ConeNumbers<float>& cone, const CellSamples& samples, float (&field)[FieldCell::size])
{
  for (int i = 0; i < FieldCell::size; i += floats)
  {
    const Floats at[3] = { load(samples.position[0] + i), load(samples.position[1] + i), load(samples.position[2] + i) };
    store(field + i, larger(fieldOf<isEven>(cone, at), load(field + i)));
  }
}

/// Writes the largest field of a group's cones at each sample. Cones whose field at the centre is below `enough` cannot have it.
CACTUS_KERNEL_INLINE void evaluateGroup(
  const ConeColumns& cones, const ConeGroup& group, float enough, const CellSamples& samples, float (&field)[FieldCell::size])
{
  const Floats none = Floats{} + nowhere;
  for (int i = 0; i < FieldCell::size; i += floats)
  {
    store(field + i, none);
  }
  for (std::size_t c = group.begin; c < group.end; ++c)
  {
    if (cones.atCentre[c] < enough)
    {
      continue;
    }
    const ConeNumbers<float> cone = { { cones.start[0][c], cones.start[1][c], cones.start[2][c] },
      { cones.axis[0][c], cones.axis[1][c], cones.axis[2][c] }, cones.length[c], cones.radius[c], cones.slope[c], cones.lean[c] };
    if (cone.slope == 0.0f && cone.lean == 0.0f)
    {
      evaluateCone<true>(cone, samples, field);
    }
    else
    {
      evaluateCone<false>(cone, samples, field);
    }
  }
}

/// Takes one fibre's field into the two largest.
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

void evaluateCell(
  const ConeColumns& cones, ConeGroup* groups, std::size_t groupCount, const CellRelevance& relevance, CellSamples& samples)
{
  evaluateCentre(cones, samples.centre);
  float best = nowhere;
  float second = nowhere;
  for (std::size_t g = 0; g < groupCount; ++g)
  {
    float value = nowhere;
    for (std::size_t c = groups[g].begin; c < groups[g].end; ++c)
    {
      value = cones.atCentre[c] > value ? cones.atCentre[c] : value;
    }
    groups[g].atCentre = value;
    const float lesser = best < value ? best : value;
    second = second > lesser ? second : lesser;
    best = best > value ? best : value;
  }

  for (int i = 0; i < FieldCell::size; ++i)
  {
    samples.best[i] = nowhere;
    samples.second[i] = nowhere;
    samples.rank[i] = -1;
  }
  const float twice = 2.0f * samples.extent;
  const bool secondMatters = best + samples.extent > -relevance.secondReach;
  alignas(64) float field[FieldCell::size];
  for (std::size_t g = 0; g < groupCount; ++g)
  {
    const float value = groups[g].atCentre;
    const bool mayBeBest = value + twice >= best && value + samples.extent > -relevance.bestReach;
    const bool mayBeSecond = secondMatters && value + twice >= second && value + best + twice > -relevance.sumReach &&
                             value + twice >= best - relevance.contrast;
    if (mayBeBest || mayBeSecond)
    {
      evaluateGroup(cones, groups[g], value - twice, samples, field);
      merge(groups[g].rank, field, samples);
    }
  }
}

} // namespace

const FieldKernels CACTUS_KERNELS_OF_UNIT(FieldKernels) = { evaluateCell };

} // namespace cactus
