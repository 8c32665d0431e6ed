// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SurfaceSpacing.h"

#include "base/Parallel.h"
#include "mesh/CappedSurface.h"
#include "mesh/SurfaceDistance.h"
#include "mesh/TriangleTree.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <utility>

namespace cactus
{

namespace
{

using Eigen::Vector3d;

/// µm that a pair is moved farther apart than it has to be: rounding, and corners that move askew, take some of it back.
constexpr double extraDistance = 0.0002;
/// Surfaces that meet are moved as if they had to keep this distance (µm), or the gap if that is larger: they have to get out of
/// each other first.
constexpr double distanceAfterMeeting = 0.005;
/// µm that a distance may lose where points are written in single precision; extraDistance is more.
constexpr double rounding = 5e-5;
/// Most pairs take one or two; corners whose normals point askew, as on a face that cuts a fibre at a small angle, get apart
/// slowly.
constexpr int rounds = 48;
constexpr double infinite = std::numeric_limits<double>::infinity();

/// Surfaces are looked at in slabs along z, of this thickness (µm), so that trees are held over one slab at a time.
constexpr double slabThickness = 10.0;

/// What of a surface is in a slab.
struct Part
{
  std::size_t surface = 0;
  std::vector<std::uint32_t> triangles; ///< until they are the tree's
  Eigen::AlignedBox3d box;
  std::unique_ptr<TriangleTree> tree; ///< where another part is near
};

/// Two parts, and by which triangles they are too near.
struct Pair
{
  Part* one;
  Part* other;
  double missing = 0.0; ///< µm, of the gap
  std::vector<std::uint32_t> trianglesOfOne;
  std::vector<std::uint32_t> trianglesOfOther;
};

/// Which pairs of surfaces are looked at.
struct PairSelection
{
  std::vector<char> isGiven;   ///< by the caller, or moved
  std::vector<char> isChanged; ///< since all were looked at

  bool holds(std::size_t a, std::size_t b) const
  {
    return (this->isGiven[a] || this->isGiven[b]) && (this->isChanged[a] || this->isChanged[b]);
  }
};

/// How far to move each of the points that have to move.
using Moves = std::map<std::int32_t, double>;

void moveInwards(TriangleMesh& mesh, const Moves& moves, const Eigen::AlignedBox3d& box, double margin)
{
  const auto onFace = [&](std::int32_t p, Eigen::Index axis, int side)
  { return mesh.points[std::size_t(p)][axis] == (side == 0 ? box.min()[axis] : box.max()[axis]); };
  std::map<std::int32_t, Vector3d> normals;
  for (const auto& t : mesh.triangles)
  {
    if (moves.count(t[0]) == 0 && moves.count(t[1]) == 0 && moves.count(t[2]) == 0)
    {
      continue;
    }
    bool isCap = false;
    for (int face = 0; face < 6; ++face)
    {
      const Eigen::Index axis = face / 2;
      isCap = isCap || (onFace(t[0], axis, face % 2) && onFace(t[1], axis, face % 2) && onFace(t[2], axis, face % 2));
    }
    if (isCap)
    {
      continue;
    }
    const Vector3d& a = mesh.points[std::size_t(t[0])];
    const Vector3d normal = (mesh.points[std::size_t(t[1])] - a).cross(mesh.points[std::size_t(t[2])] - a);
    for (const std::int32_t corner : t)
    {
      normals.emplace(corner, Vector3d::Zero()).first->second += normal;
    }
  }
  for (const auto& [point, distance] : moves)
  {
    const auto found = normals.find(point);
    if (found == normals.end())
    {
      continue; // amid a cap
    }
    Vector3d normal = found->second;
    for (Eigen::Index axis = 0; axis < 3; ++axis)
    {
      if (onFace(point, axis, 0) || onFace(point, axis, 1))
      {
        normal[axis] = 0.0;
      }
    }
    const double length = normal.norm();
    if (length > 0.0)
    {
      Vector3d& p = mesh.points[std::size_t(point)];
      p = keptInside(box, p, p - (distance / length) * normal, margin);
    }
  }
}

void addMoves(Moves& moves, const TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles, double distance)
{
  for (const std::uint32_t t : triangles)
  {
    for (const std::int32_t corner : mesh.triangles[t])
    {
      double& move = moves.emplace(corner, 0.0).first->second;
      move = std::max(move, distance);
    }
  }
}

/// The boxes of the surfaces that are given, and of those whose boxes are near one of these; the others' are empty.
std::vector<Eigen::AlignedBox3d> boxesToLookAt(
  const std::vector<TriangleMesh*>& surfaces, const std::vector<char>& isGiven, double gap, const Context& context)
{
  std::vector<Eigen::AlignedBox3d> boxes(surfaces.size());
  parallelFor(surfaces.size(), context,
    [&](std::size_t s)
    {
      for (const Vector3d& p : surfaces[s]->points)
      {
        boxes[s].extend(p);
      }
    });
  const std::vector<Eigen::AlignedBox3d> all = boxes;
  parallelFor(surfaces.size(), context,
    [&](std::size_t s)
    {
      bool isNear = isGiven[s];
      for (std::size_t g = 0; g < all.size() && !isNear; ++g)
      {
        isNear = isGiven[g] && all[g].squaredExteriorDistance(all[s]) < gap * gap;
      }
      if (!isNear)
      {
        boxes[s].setEmpty();
      }
    });
  return boxes;
}

/// What of a surface touches `lower` <= z <= `upper`.
Part partBetween(const TriangleMesh& mesh, double lower, double upper)
{
  std::vector<unsigned char> beyond(mesh.points.size());
  for (std::size_t p = 0; p < beyond.size(); ++p)
  {
    const double z = mesh.points[p][2];
    beyond[p] = static_cast<unsigned char>((z < lower ? 1 : 0) + (z > upper ? 2 : 0));
  }
  Part part;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
  {
    const auto& t = mesh.triangles[i];
    if ((beyond[std::size_t(t[0])] & beyond[std::size_t(t[1])] & beyond[std::size_t(t[2])]) == 0)
    {
      part.triangles.push_back(static_cast<std::uint32_t>(i));
      for (const std::int32_t corner : t)
      {
        part.box.extend(mesh.points[std::size_t(corner)]);
      }
    }
  }
  return part;
}

/// Pairs of parts to look at, whose boxes come nearer than the gap. Sorts the parts.
std::vector<Pair> neighbours(std::vector<Part>& parts, const PairSelection& selection, double gap)
{
  std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.box.min()[0] < b.box.min()[0]; });
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    Part& a = parts[i];
    for (std::size_t j = i + 1; j < parts.size() && parts[j].box.min()[0] <= a.box.max()[0] + gap; ++j)
    {
      Part& b = parts[j];
      if (selection.holds(a.surface, b.surface) && a.box.squaredExteriorDistance(b.box) < gap * gap)
      {
        pairs.push_back({ &a, &b, 0.0, {}, {} });
      }
    }
  }
  return pairs;
}

