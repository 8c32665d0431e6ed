// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SurfaceRemeshing.h"

#include "base/Constants.h"
#include "mesh/EditableSurface.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace cactus
{

namespace
{

using Eigen::Vector3d;

constexpr int remeshingRounds = 7;
constexpr int finishingRounds = 12;
/// Edges are split above, and collapsed below, these fractions of the target length.
constexpr double longEdge = 4.0 / 3.0;
constexpr double shortEdge = 4.0 / 5.0;
/// The error in the middle of an edge of the target length, as a fraction of the largest error.
constexpr double errorOfEdge = 0.6;
/// Largest growth of target lengths along the surface.
constexpr double grading = 0.35;
/// As fractions of the longest edge: the shortest target length, and the distance from a point at which its curvature is
/// measured.
constexpr double shortestPart = 0.12;
constexpr double curvatureReach = 0.25;
/// Least cosine between the normals of a triangle before and after a change.
constexpr double leastKeptTurn = 0.5;
/// Radians that a change leaves a triangle at least, unless it had less.
constexpr double leastAngle = 0.2;
/// Radians above which an angle need not improve.
constexpr double goodAngle = 0.6;

double smallestAngleOf(const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
  const auto angle = [](const Vector3d& u, const Vector3d& v) { return std::atan2(u.cross(v).norm(), u.dot(v)); };
  return std::min({ angle(b - a, c - a), angle(c - b, a - b), angle(a - c, b - c) });
}

class Remeshing
{
public:
  Remeshing(CappedSurface& surface, const SurfaceRemeshingOptions& options)
    : Mesh(surface)
    , Options(options)
    , Box(surface.box)
    , Error(options.surface.maximumError)
  {
  }

  void run()
  {
    for (int round = 0; round < remeshingRounds; ++round)
    {
      this->measureLengths();
      this->splitLongEdges();
      this->collapseShortEdges();
      this->flipEdges();
      this->relax();
    }
    this->measureLengths();
    for (int round = 0; round < finishingRounds && this->finishAngles(); ++round)
    {
      this->flipEdges();
      this->relax();
    }
    this->flipEdges();
    this->Mesh.compact();
  }

private:
  using Corners = std::array<std::int32_t, 3>;

  const Vector3d& at(std::int32_t point) const { return this->Mesh.at(point); }
  double field(const Vector3d& p) const { return this->Options.surface.field(p) - this->Options.surface.level; }

  /// Returns the faces of the box that a triangle lies in: 0 for those of the wall.
  unsigned capOf(const Corners& t) const
  {
    return unsigned(this->Mesh.facesOf(t[0]) & this->Mesh.facesOf(t[1]) & this->Mesh.facesOf(t[2]));
  }

  /// Tells whether an edge is part of an outline: of a cap, or of the box.
  bool isOutline(std::int32_t a, std::int32_t b) const
  {
    return (this->Mesh.facesOf(a) & this->Mesh.facesOf(b)) != 0 &&
           this->capOf(this->Mesh.cornersOf(this->Mesh.triangleAlong(a, b))) !=
             this->capOf(this->Mesh.cornersOf(this->Mesh.triangleAlong(b, a)));
  }

  /// Returns the other ends of the outlines' edges at a point.
  std::vector<std::int32_t> outlinesAt(std::int32_t point) const
  {
    std::vector<std::int32_t> ends;
    for (std::int32_t c = this->Mesh.facesOf(point) == 0 ? -1 : this->Mesh.firstCorner(point); c >= 0;
         c = this->Mesh.nextCorner(c))
    {
      const std::int32_t next = this->Mesh.oppositeEdge(c)[0];
      if (this->isOutline(point, next))
      {
        ends.push_back(next);
      }
    }
    return ends;
  }

  /// Returns the field's gradient, without the axes along which a point has to stay.
  Vector3d gradient(const Vector3d& p, std::uint8_t faces) const
  {
    const double step = 0.1 * this->Options.longestEdge;
    Vector3d sum = Vector3d::Zero();
    for (int axis = 0; axis < 3; ++axis)
    {
      if ((faces >> (2 * axis) & 3) == 0)
      {
        const Vector3d along = step * Vector3d::Unit(axis);
        sum[axis] = (this->field(p + along) - this->field(p - along)) / (2.0 * step);
      }
    }
    return sum;
  }

  /// Returns the point on the level next to a place, within the same faces; at most `furthest` away.
  Vector3d onLevel(Vector3d p, std::uint8_t faces, double furthest) const
  {
    for (int step = 0; step < 2; ++step)
    {
      const Vector3d slope = this->gradient(p, faces);
      const double square = slope.squaredNorm();
      const double off = this->field(p);
      if (!(square >= 0.05) || !std::isfinite(square) || !std::isfinite(off))
      {
        return p; // no gradient, as in the middle of a fibre or where its field ends
      }
      Vector3d move = -off / square * slope;
      move *= std::min(1.0, furthest / std::max(move.norm(), 1e-300));
      p = faces == 0 ? keptInside(this->Box, p, p + move, 2.0 * this->Error) : Vector3d(p + move);
      p = this->Box.isEmpty() ? p : Vector3d(p.cwiseMax(this->Box.min()).cwiseMin(this->Box.max()));
    }
    return p;
  }

  double lengthAt(std::int32_t a, std::int32_t b) const
  {
    return 0.5 * (this->Length[std::size_t(a)] + this->Length[std::size_t(b)]);
  }

  double curvedLength(std::int32_t point) const;
  void measureLengths();
  void splitLongEdges();
  void collapseShortEdges();
  bool collapseEdge(std::int32_t a, std::int32_t b, double longest, double leastNew);
  bool collapsePlace(std::int32_t a, std::int32_t b, Vector3d& place) const;
  bool allowsCollapse(std::int32_t a, std::int32_t b, const Vector3d& place, double longest, double leastNew) const;
  void flipEdges();
  bool flipEdge(std::size_t triangle, std::size_t place);
  double errorAround(const Vector3d& a, const Vector3d& b) const { return std::fabs(this->field(0.5 * (a + b))); }
  void relax();
  Vector3d relaxedPlace(std::int32_t point) const;
  bool moveIfBetter(std::int32_t point, const Vector3d& wanted, double enough);
  double worstAngleAt(std::int32_t point, const Vector3d& place, bool& isTurned) const;
  bool finishAngles();
  bool finishTriangle(std::size_t triangle);
  bool searchBetterPlace(std::int32_t point);

  EditableSurface Mesh;
  const SurfaceRemeshingOptions& Options;
  Eigen::AlignedBox3d Box;
  double Error;
  std::vector<double> Length; ///< µm, per point, target length of edges there
};

/// Returns the length of edges whose middles have the largest allowed error, by the second differences of the field.
double Remeshing::curvedLength(std::int32_t point) const
{
  const double longest = this->Options.longestEdge;
  const Vector3d& p = this->at(point);
  const Vector3d slope = this->gradient(p, 0);
  if (!(slope.norm() >= 0.2) || !std::isfinite(slope.norm()))
  {
    return shortestPart * longest;
  }
  const Vector3d u = slope.unitOrthogonal();
  const Vector3d v = slope.cross(u).normalized();
  const double step = curvatureReach * longest;
  const double here = this->field(p);
  double curvature = 0.0;
  for (const Vector3d& along : { u, v, Vector3d((u + v).normalized()), Vector3d((u - v).normalized()) })
  {
    const double there = this->field(p + step * along) + this->field(p - step * along);
    curvature = std::max(curvature, std::fabs(there - 2.0 * here) / (step * step));
  }
  double allowed = errorOfEdge * this->Error;
  for (const LocalErrorBound& bound : this->Options.surface.localBounds)
  {
    allowed *= (p - bound.centre).squaredNorm() < bound.radius * bound.radius ? bound.part : 1.0;
  }
  return std::clamp(std::sqrt(8.0 * allowed / std::max(curvature, 1e-9)), shortestPart * longest, longest);
}

void Remeshing::measureLengths()
{
  const double longest = this->Options.longestEdge;
  this->Length.assign(this->Mesh.pointCount(), longest);
  for (std::size_t p = 0; p < this->Mesh.pointCount(); ++p)
  {
    const auto point = static_cast<std::int32_t>(p);
    const bool isOfWall = !this->Mesh.isDeadPoint(point) && (this->Mesh.facesOf(point) == 0 || !this->outlinesAt(point).empty());
    this->Length[p] = isOfWall ? this->curvedLength(point) : longest;
  }
  // Lengths grow slowly away from short ones.
  for (int sweep = 0; sweep < 6; ++sweep)
  {
    for (std::size_t t = 0; t < this->Mesh.triangleCount(); ++t)
    {
      for (std::size_t i = 0; i < 3 && !this->Mesh.isDead(t); ++i)
      {
        const std::int32_t a = this->Mesh.cornersOf(t)[i];
        const std::int32_t b = this->Mesh.cornersOf(t)[(i + 1) % 3];
        const double more = grading * (this->at(a) - this->at(b)).norm();
        this->Length[std::size_t(b)] = std::min(this->Length[std::size_t(b)], this->Length[std::size_t(a)] + more);
      }
    }
  }
}

void Remeshing::splitLongEdges()
{
  for (std::size_t t = 0; t < this->Mesh.triangleCount(); ++t)
  {
    for (std::size_t i = 0; i < 3 && !this->Mesh.isDead(t); ++i)
    {
      const std::int32_t a = this->Mesh.cornersOf(t)[i];
      const std::int32_t b = this->Mesh.cornersOf(t)[(i + 1) % 3];
      const double wanted = this->lengthAt(a, b);
      const double length = (this->at(a) - this->at(b)).norm();
      const Corners& corners = this->Mesh.cornersOf(t);
      const bool isLongest = length >= (this->at(corners[(i + 2) % 3]) - this->at(a)).norm() &&
                             length >= (this->at(corners[(i + 2) % 3]) - this->at(b)).norm();
      if (!isLongest || length <= longEdge * wanted)
      {
        continue;
      }
      const auto shared = static_cast<std::uint8_t>(this->Mesh.facesOf(a) & this->Mesh.facesOf(b));
      const bool isInCap = shared != 0 && !this->isOutline(a, b);
      const Vector3d middle = 0.5 * (this->at(a) + this->at(b));
      const std::int32_t point = this->Mesh.split(a, b, middle);
      this->Length.push_back(wanted);
      if (!isInCap)
      {
        this->moveIfBetter(point, this->onLevel(middle, shared, 0.2 * length), 0.0);
      }
    }
  }
}

void Remeshing::collapseShortEdges()
{
  for (std::size_t t = 0; t < this->Mesh.triangleCount(); ++t)
  {
    for (std::size_t i = 0; i < 3 && !this->Mesh.isDead(t); ++i)
    {
      const std::int32_t a = this->Mesh.cornersOf(t)[i];
      const std::int32_t b = this->Mesh.cornersOf(t)[(i + 1) % 3];
      const double wanted = this->lengthAt(a, b);
      if ((this->at(a) - this->at(b)).norm() < shortEdge * wanted)
      {
        this->collapseEdge(a, b, longEdge * wanted, leastAngle);
      }
    }
  }
}

/// Merges two points, unless an edge would become longer than `longest`, or an angle smaller than `leastNew` and than any.
bool Remeshing::collapseEdge(std::int32_t a, std::int32_t b, double longest, double leastNew)
{
  Vector3d place;
  if (!this->collapsePlace(a, b, place) || !this->Mesh.isCollapsible(a, b) ||
      !this->allowsCollapse(a, b, place, longest, leastNew))
  {
    return false;
  }
  this->Mesh.collapse(a, b, place);
  this->Length[std::size_t(a)] = std::min(this->Length[std::size_t(a)], this->Length[std::size_t(b)]);
  return true;
}

/// Finds the place of the point that replaces two; false if they cannot be merged without changing an outline.
bool Remeshing::collapsePlace(std::int32_t a, std::int32_t b, Vector3d& place) const
{
  const std::uint8_t facesA = this->Mesh.facesOf(a);
  const std::uint8_t facesB = this->Mesh.facesOf(b);
  const std::size_t outlinesA = this->outlinesAt(a).size();
  const std::size_t outlinesB = this->outlinesAt(b).size();
  if (outlinesA > 0 && outlinesB > 0 && !this->isOutline(a, b))
  {
    return false;
  }
  const auto both = static_cast<std::uint8_t>(facesA & facesB);
  if (facesA == facesB && outlinesA == outlinesB && outlinesA <= 2)
  {
    const Vector3d middle = 0.5 * (this->at(a) + this->at(b));
    const bool isInCap = facesA != 0 && outlinesA == 0;
    place = isInCap ? middle : this->onLevel(middle, facesA, 0.3 * (this->at(a) - this->at(b)).norm());
    return true;
  }
  // The one with more constraints stays.
  if (both == facesB && outlinesA >= outlinesB && outlinesB <= 2)
  {
    place = this->at(a);
    return true;
  }
  if (both == facesA && outlinesB >= outlinesA && outlinesA <= 2)
  {
    place = this->at(b);
    return true;
  }
  return false;
}

bool Remeshing::allowsCollapse(std::int32_t a, std::int32_t b, const Vector3d& place, double longest, double leastNew) const
{
  const auto faces = static_cast<std::uint8_t>(this->Mesh.facesOf(a) | this->Mesh.facesOf(b));
  double worstBefore = pi;
  double worst = pi;
  const bool isBad = this->Mesh.visitCornersAt(a, b,
    [&](std::int32_t c, std::int32_t)
    {
      const Corners& corners = this->Mesh.cornersOf(std::size_t(c) / 3);
      worstBefore = std::min(worstBefore, smallestAngleOf(this->at(corners[0]), this->at(corners[1]), this->at(corners[2])));
      const auto edge = this->Mesh.oppositeEdge(c);
      if (!EditableSurface::outlivesCollapse(edge, a, b))
      {
        return false;
      }
      const Vector3d& p = this->at(edge[0]);
      const Vector3d& q = this->at(edge[1]);
      const Vector3d before = (q - p).cross(this->at(corners[std::size_t(c) % 3]) - p);
      const Vector3d after = (q - p).cross(place - p);
      const auto cap = unsigned(faces & this->Mesh.facesOf(edge[0]) & this->Mesh.facesOf(edge[1]));
      worst = std::min(worst, smallestAngleOf(place, p, q));
      const bool isTooFar = cap == 0 && (this->errorAround(place, p) > this->Error && (place - p).norm() > 0.5 * longest);
      return cap != this->capOf(corners) || after.dot(before) < leastKeptTurn * after.norm() * before.norm() ||
             (place - p).norm() > longest || isTooFar;
    });
  return !isBad && (worst >= leastNew || worst > worstBefore);
}

void Remeshing::flipEdges()
{
  for (int sweep = 0; sweep < 3; ++sweep)
  {
    bool any = false;
    for (std::size_t t = 0; t < this->Mesh.triangleCount(); ++t)
    {
      for (std::size_t i = 0; i < 3 && !this->Mesh.isDead(t); ++i)
      {
        any = this->flipEdge(t, i) || any;
      }
    }
    if (!any)
    {
      return;
    }
  }
}

/// Flips an edge of a triangle if that increases the smallest angle of the two triangles at it.
bool Remeshing::flipEdge(std::size_t triangle, std::size_t place)
{
  const Corners corners = this->Mesh.cornersOf(triangle);
  const std::int32_t a = corners[place];
  const std::int32_t b = corners[(place + 1) % 3];
  const std::int32_t c = corners[(place + 2) % 3];
  const std::size_t other = this->Mesh.triangleAlong(b, a);
  const std::int32_t d = this->Mesh.thirdCorner(other, a, b);
  const unsigned cap = this->capOf(corners);
  if (cap != this->capOf(this->Mesh.cornersOf(other)) || this->capOf({ { a, d, c } }) != cap ||
      this->capOf({ { d, b, c } }) != cap)
  {
    return false;
  }
  const Vector3d& pa = this->at(a);
  const Vector3d& pb = this->at(b);
  const Vector3d& pc = this->at(c);
  const Vector3d& pd = this->at(d);
  const double before = std::min(smallestAngleOf(pa, pb, pc), smallestAngleOf(pb, pa, pd));
  const double after = std::min(smallestAngleOf(pa, pd, pc), smallestAngleOf(pd, pb, pc));
  if (after <= before + 1e-6)
  {
    return false;
  }
  const Vector3d normal = (pb - pa).cross(pc - pa) + (pa - pb).cross(pd - pb);
  const Vector3d first = (pd - pa).cross(pc - pa);
  const Vector3d second = (pb - pd).cross(pc - pd);
  const double turn = leastKeptTurn * normal.norm();
  if (first.dot(normal) <= turn * first.norm() || second.dot(normal) <= turn * second.norm() ||
      (cap == 0 && this->errorAround(pc, pd) > std::max(this->Error, this->errorAround(pa, pb))) || this->Mesh.areLinked(c, d))
  {
    return false;
  }
  this->Mesh.flip(triangle, other, a, b);
  return true;
}

/// Moves points along the surface into the middle of their neighbours.
void Remeshing::relax()
{
  for (int sweep = 0; sweep < 2; ++sweep)
  {
    for (std::size_t p = 0; p < this->Mesh.pointCount(); ++p)
    {
      const auto point = static_cast<std::int32_t>(p);
      if (!this->Mesh.isDeadPoint(point))
      {
        const Vector3d place = this->relaxedPlace(point);
        if (!this->moveIfBetter(point, place, goodAngle))
        {
          this->moveIfBetter(point, 0.5 * (place + this->at(point)), goodAngle);
        }
      }
    }
  }
}

Vector3d Remeshing::relaxedPlace(std::int32_t point) const
{
  Vector3d here = this->at(point);
  const std::uint8_t faces = this->Mesh.facesOf(point);
  const std::vector<std::int32_t> outlines = this->outlinesAt(point);
  const double reach = 0.3 * this->Length[std::size_t(point)];
  if (!outlines.empty())
  {
    const bool isSmooth =
      outlines.size() == 2 && this->Mesh.facesOf(outlines[0]) == faces && this->Mesh.facesOf(outlines[1]) == faces;
    return isSmooth ? this->onLevel(0.5 * here + 0.25 * (this->at(outlines[0]) + this->at(outlines[1])), faces, reach) : here;
  }
  Vector3d sum = Vector3d::Zero();
  Vector3d normal = Vector3d::Zero();
  double weights = 0.0;
  for (std::int32_t c = this->Mesh.firstCorner(point); c >= 0; c = this->Mesh.nextCorner(c))
  {
    const auto edge = this->Mesh.oppositeEdge(c);
    const Vector3d& p = this->at(edge[0]);
    const Vector3d& q = this->at(edge[1]);
    const Vector3d area = (p - here).cross(q - here);
    const double length = (this->Length[std::size_t(point)] + 2.0 * this->lengthAt(edge[0], edge[1])) / 3.0;
    const double weight = area.norm() / (length * length * length * length);
    sum += weight * (here + p + q) / 3.0;
    weights += weight;
    normal += area;
  }
  if (!(weights > 0.0) || !(normal.norm() > 0.0))
  {
    return here;
  }
  normal.normalize();
  const Vector3d move = sum / weights - here;
  Vector3d place = here + move - normal.dot(move) * normal;
  if (faces != 0)
  {
    return place;
  }
  return this->onLevel(keptInside(this->Box, here, place, 2.0 * this->Error), 0, reach);
}

/// Moves a point, unless that turns a triangle over, or reduces the smallest angle there below both its old value and `enough`
/// (radians).
bool Remeshing::moveIfBetter(std::int32_t point, const Vector3d& wanted, double enough)
{
  // Points on a face stay there, even if their cap is gone.
  Vector3d place = wanted;
  for (int bit = 0; bit < 6; ++bit)
  {
    if ((this->Mesh.facesOf(point) >> bit & 1) != 0)
    {
      place[bit / 2] = this->at(point)[bit / 2];
    }
  }
  bool wasTurned = false;
  bool isTurned = false;
  const double before = this->worstAngleAt(point, this->at(point), wasTurned);
  const double after = this->worstAngleAt(point, place, isTurned);
  if (isTurned || (after < enough && after <= before))
  {
    return false;
  }
  this->Mesh.move(point, place);
  return true;
}

double Remeshing::worstAngleAt(std::int32_t point, const Vector3d& place, bool& isTurned) const
{
  double worst = pi;
  isTurned = false;
  for (std::int32_t c = this->Mesh.firstCorner(point); c >= 0; c = this->Mesh.nextCorner(c))
  {
    const auto edge = this->Mesh.oppositeEdge(c);
    const Vector3d& p = this->at(edge[0]);
    const Vector3d& q = this->at(edge[1]);
    const Vector3d before = (q - p).cross(this->at(point) - p);
    const Vector3d after = (q - p).cross(place - p);
    isTurned = isTurned || after.dot(before) < leastKeptTurn * after.norm() * before.norm();
    worst = std::min(worst, smallestAngleOf(place, p, q));
  }
  return worst;
}

/// Tries to repair each triangle with too small an angle. Returns whether there was any.
bool Remeshing::finishAngles()
{
  const double wanted = this->Options.smallestAngle * pi / 180.0;
  bool any = false;
  for (std::size_t t = 0; t < this->Mesh.triangleCount(); ++t)
  {
    if (!this->Mesh.isDead(t))
    {
      const Corners& corners = this->Mesh.cornersOf(t);
      if (smallestAngleOf(this->at(corners[0]), this->at(corners[1]), this->at(corners[2])) < 1.1 * wanted)
      {
        any = true;
        this->finishTriangle(t);
      }
    }
  }
  return any;
}

bool Remeshing::finishTriangle(std::size_t triangle)
{
  const Corners corners = this->Mesh.cornersOf(triangle);
  std::array<std::size_t, 3> byLength{ { 0, 1, 2 } };
  const auto length = [&](std::size_t i) { return (this->at(corners[(i + 1) % 3]) - this->at(corners[i])).norm(); };
  std::sort(byLength.begin(), byLength.end(), [&](std::size_t i, std::size_t j) { return length(i) < length(j); });
  if (this->flipEdge(triangle, byLength[2]))
  {
    return true;
  }
  for (const std::int32_t corner : corners)
  {
    if (this->searchBetterPlace(corner))
    {
      return true;
    }
  }
  const std::size_t s = byLength[0];
  const double longest = 2.0 * this->lengthAt(corners[s], corners[(s + 1) % 3]);
  return this->collapseEdge(corners[s], corners[(s + 1) % 3], longest, 1.1 * this->Options.smallestAngle * pi / 180.0);
}

/// Moves a point a little in the direction along the surface that makes the smallest angle there largest.
bool Remeshing::searchBetterPlace(std::int32_t point)
{
  const std::uint8_t faces = this->Mesh.facesOf(point);
  const std::vector<std::int32_t> outlines = this->outlinesAt(point);
  if (outlines.size() > 2 || (!outlines.empty() && (faces & (faces - 1)) != 0))
  {
    return false;
  }
  const Vector3d here = this->at(point);
  std::vector<Vector3d> directions;
  for (std::int32_t c = this->Mesh.firstCorner(point); c >= 0; c = this->Mesh.nextCorner(c))
  {
    const std::int32_t next = this->Mesh.oppositeEdge(c)[0];
    if (outlines.empty() || this->isOutline(point, next))
    {
      directions.push_back((this->at(next) - here).normalized());
      directions.push_back(-directions.back());
    }
  }
  bool isMoved = false;
  for (const double part : { 0.2, 0.1, 0.05 })
  {
    const double reach = part * this->Length[std::size_t(point)];
    for (const Vector3d& direction : directions)
    {
      Vector3d place = this->at(point) + reach * direction;
      const bool isInCap = faces != 0 && outlines.empty();
      place = isInCap ? place : this->onLevel(keptInside(this->Box, here, place, 2.0 * this->Error), faces, reach);
      isMoved = this->moveIfBetter(point, place, pi) || isMoved;
    }
  }
  return isMoved;
}

} // namespace

void remesh(CappedSurface& surface, const SurfaceRemeshingOptions& options)
{
  Remeshing(surface, options).run();
}

} // namespace cactus
