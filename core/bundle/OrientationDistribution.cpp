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

double valueAt(const std::vector<double>& coefficients, int order, const Eigen::Vector3d& direction)
{
  const std::vector<double> harmonics = harmonicsAt(direction, order);
  return std::max(0.0, std::inner_product(harmonics.begin(), harmonics.end(), coefficients.begin(), 0.0));
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

} // namespace

std::unique_ptr<OrientationDistribution> orientationDistribution(const BundleInitializerOptions& options)
{
  if (options.dispersionModel == DispersionModel::Peaks)
  {
    return std::make_unique<PeaksDistribution>(options.peaks, options.meanDispersion);
  }
  return std::make_unique<HarmonicsDistribution>(options.harmonics);
}

HarmonicsDistribution::HarmonicsDistribution(std::vector<double> coefficients)
  : Asked(std::move(coefficients))
{
  const int order = orderOf(this->Asked);
  if (!std::all_of(this->Asked.begin(), this->Asked.end(), [](double c) { return std::isfinite(c); }))
  {
    throw InvalidInput("OrientationHarmonics has a coefficient that is no finite number");
  }
  double all = 0.0;
  for (std::size_t row = 0; row < rows; ++row)
  {
    double sum = 0.0;
    for (std::size_t column = 0; column < columns; ++column)
    {
      const double z = (static_cast<double>(row) + 0.5) / rows;
      const double azimuth = 2.0 * pi * (static_cast<double>(column) + 0.5) / columns;
      sum += valueAt(this->Asked, order, directionAt(z, azimuth));
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

DrawnDirection HarmonicsDistribution::at(double u, double v) const
{
  const double row = std::min(placeOf(this->Rows.data(), rows, u), static_cast<double>(rows) * (1.0 - 1e-15));
  const auto index = static_cast<std::size_t>(row);
  const double column = placeOf(&this->Columns[index * columns], columns, v);
  return { directionAt(row / rows, 2.0 * pi * column / columns) };
}

std::vector<double> HarmonicsDistribution::harmonics() const
{
  std::vector<double> known = this->Asked;
  known.resize(std::min(known.size(), harmonicCount(comparedOrder)));
  return known;
}

PeaksDistribution::PeaksDistribution(const std::vector<Eigen::Vector3d>& peaks, double meanAngle)
{
  double all = 0.0;
  for (std::size_t i = 0; i < peaks.size(); ++i)
  {
    const double length = peaks[i].stableNorm();
    all += length;
    if (!std::isfinite(all))
    {
      throw InvalidInput(
        text("OrientationPeaks has a peak, ", i + 1, ", that is not finite: give lengths such as shares, 0 for none"));
    }
    if (length == 0.0)
    {
      continue;
    }
    this->Axes.emplace_back(peaks[i].stableNormalized());
    this->Bundles.push_back(static_cast<int>(i) + 1);
    this->Shares.push_back(all);
  }
  if (this->Axes.empty())
  {
    throw InvalidInput("OrientationPeaks has no peak: give x, y and z of one for each bundle, as long as the bundle's share");
  }
  for (double& share : this->Shares)
  {
    share /= all;
  }
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

double PeaksDistribution::angleAt(double quantile) const
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

DrawnDirection PeaksDistribution::at(double u, double v) const
{
  const auto found = std::upper_bound(this->Shares.begin(), this->Shares.end() - 1, u);
  const double before = found == this->Shares.begin() ? 0.0 : found[-1];
  const auto place = static_cast<std::size_t>(found - this->Shares.begin());
  const double angle = this->angleAt(std::clamp((u - before) / (*found - before), 0.0, 1.0));
  const Eigen::Vector3d aboutZ = directionAt(std::cos(angle), 2.0 * pi * v);
  return { turnTo(this->Axes[place]) * aboutZ, this->Bundles[place] };
}

std::vector<double> PeaksDistribution::harmonics() const
{
  // Those of a bundle about an axis are proportional to the harmonics at this axis, by the mean of P_l of each degree.
  constexpr int quantiles = 4096;
  std::vector<double> means(harmonicCount(comparedOrder), 0.0);
  for (int i = 0; i < quantiles; ++i)
  {
    const double angle = this->angleAt((i + 0.5) / quantiles);
    const std::vector<double> values = harmonicsAt({ std::sin(angle), 0.0, std::cos(angle) }, comparedOrder);
    for (int l = 0; l <= comparedOrder; l += 2)
    {
      const auto middle = static_cast<std::size_t>(l * (l + 1) / 2);
      means[middle] += values[middle] * std::sqrt(4.0 * pi / (2.0 * l + 1.0)) / quantiles;
    }
  }
  std::vector<double> sum(means.size(), 0.0);
  for (std::size_t peak = 0; peak < this->Axes.size(); ++peak)
  {
    const double share = this->Shares[peak] - (peak == 0 ? 0.0 : this->Shares[peak - 1]);
    const std::vector<double> values = harmonicsAt(this->Axes[peak], comparedOrder);
    for (int l = 0; l <= comparedOrder; l += 2)
    {
      for (int m = -l; m <= l; ++m)
      {
        const auto middle = static_cast<std::size_t>(l * (l + 1) / 2);
        const auto index = static_cast<std::size_t>(l * (l + 1) / 2 + m);
        sum[index] += share * means[middle] * values[index];
      }
    }
  }
  return sum;
}

} // namespace cactus
