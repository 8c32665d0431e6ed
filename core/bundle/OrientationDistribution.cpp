// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/OrientationDistribution.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "base/Numbers.h"
#include "base/SphericalHarmonics.h"
#include "bundle/BundleInitializerOptions.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace cactus
{

namespace
{

constexpr int comparedOrder = 8;     // of what is compared with the directions reached
constexpr std::size_t rows = 256;    // from z = 0 to 1
constexpr std::size_t columns = 512; // around z

int orderOf(const std::vector<double>& coefficients)
{
  const int order = orderOfHarmonics(coefficients.size());
  if (order < 0)
  {
    throw InvalidInput(text("OrientationHarmonics has ", coefficients.size(),
      " coefficients: give 1, 6, 15, 28 or 45 (even degrees up to 0, 2, 4, 6, 8, and so on up to 16)"));
  }
  return order;
}

std::size_t placeOfHarmonic(int l, int m)
{
  return static_cast<std::size_t>(l * (l + 1) / 2 + m);
}

double valueAt(const std::vector<double>& coefficients, int order, const Eigen::Vector3d& direction)
{
  const std::vector<double> harmonics = harmonicsAt(direction, order);
  return std::max(0.0, std::inner_product(harmonics.begin(), harmonics.end(), coefficients.begin(), 0.0));
}

/// Returns the mean of the sine of the angle between two fibres' directions: 0 if all are parallel, π/4 if none is preferred.
double meanSine(const std::vector<double>& coefficients, int order)
{
  // By the addition theorem, from the expansion of the sine in Legendre's polynomials.
  double expansion = 0.5 * pi;
  double sum = 0.0;
  for (int l = 0; l <= order; l += 2)
  {
    expansion *= l == 0 ? 1.0 : (l - 3.0) * (l - 1.0) / ((l + 2.0) * l);
    for (std::size_t i = placeOfHarmonic(l, -l); i <= placeOfHarmonic(l, l); ++i)
    {
      const double relative = coefficients[i] / coefficients[0];
      sum += 0.5 * expansion * relative * relative;
    }
  }
  return std::max(0.0, sum);
}

Eigen::Vector3d directionAt(double z, double azimuth)
{
  const double sine = std::sqrt(std::max(0.0, 1.0 - z * z));
  return { sine * std::cos(azimuth), sine * std::sin(azimuth), z };
}

/// Returns where a running sum reaches a share of its total: an index and the fraction of its step.
double placeOf(const double* sums, std::size_t count, double share)
{
  const double wanted = share * sums[count - 1];
  const double* found = std::upper_bound(sums, sums + count - 1, wanted);
  const double before = found == sums ? 0.0 : found[-1];
  const double step = *found - before;
  return static_cast<double>(found - sums) + (step > 0.0 ? std::clamp((wanted - before) / step, 0.0, 1.0) : 0.5);
}

/// Blurs functions on the cells of the grid as fibres' winding does: each component of a tangent deviates with a variance from
/// the fibre's direction, so that degree l falls by exp(-l(l + 1)/2 times the variance).
class Winding
{
public:
  explicit Winding(double variance)
  {
    constexpr double lowest = 1e-12; // of factors that matter
    for (int l = 0; l <= blurredOrder; l += 2)
    {
      const double factor = std::exp(-0.5 * l * (l + 1) * variance);
      this->Factors.push_back(factor > lowest ? factor : 0.0);
    }
    for (std::size_t row = 0; row < rows; ++row)
    {
      this->AtAzimuth0.push_back(harmonicsAt(directionAt((static_cast<double>(row) + 0.5) / rows, 0.0), blurredOrder));
    }
    for (int m = 0; m <= blurredOrder; ++m)
    {
      for (std::size_t column = 0; column < columns; ++column)
      {
        const double azimuth = 2.0 * pi * (static_cast<double>(column) + 0.5) / columns;
        this->Cosines.push_back(std::cos(m * azimuth));
        this->Sines.push_back(std::sin(m * azimuth));
      }
    }
  }

  std::vector<double> blurred(const std::vector<double>& function) const
  {
    // Harmonics are products of a function of the row and a cosine or sine of the azimuth.
    std::vector<double> coefficients(harmonicCount(blurredOrder), 0.0);
    for (std::size_t row = 0; row < rows; ++row)
    {
      for (int m = 0; m <= blurredOrder; ++m)
      {
        const double* values = &function[row * columns];
        const double cosines = std::inner_product(values, values + columns, &this->Cosines[m * columns], 0.0);
        const double sines = std::inner_product(values, values + columns, &this->Sines[m * columns], 0.0);
        for (int l = m + m % 2; l <= blurredOrder; l += 2)
        {
          const double ofRow = this->AtAzimuth0[row][placeOfHarmonic(l, m)] * 4.0 * pi / (rows * columns);
          coefficients[placeOfHarmonic(l, m)] += ofRow * cosines;
          coefficients[placeOfHarmonic(l, -m)] += m > 0 ? ofRow * sines : 0.0;
        }
      }
    }
    std::vector<double> result(function.size(), 0.0);
    for (std::size_t row = 0; row < rows; ++row)
    {
      for (int m = 0; m <= blurredOrder; ++m)
      {
        double cosines = 0.0;
        double sines = 0.0;
        for (int l = m + m % 2; l <= blurredOrder; l += 2)
        {
          const double ofRow = this->Factors[std::size_t(l / 2)] * this->AtAzimuth0[row][placeOfHarmonic(l, m)];
          cosines += ofRow * coefficients[placeOfHarmonic(l, m)];
          sines += m > 0 ? ofRow * coefficients[placeOfHarmonic(l, -m)] : 0.0;
        }
        for (std::size_t column = 0; column < columns; ++column)
        {
          result[row * columns + column] +=
            cosines * this->Cosines[m * columns + column] + sines * this->Sines[m * columns + column];
        }
      }
    }
    return result;
  }

private:
  static constexpr int blurredOrder = 16;

  std::vector<double> Factors;                 ///< per even degree
  std::vector<std::vector<double>> AtAzimuth0; ///< harmonics per row
  std::vector<double> Cosines;                 ///< of multiples of the azimuth, per multiple and column
  std::vector<double> Sines;
};

/// Returns the distribution whose fibres have the given one as they wind, as nearly as there is one, by the iteration of
/// Richardson (1972, J Opt Soc Am 62:55) and Lucy (1974, Astron J 79:745): it is positive where the given one is. Both are values
/// in the cells of the grid.
std::vector<double> sharpened(const std::vector<double>& asked, double variance)
{
  constexpr int iterations = 20;
  constexpr double least = 1e-3; // of the largest value, by which is divided
  const Winding winding(variance);
  const double floor = least * *std::max_element(asked.begin(), asked.end());
  std::vector<double> sharper = asked;
  for (int i = 0; i < iterations; ++i)
  {
    std::vector<double> ratios = winding.blurred(sharper);
    std::transform(asked.begin(), asked.end(), ratios.begin(), ratios.begin(),
      [&](double value, double blurred) { return value / std::max(blurred, floor); });
    ratios = winding.blurred(ratios);
    std::transform(sharper.begin(), sharper.end(), ratios.begin(), sharper.begin(),
      [](double value, double ratio) { return value * std::max(ratio, 0.0); });
  }
  return sharper;
}

/// Returns the variance of a component of tangents about their fibres' direction, once the optimiser has parted them, where
/// fibres of these directions fill a fraction. It was found by tools/benchmarks/crossings.py, for one and three peaks and
/// fractions of 0.2 to 0.6.
double variationByWinding(const std::vector<double>& coefficients, int order, double fraction)
{
  return coefficients[0] > 0.0 ? 0.257 * std::pow(fraction, 1.6) * meanSine(coefficients, order) : 0.0;
}

} // namespace

std::vector<OrientedBundle> orientedBundles(const BundleInitializerOptions& options)
{
  std::vector<OrientedBundle> bundles;
  if (options.dispersionModel != DispersionModel::Peaks)
  {
    bundles.push_back({ 1, 1.0, std::make_unique<HarmonicsDistribution>(options.harmonics, options.fibreVolumeFraction) });
    return bundles;
  }
  double all = 0.0;
  for (std::size_t i = 0; i < options.peaks.size(); ++i)
  {
    const double length = options.peaks[i].stableNorm();
    all += length;
    if (!std::isfinite(all))
    {
      throw InvalidInput(
        text("OrientationPeaks has a peak, ", i + 1, ", that is not finite: give lengths such as shares, 0 for none"));
    }
    if (length > 0.0)
    {
      bundles.push_back({ static_cast<int>(i) + 1, length,
        std::make_unique<AxialDistribution>(options.peaks[i].stableNormalized(), options.meanDispersion) });
    }
  }
  if (bundles.empty())
  {
    throw InvalidInput("OrientationPeaks has no peak: give x, y and z of one for each bundle, as long as the bundle's share");
  }
  for (OrientedBundle& bundle : bundles)
  {
    bundle.share /= all;
  }
  return bundles;
}

HarmonicsDistribution::HarmonicsDistribution(std::vector<double> coefficients, double fraction)
  : Asked(std::move(coefficients))
{
  const int order = orderOf(this->Asked);
  if (!std::all_of(this->Asked.begin(), this->Asked.end(), [](double c) { return std::isfinite(c); }))
  {
    throw InvalidInput("OrientationHarmonics has a coefficient that is no finite number");
  }
  std::vector<double> values;
  for (std::size_t row = 0; row < rows; ++row)
  {
    for (std::size_t column = 0; column < columns; ++column)
    {
      const double z = (static_cast<double>(row) + 0.5) / rows;
      const double azimuth = 2.0 * pi * (static_cast<double>(column) + 0.5) / columns;
      values.push_back(valueAt(this->Asked, order, directionAt(z, azimuth)));
    }
  }
  const double variance = variationByWinding(this->Asked, order, fraction);
  if (variance > 0.0)
  {
    values = sharpened(values, variance);
  }
  double all = 0.0;
  for (std::size_t row = 0; row < rows; ++row)
  {
    double sum = 0.0;
    for (std::size_t column = 0; column < columns; ++column)
    {
      sum += values[row * columns + column];
      this->Columns.push_back(sum);
    }
    all += sum;
    this->Rows.push_back(all);
  }
  if (!(all > 0.0) || !std::isfinite(all))
  {
    throw InvalidInput("OrientationHarmonics has no direction of positive density: the first coefficient is normally positive");
  }
}

Eigen::Vector3d HarmonicsDistribution::at(double u, double v) const
{
  const double row = std::min(placeOf(this->Rows.data(), rows, u), static_cast<double>(rows) * (1.0 - 1e-15));
  const auto index = static_cast<std::size_t>(row);
  const double column = placeOf(&this->Columns[index * columns], columns, v);
  return directionAt(row / rows, 2.0 * pi * column / columns);
}

std::vector<double> HarmonicsDistribution::harmonics() const
{
  std::vector<double> known = this->Asked;
  known.resize(std::min(known.size(), harmonicCount(comparedOrder)));
  return known;
}

AxialDistribution::AxialDistribution(const Eigen::Vector3d& axis, double meanAngle)
  : Axis(axis)
{
  if (meanAngle > 0.0)
  {
    const double kappa = watsonKappa(meanAngle);
    constexpr int intervals = 4096;
    this->Step = std::min(0.5 * pi, 9.0 / std::sqrt(kappa)) / intervals;
    double before = 0.0;
    for (int i = 1; i <= intervals; ++i) // by the trapezoidal rule
    {
      const double sine = std::sin(this->Step * i);
      const double weight = std::exp(-kappa * sine * sine) * sine;
      this->Angles.push_back(this->Angles.back() + before + weight);
      before = weight;
    }
  }
}

double AxialDistribution::angleAt(double quantile) const
{
  // Below the first entry it goes with the square of the angle.
  const double wanted = quantile * this->Angles.back();
  const auto found = std::upper_bound(this->Angles.begin(), this->Angles.end() - 1, wanted);
  const auto index = static_cast<double>(found - this->Angles.begin());
  if (index <= 1.0)
  {
    return this->Step * std::sqrt(this->Angles.size() > 1 ? wanted / this->Angles[1] : 0.0);
  }
  return this->Step * (index - (*found - wanted) / (*found - found[-1]));
}

Eigen::Vector3d AxialDistribution::at(double u, double v) const
{
  return turnTo(this->Axis) * directionAt(std::cos(this->angleAt(u)), 2.0 * pi * v);
}

std::vector<double> AxialDistribution::harmonics() const
{
  // They are proportional to the harmonics at the axis, by the mean of Legendre's polynomial of each degree.
  constexpr int quantiles = 4096;
  std::vector<double> coefficients = harmonicsAt(this->Axis, comparedOrder);
  std::vector<double> means(comparedOrder / 2 + 1, 0.0);
  for (int i = 0; i < quantiles; ++i)
  {
    const double cosine = std::cos(this->angleAt((i + 0.5) / quantiles));
    const std::vector<double> values = harmonicsAt(directionAt(cosine, 0.0), comparedOrder);
    for (int l = 0; l <= comparedOrder; l += 2)
    {
      const double ofPolynomial = std::sqrt(4.0 * pi / (2.0 * l + 1.0));
      means[std::size_t(l / 2)] += ofPolynomial * values[placeOfHarmonic(l, 0)] / quantiles;
    }
  }
  for (int l = 0; l <= comparedOrder; l += 2)
  {
    for (std::size_t i = placeOfHarmonic(l, -l); i <= placeOfHarmonic(l, l); ++i)
    {
      coefficients[i] *= means[std::size_t(l / 2)];
    }
  }
  return coefficients;
}

} // namespace cactus
