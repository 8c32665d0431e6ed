// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/StationaryFlow.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "base/Parallel.h"
#include "base/Random.h"
#include "bundle/BundleLayout.h"
#include "bundle/DirectionDistribution.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace cactus
{

namespace
{

/// Lateral distance (µm) over which neighbours undulate together.
constexpr double undulationTogether = 6.0;
/// Relative deviation of the wavelengths of undulation.
constexpr double undulationBandwidth = 0.15;
/// Distance along z over which the direction changes, in lateral correlation lengths.
constexpr double lengthAlong = 8.0;

/// Domains of more correlation lengths hold so many independent places that the first flow is even.
constexpr double manyLengths = 12.0;
constexpr int mostDraws = 32;

/// Fibres that are followed to measure a flow start on a square grid with so many to a side.
constexpr int gridSide = 20;
/// Height (µm) over which they are followed through the domain, at most.
constexpr double longestPath = 100.0;
/// Height over which their sinuosity is measured, in wavelengths of undulation: in a shorter domain they would be less sinuous.
constexpr double measuredWavelengths = 1.0;
/// Planes on which angles are measured.
constexpr int anglePlanes = 5;

/// A flow is even with a distance to Watson's distribution (from end to end, and of all its angles), a twist and an anisotropy of
/// azimuths up to these.
constexpr double evenDistance = 0.045;
constexpr double evenDistanceOfAll = 0.06;
constexpr double evenTwist = 0.07;
constexpr double evenAzimuths = 1.28;

/// Distance (µm) between planes on which places are kept; much shorter than any change of direction.
constexpr double planeDistance = 1.0;

/// Points that are carried together by a thread.
constexpr std::size_t together = 64;

/// Returns the width of the domain across the bundle.
double widthOf(const BundleInitializerOptions& options)
{
  return options.extent().head<2>().maxCoeff();
}

/// Returns the period of the waves: the domain's width, but, unless that is a period, never so short that few waves are left.
double widthOfWaves(const BundleInitializerOptions& options, double correlationLength)
{
  return options.isPeriodic() ? options.side : std::max(widthOf(options), 3.0 * correlationLength);
}

/// Returns the period of the waves along z, or 0.
double lengthOfWaves(const BundleInitializerOptions& options)
{
  return options.border == Border::Periodic ? options.extent().z() : 0.0;
}

/// Returns the lateral distance (µm) over which neighbours undulate together: in a periodic domain a third of it at most.
double undulationLength(const BundleInitializerOptions& options)
{
  return options.isPeriodic() ? std::min(undulationTogether, options.side / 3.0) : undulationTogether;
}

/// The streams of the two parts of an attempt.
RandomEngine streamOf(const BundleInitializerOptions& options, int part, int attempt)
{
  return randomStream(options.seed, RandomStage::Directions, itemOf(static_cast<std::size_t>(part), 1, attempt));
}

/// Returns b of f' = exp(bψ) for angles of this mean (degrees). In an endless flow they are then Watson's within 0.05, up to 45°.
/// With twice as much at 20° the distance would be 0.014 instead of 0.035, but steep fibres would crowd, and fibres wind more.
double skewnessFor(double meanAngle)
{
  return std::max(0.0, 0.02 * (meanAngle - 10.0));
}

std::vector<Eigen::Vector2d> gridIn(const BundleInitializerOptions& options)
{
  const Eigen::Array2d size = options.extent().head<2>();
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < gridSide * gridSide; ++i)
  {
    const Eigen::Vector2d cell(i % gridSide, i / gridSide); // NOLINT(bugprone-integer-division): row and column
    points.emplace_back(((cell.array() + 0.5) / gridSide - 0.5) * size);
  }
  return points;
}

/// Directions across the axis, and whether they turn around it.
class Turns
{
public:
  void add(const Eigen::Vector2d& place, const Eigen::Vector2d& direction)
  {
    this->Turned += place.x() * direction.y() - place.y() * direction.x();
    this->Most += place.norm() * direction.norm();
    this->Squares += direction * direction.transpose();
  }

  /// Returns the twist, or the anisotropy of azimuths, over what is even.
  double unevenness() const
  {
    const double middle = 0.5 * this->Squares.trace();
    const double spread = std::hypot(0.5 * (this->Squares(0, 0) - this->Squares(1, 1)), this->Squares(0, 1));
    const double ratio = (middle + spread) / (middle - spread);
    return std::max(std::abs(this->Turned) / this->Most / evenTwist, (ratio - 1.0) / (evenAzimuths - 1.0));
  }

private:
  double Turned = 0.0;
  double Most = 0.0;
  Eigen::Matrix2d Squares = Eigen::Matrix2d::Zero();
};

} // namespace

