// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceDecimation.h"

#include <Eigen/Cholesky>
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

  /// Mean squared distance.
  double error(const Vector3d& p) const { return std::max(0.0, (p.dot(this->times(p)) + 2.0 * b.dot(p) + c) / weight); }

  /// The place of least error, drawn towards `middle` in directions that the planes leave open.
  Vector3d best(const Vector3d& middle) const
  {
    const double damping = 1e-3 * (xx + yy + zz);
    Eigen::Matrix3d m;
    m << xx + damping, xy, xz, xy, yy + damping, yz, xz, yz, zz + damping;
    const Vector3d gradient = this->times(middle) + b;
    return middle - m.llt().solve(gradient);
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
constexpr double flattestTriangle = 0.03;
/// Least cosine between a triangle's normals before and after a collapse.
constexpr double leastTurn = 0.3;
/// Errors of the sweeps, as parts of the largest one.
constexpr double sweepErrors[] = { 0.1, 0.4, 1.0 };
/// Collapses of less than this part of the largest error are made without a look at the field.
constexpr double unnoticed = 0.05;
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
      const double twiceArea = normal.norm();
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
          this->tryCollapse(u, v, limit);
        }
      }
    }
    return before - this->Alive;
  }

  void tryCollapse(std::int32_t u, std::int32_t v, double limit, bool thorough = false)
  {
    Quadric sum = this->Quadrics[std::size_t(u)];
    sum.add(this->Quadrics[std::size_t(v)]);
    if (!(sum.weight > 0.0))
    {
      return;
    }
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
        places[count++] = sum.best(middle - this->Origin) + this->Origin;
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

  /// No triangle around the edge is turned over or made a needle where u and v move to `place`.
  bool keepsShape(std::int32_t u, std::int32_t v, const Vector3d& place, bool thorough) const
  {
    Vector3d around = Vector3d::Zero(); // sum of the old triangles' normals, but for caps
    for (const std::int32_t self : { u, v })
    {
      for (std::int32_t c = this->First[std::size_t(self)]; c >= 0; c = this->Next[std::size_t(c)])
      {
        const auto& corners = this->Triangles[std::size_t(c) / 3];
        if (!this->isCap(corners))
        {
          const Vector3d& a = this->at(corners[0]);
          around += (this->at(corners[1]) - a).cross(this->at(corners[2]) - a);
        }
      }
    }
    double oldRatio = this->Options.largestSquaredEdgeRatio;
    double oldFlatness = flattestTriangle;
    double newRatio = 0.0;
    double newFlatness = 1.0;
    for (int side = 0; side < 2; ++side)
    {
      for (std::int32_t c = this->First[std::size_t(side == 0 ? u : v)]; c >= 0; c = this->Next[std::size_t(c)])
      {
        const auto& corners = this->Triangles[std::size_t(c) / 3];
        const auto i = std::size_t(c) % 3;
        const std::int32_t other = side == 0 ? v : u;
        const Vector3d& a = this->at(corners[i]);
        const Vector3d& b = this->at(corners[(i + 1) % 3]);
        const Vector3d& d = this->at(corners[(i + 2) % 3]);
        const Shape before = shapeOf(a, b, d);
        oldRatio = std::max(oldRatio, before.edgeRatio);
        oldFlatness = std::min(oldFlatness, before.flatness);
        if (corners[(i + 1) % 3] == other || corners[(i + 2) % 3] == other)
        {
          continue;
        }
        const Shape after = shapeOf(place, b, d);
        newRatio = std::max(newRatio, after.edgeRatio);
        newFlatness = std::min(newFlatness, after.flatness);
        const Vector3d edge = d - b;
        const Vector3d normalBefore = edge.cross(a - b);
        const Vector3d normalAfter = edge.cross(place - b);
        // The normal of a triangle lower than the error says little: the surroundings' is taken in its place.
        const double longest = std::sqrt(std::max({ edge.squaredNorm(), (a - b).squaredNorm(), (d - a).squaredNorm() }));
        const bool isNoise = !this->isCap(corners) && normalBefore.norm() < this->Options.maximumError * longest;
        const Vector3d& reference = isNoise ? around : normalBefore;
        if (!(normalAfter.dot(reference) >= leastTurn * normalAfter.norm() * reference.norm()) ||
            !(normalAfter.squaredNorm() > 0.0))
        {
          return false;
        }
      }
    }
    if (newRatio > oldRatio || (!thorough && newFlatness < oldFlatness))
    {
      return false;
    }
    return true;
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
