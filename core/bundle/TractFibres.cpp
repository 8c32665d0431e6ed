// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/TractFibres.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "base/Limits.h"
#include "base/Memory.h"
#include "bundle/BundleLayout.h"
#include "bundle/BundlePacking.h"
#include "bundle/FibreAlong.h"
#include "bundle/TractPath.h"
#include "bundle/VaryingCalibre.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace cactus
{

namespace
{

/// The smallest bend radius of a path, in radii of its bundle.
constexpr double leastBend = 1.1;
/// Least number of packed circles for the density to be accurate.
constexpr double fewestCircles = 64.0;
/// How near to its fraction a bundle that covers the domain has to come, in so many attempts, with this density of circles at
/// most.
constexpr double tolerance = 0.01;
constexpr int mostRounds = 8;
constexpr double densest = 0.95;

/// Sizes (µm) that follow from the options.
struct TractSizes
{
  BundleInitializerOptions straight; ///< the bundle with its fibres as thin as they start
  double thinning = 1.0;
  double reach = 0.0; ///< largest distance from the domain's middle of a fibre that still enters the domain
};

TractSizes sizesOf(const TractFibresOptions& options)
{
  TractSizes sizes;
  sizes.straight = options.straightBundle();
  sizes.thinning = sizes.straight.thinning();
  sizes.straight.radius = options.radius.scaled(sizes.thinning);
  sizes.straight.unmyelinated = options.unmyelinated.scaled(sizes.thinning);
  const Eigen::Vector3d half = (0.5 * options.domain().size()).array() + options.margin + options.radius.maximum;
  sizes.reach = options.length > 0.0 ? half.norm() : std::sqrt(3.0) * half.x();
  return sizes;
}

/// Returns the length of a stretch within the domain (µm).
double lengthWithin(const std::vector<Eigen::Vector3d>& points, const Domain& domain)
{
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i)
  {
    const auto part = domain.clip(points[i - 1], points[i]);
    length += std::max(0.0, part[1] - part[0]) * (points[i] - points[i - 1]).norm();
  }
  return length;
}

/// The streamlines that enter the domain, sampled as coarsely as a bundle that covers it allows.
struct ChosenStretches
{
  std::vector<StreamlinePlace> places;
  double length = 0.0; ///< µm, total within the domain
};

ChosenStretches stretchesWithin(
  const Streamlines& streamlines, const StreamlineChoice& choice, const TractFibresOptions& options, double reach)
{
  ChosenStretches chosen;
  for (const StreamlinePlace& place : choice.places)
  {
    const TractStretch stretch = stretchAround(streamlines, place, choice.middle, options.scale(), 2.0 * reach, reach / 64.0);
    const double length = lengthWithin(stretch.points, options.domain());
    if (length > 0.0)
    {
      chosen.places.push_back(place);
      chosen.length += length;
    }
  }
  return chosen;
}

/// Throws OutOfMemory if the circles of one bundle, or the fibres in the domain, would not fit into memory.
void requireMemoryForTract(const TractFibresOptions& options, const TractSizes& sizes, double radius)
{
  const double each = meanCircleArea(sizes.straight.radius);
  const double circles = fewestCircles + options.fibreVolumeFraction * 4.0 * radius * radius / each;
  const Eigen::Array3d widths = options.domain().size().array() + 2.0 * (options.margin + options.radius.maximum);
  const double points = options.fibreVolumeFraction * widths.prod() / (each * sizes.straight.controlPointSpacing(0.0));
  requireMemory(circles * 600.0 + points * 160.0, text("Side ", options.side, " µm with ", circles, " fibres"),
    "choose a smaller Side, a smaller Margin or larger radii");
}

/// A fibre's place in its bundle's cross-section.
struct PlacedCircle
{
  Eigen::Vector2d centre;
  double radius;
  bool isBare; ///< whether the fibre has no myelin
};

/// Returns packed circles around the origin whose area comes as near as whole circles allow to the requested fraction of a disc
/// plus `owed`, which receives the missing area (µm²).
std::vector<PlacedCircle> circlesWithin(
  double radius, const TractSizes& sizes, double density, std::size_t path, double& owed, const Context& context)
{
  BundleInitializerOptions square = sizes.straight;
  square.fibreVolumeFraction = density;
  const double needed = std::sqrt(fewestCircles * meanCircleArea(square.radius) / square.fibreVolumeFraction);
  square.side = std::max({ 2.0 * (radius + square.radius.maximum), 4.0 * square.radius.maximum, needed });
  square.length = 0.0;
  square.margin = 0.0;
  square.seed = sizes.straight.seed + (static_cast<std::uint64_t>(path) << 32); // users' seeds have 31 bits
  std::vector<Bundle> bundles = { layOutSingle(square, square.fibreVolumeFraction) };
  packFaces(bundles, square, context);
  const Circles& circles = bundles.front().bottom;

  std::vector<std::size_t> order(circles.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b) { return circles.centres[a].squaredNorm() < circles.centres[b].squaredNorm(); });
  owed += square.fibreVolumeFraction * pi * radius * radius;
  std::vector<PlacedCircle> placed;
  Eigen::Vector2d balance = Eigen::Vector2d::Zero();
  double area = 0.0;
  for (const std::size_t i : order)
  {
    const double own = pi * circles.radii[i] * circles.radii[i];
    if (own >= 2.0 * owed)
    {
      break;
    }
    owed -= own;
    area += own;
    balance += own * circles.centres[i];
    placed.push_back({ circles.centres[i], circles.radii[i], i >= bundles.front().myelinated });
  }
  for (PlacedCircle& circle : placed)
  {
    circle.centre -= balance / area;
  }
  return placed;
}

