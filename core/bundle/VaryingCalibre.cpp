// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/VaryingCalibre.h"

#include "base/Limits.h"
#include "base/MyelinThickness.h"
#include "base/RandomVariates.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace cactus
{

namespace
{

/// The deviation falls with this power of the radius (mouse, human and monkey axons of 0.5 to 2 µm).
constexpr double fallOff = 0.3;
constexpr double largestDeviation = 0.6; ///< of a thin fibre
/// What occurs of the normal variable: axons swell further than they narrow (mouse: 1.64 and 0.59 times the mean).
constexpr double lowestNormal = -2.0;
constexpr double highestNormal = 3.0;
/// Length of the process, in correlation lengths: between control points the radius is linear, and growth and surfaces smooth it,
/// too.
constexpr double shortening = 0.8;

/// Returns the part of the variance that growth to a volume fraction of fibres leaves.
double keptByGrowth(double fraction)
{
  return 1.0 - 0.52 * std::pow(fraction / 0.9, 3.0);
}

/// Returns the deviation before growth to a volume fraction of fibres that comes out as the one asked for. By measurements of
/// default bundles (tools/benchmarks/calibre.py): reached² = own² + kept · begun².
double deviationBeforeGrowth(double asked, double fraction)
{
  const double own = 0.15 * std::pow(fraction / 0.9, 5.4);
  return std::sqrt(std::max(0.0, asked * asked - own * own) / keptByGrowth(fraction));
}

/// Returns the radius (µm) of an axon at its thinnest neck before its neighbours' growth to a volume fraction of fibres squeezes
/// it, so that a voxel of 0.1 µm still resolves it, or one of 0.05 µm, which axons without myelin need anyway.
double thinnestAxon(double fraction, bool isBare)
{
  return (isBare ? 0.5 : 1.0) * (0.12 + 0.1 * std::pow(fraction / 0.9, 4.0));
}

/// Returns the g-ratio of a fibre, as far as its source knows it: it says how much thicker the same myelin makes the fibre.
double expectedGRatio(const RadiusDistributionOptions& drawn, double grownRadius)
{
  constexpr double usual = 0.7;
  if (drawn.model != RadiusModel::Histogram)
  {
    return usual;
  }
  return drawn.histogramGRatio > 0.0 ? drawn.histogramGRatio : logLinearGRatio(2.0 * grownRadius);
}

/// Returns the radius at which the deviation is its mean over fibres: the power mean of the radii.
double typicalRadius(const RadiusDistributionOptions& drawn, std::uint64_t seed)
{
  constexpr std::uint64_t draws = 1000;
  double sum = 0.0;
  for (std::uint64_t i = 0; i < draws; ++i)
  {
    sum += std::pow(sampleRadius(drawn, seed, i), -fallOff);
  }
  return std::pow(sum / static_cast<double>(draws), -1.0 / fallOff);
}

/// The Gaussian process of one fibre. White noise at knots along the fibre is summed with weights exp(-√3 d/ℓ), whose convolution
/// with themselves is the correlation.
class CalibreProcess
{
public:
  /// Draws the noise for a fibre that reaches `half` (µm) to either side of its middle and, if asked, repeats after that.
  CalibreProcess(double correlationLength, std::uint64_t seed, int fibreId, double half, bool repeats)
    : KnotsPerLength(repeats
                       ? correlationLength * std::max(1.0, std::round(2.0 * half * usualKnots / correlationLength)) / (2.0 * half)
                       : usualKnots)
    , Spacing(correlationLength / this->KnotsPerLength)
    , First(static_cast<std::int64_t>(std::floor(-half / this->Spacing)) - reach)
  {
    const auto last = static_cast<std::int64_t>(std::ceil(half / this->Spacing)) + reach;
    const auto period = repeats ? std::llround(2.0 * half / this->Spacing) : 0;
    for (std::int64_t knot = this->First; knot <= last; ++knot)
    {
      const std::int64_t drawn = period > 0 ? (knot % period + period) % period : knot;
      const std::uint64_t item = (std::uint64_t(std::uint32_t(fibreId)) << 32) | std::uint32_t(drawn);
      RandomEngine engine = randomStream(seed, RandomStage::Calibre, item);
      this->Noise.push_back(normal(engine));
    }
  }

  /// Returns z at a length (µm) from the fibre's middle.
  double at(double length) const
  {
    const double place = length / this->Spacing;
    const double below = std::floor(place);
    const auto left = static_cast<std::size_t>(static_cast<std::int64_t>(below) - this->First);
    const double decay = std::exp(-std::sqrt(3.0) / this->KnotsPerLength);
    double leftWeight = std::exp(-std::sqrt(3.0) / this->KnotsPerLength * (place - below));
    double rightWeight = decay / leftWeight;
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t k = 0; k < reach; ++k)
    {
      sum += leftWeight * this->Noise[left - k] + rightWeight * this->Noise[left + 1 + k];
      squares += leftWeight * leftWeight + rightWeight * rightWeight;
      leftWeight *= decay;
      rightWeight *= decay;
    }
    return sum / std::sqrt(squares);
  }

private:
  static constexpr double usualKnots = 4.0;
  static constexpr int reach = 40; ///< knots, beyond which weights are below 1e-7

  double KnotsPerLength; ///< correlation length
  double Spacing;
  std::int64_t First;
  std::vector<double> Noise;
};

/// Returns the correlation of the process at a distance of so many correlation lengths.
double correlationAt(double distance)
{
  const double x = std::sqrt(3.0) * distance;
  return (1.0 + x) * std::exp(-x);
}

/// Returns the mean of the outer radius squared, relative to that of an axon of its median radius, by the trapezoidal rule.
double meanSquare(double gRatio, double deviation)
{
  constexpr int steps = 60; // on either side, of a tenth of a deviation
  double sum = 0.0;
  double weights = 0.0;
  for (int step = -steps; step <= steps; ++step)
  {
    const double x = 0.1 * step;
    const double weight = std::exp(-0.5 * x * x);
    const double radius = 1.0 - gRatio + gRatio * std::exp(deviation * std::clamp(x, lowestNormal, highestNormal));
    sum += weight * radius * radius;
    weights += weight;
  }
  return sum / weights;
}

/// The outer radii of one fibre's control points.
struct CalibredFibre
{
  std::vector<double> lengths; ///< µm, of the control points from the fibre's beginning, or of those of its first period
  double apart;                ///< µm, mean distance of neighbouring control points
  double half; ///< µm, that of the middle, from which the calibre is drawn, or half the period of a fibre that repeats
  bool repeats;
  double radius; ///< µm, root mean square
  double gRatio;
  double thinnest; ///< µm, radius of an axon's thinnest neck
  int id;
};

/// Lognormal calibre of all fibres.
class LognormalCalibre
{
public:
  explicit LognormalCalibre(const BundleInitializerOptions& options)
    : Asked(deviationBeforeGrowth(options.calibre.deviation, options.grownFibreVolumeFraction))
    , Typical(this->Asked > 0.0 ? typicalRadius(options.radius, options.seed) : 1.0)
    , Length(shortening * options.calibre.correlationLength)
    , Seed(options.seed)
  {
  }

  bool varies() const { return this->Asked > 0.0; }

  std::vector<double> radii(const CalibredFibre& line) const
  {
    // Between control points the radius is interpolated, which takes some of the variance.
    const double kept = (2.0 + correlationAt(line.apart / this->Length)) / 3.0;
    const double narrowest = std::log(line.thinnest / (line.gRatio * line.radius)) / lowestNormal;
    const double deviation = std::clamp(this->Asked * std::pow(line.radius / this->Typical, -fallOff) / std::sqrt(kept), 0.0,
      std::clamp(narrowest, 0.0, largestDeviation));
    const double scale = line.radius / std::sqrt(meanSquare(line.gRatio, deviation));
    const CalibreProcess process(this->Length, this->Seed, line.id, line.half, line.repeats);
    std::vector<double> radii;
    for (const double length : line.lengths)
    {
      const double z = std::clamp(process.at(length - line.half), lowestNormal, highestNormal);
      radii.push_back(scale * (1.0 - line.gRatio + line.gRatio * std::exp(deviation * z)));
    }
    return radii;
  }

private:
  double Asked;
  double Typical;
  double Length;
  std::uint64_t Seed;
};

/// Beads of all fibres.
class BeadedCalibre
{
public:
  explicit BeadedCalibre(const BundleInitializerOptions& options)
    : Shape(options.calibre.beads)
    , Height(this->Shape.heightOf(options.calibre.beadAmplitude) / std::sqrt(keptByGrowth(options.grownFibreVolumeFraction)))
    , Mean(this->Shape.mean())
    , MeanSquare(this->Shape.meanSquare())
    , Seed(options.seed)
  {
  }

  bool varies() const { return this->Height > 0.0; }

  std::vector<double> radii(const CalibredFibre& line) const
  {
    // Of the axon in units of its mean radius: (1 + a b) / (1 + a ⟨b⟩). A neck has b = 0.
    const double highest = std::max(0.0, (line.gRatio * line.radius / line.thinnest - 1.0) / this->Mean);
    const double a = std::min(this->Height, highest);
    const double mean = 1.0 + a * this->Mean;
    const double square = (1.0 + 2.0 * a * this->Mean + a * a * this->MeanSquare) / (mean * mean);
    const double g = line.gRatio;
    const double scale = line.radius / std::sqrt((1.0 - g) * (1.0 - g) + 2.0 * g * (1.0 - g) + g * g * square);
    const Beads beads(this->Shape, this->Seed, line.id, line.half, line.repeats);
    std::vector<double> radii;
    for (const double length : line.lengths)
    {
      radii.push_back(scale * (1.0 - g + g * (1.0 + a * beads.at(length - line.half)) / mean));
    }
    return radii;
  }

private:
  BeadShape Shape;
  double Height;
  double Mean;
  double MeanSquare;
  std::uint64_t Seed;
};

/// Varies all fibres' radii by one of the classes above.
template <typename Calibre>
void varyBy(const Calibre& calibre, const BundleInitializerOptions& options, Fibres& fibres)
{
  if (!calibre.varies())
  {
    return;
  }
  const double thinning = options.thinning();
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    const std::size_t first = fibres.offsets[f];
    const std::size_t last = fibres.offsets[f + 1] - 1;
    std::vector<double> lengths{ 0.0 };
    for (std::size_t p = first; p < last; ++p)
    {
      lengths.push_back(lengths.back() + (fibres.points[p + 1] - fibres.points[p]).norm());
    }
    // Of fibres that repeat, one period is drawn, and copied.
    const bool repeats = fibres.domain.periodic[2];
    const std::size_t period = repeats ? periodOf(fibres, f).points : last - first + 1;
    const double half = 0.5 * (repeats ? lengths[period] : lengths.back());
    const double apart = lengths.back() / static_cast<double>(lengths.size() - 1);
    lengths.resize(period);
    const double radius = fibres.radii[first];
    const double given = fibres.columns.value(targetGRatioColumn.name, f); // NaN: none
    const double gRatio = given > 0.0 ? given : expectedGRatio(options.radius, radius / thinning);
    const double thinnest = thinnestAxon(options.grownFibreVolumeFraction, isBare(fibres, f)) * thinning;
    const std::vector<double> varied =
      calibre.radii({ std::move(lengths), apart, half, repeats, radius, gRatio, thinnest, fibres.fibreIds[f] });
    for (std::size_t p = first; p <= last; ++p)
    {
      fibres.radii[p] = std::clamp(varied[(p - first) % period], limits::radius.lowest, limits::radius.highest);
    }
  }
}

} // namespace

