// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/BandCoarsening.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace cactus
{

namespace
{

using Eigen::Vector3d;

/// How far apart points of a loop that one chord replaces may be, across it, as a part of the largest error: the chord goes
/// amid them.
constexpr double chordPart = 1.2;
/// Bands that one strip replaces at most.
constexpr std::size_t mostBands = 16;
constexpr std::size_t firstBands = 4;
constexpr double slack = 1.2;
constexpr double looseSlack = 2.0;

/// The points of a surface in one plane, one after the other, counterclockwise as seen from the upper end of the axis.
struct Loop
{
  std::vector<std::int32_t> points;
  /// Of points that have to stay since the loop comes to a face of the box there, or leaves it: their places in `points`.
  std::vector<std::size_t> anchors;
};

/// Triangles between two planes, in the place of the bands between them.
struct Strip
{
  std::size_t begin = 0; ///< plane below, which is the number of the first band, too
  std::size_t end = 0;   ///< plane above
  bool hasAllBelow = false;
  bool hasAllAbove = false; ///< all points of the loop there, since the band behind stays as it is
  std::vector<std::array<std::int32_t, 3>> triangles;
  /// Of each triangle, by how much the field exceeds its level in its middle, and in that of the edge to the next triangle.
  std::vector<std::array<double, 2>> errors;
};

class Bands
{
public:
  Bands(CappedSurface& surface, const NodeLattice& lattice, const SurfaceDecimationOptions& options)
    : Surface(surface)
    , Options(options)
    , Axis(longestAxis(surface.mesh))
    , Planes(lattice.planes[std::size_t(Axis)])
  {
  }

  void run()
  {
    this->place();
    this->sort();
    this->findRings();
    this->chooseStrips();
    this->joinStrips();
    this->settle();
    this->replace();
  }

private:
  static Eigen::Index longestAxis(const TriangleMesh& mesh)
  {
    Eigen::AlignedBox3d box;
    for (const Vector3d& p : mesh.points)
    {
      box.extend(p);
    }
    Eigen::Index axis = 0;
    box.sizes().maxCoeff(&axis);
    return axis;
  }

  const Vector3d& at(std::int32_t point) const { return this->Surface.mesh.points[std::size_t(point)]; }
  /// Where a point is to go.
  const Vector3d& placeOf(std::int32_t point) const { return this->Places[std::size_t(point)]; }
  std::uint8_t facesOf(std::int32_t point) const { return this->Surface.faces[std::size_t(point)]; }
  int codeOf(std::int32_t point) const { return this->Codes[std::size_t(point)]; }
  std::size_t bandCount() const { return this->Planes.size() - 1; }

  /// Finds the plane of each point: 2 p where it lies in plane p, 2 p + 1 between that and the next one.
  void place()
  {
    const auto& points = this->Surface.mesh.points;
    const int last = static_cast<int>(this->Planes.size()) - 1;
    const double spacing = (this->Planes[std::size_t(last) - 1] - this->Planes[1]) / std::max(1, last - 2);
    this->Codes.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const double x = points[i][this->Axis];
      int p = std::clamp(1 + static_cast<int>((x - this->Planes[1]) / spacing), 0, last - 1);
      for (; p > 0 && x < this->Planes[std::size_t(p)]; --p)
      {
      }
      for (; p < last - 1 && x >= this->Planes[std::size_t(p) + 1]; ++p)
      {
      }
      this->Codes[i] = 2 * p + (x == this->Planes[std::size_t(p)] ? 0 : 1);
    }
  }

  /// Sorts triangles by bands, and chains the edges along which a band begins.
  void sort()
  {
    const auto& triangles = this->Surface.mesh.triangles;
    this->BandOf.resize(triangles.size());
    this->TrianglesIn.assign(this->bandCount(), 0);
    this->Next.assign(this->Codes.size(), -1);
    for (std::size_t t = 0; t < triangles.size(); ++t)
    {
      const auto& corners = triangles[t];
      const int lowest = std::min({ this->codeOf(corners[0]), this->codeOf(corners[1]), this->codeOf(corners[2]) });
      const std::size_t band = std::min(std::size_t(lowest) / 2, this->bandCount() - 1);
      this->BandOf[t] = band;
      ++this->TrianglesIn[band];
      for (std::size_t i = 0; i < 3 && lowest % 2 == 0; ++i)
      {
        const std::int32_t from = corners[i];
        const std::int32_t to = corners[(i + 1) % 3];
        if (this->codeOf(from) == lowest && this->codeOf(to) == lowest)
        {
          this->Next[std::size_t(from)] = to;
        }
      }
    }
  }

  /// Finds the bands that are rings between a loop below and a loop above.
  void findRings()
  {
    std::vector<std::size_t> count(2 * this->Planes.size(), 0);
    std::vector<std::int32_t> any(this->Planes.size(), -1);
    for (std::size_t p = 0; p < this->Codes.size(); ++p)
    {
      const auto code = std::size_t(this->Codes[p]);
      ++count[code];
      if (code % 2 == 0)
      {
        any[code / 2] = static_cast<std::int32_t>(p);
      }
    }
    this->Loops.resize(this->Planes.size());
    for (std::size_t plane = 1; plane + 1 < this->Planes.size(); ++plane)
    {
      this->trace(any[plane], count[2 * plane], this->Loops[plane]);
    }
    this->IsRing.assign(this->bandCount(), false);
    for (std::size_t band = 1; band + 2 < this->Planes.size(); ++band)
    {
      // Points less edges plus triangles are 0, where each edge but those of the two loops has a triangle on both sides.
      const std::size_t onLoops = count[2 * band] + count[2 * band + 2];
      this->IsRing[band] = !this->Loops[band].points.empty() && !this->Loops[band + 1].points.empty() &&
                           2 * count[2 * band + 1] + onLoops == this->TrianglesIn[band];
    }
  }

  /// Follows the loop from a point. Leaves it empty where it does not come back, or does not pass `count` points.
  void trace(std::int32_t first, std::size_t count, Loop& loop) const
  {
    std::int32_t point = first;
    while (point >= 0 && loop.points.size() < count)
    {
      loop.points.push_back(point);
      point = this->Next[std::size_t(point)];
    }
    if (point < 0 || point != first || loop.points.size() != count || count < 3)
    {
      loop.points.clear();
      return;
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::uint8_t here = this->facesOf(loop.points[i]);
      const std::uint8_t before = this->facesOf(loop.points[(i + count - 1) % count]);
      const std::uint8_t behind = this->facesOf(loop.points[(i + 1) % count]);
      if ((here & ~(before & behind)) != 0)
      {
        loop.anchors.push_back(i);
      }
    }
    // It begins at an anchor or, if there is none, at the point farthest from its middle.
    std::size_t start = 0;
    if (loop.anchors.empty())
    {
      const Vector3d middle = this->middleOf(loop);
      const auto distance = [&](std::int32_t p) { return (this->at(p) - middle).squaredNorm(); };
      start = std::size_t(std::max_element(loop.points.begin(), loop.points.end(),
                            [&](std::int32_t p, std::int32_t q) { return distance(p) < distance(q); }) -
                          loop.points.begin());
    }
    else
    {
      start = loop.anchors.front();
      for (std::size_t& anchor : loop.anchors)
      {
        anchor -= start;
      }
    }
    std::rotate(loop.points.begin(), loop.points.begin() + std::ptrdiff_t(start), loop.points.end());
  }

  Vector3d middleOf(const Loop& loop) const
  {
    Vector3d sum = Vector3d::Zero();
    for (const std::int32_t p : loop.points)
    {
      sum += this->at(p);
    }
    return sum / double(loop.points.size());
  }

  /// The loop with few points, whose chords go amid those that are left out: `moves` are how far they move outwards for that.
  Loop simplified(const Loop& loop, std::vector<double>& moves) const
  {
    Loop few;
    const std::size_t count = loop.points.size();
    std::vector<double> offsets; ///< of the points that each chord replaces, outwards
    std::size_t anchor = 0;
    for (std::size_t i = 0; i < count;)
    {
      if (anchor < loop.anchors.size() && loop.anchors[anchor] == i)
      {
        few.anchors.push_back(few.points.size());
        ++anchor;
      }
      few.points.push_back(loop.points[i]);
      const std::size_t end = anchor < loop.anchors.size() ? loop.anchors[anchor] : count;
      std::size_t next = i + 1;
      double offset = 0.0;
      while (next < end && this->canSkip(loop, i, next + 1, offset))
      {
        ++next;
      }
      offsets.push_back(offset);
      i = next;
    }
    moves.resize(few.points.size());
    for (std::size_t i = 0; i < few.points.size(); ++i)
    {
      moves[i] = 0.5 * (offsets[i] + offsets[(i + offsets.size() - 1) % offsets.size()]);
    }
    return few;
  }

  /// Whether the points between two of a loop are near enough to each other, across the chord. `offset` becomes where their middle
  /// lies, outwards.
  bool canSkip(const Loop& loop, std::size_t from, std::size_t to, double& offset) const
  {
    const auto point = [&](std::size_t i) { return loop.points[i % loop.points.size()]; };
    const Vector3d& a = this->at(point(from));
    const Vector3d along = this->at(point(to)) - a;
    const double length = along.norm();
    if (length > this->Options.sampling)
    {
      return false;
    }
    const int faces = this->facesOf(point(from)) & this->facesOf(point(to));
    double lowest = 0.0;
    double highest = 0.0;
    for (std::size_t i = from + 1; i < to; ++i)
    {
      if ((faces & ~this->facesOf(point(i))) != 0)
      {
        return false; // the wall between two points of a face would come to lie in that
      }
      const Vector3d off = this->at(point(i)) - a;
      const double part = along.dot(off);
      const double outwards = off.cross(along)[this->Axis] / length;
      lowest = std::min(lowest, outwards);
      highest = std::max(highest, outwards);
      if (highest - lowest > chordPart * this->Options.maximumError || part < 0.0 || part > length * length)
      {
        return false;
      }
    }
    offset = 0.5 * (lowest + highest);
    return true;
  }

  /// Chooses planes, as far apart as the field lets strips between them be.
  void chooseStrips()
  {
    this->Few.resize(this->Planes.size());
    this->Places = this->Surface.mesh.points;
    this->Moves.assign(this->Places.size(), 0.0);
    std::vector<double> moves;
    for (std::size_t plane = 0; plane < this->Planes.size(); ++plane)
    {
      this->Few[plane] = this->simplified(this->Loops[plane], moves);
      for (std::size_t i = 0; i < moves.size(); ++i)
      {
        this->move(this->Few[plane], i, moves[i]);
      }
    }
    std::size_t length = firstBands;
    for (std::size_t band = 0; band < this->bandCount();)
    {
      Strip strip;
      strip.begin = strip.end = band;
      while (strip.end < this->bandCount() && this->IsRing[strip.end] && strip.end - band < length)
      {
        ++strip.end;
      }
      while (strip.end > band && !this->make(strip))
      {
        strip.end = band + (strip.end - band) / 2;
      }
      const std::size_t made = strip.end - band;
      length = made == 0 ? 1 : std::min(mostBands, 2 * made);
      band += std::max<std::size_t>(1, made);
      if (made > 0)
      {
        this->Strips.push_back(std::move(strip));
      }
    }
  }

  /// Moves a point of a loop outwards in its plane, from where it was first, if no face of the box holds it.
  void move(const Loop& loop, std::size_t i, double way)
  {
    const std::size_t count = loop.points.size();
    const std::int32_t p = loop.points[i];
    const Vector3d along = this->at(loop.points[(i + 1) % count]) - this->at(loop.points[(i + count - 1) % count]);
    const Vector3d outwards = along.cross(Vector3d::Unit(this->Axis));
    const double length = outwards.norm();
    if (this->facesOf(p) == 0 && length > 0.0)
    {
      const Vector3d to = this->at(p) + (way / length) * outwards;
      this->Places[std::size_t(p)] = keptInside(this->Surface.box, this->at(p), to, this->Options.maximumError);
      this->Moves[std::size_t(p)] = way;
    }
  }

  /// Makes those strips again which have bands that stay beside them, and leaves bands as they are where that fails.
  void joinStrips()
  {
    for (bool isJoined = false; !isJoined;)
    {
      isJoined = true;
      for (std::size_t i = 0; i < this->Strips.size(); ++i)
      {
        Strip& strip = this->Strips[i];
        const bool hasAllBelow = i == 0 || this->Strips[i - 1].end != strip.begin;
        const bool hasAllAbove = i + 1 == this->Strips.size() || this->Strips[i + 1].begin != strip.end;
        if (hasAllBelow != strip.hasAllBelow || hasAllAbove != strip.hasAllAbove)
        {
          strip.hasAllBelow = hasAllBelow;
          strip.hasAllAbove = hasAllAbove;
          this->restore(hasAllBelow, strip.begin);
          this->restore(hasAllAbove, strip.end);
          if (!this->make(strip))
          {
            this->Strips.erase(this->Strips.begin() + std::ptrdiff_t(i));
            isJoined = false;
            break;
          }
        }
      }
    }
  }

  /// Puts the points of a plane back to where they were.
  void restore(bool isRestored, std::size_t plane)
  {
    for (const std::int32_t p : isRestored ? this->Few[plane].points : std::vector<std::int32_t>())
    {
      this->Places[std::size_t(p)] = this->at(p);
      this->Moves[std::size_t(p)] = 0.0;
    }
  }

  /// Fills a strip between its planes, and says whether it is near enough to the field's level.
  bool make(Strip& strip)
  {
    strip.triangles.clear();
    strip.errors.clear();
    return this->fill(strip, strip.hasAllBelow ? this->Loops[strip.begin] : this->Few[strip.begin],
      strip.hasAllAbove ? this->Loops[strip.end] : this->Few[strip.end]);
  }

  bool fill(Strip& strip, const Loop& lower, const Loop& upper)
  {
    if (lower.anchors.size() != upper.anchors.size())
    {
      return false;
    }
    const Vector3d offset = this->middleOf(upper) - this->middleOf(lower);
    if (lower.anchors.empty())
    {
      const auto [i, j] = this->nearestPair(lower, upper, offset);
      return this->stitch(strip, lower, i, i + lower.points.size(), upper, j, j + upper.points.size(), offset);
    }
    const std::size_t parts = lower.anchors.size();
    if (!this->matchAnchors(lower, upper, offset))
    {
      return false;
    }
    for (std::size_t part = 0; part < parts; ++part)
    {
      const std::size_t other = (this->AnchorTurn + part) % parts;
      const auto endOf = [](const Loop& loop, std::size_t anchor)
      { return anchor + 1 < loop.anchors.size() ? loop.anchors[anchor + 1] : loop.points.size(); };
      if (!this->stitch(
            strip, lower, lower.anchors[part], endOf(lower, part), upper, upper.anchors[other], endOf(upper, other), offset))
      {
        return false;
      }
    }
    return true;
  }

  /// The points of two loops that are nearest to each other, by their places.
  std::pair<std::size_t, std::size_t> nearestPair(const Loop& lower, const Loop& upper, const Vector3d& offset) const
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

  /// Finds which anchor of the upper loop belongs to the first one of the lower loop, AnchorTurn. Returns false where the loops do
  /// not come to the same faces, one after the other.
  bool matchAnchors(const Loop& lower, const Loop& upper, const Vector3d& offset)
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
        this->AnchorTurn = turn;
      }
    }
    return least < std::numeric_limits<double>::infinity();
  }

  /// Whether a loop runs in a face of the box behind an anchor.
  bool isInFace(const Loop& loop, std::size_t anchor) const
  {
    const std::size_t i = loop.anchors[anchor];
    return (this->facesOf(loop.points[i]) & this->facesOf(loop.points[(i + 1) % loop.points.size()])) != 0;
  }

  /// Triangles between two lines, from i to iEnd of the lower loop and from j to jEnd of the upper one, taken round the loops.
  bool stitch(Strip& strip, const Loop& lower, std::size_t i, std::size_t iEnd, const Loop& upper, std::size_t j, std::size_t jEnd,
    const Vector3d& offset) const
  {
    const std::size_t bands = strip.end - strip.begin;
    const auto below = [&](std::size_t at) { return lower.points[at % lower.points.size()]; };
    const auto above = [&](std::size_t at) { return upper.points[at % upper.points.size()]; };
    const bool isLoose = bands == 1 || strip.hasAllBelow || strip.hasAllAbove;
    const double most = (isLoose ? looseSlack : slack) * this->Options.maximumError;
    double error = this->errorAlong(below(i), above(j), bands);
    Vector3d before = Vector3d::Zero();
    while (std::abs(error) <= most && (i < iEnd || j < jEnd))
    {
      bool goesBelow = j == jEnd;
      if (i < iEnd && j < jEnd)
      {
        goesBelow = (this->placeOf(below(i + 1)) + offset - this->placeOf(above(j))).squaredNorm() <
                    (this->placeOf(above(j + 1)) - this->placeOf(below(i)) - offset).squaredNorm();
        error = this->errorAlong(below(i + (goesBelow ? 1 : 0)), above(j + (goesBelow ? 0 : 1)), bands);
        if (std::abs(error) > this->Options.maximumError)
        {
          const double other = this->errorAlong(below(i + (goesBelow ? 0 : 1)), above(j + (goesBelow ? 1 : 0)), bands);
          goesBelow = goesBelow != (std::abs(other) < std::abs(error));
          error = std::abs(other) < std::abs(error) ? other : error;
        }
      }
      else
      {
        error = this->errorAlong(below(i + (goesBelow ? 1 : 0)), above(j + (goesBelow ? 0 : 1)), bands);
      }
      const std::array<std::int32_t, 3> triangle = goesBelow ? std::array<std::int32_t, 3>{ { below(i), below(i + 1), above(j) } }
                                                             : std::array<std::int32_t, 3>{ { below(i), above(j + 1), above(j) } };
      ++(goesBelow ? i : j);
      const Vector3d& p = this->placeOf(triangle[0]);
      const Vector3d normal = (this->placeOf(triangle[1]) - p).cross(this->placeOf(triangle[2]) - p);
      const double inMiddle = this->Surface.isCap(triangle) ? 0.0 : this->errorIn(triangle);
      if (normal.dot(before) < 0.0 || std::abs(inMiddle) > most)
      {
        return false;
      }
      before = normal;
      strip.triangles.push_back(triangle);
      strip.errors.push_back({ { inMiddle, error } });
    }
    return std::abs(error) <= most;
  }

  /// By how much the field exceeds its level where it does so most, or falls below it, along an edge that crosses so many bands;
  /// in a face of the box it may be larger.
  double errorAlong(std::int32_t lower, std::int32_t upper, std::size_t bands) const
  {
    const Vector3d& a = this->placeOf(lower);
    const Vector3d along = this->placeOf(upper) - a;
    const int parts = bands < 4 ? 2 : 4;
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

  double errorIn(const std::array<std::int32_t, 3>& t) const
  {
    return this->errorAt((this->placeOf(t[0]) + this->placeOf(t[1]) + this->placeOf(t[2])) / 3.0);
  }

  double errorAt(const Vector3d& p) const { return this->Options.field(p) - this->Options.level; }

  /// Moves points in their planes so that the surface around each is amid where the field is too large and too small.
  void settle()
  {
    struct Range
    {
      double lowest = 0.0;
      double highest = 0.0;
      void add(double error)
      {
        lowest = std::min(lowest, error);
        highest = std::max(highest, error);
      }
    };
    std::vector<Range> around(this->Places.size());
    for (std::size_t p = 0; p < this->Places.size(); ++p)
    {
      around[p].add(-this->Moves[p]);
    }
    for (const Strip& strip : this->Strips)
    {
      for (std::size_t t = 0; t < strip.triangles.size(); ++t)
      {
        for (const std::int32_t p : strip.triangles[t])
        {
          around[std::size_t(p)].add(strip.errors[t][0]);
          around[std::size_t(p)].add(strip.errors[t][1]); // of an edge that most of them are at
        }
      }
    }
    for (const Strip& strip : this->Strips)
    {
      const Loop& loop = this->Few[strip.begin];
      for (std::size_t i = 0; !strip.hasAllBelow && i < loop.points.size(); ++i)
      {
        const Range& range = around[std::size_t(loop.points[i])];
        this->move(loop, i, this->Moves[std::size_t(loop.points[i])] + 0.5 * (range.lowest + range.highest));
      }
    }
  }

  /// Puts strips in the place of bands, and removes points that no triangle has any more.
  void replace()
  {
    std::vector<bool> isReplaced(this->bandCount(), false);
    for (const Strip& strip : this->Strips)
    {
      std::fill(isReplaced.begin() + std::ptrdiff_t(strip.begin), isReplaced.begin() + std::ptrdiff_t(strip.end), true);
    }
    auto& triangles = this->Surface.mesh.triangles;
    std::size_t kept = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t)
    {
      if (!isReplaced[this->BandOf[t]])
      {
        triangles[kept++] = triangles[t];
      }
    }
    triangles.resize(kept);
    this->Surface.mesh.points.swap(this->Places);
    for (const Strip& strip : this->Strips)
    {
      triangles.insert(triangles.end(), strip.triangles.begin(), strip.triangles.end());
    }
    this->removeUnused();
  }

  void removeUnused()
  {
    auto& points = this->Surface.mesh.points;
    std::vector<std::int32_t> place(points.size(), -1);
    for (const auto& t : this->Surface.mesh.triangles)
    {
      for (const std::int32_t p : t)
      {
        place[std::size_t(p)] = 0;
      }
    }
    std::size_t kept = 0;
    for (std::size_t p = 0; p < points.size(); ++p)
    {
      if (place[p] == 0)
      {
        points[kept] = points[p];
        this->Surface.faces[kept] = this->Surface.faces[p];
        place[p] = static_cast<std::int32_t>(kept++);
      }
    }
    points.resize(kept);
    this->Surface.faces.resize(kept);
    for (auto& t : this->Surface.mesh.triangles)
    {
      for (std::int32_t& p : t)
      {
        p = place[std::size_t(p)];
      }
    }
  }

  CappedSurface& Surface;
  const SurfaceDecimationOptions& Options;
  Eigen::Index Axis;
  const std::vector<double>& Planes;
  std::vector<int> Codes;                ///< per point, see place()
  std::vector<std::int32_t> Next;        ///< per point, the next one of its plane's loop, or -1
  std::vector<std::size_t> BandOf;       ///< per triangle
  std::vector<std::size_t> TrianglesIn;  ///< per band
  std::vector<bool> IsRing;              ///< per band
  std::vector<Loop> Loops;               ///< per plane; empty where there is not one loop
  std::vector<Loop> Few;                 ///< the same with few points
  std::vector<Vector3d> Places;          ///< per point, where it is to go
  std::vector<double> Moves;             ///< per point, how far it has moved outwards
  std::vector<Strip> Strips;             ///< from below
  std::size_t AnchorTurn = 0;            ///< see matchAnchors()
};

} // namespace

void coarsenBands(CappedSurface& surface, const NodeLattice& lattice, const SurfaceDecimationOptions& options)
{
  if (options.maximumError > 0.0 && !surface.mesh.triangles.empty())
  {
    Bands(surface, lattice, options).run();
  }
}

} // namespace cactus
