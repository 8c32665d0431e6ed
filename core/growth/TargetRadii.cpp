// SPDX-License-Identifier: BSD-3-Clause
#include "growth/TargetRadii.h"

#include "base/Error.h"
#include "base/Limits.h"
#include "growth/Arrivals.h"
#include "growth/CapsuleField.h"
#include "growth/Crowding.h"
#include "growth/RankedGrowth.h"
#include "growth/SectionShape.h"
#include "growth/VolumeInDomain.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

namespace cactus
{

namespace
{

/// Rounds of radius correction, and the samples that each counts: per fibre, and at least.
constexpr int rounds = 3;
constexpr double samplesPerFibre = 2000.0;
constexpr double fewestSamples = 5e5;
/// The fraction of a shortage corrected in one round: more than 1, since the surface that two fibres share moves by half of what
/// one is thickened.
constexpr double correction = 1.4;
/// Limits of a factor relative to its initial value.
constexpr FactorBounds factorBounds = { 1.2, 1.5 };
/// The usual relative difference between the volume that fibres fill at their target radii and that they were made for:
/// dispersion and winding lengthen them.
constexpr double usualDifference = 0.15;
/// Layers of samples in a slab, as in the blocks of a sweep.
constexpr int slabLayers = 16;

/// Layers of samples along z.
int layersOf(const Domain& domain, double spacing)
{
  return std::max(1, static_cast<int>(std::round(domain.size()[2] / spacing)));
}

/// Returns the samples of one slab of the domain. Every slab has its own lateral shift in every `round`, so that fibres along an
/// axis do not line up with the samples.
VoxelGrid slabGrid(const Domain& domain, double spacing, int slab, int round)
{
  const Eigen::Array3d size = domain.size().array();
  const int layers = layersOf(domain, spacing);
  const int slabs = (layers + slabLayers - 1) / slabLayers;
  // The low-discrepancy sequence in the plane by the smallest Pisot number of degree 3.
  const double n = slab + 0.5 + round * slabs;
  const double across[2] = { std::fmod(n * 0.7548776662466927, 1.0), std::fmod(n * 0.5698402909980532, 1.0) };
  VoxelGrid grid;
  grid.spacing = spacing;
  for (Eigen::Index axis = 0; axis < 2; ++axis)
  {
    grid.origin[axis] = domain.lower[axis] + across[axis] * spacing;
    grid.count[static_cast<std::size_t>(axis)] = static_cast<int>(std::ceil(size[axis] / spacing - across[axis]));
  }
  grid.origin[2] = domain.lower[2] + 0.5 * (size[2] - (layers - 1) * spacing);
  grid.lower[2] = slab * slabLayers;
  grid.count[2] = std::min(slabLayers, layers - grid.lower[2]);
  return grid;
}

/// Returns how many samples of the domain, `spacing` apart, each fibre holds after growth.
std::vector<double> countPerFibre(const Fibres& fibres, const FibreRadialGrowthOptions& options, double growth, double spacing,
  int round, const Context& context, double from, double to, const Sharing& sharing)
{
  FieldRelevance relevance;
  relevance.bestReach = growth;
  relevance.secondReach = growth;
  relevance.contrast = options.gap();
  const Eigen::AlignedBox3d domain(fibres.domain.lower, fibres.domain.upper);
  const double reach = growth + options.gap() + spacing;
  const CapsuleField field(fibres, seedOptions(fibres, options), domain, std::max(reach, 0.0), context.threadCount());
  Context sweeping = context;
  sweeping.threads = context.threadCount(); // fixed here, because it may change between calls
  std::vector<std::vector<std::uint64_t>> perThread(
    static_cast<std::size_t>(sweeping.threads), std::vector<std::uint64_t>(fibres.size(), 0));
  const auto gap = static_cast<float>(options.gap());
  const RankedGrowth growthOf(fibres, options, field, growth);

  const int slabs = (layersOf(fibres.domain, spacing) + slabLayers - 1) / slabLayers;
  for (int slab = sharing.place(); slab < slabs; slab += sharing.size())
  {
    const VoxelGrid grid = slabGrid(fibres.domain, spacing, slab, round);
    const double step = (to - from) / slabs;
    field.sweep(grid, relevance, sweeping, from + slab * step, from + (slab + 1) * step, "aiming at the target radii",
      [&](const FieldCell& cell, int thread)
      {
        auto& counts = perThread[static_cast<std::size_t>(thread)];
        cell.forEachSample(
          [&](int sample)
          {
            if (cell.best[sample] > static_cast<float>(-growthOf(cell.rank[sample])) &&
                cell.best[sample] - cell.second[sample] > gap)
            {
              ++counts[static_cast<std::size_t>(cell.rank[sample])];
            }
          });
      });
  }
  std::vector<std::uint64_t> sums(field.size(), 0);
  for (const auto& counts : perThread)
  {
    for (std::size_t rank = 0; rank < sums.size(); ++rank)
    {
      sums[rank] += counts[rank];
    }
  }
  sharing.addUp(sums);
  std::vector<double> samples(fibres.size(), 0.0);
  for (std::size_t rank = 0; rank < sums.size(); ++rank)
  {
    samples[field.fibre(static_cast<int>(rank))] = static_cast<double>(sums[rank]);
  }
  return samples;
}

/// The intended thickness of fibres: per fibre, the factor on its radii and the volume that it is to fill.
struct Aim
{
  std::vector<double> factors;
  std::vector<double> volumes;