struct StationaryFlow::Sample
{
  double sinuosity = 0.0;
  double stretch = 0.0;
  double unevenness = 0.0; ///< at most 1 if the flow fills the domain evenly
};

StationaryFlow::StationaryFlow(const BundleInitializerOptions& options, int attempt)
  : Direction{ [&]
    {
      RandomEngine engine = streamOf(options, 0, attempt);
      const double length = options.lateralCorrelationLength();
      const WaveField::Along along = { 0.0, std::sqrt(2.0) / (lengthAlong * length), lengthOfWaves(options) };
      return WaveField(widthOfWaves(options, length), length, along, engine);
    }() }
  , Undulation{ [&]
    {
      RandomEngine engine = streamOf(options, 1, attempt);
      const double waveNumber = 2.0 * pi / options.undulationWavelength;
      const WaveField::Along along = { waveNumber, undulationBandwidth * waveNumber, lengthOfWaves(options) };
      return WaveField(widthOfWaves(options, undulationLength(options)), undulationLength(options), along, engine);
    }() }
{
  this->Direction.skewness = skewnessFor(options.meanDispersion);
}

StationaryFlow StationaryFlow::draw(const BundleInitializerOptions& options, const Context& context)
{
  const double width = widthOf(options);
  const double shortest = CoherentFlow::smallestLength * width;
  if (!(options.correlationLength >= shortest))
  {
    throw InvalidInput(text("CorrelationLength is ", options.correlationLength, " µm: give at least ", shortest,
      " µm in a domain of this width, or DispersionModel Watson for directions that do not depend on each other"));
  }
  const bool isLarge = width > manyLengths * options.correlationLength;
  const int draws = isLarge || options.meanDispersion == 0.0 ? 1 : mostDraws;
  std::optional<StationaryFlow> best;
  double least = 0.0;
  for (int attempt = 0; attempt < draws && (!best || least > 1.0); ++attempt)
  {
    context.checkpoint();
    StationaryFlow flow(options, attempt);
    flow.scaleToAngle(options);
    flow.Undulation.scale = std::sqrt(options.sinuosity - 1.0); // roughly
    const double unevenness = flow.followFibres(options, std::min(options.extent().z(), longestPath), context).unevenness;
    if (!best || unevenness < least)
    {
      best = std::move(flow);
      least = unevenness;
    }
  }
  const Sample sample = best->scaleToSinuosity(options, context);
  best->Reached.sinuosity = sample.sinuosity;
  best->Reached.stretch = sample.stretch;
  return std::move(*best);
}

StationaryFlow::Planes StationaryFlow::planesAt(double z) const
{
  return { this->Direction.field.plane(z), this->Undulation.field.plane(z) };
}

/// Returns the planes for so many points.
StationaryFlow::Planes StationaryFlow::planesAt(double z, std::size_t points, const Context& context) const
{
  Planes planes = this->planesAt(z);
  const auto prepare = [&](const Part& part, WaveField::Plane& plane)
  {
    if (part.scale > 0.0 && part.field.needsTable(points))
    {
      part.field.tabulate(plane, context);
    }
  };
  prepare(this->Direction, planes.direction);
  prepare(this->Undulation, planes.undulation);
  return planes;
}

