// SPDX-License-Identifier: BSD-3-Clause
#include "surface/MyelinSurface.h"

#include "base/Error.h"
#include "base/Limits.h"
#include "base/Parallel.h"
#include "mesh/SurfaceSpacing.h"
#include "surface/FibreMesher.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <string>

namespace cactus
{

namespace
{

using Blocks = std::vector<std::uint32_t>;

/// Relative error of the axons' common volume that is good enough.
constexpr double volumeTolerance = 2e-3;
/// Size of a voxel, in radii of the thinnest fibre, above which it is the first thing to change.
constexpr double coarsestVoxel = 0.5;
/// µm by which those that are not coarsened, and so cannot be coarsened less, then lie deeper each time.
constexpr double deeperEachTime = 0.005;
/// How often outer surfaces that went wrong when they were moved are made again.
constexpr int remakes = 3;

std::vector<FibreSurfacePair> fibresOf(const LabelImageFacts& facts, const std::map<std::int32_t, Blocks>& blocksOf)
{
  require(facts.bundleIds.size() == facts.fibreIds.size() && facts.targetRadii.size() == facts.fibreIds.size() &&
            (facts.lengths.empty() || facts.lengths.size() == facts.fibreIds.size()),
    "the columns of the label image's FibreTable differ in length");
  std::vector<FibreSurfacePair> pairs(facts.fibreIds.size());
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    pairs[i].fibreId = facts.fibreIds[i];
    pairs[i].bundleId = facts.bundleIds[i];
    pairs[i].targetRadius = facts.targetRadii[i];
    pairs[i].isWanted = facts.lengths.empty() || !(facts.lengths[i] <= 0.0);
  }
  std::sort(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) { return a.fibreId < b.fibreId; });
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    if (pairs[i].fibreId < 1 || (i > 0 && pairs[i].fibreId == pairs[i - 1].fibreId))
    {
      throw InvalidInput(
        text("the label image's FibreTable names fibre ", pairs[i].fibreId, ": ids must count from 1 and be unique"));
    }
  }
  for (const auto& entry : blocksOf)
  {
    const bool known = std::binary_search(facts.fibreIds.begin(), facts.fibreIds.end(), entry.first) ||
                       std::find(facts.fibreIds.begin(), facts.fibreIds.end(), entry.first) != facts.fibreIds.end();
    if (!known)
    {
      throw InvalidInput(text("fibre ", entry.first, " of the label image is not in its FibreTable"));
    }
  }
  return pairs;
}

/// Keeps outer surfaces apart. One that comes to meet itself when it is moved, as a thin cap may that folds, is made again with
/// less coarsening there, or deeper where nothing is coarsened (`coarsens`).
template <typename BlocksOf>
void spaceOut(const FibreMesher& mesher, const BlocksOf& blocks, double gap, bool coarsens, std::vector<FibreSurfacePair>& pairs,
  const Context& context)
{
  std::vector<TriangleMesh*> outer;
  outer.reserve(pairs.size());
  for (FibreSurfacePair& pair : pairs)
  {
    outer.push_back(&pair.outer);
  }
  const Domain& box = mesher.field().box();
  std::vector<std::size_t> made(pairs.size());
  std::iota(made.begin(), made.end(), std::size_t(0));
  std::vector<std::size_t> tooNear; // as far as is known, increasing
  std::map<std::size_t, std::vector<LocalErrorBound>> bounds;
  for (int attempt = 0; !made.empty(); ++attempt)
  {
    // What was too near is looked at again, since the other one of the pair may be new.
    std::vector<std::size_t> changed;
    std::set_union(made.begin(), made.end(), tooNear.begin(), tooNear.end(), std::back_inserter(changed));
    const SpacingReport spacing =
      keepApart(outer, changed, gap, Eigen::AlignedBox3d(box.lower, box.upper), context, attempt == 0 ? 0.45 : 0.54, 0.55);
    tooNear = spacing.tooNear;
    std::vector<std::vector<Eigen::Vector3d>> faults(spacing.moved.size());
    parallelFor(faults.size(), context, [&](std::size_t i) { faults[i] = mesher.checkOuter(pairs[spacing.moved[i]]); });
    made.clear();
    for (std::size_t i = 0; i < faults.size(); ++i)
    {
      if (!faults[i].empty() && attempt < remakes)
      {
        const std::vector<LocalErrorBound> more = boundsAround(faults[i], mesher.field().image().grid.spacing, attempt);
        auto& known = bounds[spacing.moved[i]];
        known.insert(known.end(), more.begin(), more.end());
        made.push_back(spacing.moved[i]);
      }
      else
      {
        pairs[spacing.moved[i]].isFlawed = !faults[i].empty();
      }
    }
    parallelFor(made.size(), context,
      [&](std::size_t i)
      {
        FibreSurfacePair& pair = pairs[made[i]];
        pair.isFlawed = false; // of the surface that goes
        mesher.makeOuter(
          mesher.smoothed(blocks(pair), pair.fibreId), pair, bounds.at(made[i]), coarsens ? 0.0 : deeperEachTime * (attempt + 1));
      });
  }
  for (const std::size_t i : tooNear)
  {
    pairs[i].isFlawed = true;
  }
}

} // namespace