/// Carries the circles along a path.
void addBundle(const TractPath& path, const std::vector<PlacedCircle>& circles, int bundleId, const TractFibresOptions& options,
  double thinning, Fibres& fibres)
{
  for (const PlacedCircle& circle : circles)
  {
    std::vector<Eigen::Vector3d> line;
    line.reserve(path.points.size());
    for (std::size_t i = 0; i < path.points.size(); ++i)
    {
      line.push_back(path.beside(i, circle.centre));
    }
    addFibreAlong(line, bundleId,
      { circle.radius, circle.radius / thinning, options.margin, options.straightBundle().controlPointSpacing(circle.radius),
        circle.isBare },
      fibres);
  }
}

/// Sets the fraction that growth is to fill, in proportion to the fibres' fraction of the domain.
void setGrownFraction(const TractFibresOptions& options, double thinning, double reached, bool isOne, Fibres& fibres)
{
  const double grown = reached / (thinning * thinning);
  if (grown > limits::fraction.highest)
  {
    throw Infeasible(text("the fibres would fill ", grown, " of the domain: ",
      isOne ? "enlarge Side, lower MaximumRadius, or try another Seed"
            : "the bundles of its streamlines overlap, so choose a smaller BundleDiameter or NumberOfStreamlines"));
  }
  fibres.grownFraction = options.grownFibreVolumeFraction > 0.0 ? grown : 0.0;
}

/// Returns the number of streamline ends in the domain.
int endsWithin(const TractStretch& stretch, const Domain& domain)
{
  return static_cast<int>(
    std::count_if(stretch.ends.begin(), stretch.ends.end(), [&](const Eigen::Vector3d& end) { return domain.depth(end) > 0.0; }));
}

