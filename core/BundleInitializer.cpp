// SPDX-License-Identifier: BSD-3-Clause
#include "BundleInitializer.h"

#include "CirclePacking.h"
#include "Error.h"
#include "Memory.h"
#include "Random.h"

#include <algorithm>
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

/// One bundle before it is turned into its place: faces in (u, v) at w = ±length/2, v being the domain's y.
struct Bundle
{
  int id = 1;
  double length = 0.0;
  double angle = 0.0; ///< of the axis, from +z towards +x (radians)
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
  const BundleInitializerOptions& options, const Circles& jammed, const char* face, const Context& context)
{
  std::ostringstream message;
  message.precision(3);
  message << "FibreVolumeFraction " << options.fibreVolumeFraction << " cannot be reached: the circles on the " << face
          << " face come apart only at " << reachableDensity(jammed, context)
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
    const Eigen::Vector2d centre = from + drawn.cwiseProduct(mirror);
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

/// Mean angle (degrees) between the bundle's fibres and its axis.
double meanAngle(const Bundle& bundle)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < bundle.bottom.size(); ++i)
  {
    sum += std::atan2((bundle.top.centres[i] - bundle.bottom.centres[i]).norm(), bundle.length);
  }
  return sum / static_cast<double>(bundle.bottom.size()) / degree;
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
  const DirectionDistribution directions(options.dispersionModel, options.meanDispersion);
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
    return placeOnRing(top.frame(i), bottom.centres[i], top.radii[i], reach, engine);
  };
  placeCircles(top, onRing, trialsPerCircle);

  const double tolerance = std::min(0.05, 0.02 * options.meanDispersion);
  double best = 0.0;
  for (int step = 0; step < 30; ++step)
  {
    if (!relaxCircles(top, {}, context).separated)
    {
      return TopFace::Jammed;
    }
    reached = meanAngle(bundle);
    if (std::abs(reached - options.meanDispersion) <= tolerance)
    {
      return TopFace::Done;
    }
    best = std::max(best, reached);
    const double scale = std::clamp(std::tan(options.meanDispersion * degree) / std::tan(reached * degree), 0.5, 2.0);
    for (std::size_t i = 0; i < top.size(); ++i)
    {
      top.centres[i] = top.frame(i).clampCentre(bottom.centres[i] + scale * (top.centres[i] - bottom.centres[i]), top.radii[i]);
    }
  }
  reached = best;
  return TopFace::DispersionMissed;
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
    throwDensity(options, *jammed, jammedFace, context);
  }
  std::ostringstream message;
  message.precision(3);
  message << "MeanDispersion " << options.meanDispersion << "° cannot be met: fibres that start and end within the faces came to "
          << dispersion << "°. Lower MeanDispersion, or enlarge Margin";
  throw Infeasible(message.str());
}

/// The layout of a single bundle: one square frame on each face.
std::vector<Bundle> layOutSingle(const BundleInitializerOptions& options)
{
  const double face = regionSide(options);
  Bundle bundle;
  bundle.length = options.side;
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
    if (std::abs(density - options.fibreVolumeFraction) > 0.05 * options.fibreVolumeFraction)
    {
      std::ostringstream message;
      message.precision(3);
      message << "FibreVolumeFraction " << options.fibreVolumeFraction
              << " cannot be reached with whole fibres of these radii: the nearest is " << density
              << ". Enlarge Side, or lower MaximumRadius";
      throw Infeasible(message.str());
    }
  }
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
  radius.validate();
  requireRange(
    meanDispersion, meanDispersion >= 0.0 && meanDispersion <= 45.0, "MeanDispersion", "an angle from 0 to 45 degrees");
  if (dispersionModel != DispersionModel::Watson && dispersionModel != DispersionModel::Cone)
  {
    throw InvalidInput("DispersionModel has no such choice: use Watson (0) or Cone (1)");
  }
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
  text << "Side=" << side << " FibreVolumeFraction=" << fibreVolumeFraction;
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
       << " DispersionModel=" << (dispersionModel == DispersionModel::Watson ? "Watson" : "Cone")
       << " NumberOfBundles=" << numberOfBundles;
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
  requireMemoryFor(options);
  context.report(0.0, "Drawing radii");
  if (options.numberOfBundles != 1)
  {
    throw InvalidInput("NumberOfBundles 2 is not available yet: give 1");
  }
  std::vector<Bundle> bundles = layOutSingle(options);
  requireDensity(bundles, options);

  Fibres fibres;
  fibres.domain = Domain::cube(options.side);
  double faceArea = 0.0;
  double angleSum = 0.0;
  for (std::size_t b = 0; b < bundles.size(); ++b)
  {
    const double share = 0.9 / static_cast<double>(bundles.size());
    packFaces(bundles[b], options, context, 0.05 + share * static_cast<double>(b), 0.05 + share * static_cast<double>(b + 1));
    for (const Rectangle& frame : bundles[b].bottom.frames)
    {
      faceArea += frame.area();
    }
    angleSum += meanAngle(bundles[b]) * static_cast<double>(bundles[b].bottom.size());
    appendFibres(bundles[b], options, fibres);
  }
  if (report != nullptr)
  {
    const double circleArea = std::accumulate(
      fibres.targetRadii.begin(), fibres.targetRadii.end(), 0.0, [](double sum, double r) { return sum + pi * r * r; });
    report->fibreVolumeFraction = circleArea / faceArea;
    report->meanDispersion = angleSum / static_cast<double>(fibres.size());
  }
  context.report(1.0, "Bundle initialised");
  return fibres;
}

} // namespace cactus