/// The parts of surfaces that touch `lower` <= z <= `upper`.
std::vector<Part> partsBetween(double lower, double upper, const std::vector<TriangleMesh*>& surfaces,
  const std::vector<Eigen::AlignedBox3d>& boxes, const Context& context)
{
  std::vector<std::size_t> present;
  for (std::size_t s = 0; s < surfaces.size(); ++s)
  {
    if (!boxes[s].isEmpty() && boxes[s].max()[2] >= lower && boxes[s].min()[2] <= upper)
    {
      present.push_back(s);
    }
  }
  std::vector<Part> parts(present.size());
  parallelFor(parts.size(), context,
    [&](std::size_t i)
    {
      parts[i] = partBetween(*surfaces[present[i]], lower, upper);
      parts[i].surface = present[i];
    });
  return parts;
}

/// Over the parts that belong to a pair.
void growTrees(
  const std::vector<TriangleMesh*>& surfaces, const std::vector<Pair>& pairs, std::vector<Part>& parts, const Context& context)
{
  std::vector<char> isNear(surfaces.size(), 0);
  for (const Pair& pair : pairs)
  {
    isNear[pair.one->surface] = isNear[pair.other->surface] = 1;
  }
  parallelFor(parts.size(), context,
    [&](std::size_t i)
    {
      Part& part = parts[i];
      if (isNear[part.surface])
      {
        part.tree = std::make_unique<TriangleTree>(*surfaces[part.surface], std::move(part.triangles));
      }
    });
}

void measureGap(Pair& pair, double gap)
{
  const SurfaceGap nearest = smallestGap(*pair.one->tree, *pair.other->tree, gap);
  if (nearest.found())
  {
    const double wanted = nearest.distance == 0.0 ? std::max(gap, distanceAfterMeeting) : gap;
    pair.missing = wanted - nearest.distance;
    pair.trianglesOfOne = trianglesNear(*pair.one->tree, *pair.other->tree, wanted);
    pair.trianglesOfOther = trianglesNear(*pair.other->tree, *pair.one->tree, wanted);
  }
}

