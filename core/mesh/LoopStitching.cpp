// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/LoopStitching.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cactus
{

using Eigen::Vector3d;

namespace
{

/// Largest distance of the field from its level along triangles, before points settle, as a fraction of the largest error.
constexpr double slack = 1.1;
/// The same towards the inside of the body, for triangles across one band or next to bands that stay.
constexpr double looseSlack = 4.0;
/// Across at most this many bands the field may exceed its level by as much as it does in the contour itself.
constexpr std::size_t fewBands = 3;

/// Largest distance of a place on a crossing edge from the loop in its plane, as a fraction of the largest error.
constexpr double farthestFromLoop = 6.0;
/// Number of attempts to refine a wider part around a bad triangle.
constexpr int widenings = 3;
/// Least width of a refined part, in chords.
constexpr double leastWidth = 1.0;

} // namespace

bool LoopStitching::stitch(
  const PlaneLoop& lower, const PlaneLoop& upper, std::size_t begin, std::size_t end, bool isLoose, StitchedLoops& result) const
{
  result.triangles.clear();
  result.errors.clear();
  const Span span{ begin, end, isLoose };
  const Vector3d offset = this->middleOf(upper) - this->middleOf(lower);
  if (lower.anchors.empty() && upper.anchors.empty())
  {
    return this->stitchRing(lower, upper, span, offset, result);
  }
  std::size_t turn = 0;
  if (lower.anchors.size() != upper.anchors.size() || !this->matchAnchors(lower, upper, offset, turn))
  {
    return false;
  }
  for (std::size_t part = 0; part < lower.anchors.size(); ++part)
  {
    const LoopLine above = behindAnchor(upper, (turn + part) % upper.anchors.size());
    if (!this->fill(this->cross(behindAnchor(lower, part), above, span, offset), result))
    {
      return false;
    }
  }
  return true;
}

/// Begins where the loops are nearest to each other or, if the edge there cannot stay, at one that can.
bool LoopStitching::stitchRing(
  const PlaneLoop& lower, const PlaneLoop& upper, const Span& span, const Vector3d& offset, StitchedLoops& result) const
{
  const auto from = [&](std::size_t i, std::size_t j) {
    return this->cross({ &lower, i, i + lower.points.size() }, { &upper, j, j + upper.points.size() }, span, offset);
  };
  const auto [i, j] = this->nearestPair(lower, upper, offset);
  const Crossed crossed = from(i, j);
  std::size_t good = 0;
  while (good < crossed.triangles() && !crossed.isGoodEdge(good))
  {
    ++good;
  }
  return good == 0
           ? this->fill(crossed, result)
           : good < crossed.triangles() && this->fill(from(crossed.crossings[good].lower, crossed.crossings[good].upper), result);
}

ErrorRange LoopStitching::allowedIn(const Span& span) const
{
  // Outside the body are neighbours, from which a bulging surface would have to be moved away.
  const double inside = span.isLoose || span.bands() == 1 ? looseSlack : slack;
  ErrorRange allowed{ -slack * this->Options.maximumError, inside * this->Options.maximumError };
  for (std::size_t band = span.begin; span.bands() <= fewBands && band < span.end; ++band)
  {
    allowed.add(this->Stack.excesses.in(band));
  }
  return allowed;
}

Vector3d LoopStitching::middleOf(const PlaneLoop& loop) const
{
  Vector3d sum = Vector3d::Zero();
  for (const std::int32_t p : loop.points)
  {
    sum += this->Stack.placeOf(p);
  }
  return sum / double(loop.points.size());
}

/// Returns the indices of the nearest points of two loops.
std::pair<std::size_t, std::size_t> LoopStitching::nearestPair(
  const PlaneLoop& lower, const PlaneLoop& upper, const Vector3d& offset) const
{
  std::pair<std::size_t, std::size_t> nearest{ 0, 0 };
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < lower.points.size(); ++i)
  {
    const Vector3d from = this->Stack.placeOf(lower.points[i]) + offset;
    for (std::size_t j = 0; j < upper.points.size(); ++j)
    {
      const double distance = (this->Stack.placeOf(upper.points[j]) - from).squaredNorm();
      if (distance < least)
      {
        least = distance;
        nearest = { i, j };
      }
    }
  }
  return nearest;
}

/// Finds the anchor of the upper loop that belongs to the first one of the lower loop. Returns false if the loops do not meet the
/// same faces in the same order.
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
      fits = this->Stack.facesOf(p) == this->Stack.facesOf(q) && this->isInFace(lower, i) == this->isInFace(upper, j);
      distance += (this->Stack.placeOf(q) - this->Stack.placeOf(p) - offset).squaredNorm();
    }
    if (fits && distance < least)
    {
      least = distance;
      found = turn;
    }
  }
  return least < std::numeric_limits<double>::infinity();
}

