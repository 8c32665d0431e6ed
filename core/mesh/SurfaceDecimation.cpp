// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SurfaceDecimation.h"

#include "mesh/CollapseCandidates.h"
#include "mesh/EditableSurface.h"
#include "mesh/FieldBounds.h"
#include "mesh/ShapeBounds.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace cactus
{

namespace
{

using Eigen::Vector3d;

/// Least cosine between the normals of the two triangles that a flip makes and the mean of those that it replaces.
constexpr double leastFlipTurn = 0.5;
/// Quadrics are a mean of distances to the planes of triangles at an edge: up to this multiple of the largest error, the field
/// decides.
constexpr double quadricPart = 1.8;
/// Errors of the earlier sweeps, as fractions of that of the last ones.
constexpr double sweepErrors[] = { 0.28, 0.56 };
/// Collapses below this fraction of the largest error are made without evaluating the field, if no edge is longer than the second
/// fraction of the sampling distance.
constexpr double unnoticed = 0.15;
constexpr double smallPart = 0.5;
/// An edge is flipped if that reduces the largest distance of the field from its level to this fraction, unless it is already
/// below the second fraction of the largest error.
constexpr double flipGain = 0.95;
constexpr double flipNeed = 0.2;
constexpr int sweepsPerError = 10;
/// Each stretch of the surface, at least this multiple of the sampling distance, gets all its sweeps before the next one, so that
/// its data, above all the field, stay in the processor's cache.
constexpr double stretchLength = 16.0;
/// An edge is not tried again in the sweeps of an error if its squared error was this multiple of the limit, or if the field
/// would be out of its range by the second fraction of the largest error: changes around it hardly matter then.
constexpr double farError = 1.5;
constexpr double farExcess = 0.2;
constexpr int repairRounds = 4;

class Decimation
{
public:
  Decimation(CappedSurface& surface, const SurfaceDecimationOptions& options)
    : Mesh(surface)
    , Options(options)
    , Box(surface.box)
    , Reach(quadricPart * options.maximumError)
    , Shapes(Mesh, options.largestSquaredEdgeRatio, Reach)
    , Fits(Mesh, options.field, options.level, options.maximumError, options.sampling)
    , Locked(Mesh.pointCount(), 0)
    , Changed(Mesh.pointCount(), 0)
    , Part(Mesh.pointCount(), 1.0f)
    , PointExcess(Mesh.pointCount(), unknown)
    , Excesses(Mesh.triangleCount())
    , IsKnown(Mesh.triangleCount(), 0)
    , IsKept(Mesh.triangleCount(), 0)
    , Refusals(3 * Mesh.triangleCount())
  {
    for (const LocalErrorBound& bound : options.localBounds)
    {
      for (std::size_t p = 0; p < Mesh.pointCount(); ++p)
      {
        if ((Mesh.at(std::int32_t(p)) - bound.centre).squaredNorm() < bound.radius * bound.radius)
        {
          Part[p] *= static_cast<float>(bound.part);
        }
      }
    }
  }

  void run()
  {
    for (std::vector<std::size_t>& stretch : this->stretches())
    {
      for (const double part : sweepErrors)
      {
        this->sweeps(stretch, part * this->Reach);
      }
      this->flipEdges(stretch);
      this->sweeps(stretch, this->Reach);
    }
    this->repairShapes();
    this->Mesh.compact();
  }

private:
  enum class Verdict
  {
    Worse,
    NoWorse, ///< than before, or not evaluated
    Kept     ///< the field is in its range
  };

  static constexpr float unknown = -1.0f;

  /// The last refusal to collapse an edge.
  struct Refusal
  {
    double limit = 0.0; ///< up to which it was not collapsed
    int sweep = -1;     ///< the sweep of the refusal
    int farRound = -1;  ///< the round in which it was far from being collapsed
  };
  /// The limit up to which an edge stays while no triangle at its ends changes, and whether it was far from being collapsed.
  struct Outcome
  {
    double limit;
    bool isFar = false;
  };

  /// Returns the triangles by position along the surface's longest axis.
  std::vector<std::vector<std::size_t>> stretches() const
  {
    Eigen::AlignedBox3d around;
    for (std::size_t p = 0; p < this->Mesh.pointCount(); ++p)
    {
      around.extend(this->Mesh.at(std::int32_t(p)));
    }
    Eigen::Index axis = 0;
    const double length = around.isEmpty() ? 0.0 : around.sizes().maxCoeff(&axis);
    const double count = std::max(1.0, std::floor(length / (stretchLength * this->Options.sampling)));
    std::vector<std::vector<std::size_t>> found(static_cast<std::size_t>(count));
    for (std::size_t t = 0; t < this->Mesh.triangleCount(); ++t)
    {
      const double along = this->Mesh.at(this->Mesh.cornersOf(t)[0])[axis] - around.min()[axis];
      found[static_cast<std::size_t>(std::min(count - 1.0, count * along / length))].push_back(t);
    }
    return found;
  }

  /// Sweeps until one removes little.
  void sweeps(std::vector<std::size_t>& stretch, double error)
  {
    ++this->Round;
    for (int sweep = 0; sweep < sweepsPerError; ++sweep)
    {
      const std::size_t removed = this->sweep(stretch, error * error, sweep == 0);
      stretch.erase(
        std::remove_if(stretch.begin(), stretch.end(), [this](std::size_t t) { return this->Mesh.isDead(t); }), stretch.end());
      if (removed * 10 < stretch.size())
      {
        return;
      }
    }
  }

  /// Tries every edge once (`all`), or only those near which something has changed since they were tried. Returns the number of
  /// triangles removed.
  std::size_t sweep(const std::vector<std::size_t>& stretch, double limit, bool all)
  {
    const std::size_t before = this->Mesh.aliveCount();
    ++this->Sweep;
    for (const std::size_t t : stretch)
    {
      for (std::size_t i = 0; i < 3 && !this->Mesh.isDead(t); ++i)
      {
        const std::int32_t u = this->Mesh.cornersOf(t)[i];
        const std::int32_t v = this->Mesh.cornersOf(t)[(i + 1) % 3];
        // Each edge from one of its two sides; a point moves once in a sweep, so that cheap collapses spread evenly.
        const bool isNew = all || std::max(this->Changed[std::size_t(u)], this->Changed[std::size_t(v)]) + 1 >= this->Sweep;
        if (u < v && isNew && this->Locked[std::size_t(u)] != this->Sweep && this->Locked[std::size_t(v)] != this->Sweep)
        {
          const double part = this->partOf(u, v);
          Refusal& refusal = this->Refusals[3 * t + i];
          const bool isAsBefore = std::max(this->Changed[std::size_t(u)], this->Changed[std::size_t(v)]) < refusal.sweep;
          if (refusal.farRound != this->Round && (!isAsBefore || refusal.limit <= part * part * limit))
          {
            const Outcome outcome = this->tryCollapse(u, v, part * part * limit);
            refusal = { outcome.limit, this->Sweep, outcome.isFar ? this->Round : -1 };
          }
        }
      }
    }
    return before - this->Mesh.aliveCount();
  }

  /// Improves triangles with a bad initial shape: the shortest edge of needles is removed, the longest edge of flat ones is
  /// flipped.
  void repairShapes()
  {
    for (int round = 0; round < repairRounds; ++round)
    {
      ++this->Sweep;
      bool any = false;
      for (std::size_t t = 0; t < this->Mesh.triangleCount(); ++t)
      {
        any = (!this->Mesh.isDead(t) && this->repairShape(t)) || any;
      }
      if (!any)
      {
        return;
      }
    }
  }

  bool repairShape(std::size_t triangle)
  {
    const auto corners = this->Mesh.cornersOf(triangle);
    std::array<double, 3> length;
    for (std::size_t i = 0; i < 3; ++i)
    {
      length[i] = (this->Mesh.at(corners[(i + 1) % 3]) - this->Mesh.at(corners[i])).squaredNorm();
    }
    const auto shortest = std::size_t(std::min_element(length.begin(), length.end()) - length.begin());
    const auto longest = std::size_t(std::max_element(length.begin(), length.end()) - length.begin());
    if (length[longest] > this->Options.largestSquaredEdgeRatio * length[shortest])
    {
      return this->removeNeedle(triangle, corners[shortest], corners[(shortest + 1) % 3]);
    }
    return this->Shapes.shapeOf(corners).flatness < flattestTriangle &&
           this->tryFlip(triangle, corners[longest], corners[(longest + 1) % 3], corners[(longest + 2) % 3], Flip::OfFlat);
  }

  /// Removes the edge u v of a triangle at any cost within twice the error. Returns whether the triangle is gone.
  bool removeNeedle(std::size_t triangle, std::int32_t u, std::int32_t v)
  {
    const double part = this->partOf(u, v);
    const double limit = 4.0 * part * part * this->Reach * this->Reach;
    this->removeBetween(u, v, limit);
    if (!this->Mesh.isDead(triangle) && !this->Mesh.isDeadPoint(u) && !this->Mesh.isDeadPoint(v))
    {
      this->tryCollapse(std::min(u, v), std::max(u, v), limit, true);
    }
    return this->Mesh.isDead(triangle);
  }

  /// Returns the allowed fraction of the largest error at an edge.
  double partOf(std::int32_t u, std::int32_t v) const { return std::min(this->Part[std::size_t(u)], this->Part[std::size_t(v)]); }

  /// Removes points next to both u and v that have only three neighbours: they prevent the merging of u and v.
  void removeBetween(std::int32_t u, std::int32_t v, double limit)
  {
    for (std::int32_t c = this->Mesh.firstCorner(u); c >= 0;)
    {
      const auto corners = this->Mesh.cornersOf(std::size_t(c) / 3);
      c = this->Mesh.nextCorner(c);
      for (const std::int32_t w : corners)
      {
        if (w != u && w != v && this->Mesh.valence(w) == 3 && this->Mesh.areLinked(w, v))
        {
          this->tryCollapse(std::min(u, w), std::max(u, w), limit, true);
          if (this->Mesh.isDeadPoint(u) || this->Mesh.isDeadPoint(w))
          {
            return; // the next corner to visit may be gone
          }
        }
      }
    }
  }

  /// Collapses an edge if the surface keeps its topology, the shape of its triangles and its distance from the level of the
  /// field. `thorough` tries all candidate places, and allows flat triangles.
  Outcome tryCollapse(std::int32_t u, std::int32_t v, double limit, bool thorough = false)
  {
    constexpr double any = std::numeric_limits<double>::infinity();
    CollapseCandidates candidates = collapseCandidates(this->Mesh, u, v, this->Box, this->Reach);
    const bool isInside = this->Mesh.facesOf(u) == 0 && this->Mesh.facesOf(v) == 0;
    double excess = 0.0;
    for (std::size_t tried = 0; tried < candidates.count; ++tried)
    {
      const std::size_t p = candidates.cheapest();
      const double error = candidates.errors[p];
      Vector3d& place = candidates.places[p];
      if (error > limit)
      {
        return { error, error > farError * limit };
      }
      if (tried == 0 && !this->Mesh.isCollapsible(u, v))
      {
        return { any };
      }
      if (this->Shapes.allowCollapse(u, v, place, thorough))
      {
        const double noticed = unnoticed * this->Options.maximumError;
        const bool isUnnoticed = error <= noticed * noticed && !thorough && this->isSmallAround(u, v);
        const Verdict verdict = isUnnoticed ? Verdict::NoWorse : this->keepsField(u, v, place, isInside && !thorough, excess);
        if (verdict != Verdict::Worse)
        {
          this->collapse(u, v, place, verdict == Verdict::Kept);
          return { 0.0 };
        }
      }
      if (isInside && !thorough)
      {
        break; // the other places are hardly better
      }
      candidates.errors[p] = any;
    }
    return { any, excess > farExcess * this->Options.maximumError };
  }

  /// Tells whether the triangles at u and v are so small that their planes determine the effect of a collapse.
  bool isSmallAround(std::int32_t u, std::int32_t v) const
  {
    const double longest = smallPart * this->Options.sampling;
    return !this->Mesh.visitCornersAt(u, v,
      [&](std::int32_t c, std::int32_t point)
      { return (this->Mesh.at(this->Mesh.oppositeEdge(c)[0]) - this->Mesh.at(point)).squaredNorm() > longest * longest; });
  }

  /// Tells whether the new triangles keep the field in its range, or exceed it no more than the old ones do. With `mayMove`,
  /// `place` is moved outwards or inwards if that brings the field into its range. `excess` (µm) is a lower bound of the field's
  /// excess at the original `place`.
  Verdict keepsField(std::int32_t u, std::int32_t v, Vector3d& place, bool mayMove, double& excess)
  {
    const bool mustFit = this->areKept(u, v);
    const FieldFit after = this->Fits.fitAfterCollapse(u, v, place,
      [&](const FieldFit& fit) { return fit.isOut() && !(mayMove && fit.canBeMoved()) && (mustFit || this->areFine(u, v)); });
    excess = after.excess;
    if (!after.isOut())
    {
      return this->Fits.holdAfterCollapse(u, v, place) ? Verdict::Kept : Verdict::Worse;
    }
    if (mayMove && after.canBeMoved())
    {
      const double least = std::clamp(0.0, after.lower, after.upper);
      const double middle = 0.5 * (after.lower + after.upper);
      const Vector3d outward = this->Shapes.normalAround(u, v).normalized();
      const Vector3d moved = keptInside(this->Box, place, place + 0.5 * (least + middle) * outward, this->Reach);
      if (this->Shapes.allowCollapse(u, v, moved, false) &&
          !this->Fits.fitAfterCollapse(u, v, moved, [](const FieldFit& fit) { return fit.isOut(); }).isOut())
      {
        place = moved;
        return this->Fits.holdAfterCollapse(u, v, moved) ? Verdict::Kept : Verdict::Worse;
      }
    }
    if (mustFit || this->areFine(u, v))
    {
      return Verdict::Worse;
    }
    return static_cast<float>(after.excess) <= this->excessAround(u, v) ? Verdict::NoWorse : Verdict::Worse;
  }

  /// Tells whether all triangles at u and v were made by collapses that keep the field in its range.
  bool areKept(std::int32_t u, std::int32_t v) const
  {
    return !this->Mesh.visitCornersAt(u, v, [&](std::int32_t c, std::int32_t) { return this->IsKept[std::size_t(c) / 3] == 0; });
  }

  /// Tells whether the field is in its range at the present triangles at u and v.
  bool areFine(std::int32_t u, std::int32_t v)
  {
    return !this->Mesh.visitCornersAt(u, v,
      [&](std::int32_t c, std::int32_t)
      {
        const TriangleExcess& excess = this->excessOf(std::size_t(c) / 3);
        const auto& corners = this->Mesh.cornersOf(std::size_t(c) / 3);
        return excess.inCentroid > 0.0f || std::max({ excess.inMiddles[0], excess.inMiddles[1], excess.inMiddles[2] }) > 0.0f ||
               std::max({ this->excessAt(corners[0]), this->excessAt(corners[1]), this->excessAt(corners[2]) }) > 0.0f;
      });
  }

  /// Returns the excess of the field over its range at u and v and at the middles of edges and the centroids of the triangles at
  /// them.
  float excessAround(std::int32_t u, std::int32_t v)
  {
    float largest = std::max(this->excessAt(u), this->excessAt(v));
    this->Mesh.visitCornersAt(u, v,
      [&](std::int32_t c, std::int32_t)
      {
        const TriangleExcess& excess = this->excessOf(std::size_t(c) / 3);
        largest = std::max({ largest, excess.inMiddles[std::size_t(c) % 3], excess.inCentroid });
        return false;
      });
    return largest;
  }

  // Each place is evaluated once.
  float excessAt(std::int32_t point)
  {
    float& excess = this->PointExcess[std::size_t(point)];
    if (excess == unknown)
    {
      excess = static_cast<float>(this->Fits.excessAt(this->Mesh.at(point), this->Mesh.facesOf(point)));
    }
    return excess;
  }
  const TriangleExcess& excessOf(std::size_t triangle)
  {
    if (this->IsKnown[triangle] == 0)
    {
      this->Excesses[triangle] = this->Fits.excessOf(this->Mesh.cornersOf(triangle));
      this->IsKnown[triangle] = 1;
    }
    return this->Excesses[triangle];
  }

  void collapse(std::int32_t u, std::int32_t v, const Vector3d& place, bool isKept)
  {
    this->Mesh.collapse(u, v, place);
    this->Part[std::size_t(u)] = std::min(this->Part[std::size_t(u)], this->Part[std::size_t(v)]);
    this->Locked[std::size_t(u)] = this->Sweep;
    this->PointExcess[std::size_t(u)] = unknown;
    for (std::int32_t c = this->Mesh.firstCorner(u); c >= 0; c = this->Mesh.nextCorner(c))
    {
      this->IsKept[std::size_t(c) / 3] = isKept ? 1 : 0;
      this->IsKnown[std::size_t(c) / 3] = 0;
      this->markChanged(std::size_t(c) / 3);
    }
  }

  void markChanged(std::size_t triangle)
  {
    for (const std::int32_t corner : this->Mesh.cornersOf(triangle))
    {
      this->Changed[std::size_t(corner)] = this->Sweep;
    }
  }

  /// Flips edges, away from caps and from places with local bounds, so that the surface comes nearer to the field's level.
  void flipEdges(const std::vector<std::size_t>& stretch)
  {
    for (const std::size_t t : stretch)
    {
      for (std::size_t i = 0; i < 3 && !this->Mesh.isDead(t); ++i)
      {
        const std::int32_t a = this->Mesh.cornersOf(t)[i];
        const std::int32_t b = this->Mesh.cornersOf(t)[(i + 1) % 3];
        if (a < b && this->tryFlip(t, a, b, this->Mesh.cornersOf(t)[(i + 2) % 3], Flip::ToFit))
        {
          break;
        }
      }
    }
  }

  enum class Flip
  {
    ToFit, ///< brings the surface nearer to the level
    OfFlat ///< removes a flat triangle while the surface keeps its distance
  };

  /// Flips the edge a b of triangle `one`, whose third corner is c, if that serves its purpose.
  bool tryFlip(std::size_t one, std::int32_t a, std::int32_t b, std::int32_t c, Flip kind)
  {
    const std::size_t other = this->Mesh.triangleAlong(b, a);
    const std::int32_t d = this->Mesh.thirdCorner(other, a, b);
    const float part = std::min(
      { this->Part[std::size_t(a)], this->Part[std::size_t(b)], this->Part[std::size_t(c)], this->Part[std::size_t(d)] });
    const bool isAtFace =
      (this->Mesh.facesOf(a) & this->Mesh.facesOf(b)) != 0 || (this->Mesh.facesOf(c) & this->Mesh.facesOf(d)) != 0;
    if (part < 1.0f || isAtFace)
    {
      return false;
    }
    const Vector3d& pa = this->Mesh.at(a);
    const Vector3d& pb = this->Mesh.at(b);
    const Vector3d& pc = this->Mesh.at(c);
    const Vector3d& pd = this->Mesh.at(d);
    const double before = this->Fits.largestError(pa, pb, pc, pd, std::numeric_limits<double>::infinity());
    if (before < flipNeed * this->Options.maximumError && kind == Flip::ToFit)
    {
      return false;
    }
    const double flattest = kind == Flip::ToFit
                              ? flattestTriangle
                              : std::min(flattestTriangle, 2.0 * this->Shapes.shapeOf(this->Mesh.cornersOf(one)).flatness);
    if (!this->flipKeepsShape(pa, pb, pc, pd, flattest))
    {
      return false;
    }
    const double furthest = kind == Flip::ToFit ? flipGain * before : std::max(before, this->Options.maximumError);
    if (this->Mesh.areLinked(c, d) || this->Fits.largestError(pc, pd, pa, pb, furthest) > furthest ||
        !this->Fits.holdAlong(pc, pd, 0) || !this->Fits.holdWithin({ { pa, pd, pc } }, 0) ||
        !this->Fits.holdWithin({ { pd, pb, pc } }, 0))
    {
      return false;
    }
    this->Mesh.flip(one, other, a, b);
    this->IsKept[one] = this->IsKept[other] = this->IsKept[one] & this->IsKept[other];
    this->IsKnown[one] = this->IsKnown[other] = 0;
    this->markChanged(one);
    this->markChanged(other);
    return true;
  }

  /// Tells whether the triangles a d c and d b c, in place of a b c and b a d, are not turned over, no needles, and no flatter
  /// than `flattest`.
  bool flipKeepsShape(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d, double flattest) const
  {
    const Vector3d normal = (b - a).cross(c - a) + (a - b).cross(d - b);
    const Vector3d first = (d - a).cross(c - a);
    const Vector3d second = (b - d).cross(c - d);
    const double turn = leastFlipTurn * normal.norm();
    const TriangleShape shapes[2] = { shapeOf(a, d, c), shapeOf(d, b, c) };
    return first.dot(normal) > turn * first.norm() && second.dot(normal) > turn * second.norm() &&
           this->Shapes.allow(shapes[0]) && this->Shapes.allow(shapes[1]) &&
           std::min(shapes[0].flatness, shapes[1].flatness) >= flattest;
  }

  EditableSurface Mesh;
  const SurfaceDecimationOptions& Options;
  Eigen::AlignedBox3d Box;
  double Reach; ///< µm, largest error of a quadric
  ShapeBounds Shapes;
  FieldBounds Fits;
  std::vector<int> Locked;              ///< per point, the sweep in which it was moved
  std::vector<int> Changed;             ///< per point, the sweep in which a triangle at it changed
  std::vector<float> Part;              ///< per point, fraction of the largest error
  std::vector<float> PointExcess;       ///< per point, excess of the field over its range, µm, or unknown
  std::vector<TriangleExcess> Excesses; ///< per triangle
  std::vector<std::uint8_t> IsKnown;    ///< per triangle, whether its excess is that of the present triangle
  std::vector<std::uint8_t> IsKept;     ///< per triangle, whether it was made by a collapse that keeps the field in its range
  std::vector<Refusal> Refusals;        ///< per corner, for the edge from it
  int Sweep = 0;
  int Round = 0; ///< of sweeps of one error
};

} // namespace

void decimate(CappedSurface& surface, const SurfaceDecimationOptions& options)
{
  if (options.maximumError > 0.0)
  {
    Decimation(surface, options).run();
  }
}

} // namespace cactus
