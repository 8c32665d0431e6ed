// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/OrientationDistribution.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "base/Numbers.h"
#include "base/SphericalHarmonics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cactus
{

namespace
{

constexpr int highestOrder = 16;
constexpr std::size_t rows = 256;    // from z = 0 to 1
constexpr std::size_t columns = 512; // around z

int orderOf(const std::vector<double>& coefficients)
{
  int order = 0;
  while (order < highestOrder && harmonicCount(order) < coefficients.size())
  {
    order += 2;
  }
  if (harmonicCount(order) != coefficients.size())
  {
    throw InvalidInput(text("OrientationHarmonics has ", coefficients.size(),
      " coefficients: give 1, 6, 15, 28 or 45 (even degrees up to 0, 2, 4, 6, 8, and so on up to ", highestOrder, ')'));
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

OrientationDistribution::OrientationDistribution(const std::vector<double>& coefficients)
{
  const int order = orderOf(coefficients);
  if (!std::all_of(coefficients.begin(), coefficients.end(), [](double c) { return std::isfinite(c); }))
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
      sum += valueAt(coefficients, order, directionAt(z, azimuth));
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

Eigen::Vector3d OrientationDistribution::at(double u, double v) const
{
  const double row = std::min(placeOf(this->Rows.data(), rows, u), static_cast<double>(rows) * (1.0 - 1e-15));
  const auto index = static_cast<std::size_t>(row);
  const double column = placeOf(&this->Columns[index * columns], columns, v);
  return directionAt(row / rows, 2.0 * pi * column / columns);
}

} // namespace cactus
