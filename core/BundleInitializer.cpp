// SPDX-License-Identifier: BSD-3-Clause
#include "BundleInitializer.h"

#include "CirclePacking.h"
#include "CoherentFlow.h"
#include "Error.h"
#include "Memory.h"
#include "Random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <sstream>

namespace cactus
{

namespace
{

constexpr double pi = 3.14159265358979323846;
constexpr double degree = pi / 180.0;
constexpr int trialsPerCircle = 64;
/// How often a packing is begun anew, from other random positions, before its density counts as out of reach.
constexpr int attempts = 4;

/// Random streams of different bundles and attempts are kept apart by these offsets of the item number.
std::uint64_t itemOf(std::size_t circle, int bundle, int attempt = 0)
{
  return circle + (static_cast<std::uint64_t>(bundle) << 40) + (static_cast<std::uint64_t>(attempt) << 48);
}

/// Whether fibres follow a flow: the layers of two crossing bundles are too thin for one.
bool isCoherent(const BundleInitializerOptions& options)
{
  return options.dispersionModel == DispersionModel::Coherent && options.numberOfBundles == 1;
}

/// One bundle before it is turned into its place: faces in (u, v) at w = ±length/2, v being the domain's y.
struct Bundle
{
  int id = 1;
  double length = 0.0;
  double angle = 0.0;   ///< of the axis, from +z towards +x (radians)
  double density = 0.0; ///< wanted of the circles on each face
  Circles bottom;
  Circles top;
};

void requireRange(double value, bool good, const char* property, const char* range)
{
  if (!std::isfinite(value) || !good)
  {
    std::ostringstream message;
    message << property << " is " << value << ": give " << range;
    throw InvalidInput(message.str());
  }
}

/// The side of the cube that fibres are to cover.
double regionSide(const BundleInitializerOptions& options)
{
  return options.side + 2.0 * options.margin;
}

/// Indices in order of falling radius, ties in order of index.
std::vector<std::size_t> largestFirst(const std::vector<double>& radii)
{
  std::vector<std::size_t> order(radii.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return radii[a] > radii[b]; });
  return order;
}

/// Throws unless every circle has room in its rectangle.
void requireFit(const Circles& circles, const char* property)
{
  for (std::size_t i = 0; i < circles.size(); ++i)
  {
    if (2.0 * circles.radii[i] > circles.frame(i).size().minCoeff())
    {
      std::ostringstream message;
      message << property << " gives a face or layer only " << circles.frame(i).size().minCoeff()
              << " µm wide, and a fibre of radius " << circles.radii[i] << " µm does not fit into it: enlarge " << property
              << " or lower MaximumRadius";
      throw InvalidInput(message.str());
    }
  }
}

/// The density at which the circles do come apart: their areas are lowered by one per cent at a time.
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
  std::ostringstream message;
  message.precision(3);
  // In proportion: for crossing bundles the faces' density is not the domain's.
  const double reachable = reachableDensity(jammed, context) * options.fibreVolumeFraction / bundle.density;
  message << "FibreVolumeFraction " << options.fibreVolumeFraction << " cannot be reached: the circles on the " << face
          << " face of bundle " << bundle.id << " come apart only at " << reachable
          << ". Lower FibreVolumeFraction, or spread the radii more widely";
  if (options.numberOfBundles == 2)
  {
    message << ", or use thicker layers (CrossingStyle Sheets, SheetThickness)";
  }
  throw Infeasible(message.str());
}

bool packBottom(Bundle& bundle, std::uint64_t seed, int attempt, const Context& context)
{
  Circles& circles = bundle.bottom;
  RandomEngine engine;
  const auto anywhere = [&](std::size_t i, int trial) -> Eigen::Vector2d
  {
    if (trial == 0)
    {
      engine = randomStream(seed, RandomStage::Packing, itemOf(i, bundle.id, attempt));
    }
    const Rectangle& frame = circles.frame(i);
    const double r = circles.radii[i];
    const double s = uniform(engine);
    const double t = uniform(engine);
    const Eigen::Vector2d room = frame.size().array() - 2.0 * r;
    return frame.clampCentre(frame.lower.array() + r + Eigen::Array2d(s, t) * room.array(), r);
  };
  placeCircles(circles, anywhere, trialsPerCircle);
  return relaxCircles(circles, {}, context).separated;
}

