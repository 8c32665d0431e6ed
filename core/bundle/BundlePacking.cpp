// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/BundlePacking.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "base/Random.h"
#include "bundle/CirclePlacement.h"
#include "bundle/CircleRelaxation.h"
#include "bundle/CoherentFlow.h"
#include "bundle/DirectionDistribution.h"
#include "bundle/StationaryFlow.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace cactus
{

namespace
{

constexpr int trialsPerCircle = 64;
/// The number of packings tried, from different random positions, before a density counts as unreachable.
constexpr int attempts = 4;

/// Returns the density at which the circles come apart: their areas are reduced by one per cent at a time.
double reachableDensity(Circles circles, const Context& context)
{
  for (int i = 0; i < 100; ++i)
  {
    for (double& radius : circles.radii)
    {
      radius *= std::sqrt(0.99);
    }
    if (relaxCircles(circles, {}, context).separated)
    {
      break;
    }
  }
  return circles.density();
}

[[noreturn]] void throwDensity(
  const BundleInitializerOptions& options, const Bundle& bundle, const Circles& jammed, const char* face, const Context& context)
{
  TextStream message;
  message.precision(3);
  // Scaled, because the faces' density of crossing bundles is not the domain's.
  const double reachable = reachableDensity(jammed, context) * options.fibreVolumeFraction / bundle.density;
  message << "FibreVolumeFraction " << options.fibreVolumeFraction << " cannot be reached: the circles on the " << face
          << " face of bundle " << bundle.id << " come apart only at " << reachable
          << ". Lower FibreVolumeFraction, or spread the radii more widely";
  if (options.isLayered())
  {
    message << ", or use thicker layers (CrossingStyle Sheets, SheetThickness)";
  }
  throw Infeasible(message.str());
}

/// Returns a random centre in a frame.
Eigen::Vector2d centreIn(const Rectangle& frame, double radius, RandomEngine& engine)
{
  const double r = frame.repeats ? 0.0 : radius;
  const double s = uniform(engine);
  const double t = uniform(engine);
  const Eigen::Vector2d room = frame.size().array() - 2.0 * r;
  return frame.clampCentre(frame.lower.array() + r + Eigen::Array2d(s, t) * room.array(), r);
}

/// Returns the middle of the cluster in which a circle lies.
Eigen::Vector2d clusterMiddle(const Bundle& bundle, const BundleInitializerOptions& options, std::size_t circle, int attempt)
{
  constexpr std::uint64_t firstCluster = std::uint64_t(1) << 36; // behind the items of all circles
  const std::size_t cluster = (circle - bundle.myelinated) / static_cast<std::size_t>(options.unmyelinated.cluster);
  RandomEngine engine = randomStream(options.seed, RandomStage::Packing, itemOf(firstCluster + cluster, bundle.id, attempt));
  return centreIn(bundle.bottom.frame(circle), 0.0, engine);
}

bool packBottom(Bundle& bundle, const BundleInitializerOptions& options, int attempt, const Context& context)
{
  Circles& circles = bundle.bottom;
  RandomEngine engine;
  Eigen::Vector2d middle;
  const auto anywhere = [&](std::size_t i, int trial) -> Eigen::Vector2d
  {
    const bool isClustered = i >= bundle.myelinated && options.unmyelinated.cluster > 1;
    if (trial == 0)
    {
      engine = randomStream(options.seed, RandomStage::Packing, itemOf(i, bundle.id, attempt));
      middle = isClustered ? clusterMiddle(bundle, options, i, attempt) : middle;
    }
    if (!isClustered)
    {
      return centreIn(circles.frame(i), circles.radii[i], engine);
    }
    // Farther out with each trial, as the middle may be taken.
    const double compact = options.unmyelinated.radius * std::sqrt(static_cast<double>(options.unmyelinated.cluster));
    const double reach = compact * (1.0 + 4.0 * trial / trialsPerCircle);
    const double distance = reach * std::sqrt(uniform(engine));
    const double azimuth = 2.0 * pi * uniform(engine);
    return circles.frame(i).clampCentre(
      middle + distance * Eigen::Vector2d(std::cos(azimuth), std::sin(azimuth)), circles.radii[i]);
  };
  placeCircles(circles, anywhere, trialsPerCircle);
  return relaxCircles(circles, {}, context).separated;
}

/// Returns a place at distance `reach` from `from`: towards `azimuth` if that stays inside the frame, else mirrored in one or
/// both components, else slid along the frame's longer side; nearer than `reach` only if the frame has no such place.
Eigen::Vector2d placeOnRing(
  const Rectangle& frame, const Eigen::Vector2d& from, double radius, double reach, RandomEngine& engine)
{
  const double azimuth = 2.0 * pi * uniform(engine);
  const double slide = uniform(engine);
  const Eigen::Vector2d drawn(reach * std::cos(azimuth), reach * std::sin(azimuth));
  for (const Eigen::Vector2d& mirror :
    { Eigen::Vector2d(1, 1), Eigen::Vector2d(-1, 1), Eigen::Vector2d(1, -1), Eigen::Vector2d(-1, -1) })
  {
    Eigen::Vector2d centre = from + drawn.cwiseProduct(mirror);
    if (frame.holds(centre, radius))
    {
      return centre;
    }
  }
  const int along = frame.size().x() >= frame.size().y() ? 0 : 1;
  const int across = 1 - along;
  const double low = std::max(frame.lower[across] + radius, from[across] - reach);
  const double high = std::min(frame.upper[across] - radius, from[across] + reach);
  Eigen::Vector2d shift;
  shift[across] = low + slide * (high - low) - from[across];
  const double rest = std::sqrt(std::max(0.0, reach * reach - shift[across] * shift[across]));
  shift[along] = drawn[along] < 0.0 ? -rest : rest;
  if (!frame.holds(from + shift, radius))
  {
    // The side with more room comes nearest to the requested distance.
    const double middle = 0.5 * (frame.lower[along] + frame.upper[along]);
    shift[along] = from[along] > middle ? -rest : rest;
  }
  return frame.clampCentre(from + shift, radius);
}

/// Places each circle of the top face at its own random angle.
void placeOnRings(Bundle& bundle, const BundleInitializerOptions& options, int attempt)
{
  Circles& top = bundle.top;
  const bool cone = options.dispersionModel == DispersionModel::Cone;
  const DirectionDistribution directions(cone ? DispersionModel::Cone : DispersionModel::Watson, options.meanDispersion);
  RandomEngine engine;
  double reach = 0.0;
  const auto onRing = [&](std::size_t i, int trial) -> Eigen::Vector2d
  {
    if (trial == 0)
    {
      engine = randomStream(options.seed, RandomStage::Directions, itemOf(i, bundle.id, attempt));
      // No place on the face is farther away than its diagonal, and near 90° the tangent diverges.
      reach = std::min(bundle.length * std::tan(directions.sampleAngle(engine)), top.frame(i).size().norm());
    }
    return placeOnRing(top.frame(i), bundle.bottom.centres[i], top.radii[i], reach, engine);
  };
  placeCircles(top, onRing, trialsPerCircle);
}

/// Lets each fibre pass at its own random angle through its circle, which was packed on the bottom face, in the middle of the
/// bundle. So fibres are as dense everywhere, but for the sides: those that start and end within faces crowd between these.
void placeThroughMiddle(Bundle& bundle, const BundleInitializerOptions& options, int attempt)
{
  const DirectionDistribution directions(options.dispersionModel, options.meanDispersion);
  std::vector<Eigen::Vector2d> shifts;
  for (std::size_t i = 0; i < bundle.bottom.size(); ++i)
  {
    RandomEngine engine = randomStream(options.seed, RandomStage::Directions, itemOf(i, bundle.id, attempt));
    const double reach = std::min(bundle.length * std::tan(directions.sampleAngle(engine)), bundle.bottom.frame(i).size().norm());
    const double azimuth = 2.0 * pi * uniform(engine);
    shifts.emplace_back(reach * std::cos(azimuth), reach * std::sin(azimuth));
  }
  const std::vector<Eigen::Vector2d> middles = bundle.bottom.centres;
  bundle.top = bundle.bottom;
  double scale = 1.0;
  for (int round = 0; round < 8; ++round) // until the mean angle is the one asked for, to many digits
  {
    for (std::size_t i = 0; i < middles.size(); ++i)
    {
      bundle.bottom.centres[i] = middles[i] - 0.5 * scale * shifts[i];
      bundle.top.centres[i] = middles[i] + 0.5 * scale * shifts[i];
    }
    scale *= std::tan(options.meanDispersion * degree) / std::tan(orientationOf(bundle).meanAngle * degree);
  }
}

/// Shears each path evenly, so that it ends where it begins. The flow has no mean along z, so this is little.
void closePaths(FlowPaths& paths)
{
  const std::vector<Eigen::Vector2d> first = paths.places.front();
  const std::vector<Eigen::Vector2d> last = paths.places.back();
  const double planes = static_cast<double>(paths.places.size() - 1);
  for (std::size_t plane = 0; plane < paths.places.size(); ++plane)
  {
    for (std::size_t i = 0; i < first.size(); ++i)
    {
      paths.places[plane][i] -= (static_cast<double>(plane) / planes - 0.5) * (last[i] - first[i]);
    }
  }
}

/// Lets each fibre follow the flow both ways from its circle, which was packed on the bottom face, in the middle of the bundle.
void followBothWays(Bundle& bundle, const StationaryFlow& flow, bool isClosed, const Context& context)
{
  bundle.paths = flow.carry(bundle.bottom.centres, bundle.length, context);
  if (isClosed)
  {
    closePaths(bundle.paths);
  }
  bundle.top = bundle.bottom;
  bundle.bottom.centres = bundle.paths.places.front();
  bundle.top.centres = bundle.paths.places.back();
}

/// Carries the circles of the bottom face to the top in one flow; false if the flow does not reach the requested angle.
bool carryAlong(Bundle& bundle, const BundleInitializerOptions& options, int attempt, const Context& context)
{
  Circles& top = bundle.top;
  const Rectangle& frame = top.frames.front();
  const double shift = bundle.length * std::tan(options.meanDispersion * degree);
  const double length =
    options.correlationLength > 0.0 ? options.correlationLength : std::max(4.0 * shift, frame.size().maxCoeff() / 32.0);
  RandomEngine engine = randomStream(options.seed, RandomStage::Directions, itemOf(0, bundle.id, attempt));
  bundle.paths =
    CoherentFlow(frame, length, engine).carry(bundle.bottom.centres, bundle.length, options.meanDispersion * degree, context);
  for (std::size_t i = 0; i < top.size(); ++i)
  {
    top.centres[i] = frame.clampCentre(bundle.paths.places.back()[i], top.radii[i]);
  }
  return bundle.paths.isFarEnough;
}

enum class TopFace
{
  Done,
  Jammed,
  DispersionMissed
};

TopFace packTop(Bundle& bundle, const BundleInitializerOptions& options, int attempt, const Context& context, double& reached)
{
  const Circles& bottom = bundle.bottom;
  Circles& top = bundle.top;
  top = bottom;
  reached = 0.0;
  if (options.meanDispersion == 0.0)
  {
    return TopFace::Done;
  }
  if (!isCoherent(options))
  {
    placeOnRings(bundle, options, attempt);
  }
  else if (!carryAlong(bundle, options, attempt, context))
  {
    reached = orientationOf(bundle).meanAngle;
    return TopFace::DispersionMissed;
  }

  const double tolerance = std::min(0.05, 0.02 * options.meanDispersion);
  constexpr double driftTolerance = 0.1;
  std::optional<Circles> accepted;
  double acceptedDrift = 0.0;
  double best = 0.0;
  for (int step = 0; step < 30; ++step)
  {
    if (!relaxCircles(top, {}, context).separated)
    {
      if (accepted)
      {
        break;
      }
      return TopFace::Jammed;
    }
    const Orientation orientation = orientationOf(bundle);
    reached = orientation.meanAngle;
    if (std::abs(reached - options.meanDispersion) <= tolerance && (!accepted || orientation.drift < acceptedDrift))
    {
      accepted = top;
      acceptedDrift = orientation.drift;
    }
    if (accepted && (acceptedDrift <= driftTolerance || step >= 15))
    {
      break;
    }
    best = std::max(best, reached);
    const double scale = std::clamp(std::tan(options.meanDispersion * degree) / std::tan(reached * degree), 0.5, 2.0);
    for (std::size_t i = 0; i < top.size(); ++i)
    {
      Eigen::Vector2d shift = scale * (top.centres[i] - bottom.centres[i]);
      for (int axis = 0; axis < 2; ++axis)
      {
        shift[axis] *= 1.0 - (shift[axis] > 0.0 ? orientation.bias[axis] : -orientation.bias[axis]);
      }
      top.centres[i] = top.frame(i).clampCentre(bottom.centres[i] + shift, top.radii[i]);
    }
  }
  if (!accepted)
  {
    reached = best;
    return TopFace::DispersionMissed;
  }
  top = *accepted;
  return TopFace::Done;
}

/// Packs both faces of a bundle whose bottom holds radii and frames.
void packBundle(Bundle& bundle, const BundleInitializerOptions& options, const StationaryFlow* flow, const Context& context,
  double begin, double end)
{
  TextStream what;
  what << "Packing the faces of bundle " << bundle.id << " (" << bundle.bottom.size() << " fibres)";
  std::optional<Circles> jammed;
  const char* jammedFace = "first";
  double dispersion = 0.0;
  for (int attempt = 0; attempt < attempts; ++attempt)
  {
    context.checkpoint();
    context.report(begin, what.str());
    if (!packBottom(bundle, options, attempt, context))
    {
      jammed = bundle.bottom;
      continue;
    }
    context.report(0.5 * (begin + end), what.str());
    if (flow != nullptr)
    {
      followBothWays(bundle, *flow, options.border == Border::Periodic, context);
      return;
    }
    if (options.isCutOut() && !options.isLayered() && options.meanDispersion > 0.0)
    {
      placeThroughMiddle(bundle, options, attempt);
      return;
    }
    const TopFace outcome = packTop(bundle, options, attempt, context, dispersion);
    if (outcome == TopFace::Done)
    {
      return;
    }
    if (outcome == TopFace::Jammed)
    {
      jammed = bundle.top;
      jammedFace = "second";
    }
    else
    {
      jammed.reset();
      // Another flow may reach a little farther, but not this far.
      if (isCoherent(options) && dispersion < 0.5 * options.meanDispersion)
      {
        break;
      }
    }
  }
  if (jammed)
  {
    throwDensity(options, bundle, *jammed, jammedFace, context);
  }
  TextStream message;
  message.precision(3);
  message << "MeanDispersion " << options.meanDispersion << "° cannot be met: fibres that start and end within the faces came to "
          << dispersion << "°. Lower MeanDispersion, or enlarge Margin";
  if (options.correlationLength > 0.0 && isCoherent(options))
  {
    message << " or CorrelationLength, which is short for so large an angle";
  }
  throw Infeasible(message.str());
}

void requireDensity(const std::vector<Bundle>& bundles, const BundleInitializerOptions& options)
{
  for (const Bundle& bundle : bundles)
  {
    const double density = bundle.bottom.density();
    if (std::abs(density - bundle.density) > 0.05 * bundle.density)
    {
      TextStream message;
      message.precision(3);
      message << "FibreVolumeFraction " << options.fibreVolumeFraction
              << " cannot be reached with whole fibres of these radii: the nearest is "
              << density * options.fibreVolumeFraction / bundle.density << ". Enlarge Side, or lower MaximumRadius";
      throw Infeasible(message.str());
    }
  }
}

} // namespace

Orientation orientationOf(const Bundle& bundle)
{
  double angles = 0.0;
  double along = 0.0;
  Eigen::Vector2d across = Eigen::Vector2d::Zero();
  Eigen::Vector2d magnitude = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < bundle.bottom.size(); ++i)
  {
    const Eigen::Vector2d shift = bundle.top.centres[i] - bundle.bottom.centres[i];
    const double length = std::hypot(shift.norm(), bundle.length);
    angles += std::atan2(shift.norm(), bundle.length);
    along += bundle.length / length;
    across += shift / length;
    magnitude += shift.cwiseAbs() / length;
  }
  Orientation orientation;
  orientation.meanAngle = angles / static_cast<double>(bundle.bottom.size()) / degree;
  orientation.drift = std::atan2(across.norm(), along) / degree;
  for (int axis = 0; axis < 2; ++axis)
  {
    orientation.bias[axis] = magnitude[axis] > 0.0 ? across[axis] / magnitude[axis] : 0.0;
  }
  return orientation;
}

void packFaces(
  std::vector<Bundle>& bundles, const BundleInitializerOptions& options, const Context& context, const StationaryFlow* flow)
{
  if (!options.isCutOut())
  {
    requireDensity(bundles, options);
  }
  const double share = 0.9 / static_cast<double>(bundles.size());
  for (std::size_t b = 0; b < bundles.size(); ++b)
  {
    const double begin = 0.05 + share * static_cast<double>(b);
    packBundle(bundles[b], options, flow, context, begin, begin + share);
  }
}

} // namespace cactus