/// Lays the fibres around all chosen streamlines: bundles of a radius (µm), whose circles have a density.
Fibres layBundles(const Streamlines& streamlines, const StreamlineChoice& choice, const ChosenStretches& chosen,
  const TractFibresOptions& options, const TractSizes& sizes, double radius, double density, const Context& context,
  TractFibresReport& reached)
{
  const bool coversDomain = chosen.places.size() == 1 && options.bundleDiameter == 0.0;
  Fibres fibres;
  fibres.domain = options.domain();
  reached.streamlines = chosen.places.size();
  reached.bundleDiameter = 2.0 * radius;
  reached.middle = choice.middle;
  double owed = 0.0;
  const double far = 1.5 * (sizes.reach + radius);
  for (std::size_t p = 0; p < chosen.places.size(); ++p)
  {
    context.checkpoint();
    const StreamlinePlace& place = chosen.places[p];
    TractStretch stretch = stretchAround(streamlines, place, choice.middle, options.scale(), far, radius / 16.0);
    const double smoothing = roundOff(stretch, leastBend * radius);
    if (coversDomain && smoothing > 0.0)
    {
      bringToOrigin(stretch, far);
    }
    reached.smoothing = std::max(reached.smoothing, smoothing);
    reached.ends += endsWithin(stretch, fibres.domain);
    const TractPath path = pathThrough(stretch, sizes.reach, radius);
    const int bundleId = streamlines.bundleIds.empty() ? static_cast<int>(p) + 1 : streamlines.bundleIds[place.streamline];
    const double share = 1.0 / static_cast<double>(chosen.places.size());
    const Context part = context.part(static_cast<double>(p) * share, static_cast<double>(p + 1) * share);
    addBundle(path, circlesWithin(radius, sizes, density, p, owed, part), bundleId, options, sizes.thinning, fibres);
  }
  if (fibres.size() == 0)
  {
    throw Infeasible("no fibre comes into the domain: enlarge BundleDiameter, FibreVolumeFraction or Side");
  }
  varyCalibre(sizes.straight, fibres);
  reached.fibreVolumeFraction = capsuleVolumeInDomain(fibres) / fibres.domain.volume();
  return fibres;
}

} // namespace

Fibres layTractFibres(
  const Streamlines& streamlines, const TractFibresOptions& options, const Context& context, TractFibresReport* report)
{
  options.validate();
  validate(streamlines);
  context.report(0.0, "Choosing streamlines");
  const TractSizes sizes = sizesOf(options);
  const StreamlineChoice choice = chooseStreamlines(streamlines, options, sizes.reach / options.scale());
  const ChosenStretches chosen = stretchesWithin(streamlines, choice, options, sizes.reach);
  const bool coversDomain = chosen.places.size() == 1 && options.bundleDiameter == 0.0;
  const double volume = options.length > 0.0 ? options.domain().volume() : std::pow(options.side, 3); // the same bits as ever
  double radius = 0.5 * options.bundleDiameter;
  if (options.bundleDiameter == 0.0)
  {
    radius = coversDomain ? sizes.reach : std::sqrt(volume / (pi * chosen.length));
  }
  requireMemoryForTract(options, sizes, radius);

  // The domain is a small piece of a bundle that covers it, and may hold more or less of it by chance.
  const double asked = options.fibreVolumeFraction;
  const int rounds = coversDomain ? mostRounds : 1;
  double density = sizes.straight.fibreVolumeFraction;
  Fibres fibres;
  TractFibresReport reached;
  for (int round = 0; round < rounds; ++round)
  {
    TractFibresReport now;
    Fibres laid;
    try
    {
      laid = layBundles(streamlines, choice, chosen, options, sizes, radius, density,
        context.part(double(round) / rounds, (round + 1.0) / rounds), now);
    }
    catch (const Infeasible&)
    {
      if (round == 0)
      {
        throw;
      }
      break; // the best before it is good enough
    }
    const double difference = std::abs(now.fibreVolumeFraction - asked);
    if (round == 0 || difference < std::abs(reached.fibreVolumeFraction - asked))
    {
      reached = now;
      fibres = std::move(laid);
    }
    if (difference <= tolerance * asked || !(now.fibreVolumeFraction > 0.0))
    {
      break;
    }
    // The square root, if it alternates between two numbers of fibres.
    const double ratio = asked / now.fibreVolumeFraction;
    density = std::min(densest, density * (round < rounds / 2 ? ratio : std::sqrt(ratio)));
  }
  setGrownFraction(options, sizes.thinning, reached.fibreVolumeFraction, coversDomain, fibres);
  validate(fibres);
  if (report != nullptr)
  {
    *report = reached;
  }
  context.report(1.0, "Fibres laid");
  return fibres;
}

} // namespace cactus
