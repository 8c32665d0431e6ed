// SPDX-License-Identifier: BSD-3-Clause
#include "base/SphericalHarmonics.h"

#include "base/Constants.h"

#include <Eigen/QR>

#include <cmath>

namespace cactus
{

namespace
{

/// Returns N P_l^m(z) / (1 − z²)^(m/2) for all l up to `order` at one m, normalised for the sphere, by recursion over l.
std::vector<double> legendreAt(double z, int m, int order)
{
  std::vector<double> values(std::size_t(order) + 1, 0.0);
  double diagonal = std::sqrt(0.25 / pi);
  for (int i = 1; i <= m; ++i)
  {
    diagonal *= std::sqrt((2.0 * i + 1.0) / (2.0 * i));
  }
  values[std::size_t(m)] = diagonal;
  double before = 0.0;
  double last = diagonal;
  for (int l = m + 1; l <= order; ++l)
  {
    const double a = std::sqrt((4.0 * l * l - 1.0) / double(l * l - m * m));
    const double b = std::sqrt((double(l - 1) * (l - 1) - double(m) * m) / (4.0 * double(l - 1) * (l - 1) - 1.0));
    const double next = a * (z * last - b * before);
    before = last;
    last = next;
    values[std::size_t(l)] = next;
  }
  return values;
}

} // namespace

std::size_t harmonicCount(int order)
{
  return std::size_t(order + 1) * std::size_t(order + 2) / 2;
}

int orderOfHarmonics(std::size_t count)
{
  constexpr int highest = 16;
  int order = 0;
  while (order < highest && harmonicCount(order) < count)
  {
    order += 2;
  }
  return harmonicCount(order) == count ? order : -1;
}

std::vector<double> harmonicsAt(const Eigen::Vector3d& direction, int order)
{
  std::vector<double> values(harmonicCount(order), 0.0);
  // (x + iy)^m is (sin θ)^m (cos mφ + i sin mφ), also at the poles.
  double cosine = 1.0;
  double sine = 0.0;
  for (int m = 0; m <= order; ++m)
  {
    const std::vector<double> legendre = legendreAt(direction[2], m, order);
    const double factor = m == 0 ? 1.0 : m % 2 == 0 ? std::sqrt(2.0) : -std::sqrt(2.0);
    for (int l = m + m % 2; l <= order; l += 2)
    {
      const int middle = l * (l + 1) / 2;
      values[std::size_t(middle + m)] = factor * legendre[std::size_t(l)] * cosine;
      if (m > 0)
      {
        values[std::size_t(middle - m)] = factor * legendre[std::size_t(l)] * sine;
      }
    }
    const double next = cosine * direction[0] - sine * direction[1];
    sine = cosine * direction[1] + sine * direction[0];
    cosine = next;
  }
  return values;
}

HarmonicRotation::HarmonicRotation(const Eigen::Matrix3d& axes, int order)
{
  // A degree's functions rotate into functions of the same degree, which are determined by their values at enough directions.
  const int count = 4 * (2 * order + 1);
  std::vector<std::vector<double>> here;
  std::vector<std::vector<double>> before;
  for (int i = 0; i < count; ++i)
  {
    const double z = (i + 0.5) / count;
    const double angle = goldenAngle * i;
    const double radius = std::sqrt(1.0 - z * z);
    const Eigen::Vector3d direction(radius * std::cos(angle), radius * std::sin(angle), z);
    here.push_back(harmonicsAt(direction, order));
    before.push_back(harmonicsAt(axes.transpose() * direction, order));
  }
  for (int l = 0; l <= order; l += 2)
  {
    const int first = l * (l + 1) / 2 - l;
    const int size = 2 * l + 1;
    Eigen::MatrixXd values(count, size);
    Eigen::MatrixXd turned(count, size);
    for (int i = 0; i < count; ++i)
    {
      for (int place = 0; place < size; ++place)
      {
        values(i, place) = here[std::size_t(i)][std::size_t(first + place)];
        turned(i, place) = before[std::size_t(i)][std::size_t(first + place)];
      }
    }
    this->Blocks.emplace_back(values.colPivHouseholderQr().solve(turned));
  }
}

void HarmonicRotation::turn(std::vector<double>& coefficients) const
{
  Eigen::Map<Eigen::VectorXd> all(coefficients.data(), Eigen::Index(coefficients.size()));
  Eigen::Index first = 0;
  for (const Eigen::MatrixXd& block : this->Blocks)
  {
    all.segment(first, block.cols()) = (block * all.segment(first, block.cols())).eval();
    first += block.cols();
  }
}

} // namespace cactus