Eigen::Vector2d StationaryFlow::slope(const Eigen::Vector2d& point, const Planes& planes, WaveField::Work& work) const
{
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  if (this->Direction.scale > 0.0)
  {
    const WaveField::Value value = this->Direction.field.at(point, planes.direction, work);
    sum += this->Direction.scale * std::exp(this->Direction.skewness * value.stream) * value.curl;
  }
  if (this->Undulation.scale > 0.0)
  {
    sum += this->Undulation.scale * this->Undulation.field.at(point, planes.undulation, work).curl;
  }
  return sum;
}

/// Scales the direction so that the mean angle in the domain is the one asked for.
void StationaryFlow::scaleToAngle(const BundleInitializerOptions& options)
{
  const double asked = options.meanDispersion * degree;
  if (asked == 0.0)
  {
    return;
  }
  std::vector<double> slopes;
  Turns turns;
  WaveField::Work work;
  const double height = options.extent().z();
  const std::vector<Eigen::Vector2d> grid = gridIn(options);
  for (int k = 0; k < anglePlanes; ++k)
  {
    const WaveField::Plane plane = this->Direction.field.plane(((k + 0.5) / anglePlanes - 0.5) * height);
    for (const Eigen::Vector2d& point : grid)
    {
      const WaveField::Value value = this->Direction.field.at(point, plane, work);
      const Eigen::Vector2d slope = std::exp(this->Direction.skewness * value.stream) * value.curl;
      slopes.push_back(slope.norm());
      turns.add(point, slope);
    }
  }
  // Newton's method from below, where the mean is a concave function of the scale.
  double scale = 0.0;
  double mean = 0.0;
  for (int step = 0; step < 60 && asked - mean > 1e-12; ++step)
  {
    double rise = 0.0;
    mean = 0.0;
    for (const double s : slopes)
    {
      mean += std::atan(scale * s) / static_cast<double>(slopes.size());
      rise += s / (1.0 + scale * scale * s * s) / static_cast<double>(slopes.size());
    }
    scale += (asked - mean) / rise;
  }
  std::transform(slopes.begin(), slopes.end(), slopes.begin(), [&](double s) { return std::atan(scale * s); });
  this->LocalUnevenness = std::max(turns.unevenness(), distanceToWatson(std::move(slopes)) / evenDistanceOfAll);
  this->Direction.scale = scale;
  this->Reached.meanAngle = mean / degree;
}

StationaryFlow::Sample StationaryFlow::followFibres(
  const BundleInitializerOptions& options, double height, const Context& context) const
{
  struct Fibre
  {
    double length = 0.0;
    Eigen::Vector2d bottom;
    Eigen::Vector2d top;
  };
  const int steps = std::max(2, static_cast<int>(std::ceil(0.5 * height / std::min(2.5, 0.1 * options.undulationWavelength))));
  const std::vector<Eigen::Vector2d> grid = gridIn(options);
  std::vector<Fibre> fibres(grid.size());
  for (const double sense : { 1.0, -1.0 })
  {
    const double step = sense * 0.5 * height / steps;
    std::vector<Planes> planes; // at starts of steps and between
    planes.reserve(2 * static_cast<std::size_t>(steps));
    for (int i = 0; i < 2 * steps; ++i)
    {
      planes.push_back(this->planesAt(0.5 * i * step));
    }
    parallelFor((grid.size() + together - 1) / together, context,
      [&](std::size_t block)
      {
        WaveField::Work work;
        for (std::size_t f = block * together; f < std::min(grid.size(), (block + 1) * together); ++f)
        {
          Fibre& fibre = fibres[f];
          Eigen::Vector2d point = grid[f];
          for (int i = 0; i < steps; ++i)
          {
            const auto at = static_cast<std::size_t>(2 * i);
            const Eigen::Vector2d half = point + 0.5 * step * this->slope(point, planes[at], work);
            const Eigen::Vector2d s = this->slope(half, planes[at + 1], work);
            fibre.length += std::abs(step) * std::sqrt(1.0 + s.squaredNorm());
            point += step * s;
          }
          (sense > 0.0 ? fibre.top : fibre.bottom) = point;
        }
      });
  }

  Sample sample;
  std::vector<double> angles;
  Turns turns;
  const auto count = static_cast<double>(fibres.size());
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    const Fibre& fibre = fibres[f];
    const double shift = (fibre.top - fibre.bottom).norm();
    sample.stretch += fibre.length / height / count;
    sample.sinuosity += fibre.length / std::hypot(shift, height) / count;
    angles.push_back(std::atan2(shift, height));
    turns.add(grid[f], fibre.top - fibre.bottom);
  }
  if (options.border == Border::Periodic)
  {
    sample.unevenness = this->LocalUnevenness; // from end to end, fibres have no angle
  }
  else if (options.meanDispersion > 0.0)
  {
    sample.unevenness = std::max({ this->LocalUnevenness, turns.unevenness(), distanceToWatson(angles) / evenDistance });
  }
  return sample;
}