/// A place at distance `reach` from `from`, towards `azimuth` if that stays inside the frame, mirrored in one or both components
/// where that does, else slid along the frame's longer side; nearer than `reach` only where the frame has no such place.
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
    // The side with more room comes nearest to the distance asked for.
    const double middle = 0.5 * (frame.lower[along] + frame.upper[along]);
    shift[along] = from[along] > middle ? -rest : rest;
  }
  return frame.clampCentre(from + shift, radius);
}

/// How a bundle's fibres lie to its nominal axis.
struct Orientation
{
  double meanAngle = 0.0; ///< degrees, of the fibres to the axis
  double drift = 0.0;     ///< degrees, of the fibres' mean direction to the axis
  /// Per component, sum over sum of magnitudes of the fibres' directions: by how much one sense outweighs the other.
  Eigen::Vector2d bias = Eigen::Vector2d::Zero();
};

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

/// Places each circle of the top face at an angle of its own.
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
      // No place on the face is further away than its diagonal, and near 90° the tangent is out of all bounds.
      reach = std::min(bundle.length * std::tan(directions.sampleAngle(engine)), top.frame(i).size().norm());
    }
    return placeOnRing(top.frame(i), bundle.bottom.centres[i], top.radii[i], reach, engine);
  };
  placeCircles(top, onRing, trialsPerCircle);
}

/// Carries the top face's circles from where the bottom's are, all in one flow; false where it does not lead as far as asked.
bool carryAlong(Bundle& bundle, const BundleInitializerOptions& options, int attempt, const Context& context)
{
  Circles& top = bundle.top;
  const Rectangle& frame = top.frames.front();
  const double shift = bundle.length * std::tan(options.meanDispersion * degree);
  const double length =
    options.correlationLength > 0.0 ? options.correlationLength : std::max(4.0 * shift, frame.size().maxCoeff() / 32.0);
  RandomEngine engine = randomStream(options.seed, RandomStage::Directions, itemOf(0, bundle.id, attempt));
  const bool isFarEnough =
    CoherentFlow(frame, length, engine).carry(top.centres, bundle.length, options.meanDispersion * degree, context);
  for (std::size_t i = 0; i < top.size(); ++i)
  {
    top.centres[i] = frame.clampCentre(top.centres[i], top.radii[i]);
  }
  return isFarEnough;
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
void packFaces(Bundle& bundle, const BundleInitializerOptions& options, const Context& context, double begin, double end)
{
  std::ostringstream what;
  what << "Packing the faces of bundle " << bundle.id << " (" << bundle.bottom.size() << " fibres)";
  std::optional<Circles> jammed;
  const char* jammedFace = "first";
  double dispersion = 0.0;
  for (int attempt = 0; attempt < attempts; ++attempt)
  {
    context.checkpoint();
    context.report(begin, what.str());
    if (!packBottom(bundle, options.seed, attempt, context))
    {
      jammed = bundle.bottom;
      continue;
    }
    context.report(0.5 * (begin + end), what.str());
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
    }
  }
  if (jammed)
  {
    throwDensity(options, bundle, *jammed, jammedFace, context);
  }
  std::ostringstream message;
  message.precision(3);
  message << "MeanDispersion " << options.meanDispersion << "° cannot be met: fibres that start and end within the faces came to "
          << dispersion << "°. Lower MeanDispersion, or enlarge Margin";
  if (options.correlationLength > 0.0 && isCoherent(options))
  {
    message << " or CorrelationLength, which is short for so large an angle";
  }
  throw Infeasible(message.str());
}

