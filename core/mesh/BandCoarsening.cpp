// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/BandCoarsening.h"

#include "mesh/BandExcesses.h"
#include "mesh/LoopStitching.h"
#include "mesh/PlaneLoops.h"
#include "mesh/PolygonTriangulation.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace cactus
{

namespace
{

using Eigen::Vector3d;

// Fractions of the largest error.

/// Width, across a chord, of the points that it may replace: it runs through their middle.
constexpr double chordPart = 1.2;
/// Largest displacement of a point in total.
constexpr double movePart = 0.8;

/// Loops of fewer points belong to fibres so thin that little can be gained, and an axon could lose its room.
constexpr std::size_t fewestPoints = 16;

/// The largest number of bands that one strip replaces, since longer ones end in triangles too thin to repair, and the number
/// tried first.
constexpr std::size_t mostBands = 8;
constexpr std::size_t firstBands = 8;
/// If a strip has this many times as many triangles as its loops have points, the next one is half as long; below the second
/// limit, twice as long.
constexpr double tooMany = 1.7;
constexpr double fewEnough = 1.25;

/// Triangles between two planes that replace the bands between them.
struct Strip
{
  std::size_t begin = 0; ///< plane below, and number of the first band
  std::size_t end = 0;   ///< plane above
  bool hasAllBelow = false;
  bool hasAllAbove = false; ///< all points of the loop are used there, since the next band stays
  StitchedLoops stitched;
};

Eigen::Index longestAxis(const TriangleMesh& mesh)
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

class BandCoarsening
{
public:
  BandCoarsening(
    CappedSurface& surface, Eigen::Index axis, const std::vector<double>& planes, const SurfaceDecimationOptions& options)
    : Surface(surface)
    , Options(options)
    , Axis(axis)
    , Loops(surface, axis, planes)
    , Places(surface.mesh.points)
    , Moves(surface.mesh.points.size(), 0.0)
    , Excesses(surface, Loops, options)
  {
  }

  void run()
  {
    this->findHeld();
    this->simplify();
    this->cutCaps(0);
    this->cutCaps(this->Loops.planeCount() - 1);
    this->chooseStrips();
    this->joinStrips();
    this->settle();
    this->replace();
  }

private:
  const Vector3d& at(std::int32_t point) const { return this->Surface.mesh.points[std::size_t(point)]; }
  std::uint8_t facesOf(std::int32_t point) const { return this->Surface.faces[std::size_t(point)]; }

  /// Selects the points of each loop that are kept, and moves these so that chords run through the middle of the others.
  void simplify()
  {
    this->Few.resize(this->Loops.planeCount());
    std::vector<double> moves;
    for (std::size_t plane = 0; plane < this->Few.size(); ++plane)
    {
      this->Few[plane] = this->simplified(this->Loops.loop(plane), moves);
      for (std::size_t i = 0; i < moves.size(); ++i)
      {
        this->move(this->Few[plane], i, moves[i]);
      }
    }
  }

  /// Returns the kept points of a loop, and the outward displacement of each (`moves`, µm).
  PlaneLoop simplified(const PlaneLoop& loop, std::vector<double>& moves) const
  {
    PlaneLoop few;
    const std::size_t count = loop.points.size();
    std::vector<double> offsets; ///< outward offsets of the points that each chord replaces
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

  /// Tells whether the points between two of a loop are near enough to each other, across the chord. Sets `offset` to the outward
  /// position of their middle.
  bool canSkip(const PlaneLoop& loop, std::size_t from, std::size_t to, double& offset) const
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
      if ((faces & ~this->facesOf(point(i))) != 0 || this->Surface.isToStay(point(i)))
      {
        return false; // otherwise the wall between two points of a face would come to lie in the face
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

  /// Moves a point of a loop outwards in its plane, from its initial place, if no face of the box along the axis holds it.
  void move(const PlaneLoop& loop, std::size_t i, double way)
  {
    const std::size_t count = loop.points.size();
    const std::int32_t p = loop.points[i];
    const Vector3d along = this->at(loop.points[(i + 1) % count]) - this->at(loop.points[(i + count - 1) % count]);
    const Vector3d outwards = along.cross(Vector3d::Unit(this->Axis));
    const double length = outwards.norm();
    const int otherFaces = this->facesOf(p) & ~(3 << (2 * this->Axis)); // a rim stays in its own face
    if (otherFaces == 0 && length > 0.0 && !this->Surface.isHeld(p))
    {
      const Vector3d to = this->at(p) + (way / length) * outwards;
      this->Places[std::size_t(p)] = keptInside(this->Surface.box, this->at(p), to, this->Options.maximumError);
      this->Moves[std::size_t(p)] = way;
    }
  }

  /// Cuts the caps in an outermost plane from its loop with few points.
  void cutCaps(std::size_t plane)
  {
    const std::vector<std::int32_t>& points = this->Few[plane].points;
    std::vector<Eigen::Vector2d> polygon;
    for (const std::int32_t p : points)
    {
      const Vector3d& place = this->Places[std::size_t(p)];
      polygon.emplace_back(place[(this->Axis + 1) % 3], place[(this->Axis + 2) % 3]);
    }
    std::vector<std::array<std::int32_t, 3>>& caps = this->Caps[plane == 0 ? 0 : 1];
    for (const std::array<std::int32_t, 3>& t : trianglesOf(polygon))
    {
      caps.push_back({ { points[std::size_t(t[0])], points[std::size_t(t[1])], points[std::size_t(t[2])] } });
      if (plane == 0)
      {
        std::swap(caps.back()[1], caps.back()[2]); // downwards
      }
    }
  }

  /// Chooses strips from band to band, each as long as the field permits.
  void chooseStrips()
  {
    std::size_t length = firstBands;
    for (std::size_t band = 0; band < this->Loops.bandCount();)
    {
      Strip strip;
      strip.begin = strip.end = band;
      while (strip.end < this->Loops.bandCount() && this->canGo(strip.end) && strip.end - band < length)
      {
        ++strip.end;
      }
      while (strip.end > band && !this->make(strip))
      {
        strip.end = band + (strip.end - band) / 2;
      }
      const std::size_t made = strip.end - band;
      const double points = made == 0 ? 1.0 : double(this->Few[band].points.size() + this->Few[strip.end].points.size());
      const double triangles(strip.stitched.triangles.size());
      length = made == 0                        ? 1
               : triangles > tooMany * points   ? std::max<std::size_t>(1, made / 2)
               : triangles < fewEnough * points ? std::min(mostBands, 2 * made)
                                                : made;
      band += std::max<std::size_t>(1, made);
      if (made > 0)
      {
        this->Strips.push_back(std::move(strip));
      }
    }
  }

  /// Finds the bands with points in held faces along the axis: their rims are not to be replaced.
  void findHeld()
  {
    const unsigned beside = this->Surface.held & ~(3U << (2 * this->Axis));
    this->IsHeld.assign(this->Loops.bandCount(), false);
    for (std::size_t t = 0; beside != 0 && t < this->Surface.mesh.triangles.size(); ++t)
    {
      const auto& corners = this->Surface.mesh.triangles[t];
      if (std::any_of(corners.begin(), corners.end(), [&](std::int32_t p) { return (this->facesOf(p) & beside) != 0; }))
      {
        this->IsHeld[this->Loops.bandOf(t)] = true;
      }
    }
  }

  /// Tells whether a band may be part of a strip.
  bool canGo(std::size_t band) const
  {
    if (this->IsHeld[band])
    {
      return false;
    }
    const bool hasCaps = (band > 0 || !this->Caps[0].empty()) && (band + 1 < this->Loops.bandCount() || !this->Caps[1].empty());
    return hasCaps && this->Loops.isRing(band) && this->Loops.loop(band).points.size() >= fewestPoints &&
           this->Loops.loop(band + 1).points.size() >= fewestPoints;
  }

  /// Remakes those strips that have unreplaced bands beside them, and keeps the old bands where that fails.
  void joinStrips()
  {
    for (bool isJoined = false; !isJoined;)
    {
      isJoined = true;
      for (std::size_t i = 0; i < this->Strips.size(); ++i)
      {
        Strip& strip = this->Strips[i];
        const bool hasAllBelow = strip.begin > 0 && (i == 0 || this->Strips[i - 1].end != strip.begin);
        const bool hasAllAbove =
          strip.end < this->Loops.bandCount() && (i + 1 == this->Strips.size() || this->Strips[i + 1].begin != strip.end);
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

  /// Moves the points of a plane back to their initial places.
  void restore(bool isRestored, std::size_t plane)
  {
    for (const std::int32_t p : isRestored ? this->Few[plane].points : std::vector<std::int32_t>())
    {
      this->Places[std::size_t(p)] = this->at(p);
      this->Moves[std::size_t(p)] = 0.0;
    }
  }

  /// Fills a strip between its planes, and returns whether it is near enough to the field's level: where the replaced contour is
  /// not, no farther inside the body than that.
  bool make(Strip& strip) const
  {
    const PlaneLoop& lower = strip.hasAllBelow ? this->Loops.loop(strip.begin) : this->Few[strip.begin];
    const PlaneLoop& upper = strip.hasAllAbove ? this->Loops.loop(strip.end) : this->Few[strip.end];
    const LoopStack stack{ this->Surface, this->Places, this->Axis, this->Loops, this->Few, this->Excesses };
    return LoopStitching(stack, this->Options)
      .stitch(lower, upper, strip.begin, strip.end, strip.hasAllBelow || strip.hasAllAbove, strip.stitched);
  }

  /// Moves points of strips to balance the field's excess and deficit around each.
  void settle()
  {
    std::vector<ErrorRange> around(this->Places.size());
    for (std::size_t p = 0; p < this->Places.size(); ++p)
    {
      around[p].add(-this->Moves[p]);
    }
    for (const Strip& strip : this->Strips)
    {
      for (std::size_t t = 0; t < strip.stitched.triangles.size(); ++t)
      {
        for (const std::int32_t p : strip.stitched.triangles[t])
        {
          around[std::size_t(p)].add(strip.stitched.errors[t][0]);
          around[std::size_t(p)].add(strip.stitched.errors[t][1]); // of an edge that most of them share
        }
      }
    }
    const double furthest = movePart * this->Options.maximumError;
    for (const Strip& strip : this->Strips)
    {
      for (std::size_t plane = strip.begin + (strip.hasAllBelow ? 1 : 0); plane < strip.end; ++plane)
      {
        const PlaneLoop& loop = this->Few[plane];
        for (std::size_t i = 0; i < loop.points.size(); ++i)
        {
          const auto p = std::size_t(loop.points[i]);
          this->move(loop, i, std::clamp(this->Moves[p] + around[p].middle(), -furthest, furthest));
        }
      }
    }
  }

  /// Replaces bands by strips, and removes points without triangles.
  void replace()
  {
    std::vector<bool> isReplaced(this->Loops.bandCount(), false);
    for (const Strip& strip : this->Strips)
    {
      std::fill(isReplaced.begin() + std::ptrdiff_t(strip.begin), isReplaced.begin() + std::ptrdiff_t(strip.end), true);
    }
    auto& triangles = this->Surface.mesh.triangles;
    std::size_t kept = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t)
    {
      if (!isReplaced[this->Loops.bandOf(t)])
      {
        triangles[kept++] = triangles[t];
      }
    }
    triangles.resize(kept);
    this->Surface.mesh.points.swap(this->Places);
    for (const Strip& strip : this->Strips)
    {
      triangles.insert(triangles.end(), strip.stitched.triangles.begin(), strip.stitched.triangles.end());
    }
    for (std::size_t end = 0; end < 2; ++end)
    {
      if (isReplaced[end == 0 ? 0 : isReplaced.size() - 1])
      {
        triangles.insert(triangles.end(), this->Caps[end].begin(), this->Caps[end].end());
      }
    }
    dropUnusedPoints(this->Surface.mesh, &this->Surface.faces);
  }

  CappedSurface& Surface;
  const SurfaceDecimationOptions& Options;
  Eigen::Index Axis;
  PlaneLoops Loops;
  std::vector<PlaneLoop> Few;   ///< per plane, its loop with few points
  std::vector<Vector3d> Places; ///< per point, its new place
  std::vector<double> Moves;    ///< per point, its outward displacement, µm
  BandExcesses Excesses;
  std::vector<bool> IsHeld;                                     ///< per band, whether it has to stay
  std::vector<Strip> Strips;                                    ///< from below
  std::array<std::vector<std::array<std::int32_t, 3>>, 2> Caps; ///< in the first plane and the last one
};

} // namespace

void coarsenBands(CappedSurface& surface, const NodeLattice& lattice, const SurfaceDecimationOptions& options)
{
  constexpr std::size_t fewestPlanes = 4; // so that there is a band between two inner planes
  // Pieces beside two opposite faces do not tell the way of a fibre that passes through them.
  const Eigen::Index axis = surface.held != 0 ? 2 : longestAxis(surface.mesh);
  std::vector<double> planes = lattice.planes[std::size_t(axis)];
  if (!surface.box.isEmpty())
  {
    planes.front() = surface.box.min()[axis];
    planes.back() = surface.box.max()[axis];
  }
  if (options.maximumError > 0.0 && !surface.mesh.triangles.empty() && planes.size() >= fewestPlanes)
  {
    BandCoarsening(surface, axis, planes, options).run();
  }
}

} // namespace cactus