  double volume() const { return std::accumulate(this->volumes.begin(), this->volumes.end(), 0.0); }
};

/// Returns the aim in which each fibre has its target radius.
Aim aimAtOwnRadii(const Fibres& fibres)
{
  Aim aim;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    aim.factors.push_back(fibres.targetRadii[f] / rootMeanSquareRadius(fibres, f));
    aim.volumes.push_back(volumeInDomain(fibres, f, aim.factors[f]));
  }
  return aim;
}

/// Scales the radii of all fibres by a common factor, so that they fill `volume`; with `keepsBare`, of all but axons without
/// myelin.
void scaleToVolume(const Fibres& fibres, double volume, bool keepsBare, Aim& aim)
{
  double kept = 0.0;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    kept += keepsBare && isBare(fibres, f) ? aim.volumes[f] : 0.0;
  }
  const double ratio = (volume - kept) / (aim.volume() - kept);
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    if (!keepsBare || !isBare(fibres, f))
    {
      aim.factors[f] *= std::sqrt(ratio);
      aim.volumes[f] *= ratio;
    }
  }
}

/// Changes the aim so that all capsules together, without overlaps, gaps and roughness, fill the volume `target`: little growth
/// remains. If they fill somewhat less than the volume `made` for which they were made, since the optimiser pushed some out of
/// the domain, their radii are scaled to fill as much of it as the target allows. For the rest they grow by the same amount.
/// Axons without myelin, which are thin, keep their volume if they slow down (`bareIsSlow`), and otherwise their share of it.
void fillTarget(const Fibres& fibres, double target, double made, bool bareIsSlow, Aim& aim)
{
  const double filled = std::min({ made, target, (1.0 + usualDifference) * aim.volume() });
  if (aim.volume() >= target)
  {
    scaleToVolume(fibres, target, false, aim);
    return;
  }
  if (aim.volume() < filled)
  {
    scaleToVolume(fibres, filled, bareIsSlow, aim);
  }
  const double volume = aim.volume();
  const double ofBare = bareIsSlow ? 1.0 : std::sqrt(target / volume);
  // All other radii grow by δ, so that the volumes w (1 + δ / r)² add up to the target.
  double more = target - volume;
  double linear = 0.0;
  double quadratic = 0.0;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    more -= isBare(fibres, f) ? aim.volumes[f] * (ofBare * ofBare - 1.0) : 0.0;
    linear += isBare(fibres, f) ? 0.0 : aim.volumes[f] / fibres.targetRadii[f];
    quadratic += isBare(fibres, f) ? 0.0 : aim.volumes[f] / (fibres.targetRadii[f] * fibres.targetRadii[f]);
  }
  const double thicker =
    linear > 0.0 ? std::min(more / (linear + std::sqrt(linear * linear + quadratic * more)), largestGrowth) : 0.0;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    const double ratio = isBare(fibres, f) ? ofBare : 1.0 + thicker / fibres.targetRadii[f];
    aim.factors[f] *= ratio;
    aim.volumes[f] *= ratio * ratio;
  }
}

