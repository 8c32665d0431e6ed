// SPDX-License-Identifier: BSD-3-Clause
#include "surface/SurfaceRemarks.h"

#include "base/Error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace cactus
{

namespace
{

/// Voxel size, in radii of the thinnest fibre, above which the remark advises smaller voxels first.
constexpr double coarsestVoxel = 0.5;

constexpr char adviceOnFilters[] = "the filters of VTK promise nothing of this: choose Meshing CACTUS, fewer SincIterations or a "
                                   "larger SincPassBand, or a smaller "
                                   "TargetReduction";

std::string adviceFor(const std::vector<FibreSurfacePair>& pairs, double voxelSize, const LabelImageFacts& facts)
{
  double thinnest = std::numeric_limits<double>::infinity();
  double thickest = 0.0;
  for (const FibreSurfacePair& pair : pairs)
  {
    thinnest = pair.targetRadius > 0.0 ? std::min(thinnest, pair.targetRadius) : thinnest; // otherwise unknown
    thickest = std::max(thickest, pair.targetRadius);
  }
  std::string advice;
  const std::string radii = thickest > 0.0 ? text(" for fibres of radii ", thinnest, " to ", thickest, " µm") : std::string();
  if (voxelSize > coarsestVoxel * thinnest)
  {
    advice = text(
      "VoxelSize ", voxelSize, " µm is coarse", radii, ": choose ", coarsestVoxel * thinnest, " or less in FibreRadialGrowth");
  }
  if (2.0 * (facts.minimumGap + facts.surfaceTolerance) > thinnest)
  {
    advice += text(advice.empty() ? "" : "; ", "MinimumGap ", facts.minimumGap, " and SurfaceTolerance ", facts.surfaceTolerance,
      " µm are large", radii, ": choose smaller ones in FibreRadialGrowth");
  }
  return !advice.empty() ? advice
                         : text("choose a smaller VoxelSize (it is ", voxelSize, " µm", radii,
                             ") in FibreRadialGrowth, or a smaller GRatio or DecimationError here");
}

} // namespace

std::string notAsAsked(const std::vector<FibreSurfacePair>& pairs, double voxelSize, const LabelImageFacts& facts, bool byFilters)
{
  const auto count = [&](auto&& is) { return std::count_if(pairs.begin(), pairs.end(), is); };
  const auto in = [&](MyelinState state)
  { return count([state](const FibreSurfacePair& pair) { return pair.state == state && pair.isWanted; }); };
  const auto all = count([](const FibreSurfacePair& pair) { return pair.isWanted || pair.isFlawed; });
  const auto bad =
    count([](const FibreSurfacePair& pair) { return pair.isFlawed || (pair.isWanted && pair.state != MyelinState::AsAsked); });
  if (bad == 0)
  {
    return {};
  }
  std::string ways;
  const auto add = [&ways](std::ptrdiff_t number, const char* what)
  { ways += number > 0 ? text(ways.empty() ? "" : ", ", number, " ", what) : std::string(); };
  add(in(MyelinState::NoFibre), "without any surface (Myelin 4)");
  add(in(MyelinState::NoAxon), "without an axon (3)");
  add(in(MyelinState::Thicker), "with thicker myelin (2)");
  add(in(MyelinState::Thinner), "with thinner myelin (1)");
  add(count([](const FibreSurfacePair& pair) { return pair.isFlawed; }),
    "with a surface that meets itself or is nearer than MinimumGap to another fibre (Flawed)");
  return text(bad, " of ", all, " fibres are not as asked, see Fibre statistics: ", ways, "; ",
    byFilters ? adviceOnFilters : adviceFor(pairs, voxelSize, facts));
}

std::string remarkOnSwellings(
  const std::vector<FibreSurfacePair>& pairs, const LabelImageFacts& facts, const MyelinSurfaceOptions& options)
{
  if (options.swellingAmplitude == 0.0)
  {
    return {};
  }
  const double wall = wallOfMyelin(facts);
  std::ptrdiff_t axons = 0;
  std::ptrdiff_t limited = 0;
  double least = options.swellingAmplitude;
  for (const FibreSurfacePair& pair : pairs)
  {
    if (pair.gRatio > 0.0 && pair.targetGRatio > 0.0 && !pair.isBare())
    {
      const double most = (1.0 - (pair.targetRadius > 0.0 ? wall / pair.targetRadius : 0.0)) / pair.targetGRatio - 1.0;
      ++axons;
      limited += most < options.swellingAmplitude ? 1 : 0;
      least = std::min(least, std::max(most, 0.0));
    }
  }
  return limited == 0
           ? std::string()
           : text(limited, " of ", axons, " axons with myelin swell by less than SwellingAmplitude ", options.swellingAmplitude,
               ", since they stay inside their fibres, below a wall of ", wall, " µm: the most limited one by about ",
               0.01 * std::round(100.0 * least), "; SubstrateStatistics measures what is reached (BeadAmplitude)");
}

} // namespace cactus
