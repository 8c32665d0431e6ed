// SPDX-License-Identifier: BSD-3-Clause
#include "growth/GrowthTarget.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "fibres/Capsules.h"
#include "fibres/SegmentDistance.h"
#include "growth/CapsuleField.h"
#include "optimiser/NeighbourSearch.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace cactus
{

namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double samplesForFraction = 8e6;
/// Width of the classes (µm) in which arrival times are counted.
constexpr double growthClass = 0.00025;
/// Growth beyond this (µm) is not looked for.
constexpr double largestGrowth = 8.0;
/// Rounds in which radii are corrected, and the samples that they count: per fibre, and at least.
constexpr int rounds = 3;
/// How much of a shortage is made up in one round: more than all, since the surface that two fibres share moves by half of what
/// one is thickened.
constexpr double step = 1.4;
constexpr double samplesPerFibre = 2000.0;
constexpr double fewestSamples = 5e5;
/// The most by which a factor ends up larger, or smaller, than the one that it starts from.
constexpr double mostThickening = 1.2;
constexpr double mostThinning = 1.5;
/// Samples are counted in slabs of this many layers, the blocks of a sweep.
constexpr int slabLayers = 16;

double largestRadius(const Fibres& fibres)
{
  return *std::max_element(fibres.radii.begin(), fibres.radii.end());
}

/// Of all samples: how many fibres reach only after some growth, by classes of that growth.
struct Arrivals
{
  double first = 0.0;                ///< growth at the lower end of the first class
  std::vector<std::uint64_t> counts; ///< samples that become part of a fibre in each class
  std::uint64_t reachable = 0;       ///< sum of counts
  std::uint64_t samples = 0;         ///< all samples
};

/// Counts over `grid` the growth at which each sample becomes part of a fibre, up to `reach`.
Arrivals countArrivals(
  const Fibres& fibres, const FibreRadialGrowthOptions& options, const VoxelGrid& grid, double reach, const Context& context)
{
  const double first = -largestRadius(fibres) - growthClass;
  const auto classes = std::size_t(std::ceil((reach - first) / growthClass)) + 1;
  const int threads = context.threadCount();
  std::vector<std::vector<std::uint64_t>> perThread(std::size_t(threads), std::vector<std::uint64_t>(classes, 0));
  FieldRelevance relevance;
  relevance.bestReach = reach;
  relevance.secondReach = reach;
  relevance.contrast = options.gap();
  const CapsuleField field(fibres, { options.surfaceRoughness, options.seed }, grid.box(), reach + options.gap() + grid.spacing);
  const auto gap = static_cast<float>(options.gap());
  field.sweep(grid, relevance, context, 0.3, 0.5, "finding the growth that reaches the target",
    [&](const FieldCell& cell, int thread)
    {
      auto& counts = perThread[std::size_t(thread)];
      cell.forEachSample(
        [&](int n)
        {
          const double arrival = -static_cast<double>(cell.best[n]);
          if (arrival < reach && cell.best[n] - cell.second[n] > gap)
          {
            ++counts[std::size_t((arrival - first) / growthClass)];
          }
        });
    });
  Arrivals arrivals;
  arrivals.first = first;
  arrivals.samples = grid.size();
  arrivals.counts.assign(classes, 0);
  for (const auto& counts : perThread)
  {
    for (std::size_t c = 0; c < classes; ++c)
    {
      arrivals.counts[c] += counts[c];
      arrivals.reachable += counts[c];
    }
  }
  return arrivals;
}

/// The growth at which `target` of the samples lie in a fibre; infinite where the counts end before.
double growthAt(const Arrivals& arrivals, double target)
{
  const double needed = target * static_cast<double>(arrivals.samples);
  double before = 0.0;
  for (std::size_t c = 0; c < arrivals.counts.size(); ++c)
  {
    const auto count = static_cast<double>(arrivals.counts[c]);
    if (count > 0.0 && before + count >= needed)
    {
      return arrivals.first + growthClass * (static_cast<double>(c) + (needed - before) / count);
    }
    before += count;
  }
  return infinity;
}

/// About `samples` points spread evenly over the domain.
VoxelGrid sampleGrid(const Domain& domain, double samples)
{
  const Eigen::Vector3d size = domain.size();
  VoxelGrid grid;
  grid.spacing = std::cbrt(domain.volume() / samples);
  for (int axis = 0; axis < 3; ++axis)
  {
    const int count = std::max(1, static_cast<int>(std::round(size[axis] / grid.spacing)));
    grid.count[static_cast<std::size_t>(axis)] = count;
    // Centred: what a side leaves over is shared by its two ends.
    grid.origin[axis] = domain.lower[axis] + 0.5 * (size[axis] - (count - 1) * grid.spacing);
  }
  return grid;
}

/// The growth at which the target is met over few samples: roughly how far to grow.
double roughGrowth(const Fibres& fibres, const FibreRadialGrowthOptions& options, const Context& context)
{
  Context quiet = context;
  quiet.progress = nullptr;
  const VoxelGrid grid = sampleGrid(fibres.domain, samplesForFraction / 64.0);
  return growthAt(countArrivals(fibres, options, grid, largestGrowth, quiet), options.targetFibreVolumeFraction);
}

/// Area (µm²) of the disc around `centre` across the unit vector `axis` that lies in the domain.
double discInDomain(const Domain& domain, const Eigen::Vector3d& centre, const Eigen::Vector3d& axis, double radius)
{
  const double depth = domain.depth(centre);
  if (depth >= radius || depth <= -radius)
  {
    return depth > 0.0 ? pi * radius * radius : 0.0;
  }
  // A sunflower: each point stands for the same area, and no line of points runs along the domain's faces.
  constexpr int points = 96;
  const Eigen::Vector3d side = axis.unitOrthogonal();
  const Eigen::Vector3d other = axis.cross(side);
  int inside = 0;
  for (int n = 0; n < points; ++n)
  {
    const double out = radius * std::sqrt((n + 0.5) / points);
    const double angle = n * goldenAngle;
    inside += domain.depth(centre + out * (std::cos(angle) * side + std::sin(angle) * other)) > 0.0;
  }
  return pi * radius * radius * inside / points;
}

/// Volume (µm³) that a fibre's chain fills in the domain with `factor` times its radii: its cross-sections along the centre line,
/// which is what a bent tube holds, and the two half balls at its ends.
double volumeInDomain(const Fibres& fibres, std::size_t f, double factor)
{
  double volume = 0.0;
  const std::size_t begin = fibres.offsets[f];
  const std::size_t last = fibres.offsets[f + 1] - 1;
  for (std::size_t p = begin; p < last; ++p)
  {
    const Eigen::Vector3d along = fibres.points[p + 1] - fibres.points[p];
    const double length = along.norm();
    const double radius = factor * std::min(fibres.radii[p], fibres.radii[p + 1]);
    const int steps = static_cast<int>(std::min(std::ceil(2.0 * length / radius), 1000.0));
    for (int n = 0; n < steps; ++n)
    {
      const double t = (n + 0.5) / steps;
      volume += length / steps *
                discInDomain(fibres.domain, fibres.points[p] + t * along, along / length,
                  factor * ((1.0 - t) * fibres.radii[p] + t * fibres.radii[p + 1]));
    }
  }
  const auto halfBall = [&](std::size_t end, std::size_t next)
  {
    constexpr int steps = 4;
    const Eigen::Vector3d out = (fibres.points[end] - fibres.points[next]).normalized();
    const double radius = factor * fibres.radii[end];
    for (int n = 0; n < steps; ++n)
    {
      const double t = (n + 0.5) / steps;
      volume +=
        radius / steps * discInDomain(fibres.domain, fibres.points[end] + t * radius * out, out, radius * std::sqrt(1.0 - t * t));
    }
  };
  halfBall(begin, begin + 1);
  halfBall(last, last - 1);
  return volume;
}

/// How many samples of the domain each fibre holds after growth, `spacing` apart. Every slab of samples is shifted across by an
/// amount of its own, that of `round` too, so that fibres along an axis do not line up with them.
std::vector<double> countPerFibre(const Fibres& fibres, const FibreRadialGrowthOptions& options, double growth, double spacing,
  int round, const Context& context, double from, double to)
{
  FieldRelevance relevance;
  relevance.bestReach = growth;
  relevance.secondReach = growth;
  relevance.contrast = options.gap();
  const Eigen::AlignedBox3d domain(fibres.domain.lower, fibres.domain.upper);
  const double reach = growth + options.gap() + spacing;
  const CapsuleField field(fibres, { options.surfaceRoughness, options.seed }, domain, std::max(reach, 0.0));
  std::vector<std::vector<std::uint64_t>> perThread(
    static_cast<std::size_t>(context.threadCount()), std::vector<std::uint64_t>(fibres.size(), 0));
  const auto gap = static_cast<float>(options.gap());
  const auto lowest = static_cast<float>(-growth);

  const Eigen::Array3d size = fibres.domain.size().array();
  const int layers = std::max(1, static_cast<int>(std::round(size[2] / spacing)));
  const int slabs = (layers + slabLayers - 1) / slabLayers;
  for (int slab = 0; slab < slabs; ++slab)
  {
    // The plane's low-discrepancy sequence of the least Pisot number of degree 3.
    const double n = slab + 0.5 + round * slabs;
    const double across[2] = { std::fmod(n * 0.7548776662466927, 1.0), std::fmod(n * 0.5698402909980532, 1.0) };
    VoxelGrid grid;
    grid.spacing = spacing;
    for (Eigen::Index axis = 0; axis < 2; ++axis)
    {
      grid.origin[axis] = fibres.domain.lower[axis] + across[axis] * spacing;
      grid.count[static_cast<std::size_t>(axis)] = static_cast<int>(std::ceil(size[axis] / spacing - across[axis]));
    }
    grid.origin[2] = fibres.domain.lower[2] + 0.5 * (size[2] - (layers - 1) * spacing);
    grid.lower[2] = slab * slabLayers;
    grid.count[2] = std::min(slabLayers, layers - grid.lower[2]);
    const double step = (to - from) / slabs;
    field.sweep(grid, relevance, context, from + slab * step, from + (slab + 1) * step, "aiming at the target radii",
      [&](const FieldCell& cell, int thread)
      {
        auto& counts = perThread[static_cast<std::size_t>(thread)];
        cell.forEachSample(
          [&](int sample)
          {
            if (cell.best[sample] > lowest && cell.best[sample] - cell.second[sample] > gap)
            {
              ++counts[static_cast<std::size_t>(cell.rank[sample])];
            }
          });
      });
  }
  std::vector<double> samples(fibres.size(), 0.0);
  for (std::size_t rank = 0; rank < field.size(); ++rank)
  {
    std::uint64_t sum = 0;
    for (const auto& counts : perThread)
    {
      sum += counts[rank];
    }
    samples[field.fibre(static_cast<int>(rank))] = static_cast<double>(sum);
  }
  return samples;
}

/// A thick fibre beside a thin one. Once the radii of either have changed by its factor, the thin one is whole where
/// thick factor · radius <= room + thin factor · core.
///
/// On the centre line of the thin fibre its own field is at least (1 - ρ) times its radius there, and that of the thick one at
/// most the latter's radius less the distance of the centre lines. Asked for is that the first is larger by the gap and half the
/// radius that came, so that a depth of a quarter of it is left.
struct Crowding
{
  std::uint32_t thick;
  std::uint32_t thin;
  double radius;
  double room;
  double core;
};

/// All pairs of fibres of which one could sever the other however the factors change from those `wished`, ordered
/// by thick and thin fibre.
std::vector<Crowding> findCrowding(
  const Fibres& fibres, const FibreRadialGrowthOptions& options, const std::vector<double>& wished, int threads)
{
  const Capsules capsules = capsulesOf(fibres);
  const auto radius = [&](std::size_t k) { return std::max(capsules.bodies[k].r0, capsules.bodies[k].r1); };
  const auto reach = [&](std::size_t k) { return std::max(0.0, mostThickening * wished[capsules.fibre[k]] - 1.0) * radius(k); };
  std::vector<float> reaches(capsules.size());
  for (std::size_t k = 0; k < capsules.size(); ++k)
  {
    reaches[k] = static_cast<float>(reach(k));
  }
  NeighbourList neighbours;
  findNeighbours(capsules, reaches, threads, neighbours);
  const auto end = [](const double* p) { return Eigen::Vector3d(p[0], p[1], p[2]); };
  std::vector<Crowding> all;
  for (std::size_t k = 0; k < capsules.size(); ++k)
  {
    const Capsule& thin = capsules.bodies[k];
    const double thinnest = std::min(thin.r0, thin.r1);
    const double core = (1.0 - options.surfaceRoughness) * thinnest;
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
      const Crowding crowding = { capsules.fibre[other], capsules.fibre[k], radius(other), distance - kept, core };
      if (mostThickening * wished[crowding.thick] * crowding.radius > crowding.room + wished[crowding.thin] / mostThinning * core)
      {
        all.push_back(crowding);
      }
    }
  }
  const auto pair = [](const Crowding& c) { return std::make_pair(c.thick, c.thin); };
  std::stable_sort(all.begin(), all.end(), [&](const Crowding& a, const Crowding& b) { return pair(a) < pair(b); });
  std::size_t pairs = 0;
  for (const Crowding& crowding : all)
  {
    if (pairs > 0 && pair(all[pairs - 1]) == pair(crowding))
    {
      // The tightest in every respect.
      Crowding& kept = all[pairs - 1];
      kept.radius = std::max(kept.radius, crowding.radius);
      kept.room = std::min(kept.room, crowding.room);
      kept.core = std::min(kept.core, crowding.core);
    }
    else
    {
      all[pairs++] = crowding;
    }
  }
  all.resize(pairs);
  return all;
}

} // namespace

