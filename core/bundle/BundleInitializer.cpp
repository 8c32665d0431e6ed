// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/BundleInitializer.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "base/Hash64.h"
#include "base/Limits.h"
#include "base/Memory.h"
#include "bundle/BundleLayout.h"
#include "bundle/BundlePacking.h"
#include "bundle/LinesInSpace.h"
#include "bundle/StationaryFlow.h"
#include "bundle/VaryingCalibre.h"
#include "fibres/JoinFibres.h"
#include "fibres/SelectFibres.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace cactus
{

namespace
{

/// Makes two bundles in layers with both their faces packed to a density.
std::vector<Bundle> packLayers(const BundleInitializerOptions& options, double density, const Context& context)
{
  if (options.crossingStyle == CrossingStyle::Interwoven)
  {
    // Narrow layers waste space along their walls: if one cannot reach its density, thicker layers may.
    constexpr double thickest = 6.0;
    for (double diameters = 1.5;; diameters *= 1.25)
    {
      std::vector<Bundle> bundles = layOutInterwoven(options, density, diameters);
      try
      {
        packFaces(bundles, options, context);
        return bundles;
      }
      catch (const Infeasible&)
      {
        if (1.25 * diameters > thickest)
        {
          throw;
        }
      }
    }
  }
  std::vector<Bundle> bundles = layOutSheets(options, density);
  packFaces(bundles, options, context);
  return bundles;
}

/// Returns the offset of a fibre that follows a flow, within its frame, from the straight line between its ends.
Eigen::Vector2d bendOf(const Bundle& bundle, const BundleInitializerOptions& options, std::size_t fibre, double share)
{
  if (bundle.paths.places.empty())
  {
    return Eigen::Vector2d::Zero();
  }
  const Eigen::Vector2d& from = bundle.bottom.centres[fibre];
  const Eigen::Vector2d straight = from + (bundle.top.centres[fibre] - from) * share;
  const Eigen::Vector2d bent = straight + bundle.paths.bend(fibre, share);
  if (options.isCutOut())
  {
    return bent - straight;
  }
  return bundle.top.frame(fibre).clampCentre(bent, bundle.bottom.radii[fibre]) - straight;
}

/// Appends a fibre without control points.
void addFibre(const Bundle& bundle, std::size_t circle, Fibres& fibres)
{
  fibres.addFibre(static_cast<int>(fibres.size()) + 1, bundle.id, bundle.bottom.radii[circle]);
  if (circle >= bundle.myelinated)
  {
    fibres.columns.set(targetGRatioColumn.name, fibres.size() - 1, bareGRatio);
  }
}

/// Appends fibres that repeat after the bundle's length, of which `around` (µm) is added beyond both ends of one period.
void appendRepeatedFibres(const Bundle& bundle, const BundleInitializerOptions& options, double around, Fibres& fibres)
{
  for (std::size_t i = 0; i < bundle.bottom.size(); ++i)
  {
    const double radius = bundle.bottom.radii[i];
    const int segments = std::max(3, static_cast<int>(std::lround(bundle.length / options.controlPointSpacing(radius))));
    const int beyond = std::max(1, static_cast<int>(std::ceil(around * segments / bundle.length)));
    std::vector<Eigen::Vector3d> period;
    for (int k = 0; k < segments; ++k)
    {
      const double share = static_cast<double>(k) / segments;
      const Eigen::Vector2d across = bundle.bottom.centres[i] + bendOf(bundle, options, i, share);
      period.emplace_back(across.x(), across.y(), (share - 0.5) * bundle.length);
    }
    addFibre(bundle, i, fibres);
    for (int k = -beyond; k <= segments + beyond; ++k)
    {
      const int periods = static_cast<int>(std::floor(static_cast<double>(k) / segments));
      const Eigen::Vector3d shift(0.0, 0.0, periods * bundle.length);
      fibres.addPoint(period[static_cast<std::size_t>(k - periods * segments)] + shift, radius);
    }
  }
}

void appendFibres(const Bundle& bundle, const BundleInitializerOptions& options, Fibres& fibres)
{
  // Exact for an axis along z: between walls, the first and last control points lie on the domain's faces.
  const auto place = [&](const Eigen::Vector2d& face, double w) -> Eigen::Vector3d
  { return bundle.turn * Eigen::Vector3d(face.x(), face.y(), w); };
  for (std::size_t i = 0; i < bundle.bottom.size(); ++i)
  {
    const double radius = bundle.bottom.radii[i];
    const Eigen::Vector3d first = place(bundle.bottom.centres[i], -0.5 * bundle.length);
    const Eigen::Vector3d last = place(bundle.top.centres[i], 0.5 * bundle.length);
    const double spacing = options.controlPointSpacing(radius);
    const int segments = std::max(2, static_cast<int>(std::lround((last - first).norm() / spacing)));
    addFibre(bundle, i, fibres);
    fibres.addPoint(first, radius);
    for (int k = 1; k < segments; ++k)
    {
      const double share = static_cast<double>(k) / segments;
      fibres.addPoint(first + (last - first) * share + place(bendOf(bundle, options, i, share), 0.0), radius);
    }
    fibres.addPoint(last, radius);
  }
}

Fibres fibresOf(const std::vector<Bundle>& bundles, const BundleInitializerOptions& options)
{
  Fibres fibres;
  fibres.domain = options.domain();
  fibres.grownFraction = options.grownFibreVolumeFraction;
  for (const Bundle& bundle : bundles)
  {
    options.border == Border::Periodic ? appendRepeatedFibres(bundle, options, surroundings(options).ends, fibres)
                                       : appendFibres(bundle, options, fibres);
  }
  return fibres;
}

/// Throws OutOfMemory if the fibres would not fit into memory.
void requireMemoryFor(const BundleInitializerOptions& options)
{
  const Eigen::Vector3d region = regionSize(options);
  const double turned = options.isLayered() ? std::sqrt(2.0) : 1.0;
  const double area = options.fibreVolumeFraction * region.x() * region.y() * turned;
  const double bare =
    options.unmyelinated.any() ? options.unmyelinatedShare() / meanCircleArea(options.unmyelinated.radii()) : 0.0;
  const double fibreCount = area * ((1.0 - options.unmyelinatedShare()) / meanCircleArea(options.radius) + bare);
  const double points = fibreCount * (2.0 + region.z() * turned / options.controlPointSpacing(0.0));
  TextStream what;
  what.precision(3);
  what << "Side " << options.side << " µm with " << fibreCount << " fibres";
  requireMemory(fibreCount * 600.0 + points * 160.0, what.str(), "choose a smaller Side, a smaller Margin or larger radii");
}

/// Returns the options with a seed of their own for each direction but z.
BundleInitializerOptions withOwnSeed(BundleInitializerOptions options)
{
  const Eigen::Vector3d axis = options.turn().col(2);
  if (axis != Eigen::Vector3d::UnitZ())
  {
    options.seed = hash64(axis.data(), sizeof(axis), options.seed);
  }
  return options;
}

/// Leaves out axons without myelin, the last ones first, until the others fill as nearly as possible `wanted` of the domain.
/// Returns the fraction that they fill.
double leaveOutBare(double wanted, Fibres& fibres)
{
  double filled = 0.0;
  std::vector<std::size_t> kept;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    const double own = isBare(fibres, f) ? capsuleVolumeInDomain(fibres, f) / fibres.domain.volume() : 0.0;
    if (filled + 0.5 * own <= wanted)
    {
      kept.push_back(f);
      filled += own;
    }
  }
  fibres = selectFibres(fibres, kept);
  std::iota(fibres.fibreIds.begin(), fibres.fibreIds.end(), 1);
  return filled;
}

Fibres initialiseSingle(const BundleInitializerOptions& asked, const Context& context, BundleInitializerReport& report)
{
  requireMemoryFor(asked);
  const BundleInitializerOptions options = withOwnSeed(asked);
  std::optional<StationaryFlow> flow;
  if (isStationary(options))
  {
    context.report(0.01, "Drawing the flow that fibres follow");
    flow = StationaryFlow::draw(options, context);
    report.sinuosity = flow->report().sinuosity;
  }
  const auto make = [&](double density, double bareSurplus)
  {
    std::vector<Bundle> bundles = { layOutSingle(options, density, bareSurplus) };
    packFaces(bundles, options, context, flow ? &*flow : nullptr);
    report.fibreVolumeFraction = bundles.front().bottom.density();
    report.meanDispersion = flow ? flow->report().meanAngle : orientationOf(bundles.front()).meanAngle;
    return fibresOf(bundles, options);
  };
  if (!options.isCutOut())
  {
    return make(options.fibreVolumeFraction, 1.0);
  }
  // Slanted fibres fill more of a volume than of a face, and the domain holds more or less of the bundle by chance.
  constexpr int rounds = 5;
  constexpr int roundsOfFew = 24; // which take no time
  constexpr std::size_t few = 1000;
  constexpr double tolerance = 0.01;
  constexpr double surelyPacked = 0.78; // by circles of nearly any radii
  const double densest = std::max(options.fibreVolumeFraction, std::min(1.1 * options.fibreVolumeFraction, surelyPacked));
  double density = options.fibreVolumeFraction / (flow ? flow->report().stretch : 1.0);
  std::optional<Fibres> best;
  double nearest = 0.0;
  double reached = 0.0;
  const double wantedBare = options.unmyelinatedShare() * options.fibreVolumeFraction;
  constexpr double mostBareSurplus = 8.0;
  double bareSurplus = 1.1; // by chance, there are fewer of them in the domain than elsewhere
  for (int round = 0; round < (best && best->size() <= few ? roundsOfFew : rounds); ++round)
  {
    Fibres fibres = make(density, bareSurplus);
    double bareMiss = 0.0;
    if (options.unmyelinated.any())
    {
      const double bare = leaveOutBare(wantedBare, fibres);
      bareMiss = std::abs(bare / wantedBare - 1.0);
      const double wider = bare < (1.0 - tolerance) * wantedBare ? std::min(1.1 * wantedBare / bare, 2.0) : 1.0;
      bareSurplus = std::min(bareSurplus * wider, mostBareSurplus);
    }
    const double filled = capsuleVolumeInDomain(fibres) / fibres.domain.volume();
    const double miss = std::max(bareMiss, std::abs(filled / options.fibreVolumeFraction - 1.0));
    if (!best || miss < nearest)
    {
      best = std::move(fibres);
      nearest = miss;
      reached = filled;
    }
    const double next = filled > 0.0 ? std::min(density * options.fibreVolumeFraction / filled, densest) : density;
    if (nearest <= tolerance || next == density)
    {
      break;
    }
    density = next;
  }
  report.fibreVolumeFraction = reached;
  return std::move(*best);
}

/// Makes crossing bundles in layers whose capsules fill the requested fraction of the domain. Their faces lie outside the domain,
/// and dispersed fibres that start and end within the faces crowd between them. So the density of the faces is a little lower; it
/// is found by iteration, scaled each time by the requested over the reached fraction.
Fibres initialiseLayers(const BundleInitializerOptions& options, const Context& context, BundleInitializerReport& report)
{
  requireMemoryFor(options);
  const double asked = options.fibreVolumeFraction;
  const double tilt = options.meanDispersion * degree;
  double density = asked * std::cos(tilt) * (1.0 - 0.5 * std::tan(tilt));
  std::optional<Fibres> best;
  const auto isNear = [&] { return best && std::abs(report.fibreVolumeFraction - asked) <= 0.05 * asked; };
  constexpr int rounds = 6;
  for (int round = 0; round < rounds || (round < 2 * rounds && !isNear()); ++round)
  {
    std::vector<Bundle> bundles;
    try
    {
      bundles = packLayers(options, density, context.part(0.5 * round / rounds, 0.5 * (round + 1) / rounds));
    }
    catch (const Infeasible&)
    {
      if (isNear())
      {
        break; // the previous layout is good enough
      }
      throw;
    }
    Fibres fibres = fibresOf(bundles, options);
    const double reached = capsuleVolumeInDomain(fibres) / fibres.domain.volume();
    if (!best || std::abs(reached - asked) < std::abs(report.fibreVolumeFraction - asked))
    {
      double angles = 0.0;
      report.layers = 0;
      for (const Bundle& bundle : bundles)
      {
        report.layers += options.isLayered() ? bundle.bottom.frames.size() : 0;
        angles += orientationOf(bundle).meanAngle * static_cast<double>(bundle.bottom.size());
      }
      report.fibreVolumeFraction = reached;
      report.meanDispersion = angles / static_cast<double>(fibres.size());
      best = std::move(fibres);
    }
    if (std::abs(reached - asked) <= std::min(0.004, 0.05 * asked) || reached <= 0.0)
    {
      break;
    }
    // Uses the square root if it alternates between two numbers of fibres.
    density = std::min(0.95, density * (round < rounds ? asked / reached : std::sqrt(asked / reached)));
  }
  if (!isNear())
  {
    TextStream message;
    message.precision(3);
    message << "FibreVolumeFraction " << asked << " cannot be reached with whole fibres of these radii: the nearest is "
            << report.fibreVolumeFraction << ". Enlarge Side, or lower MaximumRadius";
    throw Infeasible(message.str());
  }
  return std::move(*best);
}

Fibres initialiseAnywhere(const BundleInitializerOptions& options, const Context& context, BundleInitializerReport& report)
{
  requireMemoryFor(options);
  Fibres fibres = layLinesInSpace(options, context);
  report.fibreVolumeFraction = capsuleVolumeInDomain(fibres) / fibres.domain.volume();
  report.meanDispersion = meanDispersion(fibres);
  return fibres;
}

/// Makes two crossing bundles, each in the whole domain with half of the fractions.
Fibres initialiseInterpenetrating(
  const BundleInitializerOptions& options, const Context& context, BundleInitializerReport& report)
{
  std::vector<Fibres> bundles;
  const double half = 0.5 * options.crossingAngle * degree;
  double angles = 0.0;
  double sinuosities = 0.0;
  for (const double tilt : { half, -half })
  {
    BundleInitializerOptions one = options;
    one.numberOfBundles = 1;
    one.direction = Eigen::Vector3d(std::sin(tilt), 0.0, std::cos(tilt));
    one.fibreVolumeFraction *= 0.5;
    one.grownFibreVolumeFraction *= 0.5;
    one.unmyelinated.fraction *= 0.5;
    BundleInitializerReport reached;
    const double begin = 0.5 * static_cast<double>(bundles.size());
    bundles.push_back(initialiseSingle(one, context.part(begin, begin + 0.5), reached));
    const auto count = static_cast<double>(bundles.back().size());
    angles += reached.meanDispersion * count;
    sinuosities += reached.sinuosity * count;
    report.fibreVolumeFraction += reached.fibreVolumeFraction;
  }
  Fibres fibres = joinFibres(std::move(bundles));
  report.meanDispersion = angles / static_cast<double>(fibres.size());
  report.sinuosity = sinuosities / static_cast<double>(fibres.size());
  return fibres;
}

Fibres initialiseAny(const BundleInitializerOptions& options, const Context& context, BundleInitializerReport& report)
{
  if (options.isAnywhere())
  {
    return initialiseAnywhere(options, context, report);
  }
  if (options.isLayered())
  {
    return initialiseLayers(options, context, report);
  }
  return options.numberOfBundles == 2 ? initialiseInterpenetrating(options, context, report)
                                      : initialiseSingle(options, context, report);
}

} // namespace

Fibres initialiseBundles(const BundleInitializerOptions& options, const Context& context, BundleInitializerReport* report)
{
  options.validate();
  const double thinning = options.thinning();
  BundleInitializerOptions thinner = options;
  if (options.grownFibreVolumeFraction > 0.0)
  {
    thinner.radius = options.radius.scaled(thinning);
    thinner.unmyelinated = options.unmyelinated.scaled(thinning);
  }
  context.report(0.0, "Drawing radii");
  BundleInitializerReport reached;
  Fibres fibres = initialiseAny(thinner, context, reached);
  varyCalibreInDomain(withOwnSeed(thinner), fibres); // of all bundles, since growth fills the domain with all of them
  if (options.grownFibreVolumeFraction > 0.0)
  {
    for (double& radius : fibres.targetRadii)
    {
      radius /= thinning;
    }
  }
  if (report != nullptr)
  {
    *report = reached;
  }
  context.report(1.0, "Bundle initialised");
  return fibres;
}

} // namespace cactus