/// The layout of a single bundle: one square frame on each face.
std::vector<Bundle> layOutSingle(const BundleInitializerOptions& options)
{
  const double face = regionSide(options);
  Bundle bundle;
  bundle.length = options.side;
  bundle.density = options.fibreVolumeFraction;
  Rectangle frame;
  frame.lower.setConstant(-0.5 * face);
  frame.upper.setConstant(0.5 * face);
  bundle.bottom.frames = { frame };
  bundle.bottom.radii = drawRadii(options.radius, options.seed, options.fibreVolumeFraction * frame.area(), itemOf(0, bundle.id));
  bundle.bottom.frameOf.assign(bundle.bottom.radii.size(), 0);
  requireFit(bundle.bottom, "Side");
  return { bundle };
}

void requireDensity(const std::vector<Bundle>& bundles, const BundleInitializerOptions& options)
{
  for (const Bundle& bundle : bundles)
  {
    const double density = bundle.bottom.density();
    if (std::abs(density - bundle.density) > 0.05 * bundle.density)
    {
      std::ostringstream message;
      message.precision(3);
      message << "FibreVolumeFraction " << options.fibreVolumeFraction
              << " cannot be reached with whole fibres of these radii: the nearest is "
              << density * options.fibreVolumeFraction / bundle.density << ". Enlarge Side, or lower MaximumRadius";
      throw Infeasible(message.str());
    }
  }
}

/// The two bundles of a crossing, without radii and frames, each long enough for its fibres to run right through the region.
std::vector<Bundle> crossingBundles(const BundleInitializerOptions& options, double density)
{
  const double half = 0.5 * options.crossingAngle * degree;
  std::vector<Bundle> bundles(2);
  for (int b = 0; b < 2; ++b)
  {
    bundles[static_cast<std::size_t>(b)].id = b + 1;
    bundles[static_cast<std::size_t>(b)].angle = b == 0 ? half : -half;
    bundles[static_cast<std::size_t>(b)].density = density;
    // A square turned by the half angle fits into a square of this side, and the bundle covers as much in both directions.
    bundles[static_cast<std::size_t>(b)].length = regionSide(options) * (std::cos(half) + std::sin(half));
  }
  return bundles;
}

/// A layer of a crossing bundle, as wide as the bundle is long.
Rectangle layerFrame(const Bundle& bundle, double low, double high)
{
  Rectangle frame;
  frame.lower = Eigen::Vector2d(-0.5 * bundle.length, low);
  frame.upper = Eigen::Vector2d(0.5 * bundle.length, high);
  return frame;
}

/// Sheets: layers of equal thickness, the bundles taking turns; each circle, largest first, goes to the layer with most area
/// left.
std::vector<Bundle> layOutSheets(const BundleInitializerOptions& options, double density)
{
  const double height = regionSide(options);
  // By default every fibre that may be drawn has room.
  const double wanted =
    options.sheetThickness > 0.0 ? options.sheetThickness : std::max(height / 6.0, 1.05 * 2.0 * options.radius.maximum);
  const int layers = std::max(2, static_cast<int>(std::min(height / wanted + 1e-9, 1e6)));
  std::vector<Bundle> bundles = crossingBundles(options, density);
  for (int k = 0; k < layers; ++k)
  {
    Bundle& bundle = bundles[static_cast<std::size_t>(k % 2)];
    bundle.bottom.frames.push_back(layerFrame(bundle, height * (double(k) / layers - 0.5), height * ((k + 1.0) / layers - 0.5)));
  }
  for (Bundle& bundle : bundles)
  {
    Circles& circles = bundle.bottom;
    const double capacity = density * circles.frames.front().area();
    const auto count = circles.frames.size();
    circles.radii = drawRadii(options.radius, options.seed, capacity * static_cast<double>(count), itemOf(0, bundle.id));
    circles.frameOf.assign(circles.size(), 0);
    requireFit(circles, "SheetThickness");
    std::vector<double> left(count, capacity);
    for (const std::size_t i : largestFirst(circles.radii))
    {
      const auto layer = std::max_element(left.begin(), left.end());
      circles.frameOf[i] = static_cast<int>(layer - left.begin());
      *layer -= pi * circles.radii[i] * circles.radii[i];
    }
  }
  return bundles;
}

