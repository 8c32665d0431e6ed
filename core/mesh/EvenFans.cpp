// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/EvenFans.h"

#include "base/Constants.h"
#include "mesh/EditableSurface.h"
#include "mesh/RimBlunting.h"
#include "mesh/ShapeBounds.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace cactus
{

namespace
{

using Eigen::Vector3d;

// Cosines of angles between the normal of a vertex and those of its triangles.
/// Aimed at (72°): a little less than what is promised, since points are rounded.
constexpr double wantedCosine = 0.309;
/// Below this (74.7°) edges at a vertex are cut.
constexpr double leastCosine = 0.264;
/// Below this (65°) a vertex counts where caps are triangulated anew.
constexpr double easyCosine = 0.423;
/// What a flip or a cut has to gain.
constexpr double cosineGain = 0.003;
/// Where an edge is cut, as parts of its length from the vertex.
constexpr double cutParts[] = { 0.8, 0.65, 0.5, 0.33, 0.22, 0.15, 0.1, 0.06, 0.04, 0.025, 0.015, 0.01 };
/// µm, least height of a triangle that is made.
constexpr double leastHeight = 1e-3;
constexpr int capRounds = 6;
constexpr int cutRounds = 3;
constexpr int mostCutsAtOnce = 12;

class Evening
{
public:
  Evening(CappedSurface& surface, double largestSquaredEdgeRatio, double smallestAngle, double rimDepth)
    : Mesh(surface)
    , FlattestOfAll(std::tan(smallestAngle / radian))
    , Limits{ largestSquaredEdgeRatio, std::max(FlattestOfAll, flattestTriangle), leastHeight }
    , RimDepth(rimDepth)
    , Cosines(Mesh.pointCount())
    , IsSeen(Mesh.triangleCount(), 0)
  {
    this->refreshAll();
  }

  void run()
  {
    if (std::all_of(this->Cosines.begin(), this->Cosines.end(), [](double c) { return c >= leastCosine; }))
    {
      return;
    }
    if (this->RimDepth > 0.0)
    {
      bluntRims(this->Mesh, this->RimDepth, { this->Limits.largestSquaredEdgeRatio, this->FlattestOfAll, leastHeight });
      this->IsSeen.resize(this->Mesh.triangleCount(), 0);
      this->Cosines.resize(this->Mesh.pointCount());
      this->refreshAll();
    }
    for (std::size_t t = 0, count = this->Mesh.triangleCount(); t < count; ++t)
    {
      if (!this->Mesh.isDead(t) && !this->IsSeen[t] && this->faceOf(t) != 0)
      {
        this->fanCap(t);
      }
    }
    for (int round = 0; round < capRounds && this->flipInCaps(); ++round)
    {
    }
    for (int round = 0; round < cutRounds && this->cutFans(); ++round)
    {
    }
    this->Limits.leastFlatness = this->FlattestOfAll; // where that did not do
    for (int round = 0; round < cutRounds && this->cutFans(); ++round)
    {
    }
    for (int round = 0; round < cutRounds && this->splitFans(); ++round)
    {
    }
    this->Mesh.compact();
  }

private:
  /// An edge at a vertex, and where it is cut; or a triangle, and where it is split.
  struct Cut
  {
    std::int32_t end = -1; ///< the edge's other end, or the vertex' corner of the triangle
    double part = 0.0;
    double cosine = 0.0; ///< smallest at the vertex afterwards
  };

  Vector3d normalAt(std::int32_t point) const
  {
    Vector3d sum = Vector3d::Zero();
    for (std::int32_t c = this->Mesh.firstCorner(point); c >= 0; c = this->Mesh.nextCorner(c))
    {
      sum += this->Mesh.normalOf(std::size_t(c) / 3);
    }
    return sum;
  }

  static double cosineBetween(const Vector3d& a, const Vector3d& b)
  {
    const double lengths = a.norm() * b.norm();
    return lengths > 0.0 ? a.dot(b) / lengths : -1.0;
  }

  /// The smallest cosine between a direction and the normal of a triangle at a point.
  double cosineTo(const Vector3d& direction, std::int32_t point) const
  {
    double smallest = 1.0;
    for (std::int32_t c = this->Mesh.firstCorner(point); c >= 0; c = this->Mesh.nextCorner(c))
    {
      smallest = std::min(smallest, cosineBetween(direction, this->Mesh.normalOf(std::size_t(c) / 3)));
    }
    return smallest;
  }

  /// How much better a vertex is with a normal in place of the one it has, `before`: the smallest cosine or, where that is
  /// negative, what it would be with the length of `before`, so that each of several cuts that are needed counts.
  double scoreOf(const Vector3d& normal, const Vector3d& before, std::int32_t point) const
  {
    const double cosine = this->cosineTo(normal, point);
    return cosine < 0.0 ? cosine * normal.norm() / before.norm() : cosine;
  }

  void refresh(std::int32_t point) { this->Cosines[std::size_t(point)] = this->cosineTo(this->normalAt(point), point); }
  void refresh(const std::array<std::int32_t, 4>& points)
  {
    for (const std::int32_t point : points)
    {
      this->refresh(point);
    }
  }
  void refreshAll()
  {
    for (std::size_t p = 0; p < this->Cosines.size(); ++p)
    {
      this->refresh(static_cast<std::int32_t>(p));
    }
  }
  double cosineAt(std::int32_t point) const { return this->Cosines[std::size_t(point)]; }

  static double costOf(double cosine)
  {
    const double over = std::max(0.0, easyCosine - cosine);
    return over * over;
  }

  double costOf(const std::array<std::int32_t, 4>& points) const
  {
    double sum = 0.0;
    for (const std::int32_t point : points)
    {
      sum += costOf(this->cosineAt(point));
    }
    return sum;
  }

  /// The faces of the box that a triangle lies in: 0 for those of the wall.
  unsigned faceOf(std::size_t triangle) const
  {
    const auto& t = this->Mesh.cornersOf(triangle);
    return unsigned(this->Mesh.facesOf(t[0]) & this->Mesh.facesOf(t[1]) & this->Mesh.facesOf(t[2]));
  }

  /// Makes a cap a fan about its centroid where its rim is the better for it.
  void fanCap(std::size_t first)
  {
    std::vector<std::size_t> disc{ first };
    std::vector<std::array<std::int32_t, 2>> rim;
    this->IsSeen[first] = 1;
    for (std::size_t i = 0; i < disc.size(); ++i)
    {
      const auto corners = this->Mesh.cornersOf(disc[i]);
      for (std::size_t k = 0; k < 3; ++k)
      {
        const std::int32_t a = corners[k];
        const std::int32_t b = corners[(k + 1) % 3];
        const std::size_t next = this->Mesh.triangleAlong(b, a);
        if (this->faceOf(next) != this->faceOf(first))
        {
          rim.push_back({ { a, b } });
        }
        else if (!this->IsSeen[next])
        {
          this->IsSeen[next] = 1;
          disc.push_back(next);
        }
      }
    }
    std::vector<std::int32_t> loop = rim.empty() ? std::vector<std::int32_t>() : loopOf(rim);
    if (!loop.empty())
    {
      this->fanDisc(disc, loop);
    }
  }

  /// The points of edges that make one loop, in their order, or none.
  static std::vector<std::int32_t> loopOf(std::vector<std::array<std::int32_t, 2>>& edges)
  {
    std::sort(edges.begin(), edges.end());
    std::vector<std::int32_t> loop;
    std::int32_t point = edges.front()[0];
    do
    {
      const auto next = std::lower_bound(edges.begin(), edges.end(), std::array<std::int32_t, 2>{ { point, -1 } });
      loop.push_back(point);
      point = (*next)[1];
    } while (point != loop.front() && loop.size() <= edges.size());
    return loop.size() == edges.size() ? loop : std::vector<std::int32_t>();
  }

  void fanDisc(const std::vector<std::size_t>& disc, const std::vector<std::int32_t>& loop)
  {
    Vector3d normal = Vector3d::Zero();
    Vector3d centre = Vector3d::Zero();
    const Vector3d& origin = this->Mesh.at(loop[0]);
    for (const std::size_t t : disc)
    {
      const auto& corners = this->Mesh.cornersOf(t);
      const double area = this->Mesh.normalOf(t).norm();
      normal += this->Mesh.normalOf(t);
      for (const std::int32_t corner : corners)
      {
        centre += area / 3.0 * (this->Mesh.at(corner) - origin); // exactly 0 along the normal
      }
    }
    centre = origin + centre / normal.norm();
    std::vector<Vector3d> change(loop.size(), Vector3d::Zero());
    for (std::size_t i = 0; i < loop.size(); ++i)
    {
      const std::size_t next = (i + 1) % loop.size();
      const Vector3d& a = this->Mesh.at(loop[i]);
      const Vector3d& b = this->Mesh.at(loop[next]);
      const Vector3d part = (b - a).cross(centre - a);
      if (!(part.dot(normal) > 0.0) || !this->Limits.allow(a, b, centre, this->Limits.leastFlatness))
      {
        return;
      }
      change[i] += part;
      change[next] += part;
    }
    double before = 0.0;
    double after = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i)
    {
      Vector3d others = Vector3d::Zero();
      for (std::int32_t c = this->Mesh.firstCorner(loop[i]); c >= 0; c = this->Mesh.nextCorner(c))
      {
        if (this->faceOf(std::size_t(c) / 3) != this->faceOf(disc[0]))
        {
          others += this->Mesh.normalOf(std::size_t(c) / 3);
        }
      }
      before += costOf(this->cosineAt(loop[i]));
      after += costOf(this->cosineTo(others + change[i], loop[i]));
    }
    if (after < before)
    {
      this->Mesh.fan(disc, loop, centre);
      this->IsSeen.resize(this->Mesh.triangleCount(), 1);
      this->Cosines.push_back(1.0);
      for (const std::int32_t point : loop)
      {
        this->refresh(point);
      }
    }
  }

  bool flipInCaps()
  {
    bool any = false;
    for (std::size_t t = 0; t < this->Mesh.triangleCount(); ++t)
    {
      for (std::size_t i = 0; i < 3; ++i)
      {
        const auto corners = this->Mesh.cornersOf(t);
        any = (!this->Mesh.isDead(t) && this->Mesh.isCap(corners) && this->tryFlip(t, corners[i], corners[(i + 1) % 3])) || any;
      }
    }
    return any;
  }

  bool tryFlip(std::size_t one, std::int32_t a, std::int32_t b)
  {
    if (a > b)
    {
      return false; // from the other side
    }
    const std::size_t other = this->Mesh.triangleAlong(b, a);
    const std::int32_t c = this->Mesh.thirdCorner(one, a, b);
    const std::int32_t d = this->Mesh.thirdCorner(other, a, b);
    const unsigned faces =
      unsigned(this->Mesh.facesOf(a) & this->Mesh.facesOf(b) & this->Mesh.facesOf(c) & this->Mesh.facesOf(d));
    if (faces == 0)
    {
      return false;
    }
    const double before = this->costOf({ { a, b, c, d } });
    const Vector3d& pa = this->Mesh.at(a);
    const Vector3d& pb = this->Mesh.at(b);
    const Vector3d& pc = this->Mesh.at(c);
    const Vector3d& pd = this->Mesh.at(d);
    const Vector3d& normal = this->Mesh.normalOf(one);
    const double flattest = std::min(this->Mesh.flatnessOf(one), this->Mesh.flatnessOf(other));
    if (before == 0.0 || !((pd - pa).cross(pc - pa).dot(normal) > 0.0) || !((pb - pd).cross(pc - pd).dot(normal) > 0.0) ||
        !this->Limits.allow(pa, pd, pc, flattest) || !this->Limits.allow(pd, pb, pc, flattest) || this->Mesh.areLinked(c, d))
    {
      return false;
    }
    this->Mesh.flip(one, other, a, b);
    this->refresh({ { a, b, c, d } });
    if (this->costOf({ { a, b, c, d } }) < before - cosineGain * cosineGain)
    {
      return true;
    }
    this->Mesh.flip(one, other, d, c);
    this->refresh({ { a, b, c, d } });
    return false;
  }

  bool cutFans()
  {
    bool any = false;
    for (std::size_t p = 0, count = this->Mesh.pointCount(); p < count; ++p)
    {
      const auto point = static_cast<std::int32_t>(p);
      for (int i = 0; i < mostCutsAtOnce && this->cosineAt(point) < (i == 0 ? leastCosine : wantedCosine); ++i)
      {
        const Cut best = this->bestCut(point);
        if (best.end < 0)
        {
          break;
        }
        const Vector3d& from = this->Mesh.at(point);
        const Vector3d place = from + best.part * (this->Mesh.at(best.end) - from);
        this->Cosines.push_back(1.0);
        this->refresh(this->Mesh.split(point, best.end, place));
        this->refresh(point);
        this->refresh(best.end);
        any = true;
      }
    }
    return any;
  }

  /// Tells whether a cut is: by its smallest cosine or, where both do, by being nearer to the middle.
  static bool isBetter(double part, double after, const Cut& best)
  {
    return std::min(after, wantedCosine) > best.cosine ||
           (after >= wantedCosine && best.cosine >= wantedCosine && part > best.part);
  }

  /// The cut nearest to the middle of an edge that reaches the goal or, where none does, the one that comes nearest to it.
  Cut bestCut(std::int32_t point) const
  {
    Cut best;
    best.cosine = this->cosineAt(point) + cosineGain;
    const Vector3d normal = this->normalAt(point);
    for (std::int32_t c = this->Mesh.firstCorner(point); c >= 0; c = this->Mesh.nextCorner(c))
    {
      const std::int32_t end = this->Mesh.oppositeEdge(c)[0];
      if (this->Mesh.isHeldRim(point, end))
      {
        continue;
      }
      const std::size_t sides[2] = { std::size_t(c) / 3, this->Mesh.triangleAlong(end, point) };
      const Vector3d between = this->Mesh.normalOf(sides[0]) + this->Mesh.normalOf(sides[1]);
      if (std::min(cosineBetween(between, this->Mesh.normalOf(sides[0])), cosineBetween(between, this->Mesh.normalOf(sides[1]))) <
          leastCosine)
      {
        continue; // the new point would be no better
      }
      for (const double part : cutParts)
      {
        const double after = this->scoreOf(normal - (1.0 - part) * between, normal, point);
        if (isBetter(part, after, best) && this->isWellCut(point, end, sides, part))
        {
          const double there = this->cosineTo(this->normalAt(end) - part * between, end);
          if (there >= std::min(leastCosine, this->cosineAt(end)))
          {
            best = { end, part, after };
          }
        }
      }
    }
    return best;
  }

  /// Where cuts do not help, since they change the points at the other ends of edges: splits triangles into three, near the
  /// point.
  bool splitFans()
  {
    bool any = false;
    for (std::size_t p = 0, count = this->Mesh.pointCount(); p < count; ++p)
    {
      const auto point = static_cast<std::int32_t>(p);
      for (int i = 0; i < mostCutsAtOnce && this->cosineAt(point) < (i == 0 ? leastCosine : wantedCosine); ++i)
      {
        const Cut best = this->bestSplit(point);
        if (best.end < 0)
        {
          break;
        }
        const auto t = std::size_t(best.end) / 3;
        const auto corners = this->Mesh.cornersOf(t);
        const Vector3d place = this->placeAt(best.end, best.part);
        this->Cosines.push_back(1.0);
        const std::int32_t made = this->Mesh.fan({ t }, { corners[0], corners[1], corners[2] }, place);
        this->refresh({ { corners[0], corners[1], corners[2], made } });
        any = true;
      }
    }
    return any;
  }

  /// A place on the line from a corner to the middle of the opposite edge.
  Vector3d placeAt(std::int32_t corner, double part) const
  {
    const auto edge = this->Mesh.oppositeEdge(corner);
    const Vector3d& from = this->Mesh.at(this->Mesh.cornersOf(std::size_t(corner) / 3)[std::size_t(corner) % 3]);
    return from + part * (0.5 * (this->Mesh.at(edge[0]) + this->Mesh.at(edge[1])) - from);
  }

  /// As bestCut, with a corner in place of an edge's end.
  Cut bestSplit(std::int32_t point) const
  {
    Cut best;
    best.cosine = this->cosineAt(point) + cosineGain;
    const Vector3d normal = this->normalAt(point);
    for (std::int32_t c = this->Mesh.firstCorner(point); c >= 0; c = this->Mesh.nextCorner(c))
    {
      const auto edge = this->Mesh.oppositeEdge(c);
      const Vector3d& own = this->Mesh.normalOf(std::size_t(c) / 3);
      for (const double part : cutParts)
      {
        const double after = this->scoreOf(normal - (1.0 - part) * own, normal, point);
        const Vector3d place = this->placeAt(c, part);
        const double flattest = this->Mesh.flatnessOf(std::size_t(c) / 3);
        const Vector3d& from = this->Mesh.at(point);
        const Vector3d& a = this->Mesh.at(edge[0]);
        const Vector3d& b = this->Mesh.at(edge[1]);
        if (isBetter(part, after, best) && this->Limits.allow(from, a, place, flattest) &&
            this->Limits.allow(from, place, b, flattest) && this->Limits.allow(place, a, b, flattest) &&
            this->keeps(edge[0], 0.5 * part * own) && this->keeps(edge[1], 0.5 * part * own))
        {
          best = { c, part, after };
        }
      }
    }
    return best;
  }

  /// Whether a point bears to lose something of its normal.
  bool keeps(std::int32_t point, const Vector3d& lost) const
  {
    return this->cosineTo(this->normalAt(point) - lost, point) >= std::min(leastCosine, this->cosineAt(point));
  }

  bool isWellCut(std::int32_t point, std::int32_t end, const std::size_t (&sides)[2], double part) const
  {
    const Vector3d& from = this->Mesh.at(point);
    const Vector3d& to = this->Mesh.at(end);
    const Vector3d place = from + part * (to - from);
    for (const std::size_t side : sides)
    {
      const Vector3d& beside = this->Mesh.at(this->Mesh.thirdCorner(side, point, end));
      const double flattest = this->Mesh.flatnessOf(side);
      if (!this->Limits.allow(from, place, beside, flattest) || !this->Limits.allow(place, to, beside, flattest))
      {
        return false;
      }
    }
    return true;
  }

  EditableSurface Mesh;
  double FlattestOfAll;             ///< as TriangleShape has it; the angles of a triangle have tangents of at least that
  TriangleLimits Limits;            ///< of what is made now
  double RimDepth;                  ///< µm
  std::vector<double> Cosines;      ///< per point, smallest between its normal and that of one of its triangles
  std::vector<std::uint8_t> IsSeen; ///< per triangle
};

} // namespace

void evenFans(CappedSurface& surface, double largestSquaredEdgeRatio, double smallestAngle, double rimDepth)
{
  Evening(surface, largestSquaredEdgeRatio, smallestAngle, rimDepth).run();
}

} // namespace cactus
