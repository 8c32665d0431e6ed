// SPDX-License-Identifier: BSD-3-Clause
#include "growth/Crowding.h"

#include "fibres/Capsules.h"
#include "fibres/PeriodicImages.h"
#include "fibres/SegmentDistance.h"
#include "growth/Calibre.h"
#include "growth/SectionShape.h"
#include "optimiser/NeighbourSearch.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace cactus
{

namespace
{

/// Returns, per capsule, by how much the fibre's seed may come to reach beyond it, with its part of the gap (µm).
std::vector<float> reachesOf(const Capsules& capsules, const std::vector<SectionShape>& shapes, const std::vector<double>& wished,
  double thickening, double gap)
{
  std::vector<float> reaches(capsules.size());
  for (std::size_t k = 0; k < capsules.size(); ++k)
  {
    const double radius = std::max(capsules.bodies[k].r0, capsules.bodies[k].r1);
    const double farthest = shapes[capsules.fibre[k]].reach() * (thickening * wished[capsules.fibre[k]]);
    reaches[k] = static_cast<float>(std::max(0.0, farthest - 1.0) * radius + 0.5 * gap);
  }
  return reaches;
}

} // namespace

std::vector<Crowding> findCrowding(const Fibres& fibres, const FibreRadialGrowthOptions& options,
  const std::vector<double>& wished, const FactorBounds& bounds, int threads)
{
  Capsules capsules = capsulesOf(fibres);
  const std::size_t inPlace = capsules.size();
  const SeedOptions seeds = seedOptions(fibres, options);
  const std::vector<SectionShape> shapes = sectionShapes(fibres, seeds);
  std::vector<CapsuleImage> images;
  if (fibres.domain.isPeriodic())
  {
    const std::vector<float> reaches = reachesOf(capsules, shapes, wished, bounds.thickening, options.gap());
    images = imagesWithin(fibres.domain, capsules, reaches);
    addImages(images, capsules);
  }
  NeighbourList neighbours;
  findNeighbours(capsules, reachesOf(capsules, shapes, wished, bounds.thickening, options.gap()), threads, neighbours);
  const double smallestFraction = Calibre(seeds).smallestFraction();
  const auto end = [](const double* p) { return Eigen::Vector3d(p[0], p[1], p[2]); };
  std::vector<Crowding> all;
  for (std::size_t k = 0; k < inPlace; ++k)
  {
    const Capsule& thin = capsules.bodies[k];
    const double thinnest = std::min(thin.r0, thin.r1);
    const double core = shapes[capsules.fibre[k]].core() * (smallestFraction * thinnest);
    const double kept = options.gap() + 0.75 * thinnest;
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
      const double room = distance - kept;
      const double farthest = bounds.thickening * wished[capsules.fibre[other]] * radius;
      if (farthest > room + wished[capsules.fibre[k]] / bounds.thinning * core)
      {
        const std::size_t own = other < inPlace ? other : images[other - inPlace].capsule;
        all.push_back(
          { capsules.first[own], capsules.first[k], static_cast<float>(room / radius), static_cast<float>(core / radius) });
      }
    }
  }
  // The order of those of one point does not matter.
  std::sort(all.begin(), all.end(), [](const Crowding& a, const Crowding& b) { return a.thickPoint < b.thickPoint; });
  return all;
}

void limitFactors(
  const std::vector<Crowding>& crowding, std::size_t first, std::size_t last, double least, std::vector<double>& factors)
{
  auto c = std::lower_bound(
    crowding.begin(), crowding.end(), first, [](const Crowding& entry, std::size_t point) { return entry.thickPoint < point; });
  for (; c != crowding.end() && c->thickPoint < last; ++c)
  {
    const double ofThin = std::min(factors[c->thinPoint], factors[c->thinPoint + 1]);
    const double largest = std::max(least, double(c->room) + double(c->core) * ofThin);
    factors[c->thickPoint] = std::min(factors[c->thickPoint], largest);
    factors[c->thickPoint + 1] = std::min(factors[c->thickPoint + 1], largest);
  }
}

} // namespace cactus