std::vector<FibreSurfacePair> myelinSurfaces(const LabelImageView& image, const LabelImageFacts& facts,
  const MyelinSurfaceOptions& options, const Context& context, const SurfaceFilters* filters)
{
  validate(options);
  requireWithin("MinimumGap of the label image", facts.minimumGap, limits::gap);
  requireWithin("SurfaceTolerance of the label image", facts.surfaceTolerance, limits::surfaceTolerance);
  if (options.decimationError > facts.surfaceTolerance * (1.0 + 1e-9))
  {
    throw InvalidInput(text("DecimationError ", options.decimationError, " is more than the room of ", facts.surfaceTolerance,
      " µm that growth left for moving surfaces: choose a smaller one, or raise SurfaceTolerance in FibreRadialGrowth"));
  }
  const FibreMesher mesher(image, facts, options, filters, context);
  const auto blocksOf = mesher.field().findFibres(options.smoothingIterations, context);
  std::vector<FibreSurfacePair> pairs = fibresOf(facts, blocksOf);
  static const Blocks none;
  const auto blocks = [&](const FibreSurfacePair& pair) -> const Blocks&
  {
    const auto found = blocksOf.find(pair.fibreId);
    return found == blocksOf.end() ? none : found->second;
  };

  parallelFor(
    pairs.size(), context,
    [&](std::size_t i)
    {
      FibreSurfacePair& pair = pairs[i];
      const SmoothedField field = mesher.smoothed(blocks(pair), pair.fibreId);
      mesher.makeOuter(field, pair);
      if (pair.state == MyelinState::NoFibre)
      {
        return;
      }
      switch (options.model)
      {
      case GRatioModel::Constant:
        pair.targetGRatio = options.gRatio;
        break;
      case GRatioModel::LogLinear:
        pair.targetGRatio = logLinearGRatio(mesher.equivalentDiameter(field, pair));
        break;
      case GRatioModel::Distributed:
        pair.targetGRatio = distributedGRatio(options.gRatio, options.gRatioDeviation, options.seed, pair.fibreId);
        break;
      case GRatioModel::TargetAxonVolumeFraction:
        break; // known once all volumes are
      }
    },
    "making outer surfaces", 0.05, 0.45);

  if (filters == nullptr)
  {
    spaceOut(mesher, blocks, std::max(facts.minimumGap, leastSeparation), options.decimationError > 0.0, pairs, context);
  }

  const auto makeInner = [&]
  {
    parallelFor(
      pairs.size(), context,
      [&](std::size_t i)
      {
        if (pairs[i].state != MyelinState::NoFibre)
        {
          mesher.makeInner(mesher.smoothed(blocks(pairs[i]), pairs[i].fibreId), pairs[i]);
        }
      },
      "making inner surfaces", 0.55, 1.0);
  };
  if (options.model != GRatioModel::TargetAxonVolumeFraction)
  {
    makeInner();
    return pairs;
  }

  // One g-ratio for all; where a fibre cannot have it, the others make up for that.
  const double wanted = options.targetAxonVolumeFraction * mesher.field().box().volume();
  double given = 0.0; // by fibres that cannot have the common g-ratio
  double open = 0.0;  // outer volume of the others
  double reached = 0.0;
  for (const FibreSurfacePair& pair : pairs)
  {
    open += pair.outerReport.volume;
  }
  const double fibreFraction = open / mesher.field().box().volume();
  double before = 0.0;
  double correction = 1.0; // for what the fibres' own tolerances sum up to
  for (int round = 0; round < 6; ++round)
  {
    double square = open > 0.0 ? correction * (wanted - given) / open : 2.0;
    if (square == before && reached > given)
    {
      correction *= (wanted - given) / (reached - given);
      square = correction * (wanted - given) / open;
    }
    before = square;
    if (!(square > 0.0 && square < 1.0))
    {
      break;
    }
    for (FibreSurfacePair& pair : pairs)
    {
      pair.targetGRatio = std::sqrt(square);
    }
    makeInner();
    given = open = reached = 0.0;
    for (const FibreSurfacePair& pair : pairs)
    {
      const double inner = pair.innerReport.volume;
      reached += inner;
      (pair.state == MyelinState::AsAsked ? open : given) += pair.state == MyelinState::AsAsked ? pair.outerReport.volume : inner;
    }
    if (std::abs(reached - wanted) <= volumeTolerance * wanted)
    {
      return pairs;
    }
  }
  throw Infeasible(text("TargetAxonVolumeFraction ", options.targetAxonVolumeFraction, " cannot be reached: the fibres fill ",
    fibreFraction, " of the box, and ",
    reached < wanted ? "with the thinnest myelin allowed their axons fill " : "the nearest that their axons come to is ",
    reached / mesher.field().box().volume(), ". Ask for another fraction, or grow the fibres further"));
}