/// Divides a bundle's circles among thin layers: each takes the largest circles left, with room to spare, and then others in the
/// order they were drawn, up to a thickness drawn around `wanted` (µm). Returns the layers' thicknesses, each just so that the
/// layer has the density asked for.
std::vector<double> weave(Bundle& bundle, const BundleInitializerOptions& options, double wanted)
{
  Circles& circles = bundle.bottom;
  circles.frameOf.assign(circles.size(), -1);
  const double areaPerThickness = bundle.density * bundle.length;
  double left = 0.0;
  for (const double r : circles.radii)
  {
    left += pi * r * r;
  }
  const std::vector<std::size_t> largest = largestFirst(circles.radii);
  RandomEngine engine = randomStream(options.seed, RandomStage::Packing, itemOf(0, bundle.id + 16));
  std::vector<double> thicknesses;
  std::size_t nextLargest = 0;
  std::size_t nextDrawn = 0;
  while (left > 0.0)
  {
    while (nextLargest < circles.size() && circles.frameOf[largest[nextLargest]] >= 0)
    {
      ++nextLargest;
    }
    if (nextLargest == circles.size())
    {
      break;
    }
    const double room = 1.05 * 2.0 * circles.radii[largest[nextLargest]];
    const double thickness = std::max(room, wanted * (0.75 + 0.5 * uniform(engine)));
    const bool last = left < areaPerThickness * thickness;
    // What does not fill a layer of its own thickens the one before.
    const bool merge = last && !thicknesses.empty();
    const int layer = static_cast<int>(thicknesses.size()) - (merge ? 1 : 0);
    double taken = 0.0;
    const auto take = [&](std::size_t i)
    {
      circles.frameOf[i] = layer;
      taken += pi * circles.radii[i] * circles.radii[i];
    };
    // Large circles keep together in few thick layers, so that the others can be thin.
    for (; nextLargest < circles.size() && taken < 0.6 * areaPerThickness * thickness; ++nextLargest)
    {
      if (circles.frameOf[largest[nextLargest]] < 0)
      {
        take(largest[nextLargest]);
      }
    }
    for (; nextDrawn < circles.size() && (last || taken < areaPerThickness * thickness); ++nextDrawn)
    {
      if (circles.frameOf[nextDrawn] < 0)
      {
        take(nextDrawn);
      }
    }
    left -= taken;
    if (merge)
    {
      thicknesses.back() += taken / areaPerThickness;
    }
    else
    {
      thicknesses.push_back(taken / areaPerThickness);
    }
  }
  return thicknesses;
}

/// Interwoven: each bundle's thin layers in random order, stacked along y so that both bundles rise evenly.
std::vector<Bundle> layOutInterwoven(const BundleInitializerOptions& options, double density, double thicknessInDiameters)
{
  const double height = regionSide(options);
  std::vector<Bundle> bundles = crossingBundles(options, density);
  double radiusSum = 0.0;
  std::size_t count = 0;
  for (Bundle& bundle : bundles)
  {
    bundle.bottom.radii = drawRadii(options.radius, options.seed, 0.5 * density * bundle.length * height, itemOf(0, bundle.id));
    radiusSum = std::accumulate(bundle.bottom.radii.begin(), bundle.bottom.radii.end(), radiusSum);
    count += bundle.bottom.size();
  }
  const double wanted = thicknessInDiameters * 2.0 * radiusSum / static_cast<double>(count);
  std::vector<std::vector<double>> thicknesses;
  std::vector<std::vector<std::size_t>> order;
  double total = 0.0;
  for (Bundle& bundle : bundles)
  {
    thicknesses.push_back(weave(bundle, options, wanted));
    total = std::accumulate(thicknesses.back().begin(), thicknesses.back().end(), total);
    order.emplace_back(thicknesses.back().size());
    std::vector<std::size_t>& shuffled = order.back();
    std::iota(shuffled.begin(), shuffled.end(), std::size_t(0));
    RandomEngine engine = randomStream(options.seed, RandomStage::Packing, itemOf(1, bundle.id + 16));
    for (std::size_t k = shuffled.size(); k > 1; --k)
    {
      std::swap(shuffled[k - 1], shuffled[std::min(k - 1, static_cast<std::size_t>(uniform(engine) * static_cast<double>(k)))]);
    }
    bundle.bottom.frames.resize(shuffled.size());
  }
  // The drawn areas miss their half by less than a circle; the layers share that out.
  const double stretch = height / total;
  double level = -0.5 * height;
  std::array<double, 2> filled{ { 0.0, 0.0 } };
  std::array<std::size_t, 2> next{ { 0, 0 } };
  while (next[0] < order[0].size() || next[1] < order[1].size())
  {
    const bool second = next[0] == order[0].size() || (next[1] < order[1].size() && filled[1] < filled[0]);
    const std::size_t b = second ? 1 : 0;
    const std::size_t layer = order[b][next[b]++];
    const double thickness = stretch * thicknesses[b][layer];
    bundles[b].bottom.frames[layer] = layerFrame(bundles[b], level, level + thickness);
    level += thickness;
    filled[b] += thickness;
  }
  for (const Bundle& bundle : bundles)
  {
    requireFit(bundle.bottom, "Side");
  }
  return bundles;
}