/// Tells whether a loop runs in a face of the box behind an anchor.
bool LoopStitching::isInFace(const PlaneLoop& loop, std::size_t anchor) const
{
  const std::size_t i = loop.anchors[anchor];
  return (this->Stack.facesOf(loop.points[i]) & this->Stack.facesOf(loop.points[(i + 1) % loop.points.size()])) != 0;
}

LoopLine LoopStitching::behindAnchor(const PlaneLoop& loop, std::size_t anchor)
{
  return { &loop, loop.anchors[anchor], anchor + 1 < loop.anchors.size() ? loop.anchors[anchor + 1] : loop.points.size() };
}

/// Returns the edges between two lines, with the triangles behind them. `before` is the normal of the triangle before the first
/// one, or 0.
LoopStitching::Crossed LoopStitching::cross(
  const LoopLine& lower, const LoopLine& upper, const Span& span, const Vector3d& offset, Vector3d before) const
{
  Crossed all{ lower, upper, span, offset, span.bands() < fewBands ? 2 : 4, this->allowedIn(span), {} };
  LoopLine below = lower;
  LoopLine above = upper;
  double error = this->errorAlong(below.here(), above.here(), all.parts);
  for (;;)
  {
    Crossing& now = all.crossings.emplace_back(Crossing{ below.at, above.at, error });
    if (below.isAtEnd() && above.isAtEnd())
    {
      return all;
    }
    const bool goesBelow = this->goesBelow(below, above, all, error);
    now.tip = goesBelow ? below.next() : above.next();
    const std::array<std::int32_t, 3> triangle{ { below.here(), now.tip, above.here() } };
    ++(goesBelow ? below : above).at;
    now.normal = this->normalOf(triangle);
    now.isFolded = now.normal.dot(before) < 0.0;
    now.inMiddle = this->errorIn(triangle);
    before = now.normal;
  }
}

/// Adds the triangles between two lines, and replaces those that cannot stay.
bool LoopStitching::fill(const Crossed& crossed, StitchedLoops& result) const
{
  const std::size_t count = crossed.triangles();
  if (!crossed.isGoodEdge(0) || !crossed.isGoodEdge(count))
  {
    return false;
  }
  std::size_t done = 0; // triangles added or replaced so far
  for (std::size_t i = 0; i < count; ++i)
  {
    if (i >= done && !(crossed.isGood(i) && crossed.isGoodEdge(i + 1)) && !this->mend(crossed, i, done, result))
    {
      return false;
    }
  }
  keep(crossed, done, count, result);
  return true;
}

/// Adds triangles up to a bad one, and replaces it and as few of those beside it as necessary.
bool LoopStitching::mend(const Crossed& crossed, std::size_t bad, std::size_t& done, StitchedLoops& result) const
{
  const std::size_t before = result.triangles.size();
  Part part{ bad, bad + 1 };
  for (int tries = 0; crossed.span.bands() > 1 && tries <= widenings; ++tries)
  {
    this->widen(crossed, done, part);
    keep(crossed, done, part.begin, result);
    if (this->refine(crossed, part, result))
    {
      done = part.end;
      return true;
    }
    result.triangles.resize(before);
    result.errors.resize(before);
    if (part.begin == done && part.end == crossed.triangles())
    {
      break;
    }
    part.begin -= part.begin > done ? 1 : 0;
    part.end += part.end < crossed.triangles() ? 1 : 0;
  }
  return false;
}

/// Widens a part until a point fits between its ends and it ends at triangles that can stay.
void LoopStitching::widen(const Crossed& crossed, std::size_t done, Part& part) const
{
  const std::size_t count = crossed.triangles();
  const auto middle = [&](std::size_t i) -> Vector3d
  {
    return 0.5 * (this->Stack.placeOf(crossed.lower.point(crossed.crossings[i].lower)) +
                   this->Stack.placeOf(crossed.upper.point(crossed.crossings[i].upper)));
  };
  const PlaneLoop& loop = this->Stack.few[crossed.span.middle()];
  const double chord = lengthOf(this->Stack, { &loop, 0, loop.points.size() }) / double(loop.points.size());
  for (;;)
  {
    while (part.end < count && !(crossed.isGoodEdge(part.end) && crossed.isGood(part.end)))
    {
      ++part.end;
    }
    const bool isWhole = part.begin == done && part.end == count;
    if (isWhole || (middle(part.end) - middle(part.begin)).norm() >= leastWidth * chord)
    {
      return;
    }
    part.begin -= part.begin > done ? 1 : 0;
    part.end += part.end < count ? 1 : 0;
  }
}