std::string notAsAsked(
  const std::vector<FibreSurfacePair>& pairs, const LabelImageView& image, const LabelImageFacts& facts, bool byFilters)
{
  const auto count = [&](auto&& is) { return std::count_if(pairs.begin(), pairs.end(), is); };
  const auto in = [&](MyelinState state)
  { return count([state](const FibreSurfacePair& pair) { return pair.state == state && pair.isWanted; }); };
  const auto wanted = count([](const FibreSurfacePair& pair) { return pair.isWanted; });
  const auto bad =
    count([](const FibreSurfacePair& pair) { return pair.isFlawed || (pair.isWanted && pair.state != MyelinState::AsAsked); });
  if (bad == 0)
  {
    return {};
  }
  double thinnest = std::numeric_limits<double>::infinity();
  double thickest = 0.0;
  for (const FibreSurfacePair& pair : pairs)
  {
    thinnest = std::min(thinnest, pair.targetRadius);
    thickest = std::max(thickest, pair.targetRadius);
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
  std::string advice;
  const std::string radii = text(" for fibres of radii ", thinnest, " to ", thickest, " µm");
  if (image.grid.spacing > coarsestVoxel * thinnest)
  {
    advice = text("VoxelSize ", image.grid.spacing, " µm is coarse", radii, ": choose ", coarsestVoxel * thinnest,
      " or less in FibreRadialGrowth");
  }
  if (2.0 * (facts.minimumGap + facts.surfaceTolerance) > thinnest)
  {
    advice += text(advice.empty() ? "" : "; ", "MinimumGap ", facts.minimumGap, " and SurfaceTolerance ", facts.surfaceTolerance,
      " µm are large", radii, ": choose smaller ones in FibreRadialGrowth");
  }
  if (byFilters)
  {
    advice =
      "the filters of VTK promise nothing of this: choose Meshing CACTUS, fewer SincIterations or a larger SincPassBand, or a "
      "smaller TargetReduction";
  }
  else if (advice.empty())
  {
    advice = text("choose a smaller VoxelSize (it is ", image.grid.spacing, " µm", radii,
      ") in FibreRadialGrowth, or a smaller GRatio or DecimationError here");
  }
  return text(bad, " of ", wanted, " fibres are not as asked, see Fibre statistics: ", ways, "; ", advice);
}

} // namespace cactus