void packAll(std::vector<Bundle>& bundles, const BundleInitializerOptions& options, const Context& context)
{
  requireDensity(bundles, options);
  const double share = 0.9 / static_cast<double>(bundles.size());
  for (std::size_t b = 0; b < bundles.size(); ++b)
  {
    const double begin = 0.05 + share * static_cast<double>(b);
    packFaces(bundles[b], options, context, begin, begin + share);
  }
}

/// Two bundles with both their faces packed to a density.
std::vector<Bundle> packCrossing(const BundleInitializerOptions& options, double density, const Context& context)
{
  if (options.crossingStyle == CrossingStyle::Interwoven)
  {
    // Narrow layers waste space along their walls: where one does not hold its density, thicker layers may.
    constexpr double thickest = 6.0;
    for (double diameters = 1.5;; diameters *= 1.25)
    {
      std::vector<Bundle> bundles = layOutInterwoven(options, density, diameters);
      try
      {
        packAll(bundles, options, context);
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
  packAll(bundles, options, context);
  return bundles;
}

void appendFibres(const Bundle& bundle, const BundleInitializerOptions& options, Fibres& fibres)
{
  const double sine = std::sin(bundle.angle);
  const double cosine = std::cos(bundle.angle);
  const auto place = [&](const Eigen::Vector2d& face, double w)
  {
    // Exact for an axis along z, whose first and last control points lie on the domain's faces.
    return Eigen::Vector3d(face.x() * cosine + w * sine, face.y(), w * cosine - face.x() * sine);
  };
  for (std::size_t i = 0; i < bundle.bottom.size(); ++i)
  {
    const double radius = bundle.bottom.radii[i];
    const Eigen::Vector3d first = place(bundle.bottom.centres[i], -0.5 * bundle.length);
    const Eigen::Vector3d last = place(bundle.top.centres[i], 0.5 * bundle.length);
    const double spacing = std::clamp(options.spacingFactor * radius, options.minimumSpacing, options.maximumSpacing);
    const int segments = std::max(2, static_cast<int>(std::lround((last - first).norm() / spacing)));
    fibres.addFibre(static_cast<int>(fibres.size()) + 1, bundle.id, radius);
    fibres.addPoint(first, radius);
    for (int k = 1; k < segments; ++k)
    {
      fibres.addPoint(first + (last - first) * (static_cast<double>(k) / segments), radius);
    }
    fibres.addPoint(last, radius);
  }
}

Fibres fibresOf(const std::vector<Bundle>& bundles, const BundleInitializerOptions& options)
{
  Fibres fibres;
  fibres.domain = Domain::cube(options.side);
  for (const Bundle& bundle : bundles)
  {
    appendFibres(bundle, options, fibres);
  }
  return fibres;
}

Fibres initialiseSingle(const BundleInitializerOptions& options, const Context& context, BundleInitializerReport& report)
{
  std::vector<Bundle> bundles = layOutSingle(options);
  packAll(bundles, options, context);
  report.fibreVolumeFraction = bundles.front().bottom.density();
  report.meanDispersion = orientationOf(bundles.front()).meanAngle;
  return fibresOf(bundles, options);
}

/// Crossing bundles whose capsules fill the domain to the fraction asked for. Their faces lie outside the domain, and dispersed
/// fibres that start and end within the faces crowd between them, so the density of the faces is a little lower, and is found by
/// trying: in proportion to what the domain came to hold.
Fibres initialiseCrossing(const BundleInitializerOptions& options, const Context& context, BundleInitializerReport& report)
{
  const double asked = options.fibreVolumeFraction;
  const double tilt = options.meanDispersion * degree;
  double density = asked * std::cos(tilt) * (1.0 - 0.5 * std::tan(tilt));
  std::optional<Fibres> best;
  for (int round = 0; round < 6; ++round)
  {
    const std::vector<Bundle> bundles = packCrossing(options, density, context);
    Fibres fibres = fibresOf(bundles, options);
    const double reached = capsuleVolumeInDomain(fibres) / fibres.domain.volume();
    if (!best || std::abs(reached - asked) < std::abs(report.fibreVolumeFraction - asked))
    {
      double angles = 0.0;
      for (const Bundle& bundle : bundles)
      {
        angles += orientationOf(bundle).meanAngle * static_cast<double>(bundle.bottom.size());
      }
      report.fibreVolumeFraction = reached;
      report.meanDispersion = angles / static_cast<double>(fibres.size());
      best = std::move(fibres);
    }
    if (std::abs(reached - asked) <= 0.004 || reached <= 0.0)
    {
      break;
    }
    density = std::min(0.95, density * asked / reached);
  }
  if (std::abs(report.fibreVolumeFraction - asked) > 0.05 * asked)
  {
    std::ostringstream message;
    message.precision(3);
    message << "FibreVolumeFraction " << asked << " cannot be reached with whole fibres of these radii: the nearest is "
            << report.fibreVolumeFraction << ". Enlarge Side, or lower MaximumRadius";
    throw Infeasible(message.str());
  }
  return std::move(*best);
}

/// Throws OutOfMemory where the fibres asked for could not be held.
void requireMemoryFor(const BundleInitializerOptions& options)
{
  const double side = regionSide(options);
  const double turned = options.numberOfBundles == 2 ? std::sqrt(2.0) : 1.0;
  const double fibreCount = options.fibreVolumeFraction * side * side * turned / meanCircleArea(options.radius);
  const double points = fibreCount * (2.0 + side * turned / options.minimumSpacing);
  std::ostringstream what;
  what.precision(3);
  what << "Side " << options.side << " µm with " << fibreCount << " fibres";
  requireMemory(fibreCount * 600.0 + points * 160.0, what.str(), "choose a smaller Side, a smaller Margin or larger radii");
}

} // namespace

void BundleInitializerOptions::validate() const
{
  requireRange(side, side > 0.0, "Side", "a positive length in µm");
  requireRange(fibreVolumeFraction, fibreVolumeFraction > 0.0 && fibreVolumeFraction < 1.0, "FibreVolumeFraction",
    "a fraction above 0 and below 1");
  requireRange(grownFibreVolumeFraction,
    grownFibreVolumeFraction == 0.0 || (grownFibreVolumeFraction >= fibreVolumeFraction && grownFibreVolumeFraction < 1.0),
    "GrownFibreVolumeFraction", "a fraction from FibreVolumeFraction to below 1, or 0");
  radius.validate();
  requireRange(
    meanDispersion, meanDispersion >= 0.0 && meanDispersion <= 45.0, "MeanDispersion", "an angle from 0 to 45 degrees");
  if (dispersionModel != DispersionModel::Watson && dispersionModel != DispersionModel::Cone &&
      dispersionModel != DispersionModel::Coherent)
  {
    throw InvalidInput("DispersionModel has no such choice: use Watson (0), Cone (1) or Coherent (2)");
  }
  requireRange(correlationLength, correlationLength >= 0.0, "CorrelationLength", "a length in µm, or 0 for the default");
  requireRange(numberOfBundles, numberOfBundles == 1 || numberOfBundles == 2, "NumberOfBundles",
    "1 or 2, and append several sources for more bundles or other directions");
  requireRange(
    crossingAngle, crossingAngle > 0.0 && crossingAngle <= 90.0, "CrossingAngle", "an angle above 0 and up to 90 degrees");
  if (crossingStyle != CrossingStyle::Interwoven && crossingStyle != CrossingStyle::Sheets)
  {
    throw InvalidInput("CrossingStyle has no such choice: use Interwoven (0) or Sheets (1)");
  }
  requireRange(sheetThickness, sheetThickness >= 0.0, "SheetThickness", "a length in µm, or 0 for the default");
  requireRange(margin, margin >= 0.0, "Margin", "a length in µm that is not negative");
  requireRange(spacingFactor, spacingFactor > 0.0, "SpacingFactor", "a positive multiple of the radius");
  requireRange(minimumSpacing, minimumSpacing > 0.0, "MinimumSpacing", "a positive length in µm");
  requireRange(
    maximumSpacing, maximumSpacing >= minimumSpacing, "MaximumSpacing", "a length in µm that is not below MinimumSpacing");
}

std::string BundleInitializerOptions::describe() const
{
  std::ostringstream text;
  text.precision(12);
  text << "Side=" << side << " FibreVolumeFraction=" << fibreVolumeFraction
       << " GrownFibreVolumeFraction=" << grownFibreVolumeFraction;
  switch (radius.model)
  {
  case RadiusModel::Gamma:
    text << " RadiusDistribution=Gamma GammaShape=" << radius.gammaShape << " GammaScale=" << radius.gammaScale;
    break;
  case RadiusModel::Lognormal:
    text << " RadiusDistribution=Lognormal LognormalMean=" << radius.lognormalMean
         << " LognormalDeviation=" << radius.lognormalDeviation;
    break;
  case RadiusModel::Table:
    text << " RadiusDistribution=Table RadiusTable=";
    for (std::size_t i = 0; i < radius.table.size(); ++i)
    {
      text << (i > 0 ? "," : "") << radius.table[i];
    }
    break;
  }
  text << " MinimumRadius=" << radius.minimum << " MaximumRadius=" << radius.maximum << " MeanDispersion=" << meanDispersion
       << " DispersionModel="
       << (dispersionModel == DispersionModel::Coherent ? "Coherent"
            : dispersionModel == DispersionModel::Cone  ? "Cone"
                                                        : "Watson");
  if (isCoherent(*this))
  {
    text << " CorrelationLength=" << correlationLength;
  }
  text << " NumberOfBundles=" << numberOfBundles;
  if (numberOfBundles == 2)
  {
    text << " CrossingAngle=" << crossingAngle
         << " CrossingStyle=" << (crossingStyle == CrossingStyle::Interwoven ? "Interwoven" : "Sheets");
    if (crossingStyle == CrossingStyle::Sheets)
    {
      text << " SheetThickness=" << sheetThickness;
    }
  }
  text << " Margin=" << margin << " SpacingFactor=" << spacingFactor << " MinimumSpacing=" << minimumSpacing
       << " MaximumSpacing=" << maximumSpacing << " Seed=" << seed;
  return text.str();
}

Fibres initialiseBundles(const BundleInitializerOptions& options, const Context& context, BundleInitializerReport* report)
{
  options.validate();
  if (options.grownFibreVolumeFraction > 0.0)
  {
    const double thinning = std::sqrt(options.fibreVolumeFraction / options.grownFibreVolumeFraction);
    BundleInitializerOptions thinner = options;
    thinner.grownFibreVolumeFraction = 0.0;
    thinner.radius = options.radius.scaled(thinning);
    Fibres fibres = initialiseBundles(thinner, context, report);
    for (double& radius : fibres.targetRadii)
    {
      radius /= thinning;
    }
    return fibres;
  }
  requireMemoryFor(options);
  context.report(0.0, "Drawing radii");
  BundleInitializerReport reached;
  Fibres fibres =
    options.numberOfBundles == 2 ? initialiseCrossing(options, context, reached) : initialiseSingle(options, context, reached);
  if (report != nullptr)
  {
    *report = reached;
  }
  context.report(1.0, "Bundle initialised");
  return fibres;
}

} // namespace cactus
