// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/LoopLines.h"

#include <algorithm>
#include <limits>

namespace cactus
{

namespace
{

using Eigen::Vector3d;

/// Points of a line between two edges keep this fraction of a chord off them.
constexpr double clearancePart = 0.3;

/// A place on a loop.
struct LoopPlace
{
  std::size_t chord = 0;                                     ///< behind this point
  double along = 0.0;                                        ///< µm from the loop's first point
  double distance = std::numeric_limits<double>::infinity(); ///< µm, to the point whose nearest place this is
};

/// Returns where a crossing edge meets the plane of a loop.
Vector3d placeAcross(const LoopStack& stack, std::int32_t lower, std::int32_t upper, const PlaneLoop& loop)
{
  const Eigen::Index axis = stack.axis;
  const Vector3d& a = stack.placeOf(lower);
  const Vector3d along = stack.placeOf(upper) - a;
  return a + (stack.placeOf(loop.points.front())[axis] - a[axis]) / along[axis] * along;
}

LoopPlace nearestOn(const LoopStack& stack, const PlaneLoop& loop, const Vector3d& place)
{
  LoopPlace nearest;
  double before = 0.0; // length of the previous chords
  for (std::size_t i = 0; i < loop.points.size(); ++i)
  {
    const Vector3d& a = stack.placeOf(loop.points[i]);
    const Vector3d chord = stack.placeOf(loop.points[(i + 1) % loop.points.size()]) - a;
    const double length = chord.norm();
    const double part = length > 0.0 ? std::clamp(chord.dot(place - a) / (length * length), 0.0, 1.0) : 0.0;
    const double distance = (a + part * chord - place).norm();
    if (distance < nearest.distance)
    {
      nearest = { i, before + part * length, distance };
    }
    before += length;
  }
  return nearest;
}

/// Finds a single point of a loop between two places, `clearance` (µm) away from both.
bool pointBetween(
  const LoopStack& stack, const PlaneLoop& loop, const Vector3d& first, const Vector3d& last, double clearance, LoopLine& found)
{
  const Vector3d middle = 0.5 * (first + last);
  double least = 0.25 * (last - first).squaredNorm();
  std::size_t nearest = loop.points.size();
  for (std::size_t i = 0; i < loop.points.size(); ++i)
  {
    const Vector3d& place = stack.placeOf(loop.points[i]);
    const double distance = (place - middle).squaredNorm();
    if (distance < least && std::min((place - first).squaredNorm(), (place - last).squaredNorm()) > clearance * clearance)
    {
      least = distance;
      nearest = i;
    }
  }
  found = { &loop, nearest, nearest };
  return nearest < loop.points.size();
}

} // namespace

double lengthOf(const LoopStack& stack, const LoopLine& line)
{
  double length = 0.0;
  for (std::size_t i = line.at; i < line.end; ++i)
  {
    length += (stack.placeOf(line.point(i + 1)) - stack.placeOf(line.point(i))).norm();
  }
  return length;
}

bool lineBetween(
  const LoopStack& stack, const LoopLine& lower, const LoopLine& upper, std::size_t plane, double farthest, LoopLine& found)
{
  const PlaneLoop& loop = stack.few[plane];
  const std::size_t count = loop.points.size();
  const Vector3d first = placeAcross(stack, lower.here(), upper.here(), loop);
  const Vector3d last = placeAcross(stack, lower.last(), upper.last(), loop);
  const LoopPlace from = nearestOn(stack, loop, first);
  const LoopPlace to = nearestOn(stack, loop, last);
  if (from.distance > farthest || to.distance > farthest)
  {
    return false;
  }
  const double around = lengthOf(stack, { &loop, 0, count });
  const double clearance = clearancePart * around / double(count);
  const bool isAround = lower.here() == lower.last() && upper.here() == upper.last() && !lower.isAtEnd() && !upper.isAtEnd();
  double way = to.along - from.along;
  way += isAround || way < 0.0 ? around : 0.0;
  // A way nearly all around between short lines goes a little backwards instead.
  const bool isShort = !isAround && way > 1.5 * std::max(lengthOf(stack, lower), lengthOf(stack, upper)) + around / double(count);
  std::size_t begin = from.chord + 1;
  std::size_t end = begin;
  if (!isShort)
  {
    const bool isOnSame = to.chord == from.chord && to.along >= from.along && !isAround;
    end = isOnSame ? begin : begin + (to.chord + count - from.chord - 1) % count + 1;
  }
  const auto isBeside = [&](std::size_t i, const Vector3d& place)
  { return (stack.placeOf(loop.points[i % count]) - place).squaredNorm() < clearance * clearance; };
  while (begin < end && isBeside(begin, first))
  {
    ++begin;
  }
  while (begin < end && isBeside(end - 1, last))
  {
    --end;
  }
  for (const std::size_t anchor : loop.anchors)
  {
    if ((anchor + count - begin % count) % count < end - begin)
    {
      return false;
    }
  }
  found = { &loop, begin, end - 1 };
  return begin < end || pointBetween(stack, stack.all.loop(plane), first, last, clearance, found);
}

} // namespace cactus
