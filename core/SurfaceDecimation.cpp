// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceDecimation.h"

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

/// Weighted sum of squared distances to planes, as a function of the place.
struct Quadric
{
  double xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0;
  Vector3d b = Vector3d::Zero();
  double c = 0.0;
  double weight = 0.0;

  void addPlane(const Vector3d& normal, double offset, double w)
  {
    xx += w * normal[0] * normal[0];
    xy += w * normal[0] * normal[1];
    xz += w * normal[0] * normal[2];
    yy += w * normal[1] * normal[1];
    yz += w * normal[1] * normal[2];
    zz += w * normal[2] * normal[2];
    b += (w * offset) * normal;
    c += w * offset * offset;
    weight += w;
  }

  void add(const Quadric& other)
  {
    xx += other.xx;
    xy += other.xy;
    xz += other.xz;
    yy += other.yy;
    yz += other.yz;
    zz += other.zz;
    b += other.b;
    c += other.c;
    weight += other.weight;
  }

  Vector3d times(const Vector3d& p) const
  {
    return { xx * p[0] + xy * p[1] + xz * p[2], xy * p[0] + yy * p[1] + yz * p[2], xz * p[0] + yz * p[1] + zz * p[2] };
  }

  /// Mean squared distance; 0 without planes.
  double error(const Vector3d& p) const
  {
    return weight > 0.0 ? std::max(0.0, (p.dot(this->times(p)) + 2.0 * b.dot(p) + c) / weight) : 0.0;
  }