/// Fills a part between two edges with a part of the loop midway.
bool LoopStitching::refine(const Crossed& crossed, const Part& part, StitchedLoops& result) const
{
  const Crossing& first = crossed.crossings[part.begin];
  const Crossing& last = crossed.crossings[part.end];
  const LoopLine lower = crossed.lower.part(first.lower, last.lower);
  const LoopLine upper = crossed.upper.part(first.upper, last.upper);
  const Span& span = crossed.span;
  LoopLine line;
  if (!lineBetween(this->Stack, lower, upper, span.middle(), farthestFromLoop * this->Options.maximumError, line))
  {
    return false;
  }
  Vector3d outwards = Vector3d::Zero();
  for (std::size_t i = part.begin; i < part.end; ++i)
  {
    outwards += crossed.crossings[i].normal;
  }
  return this->addTriangle({ { lower.here(), line.here(), upper.here() } }, outwards, crossed.allowed, result) &&
         this->addTriangle({ { line.last(), lower.last(), upper.last() } }, outwards, crossed.allowed, result) &&
         this->fillBetween(lower, line, { span.begin, span.middle(), span.isLoose }, outwards, result) &&
         this->fillBetween(line, upper, { span.middle(), span.end, span.isLoose }, outwards, result);
}

bool LoopStitching::fillBetween(
  const LoopLine& lower, const LoopLine& upper, const Span& span, const Vector3d& outwards, StitchedLoops& result) const
{
  // Mean offset of their ends.
  const Vector3d offset = 0.5 * (this->Stack.placeOf(upper.here()) - this->Stack.placeOf(lower.here()) +
                                  this->Stack.placeOf(upper.last()) - this->Stack.placeOf(lower.last()));
  return this->fill(this->cross(lower, upper, span, offset, outwards), result);
}

/// Adds the triangles behind some crossings.
void LoopStitching::keep(const Crossed& crossed, std::size_t begin, std::size_t end, StitchedLoops& result)
{
  for (std::size_t i = begin; i < end; ++i)
  {
    const Crossing& now = crossed.crossings[i];
    result.triangles.push_back({ { crossed.lower.point(now.lower), now.tip, crossed.upper.point(now.upper) } });
    result.errors.push_back({ { now.inMiddle, crossed.crossings[i + 1].error } });
  }
}

/// Adds a triangle, if it is within the allowed errors and faces outwards.
bool LoopStitching::addTriangle(
  const std::array<std::int32_t, 3>& triangle, const Vector3d& outwards, const ErrorRange& allowed, StitchedLoops& result) const
{
  const double error = this->errorIn(triangle);
  if (!allowed.holds(error) || !(this->normalOf(triangle).dot(outwards) > 0.0))
  {
    return false;
  }
  result.triangles.push_back(triangle);
  result.errors.push_back({ { error, error } });
  return true;
}

Vector3d LoopStitching::normalOf(const std::array<std::int32_t, 3>& t) const
{
  const Vector3d& p = this->Stack.placeOf(t[0]);
  return (this->Stack.placeOf(t[1]) - p).cross(this->Stack.placeOf(t[2]) - p);
}

/// Tells whether the next triangle has an edge of the lower loop, and gives the error on its edge to the one behind. That is the
/// shorter one of the two possible edges, unless only the other one is near enough to the level.
bool LoopStitching::goesBelow(const LoopLine& lower, const LoopLine& upper, const Crossed& demand, double& error) const
{
  const auto errorIf = [&](bool below)
  { return this->errorAlong(below ? lower.next() : lower.here(), below ? upper.here() : upper.next(), demand.parts); };
  if (lower.isAtEnd() || upper.isAtEnd())
  {
    error = errorIf(upper.isAtEnd());
    return upper.isAtEnd();
  }
  const bool isShorter = (this->Stack.placeOf(lower.next()) + demand.offset - this->Stack.placeOf(upper.here())).squaredNorm() <
                         (this->Stack.placeOf(upper.next()) - this->Stack.placeOf(lower.here()) - demand.offset).squaredNorm();
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

/// Returns the field's largest excess or deficit at the points that cut an edge into parts; in a face of the box it may be
/// larger.
double LoopStitching::errorAlong(std::int32_t lower, std::int32_t upper, int parts) const
{
  const Vector3d& a = this->Stack.placeOf(lower);
  const Vector3d along = this->Stack.placeOf(upper) - a;
  const bool isInFace = (this->Stack.facesOf(lower) & this->Stack.facesOf(upper)) != 0;
  double largest = 0.0;
  for (int i = 1; i < parts; ++i)
  {
    const double excess = this->errorAt(a + (double(i) / parts) * along);
    const double error = isInFace ? std::min(excess, 0.0) : excess;
    largest = std::abs(error) > std::abs(largest) ? error : largest;
  }
  return largest;
}

/// Returns the same in the middle of a triangle; 0 for a cap.
double LoopStitching::errorIn(const std::array<std::int32_t, 3>& t) const
{
  return this->Stack.surface.isCap(t)
           ? 0.0
           : this->errorAt((this->Stack.placeOf(t[0]) + this->Stack.placeOf(t[1]) + this->Stack.placeOf(t[2])) / 3.0);
}

} // namespace cactus
