// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/OverlapCost.h"

#include "base/Parallel.h"
#include "fibres/SegmentDistance.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

namespace cactus
{

namespace
{

/// The number of capsules whose costs are summed before they are added to the others.
constexpr std::size_t blockSize = 1024;

/// Axes count as meeting if their distance is less than this fraction of the sum of the radii.
constexpr double meeting = 1e-9;

/// Returns the direction (a unit vector) in which the axis u of one fibre leaves the axis v of another that it meets: across
/// both, and towards its own place (see Capsules). The other fibre gets the opposite; the direction is the same wherever the two
/// meet at a similar angle.
Eigen::Vector3d partingDirection(
  const Eigen::Vector3d& u, const Eigen::Vector3d& v, const Eigen::Vector3d& place, const Eigen::Vector3d& otherPlace)
{
  constexpr double parallel = 1e-6; // sine of the angle
  const Eigen::Vector3d wish = place - otherPlace;
  const Eigen::Vector3d across = u.cross(v);
  if (across.norm() > parallel * u.norm() * v.norm())
  {
    return across.dot(wish) < 0.0 ? Eigen::Vector3d(-across.normalized()) : Eigen::Vector3d(across.normalized());
  }
  // Symmetric in the two fibres.
  const bool first = place.x() < otherPlace.x();
  const Eigen::Vector3d along = (first ? u : v).normalized();
  const Eigen::Vector3d sideways = wish - wish.dot(along) * along;
  if (sideways.norm() > parallel * wish.norm())
  {
    return sideways.normalized();
  }
  const Eigen::Vector3d any = along.unitOrthogonal();
  return first ? any : Eigen::Vector3d(-any);
}

/// Adds the missing gradient of capsule k where its axis meets those of others: there the cost is largest and has no gradient. It
/// is the push of fibres a little apart, in a direction chosen from the fibres' ids, so that it depends neither on the order of
/// the fibres nor on threads.
void partCoincident(const Capsules& capsules, std::size_t k, const std::uint32_t* neighbours, std::size_t count, double margin,
  CapsuleOverlap& result)
{
  const auto vector = [](const double* p) { return Eigen::Vector3d(p[0], p[1], p[2]); };
  const Capsule& p = capsules.bodies[k];
  const Eigen::Vector3d u = vector(p.p1) - vector(p.p0);
  for (std::size_t n = 0; n < count; ++n)
  {
    const Capsule& q = capsules.bodies[neighbours[n]];
    const Eigen::Vector3d v = vector(q.p1) - vector(q.p0);
    const SegmentPair pair = closestPoints(vector(p.p0), vector(p.p1), vector(q.p0), vector(q.p1));
    const double rp = p.r0 + pair.s * (p.r1 - p.r0);
    const double rq = q.r0 + pair.t * (q.r1 - q.r0);
    if (pair.distance > meeting * (rp + rq))
    {
      continue;
    }
    const Eigen::Vector3d apart = vector(p.p0) + pair.s * u - vector(q.p0) - pair.t * v;
    const Eigen::Vector3d direction =
      partingDirection(u, v, capsules.places[capsules.fibre[k]], capsules.places[capsules.fibre[neighbours[n]]]);
    // Axes slightly apart in that direction, or its opposite, have a gradient of their own; axes apart along themselves do not.
    constexpr double noise = 1e-12;
    if (pair.distance > noise && std::abs(apart.dot(direction)) > 0.5 * pair.distance)
    {
      continue;
    }
    const double push = -2.0 * margin * u.norm() * v.norm() * rp * rq / (rp + rq);
    for (int axis = 0; axis < 3; ++axis)
    {
      result.gradient0[axis] += push * (1.0 - pair.s) * direction[axis];
      result.gradient1[axis] += push * pair.s * direction[axis];
    }
  }
}

/// Work space of the kernel.
class KernelRoom
{
public:
  OverlapKernels::Room get(std::size_t neighbours)
  {
    using Room = OverlapKernels::Room;
    this->Touching.resize(std::max(this->Touching.size(), Room::touchingFor(neighbours)));
    this->Lanes.resize(std::max(this->Lanes.size(), Room::lanesFor(neighbours)));
    return { this->Touching.data(), this->Lanes.data() };
  }

private:
  std::vector<std::uint32_t> Touching;
  std::vector<EightDoubles> Lanes;
};

} // namespace

bool isAnyTapered(const Capsules& capsules, const CapsuleRange& of)
{
  const auto begin = capsules.bodies.begin();
  return std::any_of(begin + static_cast<std::ptrdiff_t>(of.begin), begin + static_cast<std::ptrdiff_t>(of.end),
    [](const Capsule& body) { return body.r0 != body.r1; });
}

OverlapParts evaluateOverlap(const Capsules& capsules, const CapsuleRange& of, std::size_t place, const NeighbourList& neighbours,
  const OverlapTerms& terms, int threads, std::vector<RoughCapsule>& rough, std::vector<CapsuleOverlap>& result)
{
  const OverlapKernels& kernels = bestKernels<OverlapKernels>();
  rough.resize(capsules.size());
  parallelBlocks(capsules.size(), blockSize, threads,
    [&](std::size_t, std::size_t begin, std::size_t end)
    { kernels.roughen(capsules.bodies.data() + begin, end - begin, rough.data() + begin); });
  const ListedCapsules listed = { capsules.bodies.data(), rough.data(), of.begin, neighbours.offsets.data(),
    neighbours.indices.data(), neighbours.indices.size() };
  result.resize(of.size());
  // Blocks are those of all capsules; the first may be entered in the middle.
  const std::size_t skipped = place % blockSize;
  const std::size_t end = skipped + of.size();
  std::vector<OverlapTotals> partial((end + blockSize - 1) / blockSize);
  const auto evaluate = [&](KernelRoom& room, std::size_t begin, std::size_t end, OverlapTotals& totals)
  {
    const std::size_t pairs = neighbours.offsets[end] - neighbours.offsets[begin];
    kernels.evaluateCapsules(listed, begin, end, terms, room.get(pairs), result.data() + begin);
    for (std::size_t k = begin; k < end; ++k)
    {
      if (result[k].penetration > 1.0 - 2.0 * meeting)
      {
        const std::size_t first = neighbours.offsets[k];
        partCoincident(
          capsules, of.begin + k, neighbours.indices.data() + first, neighbours.offsets[k + 1] - first, terms.margin, result[k]);
      }
      totals.cost += result[k].cost;
      totals.penetration = std::max(totals.penetration, result[k].penetration);
      totals.overlappingPairs += result[k].overlapping;
    }
  };
  runLoop(
    partial.size(), threads, [](int) { return KernelRoom(); },
    [&](KernelRoom& room, std::size_t block)
    {
      const std::size_t blockBegin = std::max(block * blockSize, skipped) - skipped;
      const std::size_t blockEnd = std::min((block + 1) * blockSize, end) - skipped;
      for (std::size_t begin = blockBegin; begin < blockEnd; begin += OverlapKernels::together)
      {
        evaluate(room, begin, std::min(begin + OverlapKernels::together, blockEnd), partial[block]);
      }
    },
    [] { return true; });
  OverlapParts parts;
  for (std::size_t block = 0; block < partial.size(); ++block)
  {
    const std::size_t first = block * blockSize;
    if (first >= skipped && first + blockSize <= end)
    {
      parts.blocks.push_back(partial[block].cost);
    }
    else
    {
      std::vector<double>& costs = parts.blocks.empty() && first < skipped ? parts.before : parts.after;
      for (std::size_t k = std::max(first, skipped); k < std::min(first + blockSize, end); ++k)
      {
        costs.push_back(result[k - skipped].cost);
      }
    }
    parts.penetration = std::max(parts.penetration, partial[block].penetration);
    parts.overlapping += partial[block].overlappingPairs;
  }
  return parts;
}

void OverlapSum::addCapsules(const std::vector<double>& costs)
{
  for (const double cost : costs)
  {
    this->Block += cost;
    if (++this->InBlock == blockSize)
    {
      this->Sum.cost += this->Block;
      this->Block = 0.0;
      this->InBlock = 0;
    }
  }
}

void OverlapSum::add(const OverlapParts& parts)
{
  this->addCapsules(parts.before);
  for (const double cost : parts.blocks)
  {
    this->Sum.cost += cost;
  }
  this->addCapsules(parts.after);
  this->Sum.penetration = std::max(this->Sum.penetration, parts.penetration);
  this->Sum.overlappingPairs += parts.overlapping;
}

OverlapTotals OverlapSum::totals() const
{
  OverlapTotals totals = this->Sum;
  totals.cost += this->Block;
  totals.overlappingPairs /= 2;
  return totals;
}

OverlapTotals evaluateOverlap(const Capsules& capsules, const NeighbourList& neighbours, double margin, double tolerance,
  int threads, std::vector<CapsuleOverlap>& result)
{
  OverlapSum sum;
  const OverlapTerms terms{ margin, tolerance, isAnyTapered(capsules, { 0, capsules.size() }) };
  std::vector<RoughCapsule> rough;
  sum.add(evaluateOverlap(capsules, { 0, capsules.size() }, 0, neighbours, terms, threads, rough, result));
  return sum.totals();
}

} // namespace cactus
