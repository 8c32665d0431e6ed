// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SurfaceDecimation.h"

#include "mesh/EditableSurface.h"

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

/// Sum of squared distances to the planes of triangles, weighted by the squares of their areas, as a function of the place.
struct Quadric
{
  double xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0;
  Vector3d b = Vector3d::Zero();
  double c = 0.0;

  /// The plane through a point; the length of its normal is the weight's root.
  void addPlane(const Vector3d& normal, const Vector3d& point)
  {
    const double offset = -normal.dot(point);
    xx += normal[0] * normal[0];
    xy += normal[0] * normal[1];
    xz += normal[0] * normal[2];
    yy += normal[1] * normal[1];
    yz += normal[1] * normal[2];
    zz += normal[2] * normal[2];
    b += offset * normal;
    c += offset * offset;
  }

  Vector3d times(const Vector3d& p) const
  {
    return { xx * p[0] + xy * p[1] + xz * p[2], xy * p[0] + yy * p[1] + yz * p[2], xz * p[0] + yz * p[1] + zz * p[2] };
  }

  /// Mean squared distance; 0 without planes.
  double error(const Vector3d& p) const
  {
    const double weight = xx + yy + zz;
    return weight > 0.0 ? std::max(0.0, (p.dot(this->times(p)) + 2.0 * b.dot(p) + c) / weight) : 0.0;
  }

  /// The place of least error, drawn towards `middle` in directions that the planes leave open; `middle` where that is farther
  /// than `reach` away.
  Vector3d best(const Vector3d& middle, double reach) const
  {
    const double damping = 1e-5 * (xx + yy + zz);
    const double a = xx + damping;
    const double d = yy + damping;
    const double f = zz + damping;
    // Cramer's rule, with the cofactors of the symmetric matrix.
    const Vector3d g = this->times(middle) + b;
    const double ca = d * f - yz * yz;
    const double cb = xz * yz - xy * f;
    const double cc = xy * yz - d * xz;
    const double cd = a * f - xz * xz;
    const double ce = xy * xz - a * yz;
    const double cf = a * d - xy * xy;
    const double determinant = a * ca + xy * cb + xz * cc;
    const Vector3d step(ca * g[0] + cb * g[1] + cc * g[2], cb * g[0] + cd * g[1] + ce * g[2], cc * g[0] + ce * g[1] + cf * g[2]);
    return step.squaredNorm() <= reach * reach * determinant * determinant ? middle - step / determinant : middle;
  }
};

/// How well formed a triangle is: longest over shortest squared edge, and twice the area over the longest squared edge.
struct Shape
{
  double edgeRatio;
  double flatness;
};