Fibres aimAtTargetRadii(const Fibres& fibres, const FibreRadialGrowthOptions& options, const Context& context)
{
  validate(fibres);
  validate(options);
  Fibres aimed = fibres;
  if (options.targetFibreVolumeFraction <= 0.0)
  {
    return aimed;
  }
  const std::size_t count = fibres.size();
  std::vector<double> wanted(count);
  std::vector<double> factor(count);
  for (std::size_t f = 0; f < count; ++f)
  {
    double sum = 0.0;
    for (std::size_t p = fibres.offsets[f]; p < fibres.offsets[f + 1]; ++p)
    {
      sum += fibres.radii[p];
    }
    factor[f] = fibres.targetRadii[f] * static_cast<double>(fibres.pointCount(f)) / sum;
    wanted[f] = volumeInDomain(fibres, f, factor[f]);
  }
  const double wantedInAll = std::accumulate(wanted.begin(), wanted.end(), 0.0);
  if (wantedInAll <= 0.0)
  {
    return aimed;
  }
  // Capsules that fill the target, were it not for overlaps, gaps and roughness: little growth is left to come.
  const double target = options.targetFibreVolumeFraction * fibres.domain.volume();
  if (wantedInAll >= target)
  {
    for (double& m : factor)
    {
      m *= std::sqrt(target / wantedInAll);
    }
  }
  else
  {
    // All thicker by δ, that of the volumes w (1 + δ / r)² which add up to the target.
    double linear = 0.0;
    double quadratic = 0.0;
    for (std::size_t f = 0; f < count; ++f)
    {
      linear += wanted[f] / fibres.targetRadii[f];
      quadratic += wanted[f] / (fibres.targetRadii[f] * fibres.targetRadii[f]);
    }
    const double more = target - wantedInAll;
    const double thicker = std::min(more / (linear + std::sqrt(linear * linear + quadratic * more)), largestGrowth);
    for (std::size_t f = 0; f < count; ++f)
    {
      const double ratio = 1.0 + thicker / fibres.targetRadii[f];
      factor[f] *= ratio;
      wanted[f] *= ratio * ratio;
    }
  }
  const double thickenedInAll = std::accumulate(wanted.begin(), wanted.end(), 0.0);
  const std::vector<double> wished = factor;
  const std::vector<Crowding> crowding = findCrowding(fibres, options, wished, context.threadCount());
  // Thin fibres first: how thick a fibre may become depends on those thinner than it.
  std::vector<std::size_t> byThickness(count);
  std::iota(byThickness.begin(), byThickness.end(), std::size_t(0));
  std::stable_sort(byThickness.begin(), byThickness.end(),
    [&](std::size_t a, std::size_t b) { return fibres.targetRadii[a] < fibres.targetRadii[b]; });
  const double samples = std::max(fewestSamples, samplesPerFibre * static_cast<double>(count));
  const double spacing = std::cbrt(fibres.domain.volume() / samples);
  double growth = 0.0;
  for (int round = 0; round <= rounds; ++round)
  {
    for (const std::size_t f : byThickness)
    {
      factor[f] = std::min(std::max(factor[f], wished[f] / mostThinning), wished[f] * mostThickening);
      const auto first = std::lower_bound(
        crowding.begin(), crowding.end(), f, [](const Crowding& c, std::size_t thick) { return c.thick < thick; });
      double most = infinity;
      for (auto c = first; c != crowding.end() && c->thick == f; ++c)
      {
        most = std::min(most, (c->room + c->core * factor[c->thin]) / c->radius);
      }
      // Capsules of the radii that came leave each other room.
      factor[f] = std::min(factor[f], std::max(most, std::min(1.0, wished[f])));
      for (std::size_t p = fibres.offsets[f]; p < fibres.offsets[f + 1]; ++p)
      {
        aimed.radii[p] = factor[f] * fibres.radii[p];
      }
    }
    if (round == rounds)
    {
      break;
    }
    if (round == 0)
    {
      growth = std::min(roughGrowth(aimed, options, context), 1.0);
    }
    const std::vector<double> counted =
      countPerFibre(aimed, options, growth, spacing, round, context, 0.3 * round / rounds, 0.3 * (round + 1) / rounds);
    const double perVolume = std::accumulate(counted.begin(), counted.end(), 0.0) / thickenedInAll;
    for (std::size_t f = 0; f < count; ++f)
    {
      const double expected = perVolume * wanted[f];
      if (expected > 0.0)
      {
        // Half the relative shortage of volume is that of the radius; a fibre of few samples knows its own badly.
        const double shortage = std::max(-1.0, 1.0 - counted[f] / expected);
        factor[f] += 0.5 * step * wished[f] * shortage * expected / (expected + 16.0);
      }
    }
  }
  return aimed;
}

