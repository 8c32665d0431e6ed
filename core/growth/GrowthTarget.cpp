// SPDX-License-Identifier: BSD-3-Clause
#include "growth/GrowthTarget.h"

#include "base/Error.h"
#include "growth/Arrivals.h"
#include "growth/Calibre.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cactus
{

SolvedGrowth growthFor(
  const Fibres& fibres, const FibreRadialGrowthOptions& options, const Context& context, const Sharing& sharing)
{
  validate(fibres);
  const VoxelGrid whole = growthGrid(fibres.domain, options);
  const double target = targetFraction(fibres, options);
  if (target <= 0.0)
  {
    return { options.growthIterations * whole.spacing };
  }

  // Few samples give a rough estimate: the smaller the reach of the full count, the faster it is.
  double reach = std::min(roughGrowth(fibres, options, context, sharing) + 0.1, largestGrowth);
  Arrivals arrivals = countArrivals(fibres, options, sampleGrid(fibres.domain, samplesForTarget), reach, context, sharing);
  while (!std::isfinite(growthAt(arrivals, target)) && reach < largestGrowth)
  {
    reach = std::min(reach + 2.0, largestGrowth);
    arrivals = countArrivals(fibres, options, sampleGrid(fibres.domain, samplesForTarget), reach, context, sharing);
  }
  const double growth = growthAt(arrivals, target);
  if (!std::isfinite(growth))
  {
    if (arrivals.reachable == 0)
    {
      throw Infeasible(text("TargetFibreVolumeFraction ", target, " cannot be reached: growth by ", largestGrowth,
        " µm brings no fibre into the domain. Check its position"));
    }
    return { growthOfAll(arrivals), static_cast<double>(arrivals.reachable) / static_cast<double>(arrivals.samples) };
  }
  const auto thinnest = std::min_element(fibres.radii.begin(), fibres.radii.end());
  const auto point = static_cast<std::size_t>(thinnest - fibres.radii.begin());
  const auto next = std::upper_bound(fibres.offsets.begin(), fibres.offsets.end(), point);
  const auto fibre = static_cast<std::size_t>(next - fibres.offsets.begin()) - 1;
  const SeedOptions seeds = seedOptions(fibres, options);
  const double core = sectionShapes(fibres, seeds)[fibre].core();
  if (growth <= -*thinnest * Calibre(seeds).smallestFraction() * core)
  {
    throw Infeasible(text("TargetFibreVolumeFraction ", target, " needs all fibres shrunk by ", -growth,
      " µm, which severs fibre ", fibres.fibreIds[fibre], " of radius ", *thinnest,
      " µm: ask for more, choose a smaller SurfaceRoughness, or start from fewer fibres"));
  }
  return { growth };
}

std::string remarkOnGrowth(const Fibres& fibres, const FibreRadialGrowthOptions& options, const SolvedGrowth& solved)
{
  if (solved.fraction <= 0.0)
  {
    return "";
  }
  return text("TargetFibreVolumeFraction ", targetFraction(fibres, options), " cannot be reached: the fibres fill ",
    solved.fraction, " of the domain, which is the most with MinimumGap ", options.minimumGap, " and SurfaceTolerance ",
    options.surfaceTolerance, " µm. For more, make the gap smaller, or start from more fibres");
}

} // namespace cactus
