// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/RimBlunting.h"

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

/// Where a rim is blunted: cosine of the smallest angle that a direction can have to all normals at a point (70°).
constexpr double sharpCosine = 0.342;
/// What it is then to be (64°).
constexpr double goalCosine = 0.438;
/// Steps on the way to that direction.
constexpr int directionSteps = 40;
/// How far a point moves, as parts of the longest way.
constexpr int bluntingSteps = 8;
/// Since points beside each other need one another to move.
constexpr int bluntingRounds = 2;
/// Edges are cut a little above the end of the layer, so that those that end just below the cut need none.
constexpr double deepest = 1.25;

class Blunting
{
public:
  Blunting(EditableSurface& surface, double depth, const TriangleLimits& limits)
    : Mesh(surface)
    , Depth(depth / deepest)
    , Limits(limits)
  {
  }

  void run()
  {
    std::vector<std::int32_t> sharp;
    for (std::size_t p = 0; p < this->Mesh.pointCount(); ++p)
    {
      const auto point = static_cast<std::int32_t>(p);
      if (this->Mesh.facesOf(point) != 0 && !this->Mesh.isDeadPoint(point) && this->steepnessOf(point) < 0.0 &&
          this->bestCosineAt(point) < sharpCosine && !this->Mesh.isHeldRim(point))
      {
        sharp.push_back(point);
      }
    }
    for (const std::int32_t point : sharp)
    {
      this->cutWallAt(point);
    }
    for (int round = 0; round < bluntingRounds; ++round)
    {
      for (const std::int32_t point : sharp)
      {
        this->moveInwards(point);
      }
    }
  }

private:
  bool isCap(std::size_t triangle) const { return this->Mesh.isCap(this->Mesh.cornersOf(triangle)); }

  /// The smallest cosine between the normals of a cap and of a wall at a point; 1 if it is on no rim.
  double steepnessOf(std::int32_t point) const
  {
    double smallest = 1.0;
    for (std::int32_t c = this->Mesh.firstCorner(point); c >= 0; c = this->Mesh.nextCorner(c))
    {
      if (!this->isCap(std::size_t(c) / 3))
      {
        continue;
      }
      const Vector3d cap = this->Mesh.normalOf(std::size_t(c) / 3).normalized();
      for (std::int32_t d = this->Mesh.firstCorner(point); d >= 0; d = this->Mesh.nextCorner(d))
      {
        if (!this->isCap(std::size_t(d) / 3))
        {
          smallest = std::min(smallest, cap.dot(this->Mesh.normalOf(std::size_t(d) / 3).normalized()));
        }
      }
    }
    return smallest;
  }

  /// The largest smallest cosine that a direction has to the normals of the triangles at a point, nearly.
  double bestCosineAt(std::int32_t point) const
  {
    std::vector<Vector3d> normals;
    Vector3d direction = Vector3d::Zero();
    for (std::int32_t c = this->Mesh.firstCorner(point); c >= 0; c = this->Mesh.nextCorner(c))
    {
      normals.push_back(this->Mesh.normalOf(std::size_t(c) / 3).normalized());
      direction += normals.back();
    }
    direction /= double(normals.size());
    double best = -1.0;
    for (int i = 0; i < directionSteps; ++i)
    {
      const auto cosine = [&](const Vector3d& a) { return a.dot(direction); };
      const auto worst = std::min_element(
        normals.begin(), normals.end(), [&](const Vector3d& a, const Vector3d& b) { return cosine(a) < cosine(b); });
      best = std::max(best, cosine(*worst) / std::max(1e-9, direction.norm()));
      direction += (*worst - direction) / (i + 2.0);
    }
    return best;
  }

