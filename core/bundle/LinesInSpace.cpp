// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/LinesInSpace.h"

#include "base/Constants.h"
#include "base/Random.h"
#include "bundle/OrientationDistribution.h"
#include "fibres/ColumnTable.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace cactus
{

namespace
{

/// Halton's sequence in four dimensions, all shifted by random numbers (modulo 1).
class ShiftedHalton
{
public:
  ShiftedHalton(std::uint64_t seed, std::uint64_t number)
  {
    RandomEngine engine = randomStream(seed, RandomStage::Directions, number);
    for (double& shift : this->Shifts)
    {
      shift = uniform(engine);
    }
  }

  std::array<double, 4> at(std::uint64_t index) const
  {
    static constexpr std::array<std::uint64_t, 4> bases = { 2, 3, 5, 7 };
    std::array<double, 4> point = this->Shifts;
    for (std::size_t i = 0; i < bases.size(); ++i)
    {
      double digit = 1.0;
      for (std::uint64_t rest = index + 1; rest > 0; rest /= bases[i])
      {
        digit /= static_cast<double>(bases[i]);
        point[i] += digit * static_cast<double>(rest % bases[i]);
      }
      point[i] -= std::floor(point[i]);
    }
    return point;
  }

private:
  std::array<double, 4> Shifts{};
};

/// A straight fibre, without its radius.
struct Line
{
  Eigen::Vector3d first;
  Eigen::Vector3d last;
  double lengthInDomain;
};

/// Returns the part of a segment of this length that is within `around` (µm) of the box, if it is longer than `shortest`.
std::optional<Line> partNear(
  const Domain& box, double around, const Eigen::Vector3d& begin, const Eigen::Vector3d& end, double length, double shortest)
{
  const std::array<double, 2> part = box.clip(begin, end, around);
  if (!(length * (part[1] - part[0]) > shortest))
  {
    return std::nullopt;
  }
  const std::array<double, 2> inside = box.clip(begin, end);
  return Line{ begin + (end - begin) * part[0], begin + (end - begin) * part[1], length * std::max(0.0, inside[1] - inside[0]) };
}

/// Lines of a bundle, which are made as far as they are asked for.
class LineSequence
{
public:
  LineSequence(const BundleInitializerOptions& options, const OrientationDistribution& directions, std::uint64_t number)
    : Directions(&directions)
    , Points(options.seed, number)
    , Box(options.domain())
    , Around(surroundings(options).sides)
    , Shortest(2.0 * options.radius.minimum)
  {
  }

  const Line& operator[](std::size_t place)
  {
    while (this->Lines.size() <= place)
    {
      this->addNext();
    }
    return this->Lines[place];
  }

private:
  /// Adds the next line that comes near the domain, if this one does.
  void addNext()
  {
    // Lines through this ball around the domain and its surroundings are laid evenly on the disc across each direction.
    const double reach = 0.5 * this->Box.size().norm() + std::sqrt(3.0) * this->Around;
    const std::array<double, 4> point = this->Points.at(this->Next++);
    const Eigen::Vector3d direction = this->Directions->at(point[0], point[1]);
    const double distance = reach * std::sqrt(point[2]);
    const double azimuth = 2.0 * pi * point[3];
    const double half = std::sqrt(reach * reach - distance * distance);
    const Eigen::Vector3d middle =
      turnTo(direction) * Eigen::Vector3d(distance * std::cos(azimuth), distance * std::sin(azimuth), 0.0);
    const Eigen::Vector3d begin = middle - half * direction;
    const Eigen::Vector3d end = middle + half * direction;
    if (const std::optional<Line> line = partNear(this->Box, this->Around, begin, end, 2.0 * half, this->Shortest))
    {
      this->Lines.push_back(*line);
    }
  }

  const OrientationDistribution* Directions;
  ShiftedHalton Points;
  Domain Box;
  double Around;
  double Shortest;
  std::uint64_t Next = 0;
  std::vector<Line> Lines;
};

/// Returns the radii of the first fibres, the largest first: those of any size then have successive lines, which are spread
/// evenly.
std::vector<double> radiiOf(const BundleInitializerOptions& options, std::size_t count)
{
  std::vector<double> radii(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    radii[i] = sampleRadius(options.radius, options.seed, i);
  }
  std::sort(radii.begin(), radii.end(), std::greater<>());
  return radii;
}

/// A line with the radius and the bundle of its fibre.
struct LaidLine
{
  Line line;
  double radius;
  int bundle;
  bool isBare = false; ///< an axon without myelin
};

double volumeInDomain(const LaidLine& fibre)
{
  return pi * fibre.radius * fibre.radius * fibre.line.lengthInDomain;
}

/// Returns lines beside a line, for axons of a radius that lie together, as far as they are within `around` (µm) of the box:
/// spread evenly over a disc across it (Vogel 1979, Math Biosci 44:179), which they would fill to 0.8.
std::vector<Line> clusterAround(const Line& line, double radius, int count, const Domain& box, double around)
{
  constexpr double density = 0.8;
  const double goldenAngle = pi * (3.0 - std::sqrt(5.0));
  const Eigen::Vector3d direction = (line.last - line.first).normalized();
  const Eigen::Matrix3d across = turnTo(direction);
  const double widest = radius * std::sqrt(count / density);
  const double half = box.size().norm() + std::sqrt(3.0) * around + widest; // beyond the box from each place beside the line
  std::vector<Line> lines;
  for (int k = 0; k < count; ++k)
  {
    const double distance = count > 1 ? radius * std::sqrt((k + 0.5) / density) : 0.0;
    const Eigen::Vector3d shift =
      across * Eigen::Vector3d(distance * std::cos(k * goldenAngle), distance * std::sin(k * goldenAngle), 0.0);
    const Eigen::Vector3d begin = 0.5 * (line.first + line.last) + shift - half * direction;
    const Eigen::Vector3d end = begin + 2.0 * half * direction;
    if (const std::optional<Line> beside = partNear(box, around, begin, end, 2.0 * half, 2.0 * radius))
    {
      lines.push_back(*beside);
    }
  }
  return lines;
}

/// Fibres of several bundles, laid as far as they are asked for.
class LaidBundles
{
public:
  explicit LaidBundles(const BundleInitializerOptions& options)
    : Options(&options)
    , Bundles(orientedBundles(options))
  {
    for (const OrientedBundle& bundle : this->Bundles)
    {
      this->Lines.emplace_back(options, *bundle.directions, this->Lines.size());
    }
  }

  /// Lays this number of fibres with myelin, in place of those laid before.
  std::vector<LaidLine> lay(std::size_t count)
  {
    std::vector<LaidLine> laid;
    this->Volumes.assign(this->Bundles.size(), 0.0);
    this->Used.assign(this->Bundles.size(), 0);
    this->All = 0.0;
    for (const double radius : radiiOf(*this->Options, count))
    {
      const std::size_t bundle = this->poorest();
      laid.push_back({ this->Lines[bundle][this->Used[bundle]++], radius, this->Bundles[bundle].id });
      this->count(bundle, volumeInDomain(laid.back()));
    }
    return laid;
  }

  /// Adds axons without myelin to the fibres just laid, in clusters, until they fill `wanted` (µm³) of the domain as nearly as
  /// they can.
  void addBare(double wanted, const Context& context, std::vector<LaidLine>& laid)
  {
    const UnmyelinatedAxons& axons = this->Options->unmyelinated;
    const RadiusDistributionOptions radii = axons.radii();
    double filled = 0.0;
    for (std::uint64_t i = UnmyelinatedAxons::firstItem; filled < wanted;)
    {
      context.checkpoint();
      const std::size_t bundle = this->poorest();
      const Line& middle = this->Lines[bundle][this->Used[bundle]++];
      for (const Line& line :
        clusterAround(middle, axons.radius, axons.cluster, this->Options->domain(), surroundings(*this->Options).sides))
      {
        const LaidLine axon{ line, sampleRadius(radii, this->Options->seed, i++), this->Bundles[bundle].id, true };
        const double volume = volumeInDomain(axon);
        if (filled + 0.5 * volume > wanted)
        {
          return;
        }
        filled += volume;
        this->count(bundle, volume);
        laid.push_back(axon);
      }
    }
  }

  /// Returns the coefficients of the directions asked for, see Fibres::orientationHarmonics; none if there is no scale for them.
  std::vector<double> harmonics() const
  {
    std::vector<double> sum;
    for (const OrientedBundle& bundle : this->Bundles)
    {
      std::vector<double> own = bundle.directions->harmonics();
      const double integral = own.front() * std::sqrt(4.0 * pi);
      if (!(integral > 0.0))
      {
        return {};
      }
      sum.resize(own.size(), 0.0);
      std::transform(own.begin(), own.end(), sum.begin(), sum.begin(),
        [&](double value, double before)
        { return before + value * bundle.share * this->Options->fibreVolumeFraction / integral; });
    }
    return sum;
  }

private:
  /// Returns the bundle that lacks most of its share of the volume in the domain.
  std::size_t poorest() const
  {
    std::size_t poorest = 0;
    for (std::size_t b = 1; b < this->Bundles.size(); ++b)
    {
      const auto lack = [&](std::size_t bundle) { return this->Bundles[bundle].share * this->All - this->Volumes[bundle]; };
      poorest = lack(b) > lack(poorest) ? b : poorest;
    }
    return poorest;
  }

  void count(std::size_t bundle, double volume)
  {
    this->Volumes[bundle] += volume;
    this->All += volume;
  }

  const BundleInitializerOptions* Options;
  std::vector<OrientedBundle> Bundles;
  std::vector<LineSequence> Lines;
  std::vector<double> Volumes;   ///< µm³, of the fibres laid of each bundle, in the domain
  double All = 0.0;              ///< µm³, of all of them
  std::vector<std::size_t> Used; ///< lines of each bundle
};

} // namespace

Fibres layLinesInSpace(const BundleInitializerOptions& options, const Context& context)
{
  LaidBundles bundles(options);
  const double whole = options.fibreVolumeFraction * options.domain().volume();
  const double wanted = (1.0 - options.unmyelinatedShare()) * whole;
  const auto volumeOf = [&](std::size_t count)
  {
    context.checkpoint();
    double volume = 0.0;
    for (const LaidLine& fibre : bundles.lay(count))
    {
      volume += volumeInDomain(fibre);
    }
    return volume;
  };
  std::size_t enough = 1;
  while (volumeOf(enough) < wanted)
  {
    enough *= 2;
  }
  std::size_t few = enough / 2;
  while (enough - few > 1)
  {
    const std::size_t between = few + (enough - few) / 2;
    (volumeOf(between) < wanted ? few : enough) = between;
  }
  Fibres fibres;
  fibres.domain = options.domain();
  fibres.grownFraction = options.grownFibreVolumeFraction;
  fibres.orientationHarmonics = bundles.harmonics();
  std::vector<LaidLine> laid = bundles.lay(enough);
  if (options.unmyelinated.any())
  {
    bundles.addBare(options.unmyelinatedShare() * whole, context, laid);
  }
  for (const auto& [line, radius, bundle, isBare] : laid)
  {
    const Eigen::Vector3d along = line.last - line.first;
    const int segments = std::max(2, static_cast<int>(std::lround(along.norm() / options.controlPointSpacing(radius))));
    fibres.addFibre(static_cast<int>(fibres.size()) + 1, bundle, radius);
    if (isBare)
    {
      fibres.columns.set(targetGRatioColumn.name, fibres.size() - 1, bareGRatio);
    }
    for (int k = 0; k <= segments; ++k)
    {
      fibres.addPoint(line.first + along * (static_cast<double>(k) / segments), radius);
    }
  }
  return fibres;
}

} // namespace cactus
