// SPDX-License-Identifier: BSD-3-Clause
#include "growth/Crowding.h"

#include "fibres/Capsules.h"
#include "fibres/PeriodicImages.h"
#include "fibres/SegmentDistance.h"
#include "growth/Calibre.h"
#include "growth/SectionShape.h"
#include "optimiser/NeighbourSearch.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace cactus
{

namespace
{

using FibrePair = std::pair<std::uint32_t, std::uint32_t>;

FibrePair pairOf(const Crowding& crowding)
{
  return { crowding.thick, crowding.thin };
}

/// Returns, per capsule, by how much the fibre's seed may come to reach beyond it.
std::vector<float> reachesOf(
  const Capsules& capsules, const std::vector<SectionShape>& shapes, const std::vector<double>& wished, double thickening)
{
  std::vector<float> reaches(capsules.size());
  for (std::size_t k = 0; k < capsules.size(); ++k)
  {
    const double radius = std::max(capsules.bodies[k].r0, capsules.bodies[k].r1);
    const double farthest = shapes[capsules.fibre[k]].reach() * (thickening * wished[capsules.fibre[k]]);
    reaches[k] = static_cast<float>(std::max(0.0, farthest - 1.0) * radius);
  }
  return reaches;
}

/// Finds the capsules that could come so near to each other that one of the two is severed.
NeighbourList findNear(const Capsules& capsules, const std::vector<float>& reaches, int threads)
{
  NeighbourList neighbours;
  findNeighbours(capsules, reaches, threads, neighbours);
  return neighbours;
}

/// Keeps the entries of each pair of fibres that may limit the factor of the thicker one, room / radius + core / radius · the
/// factor of the thinner: those of which no other is tighter in both terms.
void keepTightest(std::vector<Crowding>& all)
{
  const auto terms = [](const Crowding& c) { return std::pair(c.room / c.radius, c.core / c.radius); };
  std::stable_sort(all.begin(), all.end(),
    [&](const Crowding& a, const Crowding& b) { return std::pair(pairOf(a), terms(a)) < std::pair(pairOf(b), terms(b)); });
  std::size_t kept = 0;
  for (const Crowding& crowding : all)
  {
    if (kept == 0 || pairOf(all[kept - 1]) != pairOf(crowding) || terms(crowding).second < terms(all[kept - 1]).second)
    {
      all[kept++] = crowding;
    }
  }
  all.resize(kept);
}

} // namespace

std::vector<Crowding> findCrowding(const Fibres& fibres, const FibreRadialGrowthOptions& options,
  const std::vector<double>& wished, const FactorBounds& bounds, int threads)
{
  Capsules capsules = capsulesOf(fibres);
  const std::size_t inPlace = capsules.size();
  const SeedOptions seeds = seedOptions(fibres, options);
  const std::vector<SectionShape> shapes = sectionShapes(fibres, seeds);
  if (fibres.domain.isPeriodic())
  {
    addImages(imagesWithin(fibres.domain, capsules, reachesOf(capsules, shapes, wished, bounds.thickening)), capsules);
  }
  const NeighbourList neighbours = findNear(capsules, reachesOf(capsules, shapes, wished, bounds.thickening), threads);
  const double smallestFraction = Calibre(seeds).smallestFraction();
  const auto end = [](const double* p) { return Eigen::Vector3d(p[0], p[1], p[2]); };
  std::vector<Crowding> all;
  for (std::size_t k = 0; k < inPlace; ++k)
  {
    const Capsule& thin = capsules.bodies[k];
    const double thinnest = std::min(thin.r0, thin.r1);
    const double core = shapes[capsules.fibre[k]].core() * (smallestFraction * thinnest);
    const double kept = options.gap() + 0.25 * thinnest;
    for (std::size_t n = neighbours.offsets[k]; n < neighbours.offsets[k + 1]; ++n)
    {
      const std::size_t other = neighbours.indices[n];
      const Capsule& thick = capsules.bodies[other];
      if (fibres.targetRadii[capsules.fibre[other]] <= fibres.targetRadii[capsules.fibre[k]])
      {
        continue;
      }
      const double distance = closestPoints(end(thin.p0), end(thin.p1), end(thick.p0), end(thick.p1)).distance;
      const double radius = shapes[capsules.fibre[other]].reach() * std::max(thick.r0, thick.r1);
      const Crowding crowding = { capsules.fibre[other], capsules.fibre[k], radius, distance - kept, core };
      const double farthest = bounds.thickening * wished[crowding.thick] * crowding.radius;
      if (farthest > crowding.room + wished[crowding.thin] / bounds.thinning * core)
      {
        all.push_back(crowding);
      }
    }
  }
  keepTightest(all);
  return all;
}

double largestFactor(const std::vector<Crowding>& crowding, std::size_t thick, const std::vector<double>& factors)
{
  const auto first = std::lower_bound(
    crowding.begin(), crowding.end(), thick, [](const Crowding& c, std::size_t fibre) { return c.thick < fibre; });
  double largest = std::numeric_limits<double>::infinity();
  for (auto c = first; c != crowding.end() && c->thick == thick; ++c)
  {
    largest = std::min(largest, (c->room + c->core * factors[c->thin]) / c->radius);
  }
  return largest;
}

} // namespace cactus