void varyCalibre(const BundleInitializerOptions& options, Fibres& fibres)
{
  for (std::size_t f = 0; f < fibres.size() && options.calibre.gRatio > 0.0; ++f)
  {
    if (!isBare(fibres, f))
    {
      fibres.columns.set(targetGRatioColumn.name, f, options.calibre.gRatio);
    }
  }
  if (options.calibre.model == CalibreModel::Beads)
  {
    varyBy(BeadedCalibre(options), options, fibres);
  }
  else
  {
    varyBy(LognormalCalibre(options), options, fibres);
  }
  for (std::size_t f = 0; f < fibres.size() && options.calibre.sectionAxisRatio < 1.0; ++f)
  {
    fibres.columns.set(targetAxisRatioColumn.name, f, options.calibre.sectionAxisRatio);
  }
}

void varyCalibreInDomain(const BundleInitializerOptions& options, Fibres& fibres)
{
  const double before = capsuleVolumeInDomain(fibres);
  varyCalibre(options, fibres);
  const double after = capsuleVolumeInDomain(fibres);
  if (options.calibre.varies() && after > 0.0)
  {
    for (double& radius : fibres.radii)
    {
      radius = std::clamp(radius * std::sqrt(before / after), limits::radius.lowest, limits::radius.highest);
    }
  }
}

} // namespace cactus
