// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/LoopStitching.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cactus
{

using Eigen::Vector3d;

bool LoopStitching::stitch(
  const PlaneLoop& lower, const PlaneLoop& upper, int parts, const ErrorRange& allowed, StitchedLoops& result) const
{
  result.triangles.clear();
  result.errors.clear();
  const Demand demand{ this->middleOf(upper) - this->middleOf(lower), parts, allowed };
  if (lower.anchors.empty() && upper.anchors.empty())
  {
    const auto [i, j] = this->nearestPair(lower, upper, demand.offset);
    return this->stitchLines({ lower, i, i + lower.points.size() }, { upper, j, j + upper.points.size() }, demand, result);
  }
  std::size_t turn = 0;
  if (lower.anchors.size() != upper.anchors.size() || !this->matchAnchors(lower, upper, demand.offset, turn))
  {
    return false;
  }
  for (std::size_t part = 0; part < lower.anchors.size(); ++part)
  {
    const std::size_t other = (turn + part) % upper.anchors.size();
    if (!this->stitchLines(behindAnchor(lower, part), behindAnchor(upper, other), demand, result))
    {
      return false;
    }
  }
  return true;
}

Vector3d LoopStitching::middleOf(const PlaneLoop& loop) const
{
  Vector3d sum = Vector3d::Zero();
  for (const std::int32_t p : loop.points)
  {
    sum += this->placeOf(p);
  }
  return sum / double(loop.points.size());
}

/// The points of two loops that are nearest to each other, by their places.
std::pair<std::size_t, std::size_t> LoopStitching::nearestPair(
  const PlaneLoop& lower, const PlaneLoop& upper, const Vector3d& offset) const
{
  std::pair<std::size_t, std::size_t> nearest{ 0, 0 };
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < lower.points.size(); ++i)
  {
    const Vector3d from = this->placeOf(lower.points[i]) + offset;
    for (std::size_t j = 0; j < upper.points.size(); ++j)
    {
      const double distance = (this->placeOf(upper.points[j]) - from).squaredNorm();
      if (distance < least)
      {
        least = distance;
        nearest = { i, j };
      }
    }
  }
  return nearest;
}

/// Finds which anchor of the upper loop belongs to the first one of the lower loop. Returns false where the loops do not come
/// to the same faces, one after the other.
bool LoopStitching::matchAnchors(const PlaneLoop& lower, const PlaneLoop& upper, const Vector3d& offset, std::size_t& found) const
{
  const std::size_t count = lower.anchors.size();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t turn = 0; turn < count; ++turn)
  {
    double distance = 0.0;
    bool fits = true;
    for (std::size_t i = 0; i < count && fits; ++i)
    {
      const std::size_t j = (turn + i) % count;
      const std::int32_t p = lower.points[lower.anchors[i]];
      const std::int32_t q = upper.points[upper.anchors[j]];
      fits = this->facesOf(p) == this->facesOf(q) && this->isInFace(lower, i) == this->isInFace(upper, j);
      distance += (this->placeOf(q) - this->placeOf(p) - offset).squaredNorm();
    }
    if (fits && distance < least)
    {
      least = distance;
      found = turn;
    }
  }
  return least < std::numeric_limits<double>::infinity();
}

/// Whether a loop runs in a face of the box behind an anchor.
bool LoopStitching::isInFace(const PlaneLoop& loop, std::size_t anchor) const
{
  const std::size_t i = loop.anchors[anchor];
  return (this->facesOf(loop.points[i]) & this->facesOf(loop.points[(i + 1) % loop.points.size()])) != 0;
}

LoopStitching::Line LoopStitching::behindAnchor(const PlaneLoop& loop, std::size_t anchor)
{
  return { loop, loop.anchors[anchor], anchor + 1 < loop.anchors.size() ? loop.anchors[anchor + 1] : loop.points.size() };
}

/// Adds the triangles between two lines.
bool LoopStitching::stitchLines(Line lower, Line upper, const Demand& demand, StitchedLoops& result) const
{
  double error = this->errorAlong(lower.here(), upper.here(), demand.parts);
  Vector3d before = Vector3d::Zero();
  while (demand.allowed.holds(error) && !(lower.isAtEnd() && upper.isAtEnd()))
  {
    const bool goesBelow = this->goesBelow(lower, upper, demand, error);
    const std::array<std::int32_t, 3> triangle{ { lower.here(), goesBelow ? lower.next() : upper.next(), upper.here() } };
    ++(goesBelow ? lower : upper).at;
    const Vector3d& p = this->placeOf(triangle[0]);
    const Vector3d normal = (this->placeOf(triangle[1]) - p).cross(this->placeOf(triangle[2]) - p);
    const double inMiddle = this->Surface.isCap(triangle) ? 0.0 : this->errorIn(triangle);
    if (normal.dot(before) < 0.0 || !demand.allowed.holds(inMiddle))
    {
      return false;
    }
    before = normal;
    result.triangles.push_back(triangle);
    result.errors.push_back({ { inMiddle, error } });
  }
  return demand.allowed.holds(error);
}

/// Whether the next triangle has an edge of the lower loop, and what the error is on its edge to the one behind. That is the
/// shorter one of the two in question, unless only the other one is near enough to the level.
bool LoopStitching::goesBelow(const Line& lower, const Line& upper, const Demand& demand, double& error) const
{
  const auto errorIf = [&](bool below)
  { return this->errorAlong(below ? lower.next() : lower.here(), below ? upper.here() : upper.next(), demand.parts); };
  if (lower.isAtEnd() || upper.isAtEnd())
  {
    error = errorIf(upper.isAtEnd());
    return upper.isAtEnd();
  }
  const bool isShorter = (this->placeOf(lower.next()) + demand.offset - this->placeOf(upper.here())).squaredNorm() <
                         (this->placeOf(upper.next()) - this->placeOf(lower.here()) - demand.offset).squaredNorm();
  error = errorIf(isShorter);
  if (std::abs(error) > this->Options.maximumError)
  {
    const double other = errorIf(!isShorter);
    if (std::abs(other) < std::abs(error))
    {
      error = other;
      return !isShorter;
    }
  }
  return isShorter;
}

/// By how much the field exceeds its level where it does so most, or falls below it, at the points that cut an edge into
/// parts; in a face of the box it may be larger.
double LoopStitching::errorAlong(std::int32_t lower, std::int32_t upper, int parts) const
{
  const Vector3d& a = this->placeOf(lower);
  const Vector3d along = this->placeOf(upper) - a;
  const bool isInFace = (this->facesOf(lower) & this->facesOf(upper)) != 0;
  double largest = 0.0;
  for (int i = 1; i < parts; ++i)
  {
    const double excess = this->errorAt(a + (double(i) / parts) * along);
    const double error = isInFace ? std::min(excess, 0.0) : excess;
    largest = std::abs(error) > std::abs(largest) ? error : largest;
  }
  return largest;
}

double LoopStitching::errorIn(const std::array<std::int32_t, 3>& t) const
{
  return this->errorAt((this->placeOf(t[0]) + this->placeOf(t[1]) + this->placeOf(t[2])) / 3.0);
}

} // namespace cactus