  /// The place of least error, drawn towards `middle` in directions that the planes leave open; `middle` where that is farther
  /// than `reach` away.
  Vector3d best(const Vector3d& middle, double reach) const
  {
    const double damping = 1e-3 * (xx + yy + zz);
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
/// Least cosine between a triangle's normals before and after a collapse.
constexpr double leastTurn = 0.3;
/// Errors of the sweeps, as parts of the largest one.
constexpr double sweepErrors[] = { 0.05, 0.15, 0.4, 1.0 };
/// Collapses of less than this part of the largest error are made without a look at the field.
constexpr double unnoticed = 0.12;
constexpr int sweepsPerError = 10;

class Decimation
{
public:
  Decimation(CappedSurface& surface, const SurfaceDecimationOptions& options)
    : Surface(surface)
    , Options(options)
    , Points(surface.mesh.points)
    , Triangles(surface.mesh.triangles)
    , Faces(surface.faces)
  {
  }

  void run()
  {
    this->prepare();
    for (const double part : sweepErrors)
    {
      const double error = part * this->Options.maximumError;
      for (int sweep = 0; sweep < sweepsPerError; ++sweep)
      {
        if (this->sweep(error * error, sweep == 0) * 20 < this->Alive)
        {
          break;
        }
      }
    }
    this->mend();
    this->compact();
  }

private:
  /// Removes points next to both u and v that have but three neighbours, with which u and v cannot become one.
  void removeBetween(std::int32_t u, std::int32_t v, double limit)
  {
    for (std::int32_t c = this->First[std::size_t(u)]; c >= 0;)
    {
      const auto corners = this->Triangles[std::size_t(c) / 3];
      c = this->Next[std::size_t(c)];
      for (const std::int32_t w : corners)
      {
        int around = 0;
        bool besideV = false;
        for (std::int32_t e = w == u || w == v ? -1 : this->First[std::size_t(w)]; e >= 0; e = this->Next[std::size_t(e)])
        {
          const auto& other = this->Triangles[std::size_t(e) / 3];
          besideV = besideV || other[0] == v || other[1] == v || other[2] == v;
          ++around;
        }
        if (around == 3 && besideV)
        {
          this->tryCollapse(std::min(u, w), std::max(u, w), limit, true);
          if (this->First[std::size_t(u)] < 0 || this->First[std::size_t(w)] < 0)
          {
            return; // what was to be visited next may be gone
          }
        }
      }
    }
  }

  /// Removes the shortest edges of triangles that are still too long for their width, whatever that costs within twice the error.
  void mend()
  {
    const double limit = 4.0 * this->Options.maximumError * this->Options.maximumError;
    for (int round = 0; round < 4; ++round)
    {
      ++this->Sweep;
      bool any = false;
      for (std::size_t t = 0; t < this->Triangles.size(); ++t)
      {
        if (this->isDead(t))
        {
          continue;
        }
        const auto corners = this->Triangles[t];
        std::array<double, 3> length;
        for (std::size_t i = 0; i < 3; ++i)
        {
          length[i] = (this->at(corners[(i + 1) % 3]) - this->at(corners[i])).squaredNorm();
        }
        const auto shortest = std::size_t(std::min_element(length.begin(), length.end()) - length.begin());
        if (*std::max_element(length.begin(), length.end()) > this->Options.largestSquaredEdgeRatio * length[shortest])
        {
          const std::int32_t u = corners[shortest];
          const std::int32_t v = corners[(shortest + 1) % 3];
          this->removeBetween(u, v, limit);
          if (!this->isDead(t))
          {
            this->tryCollapse(std::min(u, v), std::max(u, v), limit, true);
          }
          any = any || this->isDead(t);
        }
      }
      if (!any)
      {
        return;
      }
    }
  }

  void prepare()
  {
    this->Origin = this->Points.empty() ? Vector3d::Zero() : this->Points.front();
    this->Quadrics.assign(this->Points.size(), Quadric());
    this->First.assign(this->Points.size(), -1);
    this->Next.resize(3 * this->Triangles.size());
    this->Locked.assign(this->Points.size(), 0);
    this->Changed.assign(this->Points.size(), 0);
    this->Mark.assign(this->Points.size(), 0);
    this->Part.assign(this->Points.size(), 1.0f);
    for (const CalmPlace& place : this->Options.calm)
    {
      for (std::size_t p = 0; p < this->Points.size(); ++p)
      {
        if ((this->Points[p] - place.centre).squaredNorm() < place.radius * place.radius)
        {
          this->Part[p] *= static_cast<float>(place.part);
        }
      }
    }
    this->Alive = this->Triangles.size();
    for (std::size_t t = this->Triangles.size(); t-- > 0;)
    {
      const auto& corners = this->Triangles[t];
      for (std::size_t i = 0; i < 3; ++i)
      {
        auto& first = this->First[std::size_t(corners[i])];
        this->Next[3 * t + i] = first;
        first = static_cast<std::int32_t>(3 * t + i);
      }
      const Vector3d& a = this->at(corners[0]);
      const Vector3d normal = (this->at(corners[1]) - a).cross(this->at(corners[2]) - a);
      // Points of caps stay in their plane anyway; counted in, caps would water down the error of their rims.
      const double twiceArea = this->isCap(corners) ? 0.0 : normal.norm();
      if (twiceArea > 0.0)
      {
        const Vector3d unit = normal / twiceArea;
        for (const std::int32_t corner : corners)
        {
          this->Quadrics[std::size_t(corner)].addPlane(unit, -unit.dot(a - this->Origin), twiceArea);
        }
      }
    }
  }

  const Vector3d& at(std::int32_t point) const { return this->Points[std::size_t(point)]; }
  bool isDead(std::size_t triangle) const { return this->Triangles[triangle][0] < 0; }

  bool isCap(const std::array<std::int32_t, 3>& t) const
  {
    return (this->Faces[std::size_t(t[0])] & this->Faces[std::size_t(t[1])] & this->Faces[std::size_t(t[2])]) != 0;
  }

  /// Tries every edge once or, but for the first sweep of an error, every edge near which something has changed since it was
  /// tried; the number of triangles removed.
  std::size_t sweep(double limit, bool all)
  {
    const std::size_t before = this->Alive;
    ++this->Sweep;
    for (std::size_t t = 0; t < this->Triangles.size(); ++t)
    {
      for (std::size_t i = 0; i < 3 && !this->isDead(t); ++i)
      {
        const std::int32_t u = this->Triangles[t][i];
        const std::int32_t v = this->Triangles[t][(i + 1) % 3];
        // Each edge from one of its two sides; and a point moves once in a sweep, so that cheap collapses spread evenly.
        const bool isNew = all || std::max(this->Changed[std::size_t(u)], this->Changed[std::size_t(v)]) + 1 >= this->Sweep;
        if (u < v && isNew && this->Locked[std::size_t(u)] != this->Sweep && this->Locked[std::size_t(v)] != this->Sweep)
        {
          const double part = std::min(this->Part[std::size_t(u)], this->Part[std::size_t(v)]);
          this->tryCollapse(u, v, part * part * limit);
        }
      }
    }
    return before - this->Alive;
  }

  void tryCollapse(std::int32_t u, std::int32_t v, double limit, bool thorough = false)
  {
    Quadric sum = this->Quadrics[std::size_t(u)];
    sum.add(this->Quadrics[std::size_t(v)]);
    const std::uint8_t facesU = this->Faces[std::size_t(u)];
    const std::uint8_t facesV = this->Faces[std::size_t(v)];
    const std::uint8_t both = facesU & facesV;
    std::array<Vector3d, 3> places;
    std::size_t count = 0;
    if (facesU == facesV)
    {
      const Vector3d middle = 0.5 * (this->at(u) + this->at(v));
      if (facesU == 0)
      {
        places[count++] = sum.best(middle - this->Origin, (this->at(u) - this->at(v)).norm()) + this->Origin;
      }
      else
      {
        places[count++] = middle;
      }
      places[count++] = this->at(u);
      places[count++] = this->at(v);
    }
    else if (both == facesU)
    {
      places[count++] = this->at(v);
    }
    else if (both == facesV)
    {
      places[count++] = this->at(u);
    }
    std::array<double, 3> errors;
    for (std::size_t p = 0; p < count; ++p)
    {
      errors[p] = sum.error(places[p] - this->Origin);
    }
    bool linked = false;
    for (std::size_t tried = 0; tried < count; ++tried)
    {
      const std::size_t p =
        std::size_t(std::min_element(errors.begin(), errors.begin() + std::ptrdiff_t(count)) - errors.begin());
      if (errors[p] > limit)
      {
        return;
      }
      if (!linked && !this->linkCondition(u, v))
      {
        return;
      }
      linked = true;
      const bool isSmall =
        errors[p] <= unnoticed * unnoticed * this->Options.maximumError * this->Options.maximumError && !thorough;
      if (this->keepsShape(u, v, places[p], thorough) && (isSmall || this->keepsField(u, v, places[p])))
      {
        this->collapse(u, v, places[p], sum, facesU | facesV);
        return;
      }
      if (facesU == 0 && facesV == 0 && !thorough)
      {
        return; // the other places are little better
      }
      errors[p] = std::numeric_limits<double>::infinity();
    }
  }

  /// The points next to both are just the two that the edge's triangles have beside it, and the surface is no tetrahedron.
  bool linkCondition(std::int32_t u, std::int32_t v)
  {
    this->MarkValue += 2;
    int around = 0;
    for (std::int32_t c = this->First[std::size_t(u)]; c >= 0; c = this->Next[std::size_t(c)])
    {
      const auto& corners = this->Triangles[std::size_t(c) / 3];
      for (const std::int32_t corner : corners)
      {
        this->Mark[std::size_t(corner)] = this->MarkValue;
      }
      ++around;
    }
    int common = 0;
    int aroundV = 0;
    for (std::int32_t c = this->First[std::size_t(v)]; c >= 0; c = this->Next[std::size_t(c)])
    {
      const auto& corners = this->Triangles[std::size_t(c) / 3];
      for (const std::int32_t corner : corners)
      {
        auto& mark = this->Mark[std::size_t(corner)];
        if (corner != u && corner != v && mark == this->MarkValue)
        {
          ++common;
          mark = this->MarkValue + 1;
        }
      }
      ++aroundV;
    }
    return common == 2 && around + aroundV > 6;
  }

  /// Sum of the normals of the triangles at u and v, but for caps.
  Vector3d normalAround(std::int32_t u, std::int32_t v) const
  {
    Vector3d sum = Vector3d::Zero();
    for (const std::int32_t self : { u, v })
    {
      for (std::int32_t c = this->First[std::size_t(self)]; c >= 0; c = this->Next[std::size_t(c)])
      {
        const auto& corners = this->Triangles[std::size_t(c) / 3];
        if (!this->isCap(corners))
        {
          const Vector3d& a = this->at(corners[0]);
          sum += (this->at(corners[1]) - a).cross(this->at(corners[2]) - a);
        }
      }
    }
    return sum;
  }

  /// The worst shapes among the triangles at u and v, but no better than what is allowed anyway.
  Shape worstShape(std::int32_t u, std::int32_t v) const
  {
    Shape worst{ this->Options.largestSquaredEdgeRatio, flattestTriangle };
    for (const std::int32_t self : { u, v })
    {
      for (std::int32_t c = this->First[std::size_t(self)]; c >= 0; c = this->Next[std::size_t(c)])
      {
        const auto& corners = this->Triangles[std::size_t(c) / 3];
        const Shape shape = shapeOf(this->at(corners[0]), this->at(corners[1]), this->at(corners[2]));
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
      for (std::int32_t c = this->First[std::size_t(side == 0 ? u : v)]; c >= 0; c = this->Next[std::size_t(c)])
      {
        const auto& corners = this->Triangles[std::size_t(c) / 3];
        const auto i = std::size_t(c) % 3;
        const std::int32_t second = corners[(i + 1) % 3];
        const std::int32_t third = corners[(i + 2) % 3];
        if (second == other || third == other)
        {
          continue;
        }
        const Vector3d& b = this->at(second);
        const Vector3d& d = this->at(third);
        const Vector3d edge = d - b;
        const Vector3d before = this->at(corners[i]) - b;
        const Vector3d after = place - b;
        const Vector3d normalBefore = edge.cross(before);
        const Vector3d normalAfter = edge.cross(after);
        const double edgeSquared = edge.squaredNorm();
        const double normalSquared = normalAfter.squaredNorm();
        // The normal of a triangle lower than the error says little: the surroundings' is taken in its place.
        const double longestBefore = std::max({ edgeSquared, before.squaredNorm(), (before - edge).squaredNorm() });
        const bool isNoise =
          normalBefore.squaredNorm() < this->Options.maximumError * this->Options.maximumError * longestBefore &&
          !this->isCap(corners);
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

  /// By how much the field is out of its range at a point of the surface; on faces of the box it may be larger.
  double excess(const Vector3d& p, std::uint8_t faces) const
  {
    const double value = this->Options.field(p);
    return std::max(this->Options.smallestField - value, faces != 0 ? 0.0 : value - this->Options.largestField);
  }

  /// The largest excess at points on the triangles around an edge: as they are, or with u and v moved to `place`.
  double worstExcess(std::int32_t u, std::int32_t v, const Vector3d* place) const
  {
    double worst = 0.0;
    const std::uint8_t facesOfBoth = this->Faces[std::size_t(u)] | this->Faces[std::size_t(v)];
    for (int side = 0; side < 2; ++side)
    {
      const std::int32_t self = side == 0 ? u : v;
      const std::int32_t other = side == 0 ? v : u;
      const Vector3d& a = place != nullptr ? *place : this->at(self);
      const std::uint8_t faces = place != nullptr ? facesOfBoth : this->Faces[std::size_t(self)];
      worst = std::max(worst, this->excess(a, faces));
      for (std::int32_t c = this->First[std::size_t(self)]; c >= 0; c = this->Next[std::size_t(c)])
      {
        const auto& corners = this->Triangles[std::size_t(c) / 3];
        const auto i = std::size_t(c) % 3;
        const std::int32_t second = corners[(i + 1) % 3];
        const std::int32_t third = corners[(i + 2) % 3];
        if (place != nullptr && (second == other || third == other))
        {
          continue;
        }
        const Vector3d& b = this->at(second);
        const Vector3d& d = this->at(third);
        const std::uint8_t facesOfEdge = faces & this->Faces[std::size_t(second)];
        const std::uint8_t facesOfAll = facesOfEdge & this->Faces[std::size_t(third)];
        worst = std::max({ worst, this->excess(0.5 * (a + b), facesOfEdge), this->excess((a + b + d) / 3.0, facesOfAll) });
      }
    }
    return worst;
  }

  /// The new triangles keep the field in its range, or exceed it no more than the old ones do.
  bool keepsField(std::int32_t u, std::int32_t v, const Vector3d& place) const
  {
    if (!this->Options.field)
    {
      return true;
    }
    const double after = this->worstExcess(u, v, &place);
    return after <= 0.0 || after <= this->worstExcess(u, v, nullptr);
  }

  void collapse(std::int32_t u, std::int32_t v, const Vector3d& place, const Quadric& sum, std::uint8_t faces)
  {
    this->Points[std::size_t(u)] = place;
    this->Part[std::size_t(u)] = std::min(this->Part[std::size_t(u)], this->Part[std::size_t(v)]);
    this->Quadrics[std::size_t(u)] = sum;
    this->Faces[std::size_t(u)] = faces;
    this->Locked[std::size_t(u)] = this->Sweep;
    // The triangles on the edge die; v's others become u's.
    for (std::int32_t c = this->First[std::size_t(v)]; c >= 0;)
    {
      const std::int32_t next = this->Next[std::size_t(c)];
      const auto t = std::size_t(c) / 3;
      auto& corners = this->Triangles[t];
      if (corners[0] == u || corners[1] == u || corners[2] == u)
      {
        for (std::size_t i = 0; i < 3; ++i)
        {
          if (corners[i] != v)
          {
            this->unlink(corners[i], static_cast<std::int32_t>(3 * t + i));
          }
        }
        corners = { { -1, -1, -1 } };
        --this->Alive;
      }
      else
      {
        corners[std::size_t(c) % 3] = u;
        this->Next[std::size_t(c)] = this->First[std::size_t(u)];
        this->First[std::size_t(u)] = c;
      }
      c = next;
    }
    this->First[std::size_t(v)] = -1;
    for (std::int32_t c = this->First[std::size_t(u)]; c >= 0; c = this->Next[std::size_t(c)])
    {
      for (const std::int32_t corner : this->Triangles[std::size_t(c) / 3])
      {
        this->Changed[std::size_t(corner)] = this->Sweep;
      }
    }
  }

  void unlink(std::int32_t point, std::int32_t corner)
  {
    std::int32_t* link = &this->First[std::size_t(point)];
    while (*link != corner)
    {
      link = &this->Next[std::size_t(*link)];
    }
    *link = this->Next[std::size_t(corner)];
  }

  void compact()
  {
    std::vector<std::int32_t> number(this->Points.size(), -1);
    std::size_t triangles = 0;
    std::vector<Vector3d> points;
    std::vector<std::uint8_t> faces;
    for (std::size_t t = 0; t < this->Triangles.size(); ++t)
    {
      if (this->isDead(t))
      {
        continue;
      }
      auto corners = this->Triangles[t];
      for (std::int32_t& corner : corners)
      {
        auto& n = number[std::size_t(corner)];
        if (n < 0)
        {
          n = static_cast<std::int32_t>(points.size());
          points.push_back(this->at(corner));
          faces.push_back(this->Faces[std::size_t(corner)]);
        }
        corner = n;
      }
      this->Triangles[triangles++] = corners;
    }
    this->Triangles.resize(triangles);
    this->Triangles.shrink_to_fit();
    this->Points = std::move(points);
    this->Faces = std::move(faces);
  }

  CappedSurface& Surface;
  const SurfaceDecimationOptions& Options;
  std::vector<Vector3d>& Points;
  std::vector<std::array<std::int32_t, 3>>& Triangles; ///< a dead one has corners of -1
  std::vector<std::uint8_t>& Faces;
  Vector3d Origin = Vector3d::Zero(); ///< what places in quadrics count from, so that they lose no digits
  std::vector<Quadric> Quadrics;
  std::vector<std::int32_t> First; ///< per point, a corner (3 · triangle + place) that it is, or -1
  std::vector<std::int32_t> Next;  ///< per corner, the next one that is the same point, or -1
  std::vector<int> Locked;         ///< per point, the sweep in which it was moved
  std::vector<int> Changed;        ///< per point, the sweep in which a triangle at it changed
  std::vector<float> Part;         ///< per point, of the largest error
  std::vector<int> Mark;
  int MarkValue = 0;
  int Sweep = 0;
  std::size_t Alive = 0;
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