std::vector<std::size_t> fromThinToThick(const Fibres& fibres)
{
  std::vector<std::size_t> order(fibres.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(
    order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return fibres.targetRadii[a] < fibres.targetRadii[b]; });
  return order;
}

/// Gives fibres that repeat the same factors in every period: the least of them.
void repeat(const Fibres& fibres, std::size_t f, std::vector<double>& factors)
{
  const std::size_t first = fibres.offsets[f];
  const std::size_t last = fibres.offsets[f + 1];
  const std::size_t period = periodOf(fibres, f).points;
  for (std::size_t p = first; p < first + period; ++p)
  {
    double least = factors[p];
    for (std::size_t other = p; other < last; other += period)
    {
      least = std::min(least, factors[other]);
    }
    for (std::size_t other = p; other < last; other += period)
    {
      factors[other] = least;
    }
  }
}

/// Thickens fibres that hold fewer than `density` samples per µm³ of the volume that they are to fill, and thins those that hold
/// more. What fibres lack that cannot get thicker is left to growth: by their shares of all samples the others would get thinner,
/// round after round.
void correctFactors(const std::vector<double>& counted, const std::vector<double>& wished, double density, Aim& aim)
{
  for (std::size_t f = 0; f < counted.size(); ++f)
  {
    const double expected = density * aim.volumes[f];
    if (expected > 0.0)
    {
      // The relative shortage of radius is half that of volume; that of a fibre of few samples is inaccurate.
      const double shortage = std::max(-1.0, 1.0 - counted[f] / expected);
      aim.factors[f] += 0.5 * correction * wished[f] * shortage * expected / (expected + 16.0);
    }
  }
}

void scaleRadii(const std::vector<double>& factors, const Fibres& fibres, Fibres& scaled)
{
  for (std::size_t p = 0; p < factors.size(); ++p)
  {
    scaled.radii[p] = std::clamp(factors[p] * fibres.radii[p], limits::radius.lowest, limits::radius.highest);
  }
}

} // namespace

Fibres aimAtTargetRadii(
  const Fibres& fibres, const FibreRadialGrowthOptions& options, const Context& context, const Sharing& sharing)
{
  return scaledBy(factorsForTargetRadii(fibres, options, context, sharing), fibres);
}

Fibres scaledBy(const std::vector<double>& factors, const Fibres& fibres)
{
  require(factors.empty() || factors.size() == fibres.radii.size(), "there must be one factor for each control point");
  Fibres scaled = fibres;
  scaleRadii(factors, fibres, scaled);
  return scaled;
}

