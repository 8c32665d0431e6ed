// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceSpacing.h"

#include "CappedSurface.h"
#include "Parallel.h"
#include "SurfaceDistance.h"
#include "TriangleTree.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <numeric>
#include <utility>

namespace cactus
{

namespace
{

using Eigen::Vector3d;

/// A pair is moved a little farther apart than it has to be, µm: rounding, and corners that move askew, take some of it back.
constexpr double extra = 0.0002;
/// µm that a distance may lose where points are written in single precision; extra is more.
constexpr double rounding = 5e-5;
constexpr int rounds = 12;

/// Trees over surfaces are held for about so many surfaces and their neighbours at a time.
constexpr std::size_t surfacesAtATime = 128;

/// Two surfaces, and by which triangles they are too near.
struct Pair
{
  std::size_t one;
  std::size_t other;
  std::size_t batch;    ///< in which the pair is looked at; batches go through the box along x
  double missing = 0.0; ///< µm, of the gap
  std::vector<std::uint32_t> trianglesOfOne;
  std::vector<std::uint32_t> trianglesOfOther;
};

/// All pairs of surfaces, one of which has changed, whose boxes come nearer than the gap.
std::vector<Pair> neighbours(const std::vector<TriangleMesh*>& surfaces, const std::vector<char>& isChanged, double gap)
{
  std::vector<Eigen::AlignedBox3d> boxes(surfaces.size());
  std::vector<std::size_t> order;
  for (std::size_t s = 0; s < surfaces.size(); ++s)
  {
    for (const Vector3d& p : surfaces[s]->points)
    {
      boxes[s].extend(p);
    }
    if (!surfaces[s]->triangles.empty())
    {
      order.push_back(s);
    }
  }
  std::stable_sort(
    order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return boxes[a].min()[0] < boxes[b].min()[0]; });
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const Eigen::AlignedBox3d& a = boxes[order[i]];
    for (std::size_t j = i + 1; j < order.size() && boxes[order[j]].min()[0] <= a.max()[0] + gap; ++j)
    {
      if ((isChanged[order[i]] || isChanged[order[j]]) && a.squaredExteriorDistance(boxes[order[j]]) < gap * gap)
      {
        pairs.push_back({ std::min(order[i], order[j]), std::max(order[i], order[j]), i / surfacesAtATime, 0.0, {}, {} });
      }
    }
  }
  return pairs;
}

/// Looks at all pairs, in batches, with trees only over what the present batch and those after it need.
void measureGaps(const std::vector<Pair*>& pairs, const std::vector<TriangleMesh*>& surfaces, double gap, const Context& context,
  double from, double to)
{
  std::vector<std::size_t> lastBatch(surfaces.size(), 0);
  for (const Pair* pair : pairs)
  {
    lastBatch[pair->one] = lastBatch[pair->other] = pair->batch; // they come batch by batch
  }
  std::vector<std::unique_ptr<TriangleTree>> trees(surfaces.size());
  for (std::size_t begin = 0, end = 0; begin < pairs.size(); begin = end)
  {
    const std::size_t batch = pairs[begin]->batch;
    std::vector<std::size_t> missing;
    for (end = begin; end < pairs.size() && pairs[end]->batch == batch; ++end)
    {
      for (const std::size_t s : { pairs[end]->one, pairs[end]->other })
      {
        if (!trees[s])
        {
          missing.push_back(s);
        }
      }
    }
    std::sort(missing.begin(), missing.end());
    missing.erase(std::unique(missing.begin(), missing.end()), missing.end());
    parallelFor(
      missing.size(), context, [&](std::size_t m) { trees[missing[m]] = std::make_unique<TriangleTree>(*surfaces[missing[m]]); });
    parallelFor(
      end - begin, context,
      [&](std::size_t p)
      {
        Pair& pair = *pairs[begin + p];
        const TriangleTree& one = *trees[pair.one];
        const TriangleTree& other = *trees[pair.other];
        const SurfaceGap nearest = smallestGap(one, other, gap);
        pair.missing = nearest.found() ? gap - nearest.distance : 0.0;
        pair.trianglesOfOne = nearest.found() ? trianglesNear(one, other, gap) : std::vector<std::uint32_t>();
        pair.trianglesOfOther = nearest.found() ? trianglesNear(other, one, gap) : std::vector<std::uint32_t>();
      },
      "keeping fibres apart", from + (to - from) * double(begin) / double(pairs.size()),
      from + (to - from) * double(end) / double(pairs.size()));
    for (std::size_t p = begin; p < end; ++p)
    {
      for (const std::size_t s : { pairs[p]->one, pairs[p]->other })
      {
        if (lastBatch[s] == batch)
        {
          trees[s].reset();
        }
      }
    }
  }
}

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
  std::vector<char> isChanged(surfaces.size(), 0);
  std::vector<char> isMoved(surfaces.size(), 0);
  for (const std::size_t s : changed)
  {
    isChanged[s] = 1;
  }
  std::vector<Pair> pairs = neighbours(surfaces, isChanged, gap);
  // Most of the work is the first look at all pairs.
  const double half = 0.5 * (from + to);
  for (int round = 0;; ++round)
  {
    std::vector<Pair*> active;
    for (Pair& pair : pairs)
    {
      if (isChanged[pair.one] || isChanged[pair.other])
      {
        active.push_back(&pair);
      }
    }
    measureGaps(active, surfaces, gap, context, round == 0 ? from : half, round == 0 ? half : to);
    std::map<std::size_t, Moves> moves;
    for (const Pair& pair : pairs)
    {
      if (pair.missing > 0.0)
      {
        addMoves(moves[pair.one], *surfaces[pair.one], pair.trianglesOfOne, 0.5 * pair.missing + extra);
        addMoves(moves[pair.other], *surfaces[pair.other], pair.trianglesOfOther, 0.5 * pair.missing + extra);
      }
    }
    if (moves.empty() || round == rounds)
    {
      for (const auto& entry : moves)
      {
        report.tooNear.push_back(entry.first);
      }
      break;
    }
    std::vector<std::size_t> moving;
    std::fill(isChanged.begin(), isChanged.end(), 0);
    for (const auto& entry : moves)
    {
      moving.push_back(entry.first);
      isChanged[entry.first] = isMoved[entry.first] = 1;
    }
    parallelFor(moving.size(), context, [&](std::size_t m) { moveInwards(*surfaces[moving[m]], moves.at(moving[m]), box, gap); });
  }
  for (std::size_t s = 0; s < surfaces.size(); ++s)
  {
    if (isMoved[s])
    {
      report.moved.push_back(s);
    }
  }
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