Shape shapeOf(const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
  const double edges[3] = { (b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm() };
  const double longest = std::max({ edges[0], edges[1], edges[2] });
  const double shortest = std::min({ edges[0], edges[1], edges[2] });
  return { shortest > 0.0 ? longest / shortest : std::numeric_limits<double>::infinity(),
    longest > 0.0 ? (b - a).cross(c - a).norm() / longest : 0.0 };
}

/// Heights below this part of the longest edge are not made.
constexpr double flattestTriangle = 0.015;
/// Least cosine between a triangle's normals before and after a collapse, and between those of two triangles and their mean that
/// take the place of two others.
constexpr double leastTurn = 0.3;
constexpr double leastFlipTurn = 0.5;
/// Quadrics tell a mean of distances to the planes of triangles at an edge: up to so many times the largest error, the field
/// decides.
constexpr double quadricPart = 2.0;
/// Errors of the sweeps before the last ones, as parts of that of the last ones.
constexpr double sweepErrors[] = { 0.25, 0.5 };
/// Collapses of less than this part of the largest error are made without a look at the field.
constexpr double unnoticed = 0.15;
/// How often edges are flipped, after which come sweeps of the largest error.
constexpr int flipRounds = 2;
/// An edge is flipped where that lessens the largest distance of the field from the middle of its range by a twentieth, and
/// nowhere where this is small anyway.
constexpr double flipGain = 0.95;
constexpr double flipNeed = 0.2;
constexpr int sweepsPerError = 10;

class Decimation
{
public:
  Decimation(CappedSurface& surface, const SurfaceDecimationOptions& options)
    : Mesh(surface)
    , Options(options)
    , Box(surface.box)
    , Smallest(options.level - options.maximumError)
    , Largest(options.level + options.maximumError)
    , Reach(quadricPart * options.maximumError)
    , Locked(Mesh.pointCount(), 0)
    , Changed(Mesh.pointCount(), 0)
    , Part(Mesh.pointCount(), 1.0f)
    , Known(Mesh.triangleCount(), 0)
  {
    for (const CalmPlace& place : options.calm)
    {
      for (std::size_t p = 0; p < Mesh.pointCount(); ++p)
      {
        if ((Mesh.at(std::int32_t(p)) - place.centre).squaredNorm() < place.radius * place.radius)
        {
          Part[p] *= static_cast<float>(place.part);
        }
      }
    }
  }

  void run()
  {
    for (const double part : sweepErrors)
    {
      this->sweeps(part * this->Reach);
    }
    for (int round = 0; round < flipRounds; ++round)
    {
      this->flipEdges();
      this->sweeps(this->Reach);
    }
    this->mend();
    this->Mesh.compact();
  }

private:
  enum class Verdict
  {
    Worse,
    NoWorse, ///< than before, or not looked at
    Kept     ///< the field is in its range
  };

  /// What the field says of a point, or of the triangles around one.
  struct Fit
  {
    double excess = 0.0; ///< by how much it is out of its range, 0 or more
    /// How far the point may move outwards so that it comes into its range everywhere, as far as it changes linearly; the
    /// lower one is larger where that is not possible.
    double lower = -std::numeric_limits<double>::infinity();
    double upper = std::numeric_limits<double>::infinity();
  };

  /// Of the triangles at u and v as they are now, from `origin`. That they are not those of the beginning lets a surface of much
  /// fewer triangles keep to the field: what earlier collapses have done to it, the field tells (Lindstrom and Turk 1998).
  Quadric quadricAround(std::int32_t u, std::int32_t v, const Vector3d& origin) const
  {
    Quadric sum;
    for (const std::int32_t self : { u, v })
    {
      for (std::int32_t c = this->Mesh.firstCorner(self); c >= 0; c = this->Mesh.nextCorner(c))
      {
        const auto& corners = this->Mesh.cornersOf(std::size_t(c) / 3);
        const bool isCounted = self == v && (corners[0] == u || corners[1] == u || corners[2] == u);
        // Points of caps stay in their plane anyway; counted in, caps would water down the error of their rims.
        if (!isCounted && !this->Mesh.isCap(corners))
        {
          const Vector3d& a = this->Mesh.at(corners[0]);
          sum.addPlane((this->Mesh.at(corners[1]) - a).cross(this->Mesh.at(corners[2]) - a), a - origin);
        }
      }
    }
    return sum;
  }

  /// Where a point in no face of the box goes.
  Vector3d keptOffFaces(const Vector3d& from, const Vector3d& to) const { return keptInside(this->Box, from, to, this->Reach); }

  /// Sweeps until one removes little.
  void sweeps(double error)
  {
    for (int sweep = 0; sweep < sweepsPerError; ++sweep)
    {
      if (this->sweep(error * error, sweep == 0) * 10 < this->Mesh.aliveCount())
      {
        return;
      }
    }
  }

  /// Tries every edge once or, but for the first sweep of an error, every edge near which something has changed since it was
  /// tried; the number of triangles removed.
  std::size_t sweep(double limit, bool all)
  {
    const std::size_t before = this->Mesh.aliveCount();
    ++this->Sweep;
    for (std::size_t t = 0; t < this->Mesh.triangleCount(); ++t)
    {
      for (std::size_t i = 0; i < 3 && !this->Mesh.isDead(t); ++i)
      {
        const std::int32_t u = this->Mesh.cornersOf(t)[i];
        const std::int32_t v = this->Mesh.cornersOf(t)[(i + 1) % 3];
        // Each edge from one of its two sides; and a point moves once in a sweep, so that cheap collapses spread evenly.
        const bool isNew = all || std::max(this->Changed[std::size_t(u)], this->Changed[std::size_t(v)]) + 1 >= this->Sweep;
        if (u < v && isNew && this->Locked[std::size_t(u)] != this->Sweep && this->Locked[std::size_t(v)] != this->Sweep)
        {
          const double part = std::min(this->Part[std::size_t(u)], this->Part[std::size_t(v)]);
          this->tryCollapse(u, v, part * part * limit);
        }
      }
    }
    return before - this->Mesh.aliveCount();
  }

  /// Mends triangles that came with a bad shape. The shortest edges of those that are too long for their width are removed,
  /// whatever that costs within twice the error; the longest edges of those that are too flat are flipped.
  void mend()
  {
    for (int round = 0; round < 4; ++round)
    {
      ++this->Sweep;
      bool any = false;
      for (std::size_t t = 0; t < this->Mesh.triangleCount(); ++t)
      {
        if (this->Mesh.isDead(t))
        {
          continue;
        }
        const auto corners = this->Mesh.cornersOf(t);
        std::array<double, 3> length;
        for (std::size_t i = 0; i < 3; ++i)
        {
          length[i] = (this->Mesh.at(corners[(i + 1) % 3]) - this->Mesh.at(corners[i])).squaredNorm();
        }
        const auto shortest = std::size_t(std::min_element(length.begin(), length.end()) - length.begin());
        const auto longest = std::size_t(std::max_element(length.begin(), length.end()) - length.begin());
        if (length[longest] > this->Options.largestSquaredEdgeRatio * length[shortest])
        {
          const std::int32_t u = corners[shortest];
          const std::int32_t v = corners[(shortest + 1) % 3];
          const double part = std::min(this->Part[std::size_t(u)], this->Part[std::size_t(v)]);
          const double limit = 4.0 * part * part * this->Reach * this->Reach;
          this->removeBetween(u, v, limit);
          if (!this->Mesh.isDead(t))
          {
            this->tryCollapse(std::min(u, v), std::max(u, v), limit, true);
          }
          any = any || this->Mesh.isDead(t);
        }
        else if (this->shapeOf(corners).flatness < flattestTriangle)
        {
          const std::int32_t a = corners[longest];
          any = this->tryFlip(t, a, corners[(longest + 1) % 3], corners[(longest + 2) % 3], Flip::OfFlat) || any;
        }
      }
      if (!any)
      {
        return;
      }
    }
  }

  /// Removes points next to both u and v that have but three neighbours, with which u and v cannot become one.
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
            return; // what was to be visited next may be gone
          }
        }
      }
    }
  }

  /// Collapses an edge where that keeps the surface what it shall be. `thorough` also tries all places that come into question,
  /// and puts up with flat triangles.
  void tryCollapse(std::int32_t u, std::int32_t v, double limit, bool thorough = false)
  {
    const Vector3d origin = this->Mesh.at(u); // near by, so that no digits are lost
    const Quadric sum = this->quadricAround(u, v, origin);
    const std::uint8_t facesU = this->Mesh.facesOf(u);
    const std::uint8_t facesV = this->Mesh.facesOf(v);
    const std::uint8_t both = facesU & facesV;
    std::array<Vector3d, 3> places;
    std::size_t count = 0;
    if (facesU == facesV)
    {
      const Vector3d middle = 0.5 * (this->Mesh.at(u) + this->Mesh.at(v));
      if (facesU == 0)
      {
        const double reach = (this->Mesh.at(u) - this->Mesh.at(v)).norm();
        places[count++] = this->keptOffFaces(middle, sum.best(middle - origin, reach) + origin);
      }
      else
      {
        places[count++] = middle;
      }
      places[count++] = this->Mesh.at(u);
      places[count++] = this->Mesh.at(v);
    }
    else if (both == facesU)
    {
      places[count++] = this->Mesh.at(v);
    }
    else if (both == facesV)
    {
      places[count++] = this->Mesh.at(u);
    }
    std::array<double, 3> errors;
    for (std::size_t p = 0; p < count; ++p)
    {
      errors[p] = sum.error(places[p] - origin);
    }
    const bool isInside = facesU == 0 && facesV == 0;
    for (std::size_t tried = 0; tried < count; ++tried)
    {
      const std::size_t p =
        std::size_t(std::min_element(errors.begin(), errors.begin() + std::ptrdiff_t(count)) - errors.begin());
      if (errors[p] > limit || (tried == 0 && !this->Mesh.isCollapsible(u, v)))
      {
        return;
      }
      if (this->keepsShape(u, v, places[p], thorough))
      {
        const double noticed = unnoticed * this->Options.maximumError;
        const bool isUnnoticed = errors[p] <= noticed * noticed && !thorough;
        const Verdict verdict = isUnnoticed ? Verdict::NoWorse : this->keepsField(u, v, places[p], isInside && !thorough);
        if (verdict != Verdict::Worse)
        {
          this->collapse(u, v, places[p], verdict == Verdict::Kept);
          return;
        }
      }
      if (isInside && !thorough)
      {
        return; // the other places are little better
      }
      errors[p] = std::numeric_limits<double>::infinity();
    }
  }

  /// Sum of the normals of the triangles at u and v, but for caps.
  Vector3d normalAround(std::int32_t u, std::int32_t v) const
  {
    Vector3d sum = Vector3d::Zero();
    for (const std::int32_t self : { u, v })
    {
      for (std::int32_t c = this->Mesh.firstCorner(self); c >= 0; c = this->Mesh.nextCorner(c))
      {
        const auto& corners = this->Mesh.cornersOf(std::size_t(c) / 3);
        if (!this->Mesh.isCap(corners))
        {
          const Vector3d& a = this->Mesh.at(corners[0]);
          sum += (this->Mesh.at(corners[1]) - a).cross(this->Mesh.at(corners[2]) - a);
        }
      }
    }
    return sum;
  }

  Shape shapeOf(const std::array<std::int32_t, 3>& corners) const
  {
    return cactus::shapeOf(this->Mesh.at(corners[0]), this->Mesh.at(corners[1]), this->Mesh.at(corners[2]));
  }

  /// The worst shapes among the triangles at u and v, but no better than what is allowed anyway.
  Shape worstShape(std::int32_t u, std::int32_t v) const
  {
    Shape worst{ this->Options.largestSquaredEdgeRatio, flattestTriangle };
    for (const std::int32_t self : { u, v })
    {
      for (std::int32_t c = this->Mesh.firstCorner(self); c >= 0; c = this->Mesh.nextCorner(c))
      {
        const auto& corners = this->Mesh.cornersOf(std::size_t(c) / 3);
        const Shape shape = this->shapeOf(corners);
        worst.edgeRatio = std::max(worst.edgeRatio, shape.edgeRatio);
        worst.flatness = std::min(worst.flatness, shape.flatness);
      }
    }
    return worst;
  }

  /// No triangle around the edge is turned over or made a needle where u and v move to `place`.
  bool keepsShape(std::int32_t u, std::int32_t v, const Vector3d& place, bool thorough) const
  {
    Vector3d around = Vector3d::Zero();
    bool isAroundKnown = false;
    Shape worst{ 0.0, 1.0 };
    for (int side = 0; side < 2; ++side)
    {
      const std::int32_t other = side == 0 ? v : u;
      for (std::int32_t c = this->Mesh.firstCorner(side == 0 ? u : v); c >= 0; c = this->Mesh.nextCorner(c))
      {
        const auto& corners = this->Mesh.cornersOf(std::size_t(c) / 3);
        const auto i = std::size_t(c) % 3;
        const std::int32_t second = corners[(i + 1) % 3];
        const std::int32_t third = corners[(i + 2) % 3];
        if (second == other || third == other)
        {
          continue;
        }
        const Vector3d& b = this->Mesh.at(second);
        const Vector3d& d = this->Mesh.at(third);
        const Vector3d edge = d - b;
        const Vector3d before = this->Mesh.at(corners[i]) - b;
        const Vector3d after = place - b;
        const Vector3d normalBefore = edge.cross(before);
        const Vector3d normalAfter = edge.cross(after);
        const double edgeSquared = edge.squaredNorm();
        const double normalSquared = normalAfter.squaredNorm();
        // The normal of a triangle lower than the error says little: the surroundings' is taken in its place.
        const double longestBefore = std::max({ edgeSquared, before.squaredNorm(), (before - edge).squaredNorm() });
        const bool isNoise = normalBefore.squaredNorm() < this->Reach * this->Reach * longestBefore && !this->Mesh.isCap(corners);
        if (isNoise && !isAroundKnown)
        {
          around = this->normalAround(u, v);
          isAroundKnown = true;
        }
        const Vector3d& reference = isNoise ? around : normalBefore;
        const double turn = normalAfter.dot(reference);
        if (!(normalSquared > 0.0) || !(turn > 0.0) ||
            turn * turn < leastTurn * leastTurn * normalSquared * reference.squaredNorm())
        {
          return false;
        }
        const double edges[2] = { after.squaredNorm(), (after - edge).squaredNorm() };
        const double longest = std::max({ edgeSquared, edges[0], edges[1] });
        const double shortest = std::min({ edgeSquared, edges[0], edges[1] });
        worst.edgeRatio = std::max(worst.edgeRatio, longest / shortest);
        worst.flatness = std::min(worst.flatness, normalSquared / (longest * longest));
      }
    }
    worst.flatness = std::sqrt(worst.flatness);
    if (worst.edgeRatio <= this->Options.largestSquaredEdgeRatio && (thorough || worst.flatness >= flattestTriangle))
    {
      return true;
    }
    const Shape old = this->worstShape(u, v);
    return worst.edgeRatio <= old.edgeRatio && (thorough || worst.flatness >= old.flatness);
  }

  void addToFit(Fit& fit, const Vector3d& p, std::uint8_t faces, double weight) const
  {
    const double value = this->Options.field(p);
    const double below = this->Smallest - value;
    fit.excess = std::max(fit.excess, below);
    fit.upper = std::min(fit.upper, -below / weight);
    if (faces == 0) // in a face of the box the field may be larger
    {
      const double above = value - this->Largest;
      fit.excess = std::max(fit.excess, above);
      fit.lower = std::max(fit.lower, above / weight);
    }
  }

  /// What the field says at the corner, edges' middles and centroids of the triangles around an edge: as they are, or with u and
  /// v moved to `place`. What `isHopeless` says yes to is not looked at further.
  template <typename IsHopeless>
  Fit fit(std::int32_t u, std::int32_t v, const Vector3d* place, IsHopeless&& isHopeless) const
  {
    Fit result;
    const std::uint8_t facesOfBoth = this->Mesh.facesOf(u) | this->Mesh.facesOf(v);
    for (int side = 0; side < 2; ++side)
    {
      const std::int32_t self = side == 0 ? u : v;
      const std::int32_t other = side == 0 ? v : u;
      const Vector3d& a = place != nullptr ? *place : this->Mesh.at(self);
      const std::uint8_t faces = place != nullptr ? facesOfBoth : this->Mesh.facesOf(self);
      if (place == nullptr || side == 0)
      {
        this->addToFit(result, a, faces, 1.0);
      }
      for (std::int32_t c = this->Mesh.firstCorner(self); c >= 0; c = this->Mesh.nextCorner(c))
      {
        const auto& corners = this->Mesh.cornersOf(std::size_t(c) / 3);
        const auto i = std::size_t(c) % 3;
        const std::int32_t second = corners[(i + 1) % 3];
        const std::int32_t third = corners[(i + 2) % 3];
        if (place != nullptr && (second == other || third == other))
        {
          continue;
        }
        const Vector3d& b = this->Mesh.at(second);
        const Vector3d& d = this->Mesh.at(third);
        const std::uint8_t facesOfEdge = faces & this->Mesh.facesOf(second);
        const std::uint8_t facesOfAll = facesOfEdge & this->Mesh.facesOf(third);
        this->addToFit(result, 0.5 * (a + b), facesOfEdge, 1.0 / 2.0);
        this->addToFit(result, (a + b + d) / 3.0, facesOfAll, 1.0 / 3.0);
        if (isHopeless(result))
        {
          return result;
        }
      }
    }
    return result;
  }

  /// Whether the field is in its range all over a triangle, at points less than `sampling` apart besides those of fit(). A bit of
  /// `faces` says that a corner is on that face of the box.
  bool keepsFieldWithin(const std::array<Vector3d, 3>& corners, const std::array<std::uint8_t, 3>& faces) const
  {
    const double longest = std::sqrt(std::max({ (corners[1] - corners[0]).squaredNorm(), (corners[2] - corners[1]).squaredNorm(),
      (corners[0] - corners[2]).squaredNorm() }));
    const int n = 2 + static_cast<int>(longest / this->Options.sampling);
    for (int i = 0; n > 2 && i < n; ++i)
    {
      for (int j = i == 0 ? 1 : 0; i + j <= n && j < n; ++j)
      {
        const int k = n - i - j;
        const std::uint8_t on = (i > 0 ? faces[0] : 0xff) & (j > 0 ? faces[1] : 0xff) & (k > 0 ? faces[2] : 0xff);
        Fit one;
        this->addToFit(one, (double(i) / n) * corners[0] + (double(j) / n) * corners[1] + (double(k) / n) * corners[2], on, 1.0);
        if (one.excess > 0.0)
        {
          return false;
        }
      }
    }
    return true;
  }

  /// The same for all triangles that are left at u and v where these move to `place`.
  bool keepsFieldWithin(std::int32_t u, std::int32_t v, const Vector3d& place) const
  {
    const std::uint8_t facesOfBoth = this->Mesh.facesOf(u) | this->Mesh.facesOf(v);
    for (int side = 0; side < 2; ++side)
    {
      const std::int32_t other = side == 0 ? v : u;
      for (std::int32_t c = this->Mesh.firstCorner(side == 0 ? u : v); c >= 0; c = this->Mesh.nextCorner(c))
      {
        const auto& corners = this->Mesh.cornersOf(std::size_t(c) / 3);
        const std::int32_t second = corners[(std::size_t(c) + 1) % 3];
        const std::int32_t third = corners[(std::size_t(c) + 2) % 3];
        if (second != other && third != other &&
            !this->keepsFieldWithin({ { place, this->Mesh.at(second), this->Mesh.at(third) } },
              { { facesOfBoth, this->Mesh.facesOf(second), this->Mesh.facesOf(third) } }))
        {
          return false;
        }
      }
    }
    return true;
  }

  /// Whether the new triangles keep the field in its range, or exceed it no more than the old ones do. Where moving `place`
  /// outwards or inwards brings it into its range, and `mayMove`, it is moved.
  Verdict keepsField(std::int32_t u, std::int32_t v, Vector3d& place, bool mayMove) const
  {
    const bool mustFit = this->isKnown(u, v);
    const auto isOut = [](const Fit& fit) { return fit.excess > 0.0; };
    const Fit after =
      this->fit(u, v, &place, [&](const Fit& fit) { return mustFit && isOut(fit) && !(mayMove && fit.lower <= fit.upper); });
    if (!isOut(after))
    {
      return this->keepsFieldWithin(u, v, place) ? Verdict::Kept : Verdict::Worse;
    }
    if (mayMove && after.lower <= after.upper)
    {
      const double least = std::clamp(0.0, after.lower, after.upper);
      const double middle = 0.5 * (after.lower + after.upper);
      const Vector3d outward = this->normalAround(u, v).normalized();
      const Vector3d moved = this->keptOffFaces(place, place + 0.5 * (least + middle) * outward);
      if (this->keepsShape(u, v, moved, false) && !isOut(this->fit(u, v, &moved, isOut)))
      {
        place = moved;
        return this->keepsFieldWithin(u, v, moved) ? Verdict::Kept : Verdict::Worse;
      }
    }
    if (mustFit)
    {
      return Verdict::Worse;
    }
    const Fit before = this->fit(u, v, nullptr, [&](const Fit& fit) { return fit.excess >= after.excess; });
    return after.excess <= before.excess ? Verdict::NoWorse : Verdict::Worse;
  }

  /// Whether the triangles at u and v have been found to keep the field in its range.
  bool isKnown(std::int32_t u, std::int32_t v) const
  {
    for (const std::int32_t self : { u, v })
    {
      for (std::int32_t c = this->Mesh.firstCorner(self); c >= 0; c = this->Mesh.nextCorner(c))
      {
        if (!this->Known[std::size_t(c) / 3])
        {
          return false;
        }
      }
    }
    return true;
  }

  void collapse(std::int32_t u, std::int32_t v, const Vector3d& place, bool isKnown)
  {
    this->Mesh.collapse(u, v, place);
    this->Part[std::size_t(u)] = std::min(this->Part[std::size_t(u)], this->Part[std::size_t(v)]);
    this->Locked[std::size_t(u)] = this->Sweep;
    for (std::int32_t c = this->Mesh.firstCorner(u); c >= 0; c = this->Mesh.nextCorner(c))
    {
      this->Known[std::size_t(c) / 3] = isKnown;
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

  /// Flips edges, away from caps and from places that want less coarsening, so that the surface comes nearer to the field's
  /// level.
  void flipEdges()
  {
    for (std::size_t t = 0; t < this->Mesh.triangleCount(); ++t)
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
    ToFit, ///< so that the surface comes nearer to the level
    OfFlat ///< so that a flat triangle goes, and the surface keeps its distance
  };

  /// Flips the edge a b of triangle `one`, whose third corner is c, where that does what it is for.
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
    const double before = this->worstOff(pa, pb, pc, pd);
    if (before < flipNeed * this->Options.maximumError && kind == Flip::ToFit)
    {
      return false;
    }
    const Vector3d normal = (pb - pa).cross(pc - pa) + (pa - pb).cross(pd - pb);
    const Vector3d first = (pd - pa).cross(pc - pa);
    const Vector3d second = (pb - pd).cross(pc - pd);
    const double turn = leastFlipTurn * normal.norm();
    const Shape shapes[2] = { cactus::shapeOf(pa, pd, pc), cactus::shapeOf(pd, pb, pc) };
    const double flattest = kind == Flip::ToFit
                              ? flattestTriangle
                              : std::min(flattestTriangle, 2.0 * this->shapeOf(this->Mesh.cornersOf(one)).flatness);
    const double furthest = kind == Flip::ToFit ? flipGain * before : std::max(before, this->Options.maximumError);
    if (!(first.dot(normal) > turn * first.norm()) || !(second.dot(normal) > turn * second.norm()) ||
        std::max(shapes[0].edgeRatio, shapes[1].edgeRatio) > this->Options.largestSquaredEdgeRatio ||
        std::min(shapes[0].flatness, shapes[1].flatness) < flattest)
    {
      return false;
    }
    constexpr std::array<std::uint8_t, 3> inside{ { 0, 0, 0 } };
    if (this->worstOff(pc, pd, pa, pb) > furthest || this->Mesh.areLinked(c, d) ||
        !this->keepsFieldWithin({ { pa, pd, pc } }, inside) || !this->keepsFieldWithin({ { pd, pb, pc } }, inside))
    {
      return false;
    }
    this->Mesh.flip(one, other, a, b);
    this->Known[one] = this->Known[other] = this->Known[one] && this->Known[other];
    this->markChanged(one);
    this->markChanged(other);
    return true;
  }

  /// The largest distance of the field from the middle of its range on the edge a b and on the triangles that it makes with c and
  /// d.
  double worstOff(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d) const
  {
    double worst = 0.0;
    for (const Vector3d& p : { Vector3d((a + b) / 2.0), Vector3d((a + b + c) / 3.0), Vector3d((a + b + d) / 3.0) })
    {
      worst = std::max(worst, std::abs(this->Options.field(p) - this->Options.level));
    }
    return worst;
  }

  EditableSurface Mesh;
  const SurfaceDecimationOptions& Options;
  Eigen::AlignedBox3d Box;
  double Smallest;          ///< value of the field within the largest error of its level
  double Largest;           ///< the same
  double Reach;             ///< µm, largest error of a quadric
  std::vector<int> Locked;  ///< per point, the sweep in which it was moved
  std::vector<int> Changed; ///< per point, the sweep in which a triangle at it changed
  std::vector<float> Part;  ///< per point, of the largest error
  std::vector<char> Known;  ///< per triangle, that it keeps the field in its range
  int Sweep = 0;
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