  /// How far a place is from the faces of the box that a point lies on.
  double depthOf(const Vector3d& place, std::int32_t point) const
  {
    double depth = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis)
    {
      if ((this->Mesh.facesOf(point) >> (2 * axis) & 3) != 0)
      {
        depth = std::min(depth, std::abs(place[axis] - this->Mesh.at(point)[axis]));
      }
    }
    return depth;
  }

  /// Cuts the edges of the wall at a point of a rim where they leave the layer that is blunted.
  void cutWallAt(std::int32_t point)
  {
    std::vector<std::int32_t> ends;
    for (std::int32_t c = this->Mesh.firstCorner(point); c >= 0; c = this->Mesh.nextCorner(c))
    {
      const std::int32_t end = this->Mesh.oppositeEdge(c)[0];
      if (!this->isCap(std::size_t(c) / 3) && !this->isCap(this->Mesh.triangleAlong(end, point)))
      {
        ends.push_back(end);
      }
    }
    for (const std::int32_t end : ends)
    {
      const Vector3d from = this->Mesh.at(point);
      const Vector3d way = this->Mesh.at(end) - from;
      const double depth = this->depthOf(this->Mesh.at(end), point);
      if (depth > deepest * this->Depth)
      {
        this->cut(point, end, from + this->Depth / depth * way);
      }
    }
  }

  /// Tells whether the triangles of the wall at a point end in the layer that is blunted.
  bool isCutAround(std::int32_t point) const
  {
    for (std::int32_t c = this->Mesh.firstCorner(point); c >= 0; c = this->Mesh.nextCorner(c))
    {
      for (const std::int32_t end : this->Mesh.oppositeEdge(c))
      {
        if (this->depthOf(this->Mesh.at(end), point) > deepest * this->Depth)
        {
          return false;
        }
      }
    }
    return true;
  }

  void cut(std::int32_t point, std::int32_t end, const Vector3d& place)
  {
    for (const std::size_t side : { this->Mesh.triangleAlong(point, end), this->Mesh.triangleAlong(end, point) })
    {
      const Vector3d& beside = this->Mesh.at(this->Mesh.thirdCorner(side, point, end));
      const double flattest = this->Mesh.flatnessOf(side);
      if (!this->Limits.allow(this->Mesh.at(point), place, beside, flattest) ||
          !this->Limits.allow(place, this->Mesh.at(end), beside, flattest))
      {
        return;
      }
    }
    this->Mesh.split(point, end, place);
  }

  /// The direction from a point of a rim into its caps, in all faces of the box that it lies on; zero if there is none.
  Vector3d inwardAt(std::int32_t point) const
  {
    Vector3d outward = Vector3d::Zero();
    for (std::int32_t c = this->Mesh.firstCorner(point); c >= 0; c = this->Mesh.nextCorner(c))
    {
      const std::size_t t = std::size_t(c) / 3;
      if (!this->isCap(t))
      {
        const auto edge = this->Mesh.oppositeEdge(c);
        const Vector3d a = (this->Mesh.at(edge[0]) - this->Mesh.at(point)).normalized();
        const Vector3d b = (this->Mesh.at(edge[1]) - this->Mesh.at(point)).normalized();
        outward += (1.0 - a.dot(b)) * this->Mesh.normalOf(t).normalized(); // more of what spans more
      }
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      if ((this->Mesh.facesOf(point) >> (2 * axis) & 3) != 0)
      {
        outward[axis] = 0.0;
      }
    }
    return outward.norm() > 1e-3 ? Vector3d(-outward.normalized()) : Vector3d::Zero();
  }

  /// Moves a point of a rim into its caps until a direction stands for all triangles at it, or as far as that gets better.
  void moveInwards(std::int32_t point)
  {
    if (!this->isCutAround(point))
    {
      return;
    }
    double cosine = this->bestCosineAt(point);
    const double steepness = std::min(0.0, this->steepnessOf(point));
    const double cotangent = -steepness / std::sqrt(std::max(1e-6, 1.0 - steepness * steepness));
    const Vector3d way = this->Depth * cotangent * this->inwardAt(point);
    const Vector3d from = this->Mesh.at(point);
    std::vector<Vector3d> normals;
    std::vector<double> flatness;
    for (std::int32_t c = this->Mesh.firstCorner(point); c >= 0; c = this->Mesh.nextCorner(c))
    {
      normals.push_back(this->Mesh.normalOf(std::size_t(c) / 3).normalized());
      flatness.push_back(this->Mesh.flatnessOf(std::size_t(c) / 3));
    }
    Vector3d best = from;
    for (int i = 1; i <= bluntingSteps && cosine < goalCosine; ++i)
    {
      this->Mesh.move(point, from + double(i) / bluntingSteps * way);
      if (!isInward(way, normals) || !this->isFine(point, normals, flatness))
      {
        break;
      }
      const double there = this->bestCosineAt(point);
      if (there > cosine)
      {
        cosine = there;
        best = this->Mesh.at(point);
      }
    }
    this->Mesh.move(point, best);
  }

  /// Tells whether a way leads to the inside of triangles, or along them, by their normals: behind the planes of all triangles at
  /// a point, it makes the surface smaller. Where walls turn around a point, the way into its caps may leave some of them.
  static bool isInward(const Vector3d& way, const std::vector<Vector3d>& normals)
  {
    const double tolerance = 1e-9 * way.norm();
    return std::all_of(normals.begin(), normals.end(), [&](const Vector3d& normal) { return normal.dot(way) <= tolerance; });
  }

  /// Tells whether the triangles at a point are fit, which had these normals and flatness before it was moved.
  bool isFine(std::int32_t point, const std::vector<Vector3d>& normals, const std::vector<double>& flatness) const
  {
    std::size_t i = 0;
    for (std::int32_t c = this->Mesh.firstCorner(point); c >= 0; c = this->Mesh.nextCorner(c), ++i)
    {
      const std::size_t t = std::size_t(c) / 3;
      const auto& corners = this->Mesh.cornersOf(t);
      if (!(this->Mesh.normalOf(t).dot(normals[i]) > 0.3 * this->Mesh.normalOf(t).norm()) ||
          !this->Limits.allow(this->Mesh.at(corners[0]), this->Mesh.at(corners[1]), this->Mesh.at(corners[2]), flatness[i]))
      {
        return false;
      }
    }
    return true;
  }

  EditableSurface& Mesh;
  double Depth; ///< of the cuts, µm
  TriangleLimits Limits;
};

} // namespace

void bluntRims(EditableSurface& surface, double depth, const TriangleLimits& limits)
{
  Blunting(surface, depth, limits).run();
}

} // namespace cactus