double growthFor(const Fibres& fibres, const FibreRadialGrowthOptions& options, const Context& context)
{
  validate(fibres);
  const VoxelGrid whole = growthGrid(fibres.domain, options);
  const double target = options.targetFibreVolumeFraction;
  if (target <= 0.0)
  {
    return options.growthIterations * whole.spacing;
  }

  // Few samples tell roughly how far to grow: the less far the many have to look, the faster.
  double reach = std::min(roughGrowth(fibres, options, context) + 0.1, largestGrowth);
  Arrivals arrivals = countArrivals(fibres, options, sampleGrid(fibres.domain, samplesForFraction), reach, context);
  while (!(growthAt(arrivals, target) < infinity) && reach < largestGrowth)
  {
    reach = std::min(reach + 2.0, largestGrowth);
    arrivals = countArrivals(fibres, options, sampleGrid(fibres.domain, samplesForFraction), reach, context);
  }
  const double growth = growthAt(arrivals, target);
  if (!(growth < infinity))
  {
    throw Infeasible(text("TargetFibreVolumeFraction ", target, " cannot be reached: growth fills at most ",
      static_cast<double>(arrivals.reachable) / static_cast<double>(arrivals.samples), " of the domain with MinimumGap ",
      options.minimumGap, " and SurfaceTolerance ", options.surfaceTolerance,
      " µm. Ask for less, make the gap smaller, or start from more fibres"));
  }
  // Roughness may leave a fibre no more than this part of its radius at any place.
  const auto thinnest = std::min_element(fibres.radii.begin(), fibres.radii.end());
  if (growth <= -*thinnest * (1.0 - options.surfaceRoughness))
  {
    const auto point = static_cast<std::size_t>(thinnest - fibres.radii.begin());
    const auto next = std::upper_bound(fibres.offsets.begin(), fibres.offsets.end(), point);
    const auto fibre = static_cast<std::size_t>(next - fibres.offsets.begin()) - 1;
    throw Infeasible(text("TargetFibreVolumeFraction ", target, " needs all fibres shrunk by ", -growth,
      " µm, which severs fibre ", fibres.fibreIds[fibre], " of radius ", *thinnest,
      " µm: ask for more, choose a smaller SurfaceRoughness, or start from fewer fibres"));
  }
  return growth;
}

} // namespace cactus
