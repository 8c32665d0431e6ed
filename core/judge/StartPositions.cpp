// SPDX-License-Identifier: BSD-3-Clause
#include "judge/StartPositions.h"

#include "base/Error.h"
#include "base/Memory.h"
#include "base/Parallel.h"
#include "base/Random.h"
#include "mesh/SurfaceSide.h"
#include "mesh/TriangleTree.h"

#include <algorithm>

namespace cactus
{

namespace
{

/// The place of a candidate. On a surface, or in one that it should not be in, it is not used.
enum class Place : unsigned char
{
  Outside,
  InsideOuter,
  InsideInner,
  OnSurface
};

/// Evenly over the box; the same for the same seed and number.
Eigen::Vector3d candidate(const Domain& box, std::uint64_t seed, std::uint64_t number)
{
  RandomEngine random = randomStream(seed, RandomStage::StartPositions, number);
  const double x = uniform(random);
  const double y = uniform(random);
  const double z = uniform(random);
  return box.lower + box.size().cwiseProduct(Eigen::Vector3d(x, y, z));
}

/// The candidates in or on a surface.
struct Found
{
  std::vector<std::size_t> inside;
  std::vector<std::size_t> on;
};

Found findIn(const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& candidates)
{
  Found found;
  if (mesh.points.empty())
  {
    return found;
  }
  Eigen::Vector3d lower = mesh.points.front();
  Eigen::Vector3d upper = lower;
  for (const Eigen::Vector3d& point : mesh.points)
  {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  const TriangleTree tree(mesh);
  for (std::size_t i = 0; i < candidates.size(); ++i)
  {
    if ((candidates[i] - lower).minCoeff() >= 0.0 && (upper - candidates[i]).minCoeff() >= 0.0)
    {
      const Side side = sideOf(tree, candidates[i]);
      if (side != Side::Outside)
      {
        (side == Side::Inside ? found.inside : found.on).push_back(i);
      }
    }
  }
  return found;
}

/// Marks the candidates in and on all of some surfaces.
void mark(const FibreSurfaces& surfaces, Place inside, const std::vector<Eigen::Vector3d>& candidates, std::vector<Place>& places,
  const Context& context)
{
  std::vector<Found> found(surfaces.size());
  parallelFor(
    surfaces.size(), context, [&](std::size_t i) { found[i] = findIn(surfaces.mesh(i), candidates); }, "Placing walkers");
  const auto raise = [&](std::size_t i, Place place) { places[i] = std::max(places[i], place); };
  for (const Found& one : found)
  {
    std::for_each(one.inside.begin(), one.inside.end(), [&](std::size_t i) { raise(i, inside); });
    std::for_each(one.on.begin(), one.on.end(), [&](std::size_t i) { raise(i, Place::OnSurface); });
  }
}

void take(const Eigen::Vector3d& point, std::size_t count, std::vector<Eigen::Vector3d>& points)
{
  if (points.size() < count)
  {
    points.push_back(point);
  }
}

} // namespace

StartPositions drawStartPositions(const Domain& box, const FibreSurfaces& outer, const FibreSurfaces& inner,
  const StartCounts& counts, std::uint64_t seed, const Context& context)
{
  constexpr std::uint64_t mostDrawn = 85; // per start position
  constexpr std::uint64_t mostAtOnce = std::uint64_t(1) << 22;
  const bool hasMyelin = outer.size() > 0 && inner.size() > 0;
  const bool hasExtra = outer.size() > 0;
  const std::size_t count = std::max({ counts.intra, counts.myelin, counts.extra });
  requireMemory(120.0 * double(count), text("StartPositions ", count), "ask for fewer");
  StartPositions found;
  const auto isDone = [&]
  {
    return found.intra.size() >= counts.intra && (!hasMyelin || found.myelin.size() >= counts.myelin) &&
           (!hasExtra || found.extra.size() >= counts.extra);
  };
  // Every surface is made once per round: each round draws more points than the one before, as far as memory allows.
  std::uint64_t wanted = 8 * std::uint64_t(count) + 64;
  const std::uint64_t most = mostDrawn * wanted;
  std::uint64_t number = 0;
  for (; number < most && !isDone(); wanted = std::min(4 * wanted, mostAtOnce))
  {
    const auto drawn = std::size_t(std::min({ wanted, mostAtOnce, most - number }));
    std::vector<Eigen::Vector3d> candidates;
    candidates.reserve(drawn);
    for (std::size_t i = 0; i < drawn; ++i)
    {
      candidates.push_back(candidate(box, seed, number++));
    }
    std::vector<Place> places(drawn, Place::Outside);
    mark(outer, hasMyelin ? Place::InsideOuter : Place::InsideInner, candidates, places, context);
    mark(inner, Place::InsideInner, candidates, places, context);
    for (std::size_t i = 0; i < drawn; ++i)
    {
      switch (places[i])
      {
      case Place::Outside:
        take(candidates[i], hasExtra ? counts.extra : 0, found.extra);
        break;
      case Place::InsideInner:
        take(candidates[i], counts.intra, found.intra);
        break;
      case Place::InsideOuter:
        take(candidates[i], counts.myelin, found.myelin);
        break;
      case Place::OnSurface:
        break;
      }
    }
  }
  if (!isDone())
  {
    const Eigen::Vector3d size = box.upper - box.lower;
    const bool isEmpty = (counts.intra > 0 && found.intra.empty()) || (hasMyelin && counts.myelin > 0 && found.myelin.empty()) ||
                         (hasExtra && counts.extra > 0 && found.extra.empty());
    throw Infeasible(text("StartPositions ", count, ": of ", number, " points drawn in a box of ", size.x(), " × ", size.y(),
      " × ", size.z(), " µm, ", found.intra.size(), " lay in axons, ", found.myelin.size(), " in myelin and ", found.extra.size(),
      " outside: ", isEmpty ? "make a larger substrate, which has all of them there" : "ask for fewer"));
  }
  return found;
}

} // namespace cactus