/// Adds, per surface, how far points have to move for what touches `lower` <= z <= `upper`.
void measureSlab(double lower, double upper, const std::vector<TriangleMesh*>& surfaces,
  const std::vector<Eigen::AlignedBox3d>& boxes, const PairSelection& selection, double gap, const Context& context,
  std::map<std::size_t, Moves>& moves)
{
  std::vector<Part> parts = partsBetween(lower, upper, surfaces, boxes, context);
  std::vector<Pair> pairs = neighbours(parts, selection, gap);
  growTrees(surfaces, pairs, parts, context);
  parallelFor(pairs.size(), context, [&](std::size_t p) { measureGap(pairs[p], gap); });
  for (const Pair& pair : pairs)
  {
    if (pair.missing > 0.0)
    {
      const double distance = 0.5 * pair.missing + extraDistance;
      addMoves(moves[pair.one->surface], pair.one->tree->mesh(), pair.trianglesOfOne, distance);
      addMoves(moves[pair.other->surface], pair.other->tree->mesh(), pair.trianglesOfOther, distance);
    }
  }
}

/// Goes through `box` slab by slab. Where two surfaces are too near, both are in the slab that the place is in: each holds what
/// is as near as the gap. `report(part)` gets how much of the work is done.
template <typename Report>
std::map<std::size_t, Moves> measureAll(const std::vector<TriangleMesh*>& surfaces, const PairSelection& selection, double gap,
  const Eigen::AlignedBox3d& box, const Context& context, Report&& report)
{
  const std::vector<Eigen::AlignedBox3d> boxes = boxesToLookAt(surfaces, selection.isGiven, gap, context);
  const int slabs = std::max(1, static_cast<int>(std::ceil(box.sizes()[2] / slabThickness)));
  std::map<std::size_t, Moves> moves;
  for (int slab = 0; slab < slabs; ++slab)
  {
    const double lower = slab == 0 ? -infinite : box.min()[2] + slab * slabThickness - gap;
    const double upper = slab == slabs - 1 ? infinite : box.min()[2] + (slab + 1) * slabThickness + gap;
    measureSlab(lower, upper, surfaces, boxes, selection, gap, context, moves);
    report(double(slab + 1) / slabs);
  }
  return moves;
}

} // namespace

SpacingReport keepApart(const std::vector<TriangleMesh*>& surfaces, const std::vector<std::size_t>& changed, double smallest,
  const Eigen::AlignedBox3d& box, const Context& context, double from, double to)
{
  SpacingReport report;
  if (!(smallest > 0.0))
  {
    return report;
  }
  const double gap = smallest + rounding;
  PairSelection selection;
  selection.isGiven.resize(surfaces.size(), 0);
  for (const std::size_t s : changed)
  {
    selection.isGiven[s] = 1;
  }
  selection.isChanged = selection.isGiven;
  std::set<std::size_t> moved;
  // Most of the work is the first look at all surfaces.
  const double half = 0.5 * (from + to);
  for (int round = 0;; ++round)
  {
    const std::map<std::size_t, Moves> moves = measureAll(surfaces, selection, gap, box, context,
      [&](double part) { context.report((round == 0 ? from : half) + (half - from) * part, "keeping fibres apart"); });
    std::vector<std::size_t> moving;
    moving.reserve(moves.size());
    for (const auto& entry : moves)
    {
      moving.push_back(entry.first);
    }
    if (moving.empty() || round == rounds)
    {
      report.tooNear = moving;
      break;
    }
    std::fill(selection.isChanged.begin(), selection.isChanged.end(), 0);
    for (const std::size_t s : moving)
    {
      selection.isChanged[s] = 1;
      selection.isGiven[s] = 1; // large triangles may come nearer to a third one as they turn
      moved.insert(s);
    }
    parallelFor(moving.size(), context, [&](std::size_t m) { moveInwards(*surfaces[moving[m]], moves.at(moving[m]), box, gap); });
  }
  report.moved.assign(moved.begin(), moved.end());
  return report;
}

SpacingReport keepApart(const std::vector<TriangleMesh*>& surfaces, double gap, const Eigen::AlignedBox3d& box,
  const Context& context, double from, double to)
{
  std::vector<std::size_t> all(surfaces.size());
  std::iota(all.begin(), all.end(), std::size_t(0));
  return keepApart(surfaces, all, gap, box, context, from, to);
}

} // namespace cactus