std::vector<double> factorsForTargetRadii(
  const Fibres& fibres, const FibreRadialGrowthOptions& options, const Context& context, const Sharing& sharing)
{
  validate(fibres);
  validate(options);
  const double target = targetFraction(fibres, options);
  if (target <= 0.0)
  {
    return {};
  }
  Aim aim = aimAtOwnRadii(fibres);
  if (aim.volume() <= 0.0)
  {
    return {};
  }
  Fibres aimed = fibres;
  const bool bareIsSlow = slowsBare(fibres, options);
  fillTarget(fibres, target * fibres.domain.volume(), fibres.grownFraction * fibres.domain.volume(), bareIsSlow, aim);
  const std::vector<double> wished = aim.factors;
  const std::vector<Crowding> crowding = findCrowding(fibres, options, wished, factorBounds, context.threadCount());
  const std::vector<SectionShape> shapes = sectionShapes(fibres, seedOptions(fibres, options));
  // Thin fibres first: the limit of a fibre depends on the thinner ones.
  const std::vector<std::size_t> order = fromThinToThick(fibres);
  const double samples = std::max(fewestSamples, samplesPerFibre * static_cast<double>(fibres.size()));
  const double spacing = std::cbrt(fibres.domain.volume() / samples);
  std::vector<double> factors(fibres.points.size());
  const double density = layersOf(fibres.domain, spacing) / (spacing * spacing * fibres.domain.size()[2]);
  double growth = 0.0;
  bool isReached = true;
  for (int round = 0; round <= rounds; ++round)
  {
    for (const std::size_t f : order)
    {
      aim.factors[f] = std::clamp(aim.factors[f], wished[f] / factorBounds.thinning, wished[f] * factorBounds.thickening);
      std::fill(factors.begin() + std::ptrdiff_t(fibres.offsets[f]), factors.begin() + std::ptrdiff_t(fibres.offsets[f + 1]),
        aim.factors[f]);
      // Capsules of the initial radii leave each other room, as do seeds within them.
      const double least = std::min(1.0, wished[f]) / shapes[f].reach();
      limitFactors(crowding, fibres.offsets[f], fibres.offsets[f + 1], least, factors);
      if (fibres.domain.periodic[2])
      {
        repeat(fibres, f, factors);
      }
    }
    if (round == rounds)
    {
      break;
    }
    scaleRadii(factors, fibres, aimed);
    if (round == 0 || bareIsSlow)
    {
      const double most = bareIsSlow ? largestGrowth : 1.0;
      const double rough = roughGrowth(aimed, options, context, sharing);
      isReached = rough <= most;
      growth = std::min(rough, most);
    }
    const std::vector<double> counted =
      countPerFibre(aimed, options, growth, spacing, round, context, 0.3 * round / rounds, 0.3 * (round + 1) / rounds, sharing);
    const double all = std::accumulate(counted.begin(), counted.end(), 0.0);
    correctFactors(counted, wished, isReached ? density : all / aim.volume(), aim);
  }
  return factors;
}

std::string remarkOnTarget(const Fibres& fibres, const FibreRadialGrowthOptions& options)
{
  const double made = fibres.grownFraction;
  const double asked = options.targetFibreVolumeFraction;
  if (made <= 0.0 || asked == made)
  {
    return "";
  }
  const auto by = [](double ratio)
  {
    const double percent = std::round(100.0 * std::abs(ratio - 1.0));
    return percent >= 1.0 ? text("by about ", percent, " %") : std::string("by less than 1 %");
  };
  if (asked > 0.0)
  {
    return text("TargetFibreVolumeFraction is ", asked, ", and these fibres were made to fill ", made,
      " (GrownFibreVolumeFraction): they end ", asked < made ? "thinner" : "thicker", " than their TargetRadius, ",
      by(std::sqrt(asked / made)), " on average. Leave TargetFibreVolumeFraction at -1, or make the fibres for ", asked);
  }
  if (asked == 0.0)
  {
    return text("these fibres were made to fill ", made, " (GrownFibreVolumeFraction), and are grown by GrowthIterations (",
      options.growthIterations, " voxels), wherever that leads: for their TargetRadius leave TargetFibreVolumeFraction at -1");
  }
  const double full = aimAtOwnRadii(fibres).volume() / fibres.domain.volume();
  if (std::abs(full / made - 1.0) <= usualDifference)
  {
    return "";
  }
  return text("these fibres were made to fill ", made, " (GrownFibreVolumeFraction), and would fill ", full,
    " with their TargetRadius: they end ", full > made ? "thinner" : "thicker", ", ", by(std::sqrt(made / full)),
    " on average. For their TargetRadius give TargetFibreVolumeFraction ", std::round(1000.0 * full) / 1000.0);
}

} // namespace cactus
