// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/CurvedBundles.h"

#include "base/Error.h"
#include "base/Limits.h"
#include "base/Memory.h"
#include "bundle/BundleLayout.h"
#include "bundle/BundlePacking.h"
#include "bundle/FibreAlong.h"
#include "bundle/GuideCurves.h"
#include "bundle/VaryingCalibre.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace cactus
{

namespace
{

/// Returns the square of packed circles that is large enough for all places, with room beside it where the packing's own walls
/// show, and holds enough of them for the density to be accurate.
BundleInitializerOptions squareFor(const CurvedBundlesOptions& options, BundleInitializerOptions straight)
{
  constexpr double fewest = 64.0;
  const double needed = std::sqrt(fewest * meanCircleArea(straight.radius) / straight.fibreVolumeFraction);
  straight.length = 0.0;
  straight.side = std::max(needed, 2.0 * (std::max(options.reach(), farthestPlace(options)) + options.radius.maximum));
  straight.margin = 0.0;
  return straight;
}

/// Throws OutOfMemory if the circles, or the fibres in the domain, would not fit into memory.
void requireMemoryForCurves(const CurvedBundlesOptions& options, const BundleInitializerOptions& square)
{
  const double each = meanCircleArea(square.radius);
  const double circles = options.fibreVolumeFraction * square.side * square.side / each;
  const double points = circles * 2.0 * options.reachAlong() / square.controlPointSpacing(0.0);
  requireMemory(circles * 600.0 + points * 160.0, text("Side ", options.side, " µm with ", circles, " fibres"),
    "choose a smaller Side, a smaller Margin or larger radii");
}

/// Packs circles to a density and lays a fibre along the curve of each.
Fibres fibresAlongCurves(const CurvedBundlesOptions& options, const BundleInitializerOptions& square, double density,
  double thinning, const Context& context)
{
  std::vector<Bundle> bundles = { layOutSingle(square, density) };
  packFaces(bundles, square, context);
  const Circles& circles = bundles.front().bottom;
  Fibres fibres;
  fibres.domain = options.domain();
  for (std::size_t i = 0; i < circles.size(); ++i)
  {
    const GuideCurve curve = guideCurve(options, circles.centres[i].x());
    std::vector<Eigen::Vector3d> line;
    line.reserve(curve.points.size());
    for (const Eigen::Vector2d& point : curve.points)
    {
      line.emplace_back(point.x(), circles.centres[i].y(), point.y());
    }
    const double radius = circles.radii[i];
    addFibreAlong(
      line, curve.bundleId, { radius, radius / thinning, options.margin, square.controlPointSpacing(radius) }, fibres);
  }
  return fibres;
}

/// A small domain holds more or less of a bundle by chance: of several packings, the one that fills it most nearly as asked.
Fibres nearestToFraction(const CurvedBundlesOptions& options, const BundleInitializerOptions& square, double thinning,
  double fraction, const Context& context)
{
  constexpr int rounds = 5;
  constexpr int roundsOfFew = 24; // which take no time
  constexpr std::size_t few = 1000;
  constexpr double tolerance = 0.01;
  constexpr double surelyPacked = 0.78; // by circles of nearly any radii
  const double densest = std::max(options.fibreVolumeFraction, std::min(1.1 * options.fibreVolumeFraction, surelyPacked));
  double density = options.fibreVolumeFraction;
  Fibres best;
  double nearest = 0.0;
  for (int round = 0; round == 0 || round < (best.size() <= few ? roundsOfFew : rounds); ++round)
  {
    Fibres fibres;
    try
    {
      fibres = fibresAlongCurves(options, square, density, thinning, context);
    }
    catch (const Infeasible&)
    {
      if (round == 0)
      {
        throw;
      }
      break; // the nearest so far is good enough
    }
    const double filled = capsuleVolumeInDomain(fibres) / fibres.domain.volume();
    const double miss = std::abs(filled / fraction - 1.0);
    if (round == 0 || miss < nearest)
    {
      best = std::move(fibres);
      nearest = miss;
    }
    const double next = filled > 0.0 ? std::min(density * fraction / filled, densest) : density;
    if (nearest <= tolerance || next == density)
    {
      break;
    }
    density = next;
  }
  return best;
}

} // namespace

Fibres layCurvedBundles(const CurvedBundlesOptions& options, const Context& context, double* fibreVolumeFraction)
{
  options.validate();
  context.report(0.0, "Packing circles");
  BundleInitializerOptions straight = options.straightBundle();
  const double thinning = straight.thinning();
  straight.radius = options.radius.scaled(thinning);
  const BundleInitializerOptions square = squareFor(options, straight);
  requireMemoryForCurves(options, square);
  const double fraction = options.fibreVolumeFraction * bundlesShare(options);
  Fibres fibres = nearestToFraction(options, square, thinning, fraction, context);
  if (fibres.size() == 0)
  {
    throw Infeasible("no fibre comes into the domain: enlarge FibreVolumeFraction, Side or KissDistance");
  }
  varyCalibreInDomain(straight, fibres);
  const double filled = capsuleVolumeInDomain(fibres) / fibres.domain.volume();
  fibres.grownFraction =
    options.grownFibreVolumeFraction > 0.0 ? std::min(filled / (thinning * thinning), limits::fraction.highest) : 0.0;
  validate(fibres);
  if (fibreVolumeFraction != nullptr)
  {
    *fibreVolumeFraction = filled;
  }
  context.report(1.0, "Fibres laid");
  return fibres;
}

} // namespace cactus