/// Scales the undulation so that the sinuosity of fibres that pass the domain is the one asked for. Fibres whose directions alone
/// make them longer do not undulate.
StationaryFlow::Sample StationaryFlow::scaleToSinuosity(const BundleInitializerOptions& options, const Context& context)
{
  constexpr double precision = 2e-4;
  constexpr int rounds = 8;
  const double height =
    options.border == Border::Periodic ? options.extent().z() : measuredWavelengths * options.undulationWavelength;
  this->Undulation.scale = 0.0;
  Sample sample = this->followFibres(options, height, context);
  const double straight = sample.sinuosity;
  const double wanted = options.sinuosity - straight;
  if (wanted <= precision)
  {
    return sample;
  }
  // The excess grows with the square of the scale.
  double squared = wanted;
  for (int round = 0; round < rounds; ++round)
  {
    this->Undulation.scale = std::sqrt(squared);
    sample = this->followFibres(options, height, context);
    const double excess = sample.sinuosity - straight;
    if (std::abs(excess - wanted) <= precision)
    {
      break;
    }
    squared *= std::clamp(wanted / std::max(excess, 0.1 * wanted), 0.25, 4.0);
  }
  return sample;
}

FlowPaths StationaryFlow::carry(const std::vector<Eigen::Vector2d>& middle, double height, const Context& context) const
{
  const int steps = std::max(4, static_cast<int>(std::ceil(0.5 * height / planeDistance)));
  FlowPaths paths;
  paths.isFarEnough = true;
  paths.places.assign(2 * static_cast<std::size_t>(steps) + 1, {});
  paths.places[static_cast<std::size_t>(steps)] = middle;
  for (const int sense : { 1, -1 })
  {
    const double step = sense * 0.5 * height / steps;
    Planes begin = this->planesAt(0.0, middle.size(), context);
    for (int i = 0; i < steps; ++i)
    {
      const Planes half = this->planesAt((i + 0.5) * step, middle.size(), context);
      Planes end = this->planesAt((i + 1.0) * step, middle.size(), context);
      const std::vector<Eigen::Vector2d>& from = paths.places[static_cast<std::size_t>(steps + sense * i)];
      std::vector<Eigen::Vector2d>& to = paths.places[static_cast<std::size_t>(steps + sense * (i + 1))];
      to.resize(from.size());
      parallelFor((from.size() + together - 1) / together, context,
        [&](std::size_t block)
        {
          WaveField::Work work;
          for (std::size_t p = block * together; p < std::min(from.size(), (block + 1) * together); ++p)
          {
            const Eigen::Vector2d a = this->slope(from[p], begin, work);
            const Eigen::Vector2d b = this->slope(from[p] + 0.5 * step * a, half, work);
            const Eigen::Vector2d c = this->slope(from[p] + 0.5 * step * b, half, work);
            const Eigen::Vector2d d = this->slope(from[p] + step * c, end, work);
            to[p] = from[p] + step / 6.0 * (a + 2.0 * (b + c) + d);
          }
        });
      begin = std::move(end);
    }
  }
  return paths;
}

} // namespace cactus
