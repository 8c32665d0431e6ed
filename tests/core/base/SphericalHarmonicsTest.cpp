// SPDX-License-Identifier: BSD-3-Clause
#include "base/SphericalHarmonics.h"

#include "base/Constants.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace
{

constexpr int order = 8;

double valueAt(const std::vector<double>& coefficients, const Eigen::Vector3d& direction)
{
  const std::vector<double> harmonics = cactus::harmonicsAt(direction, order);
  double sum = 0.0;
  for (std::size_t i = 0; i < harmonics.size(); ++i)
  {
    sum += coefficients[i] * harmonics[i];
  }
  return sum;
}

/// Calls visit(direction, weight) for a quadrature that is exact for products of two harmonics: by midpoints around z, and by
/// many of them along z.
template <typename Visit>
void overSphere(Visit&& visit)
{
  constexpr int along = 2000;
  constexpr int around = 40;
  for (int i = 0; i < along; ++i)
  {
    const double z = -1.0 + 2.0 * (i + 0.5) / along;
    const double radius = std::sqrt(1.0 - z * z);
    for (int j = 0; j < around; ++j)
    {
      const double angle = 2.0 * cactus::pi * j / around;
      visit(Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), z), 4.0 * cactus::pi / (along * around));
    }
  }
}

TEST(SphericalHarmonics, AreOrthonormal)
{
  const auto count = Eigen::Index(cactus::harmonicCount(order));
  ASSERT_EQ(count, 45);
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(count, count);
  overSphere(
    [&](const Eigen::Vector3d& direction, double weight)
    {
      const std::vector<double> harmonics = cactus::harmonicsAt(direction, order);
      const Eigen::Map<const Eigen::VectorXd> values(harmonics.data(), count);
      products += weight * values * values.transpose();
    });
  EXPECT_LT((products - Eigen::MatrixXd::Identity(count, count)).cwiseAbs().maxCoeff(), 1e-4);
}

/// The values of MRtrix 3.0.3's `sh2amp` for unit coefficients at (0.3, −0.5, 0.7)/|…|.
TEST(SphericalHarmonics, AreThoseOfMrtrix)
{
  const std::vector<double> values = cactus::harmonicsAt(Eigen::Vector3d(0.3, -0.5, 0.7).normalized(), 2);
  const std::vector<double> wanted = { 0.28209481, -0.19744851, 0.46071321, 0.24319349, -0.27642792, -0.10530587 };
  ASSERT_EQ(values.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i)
  {
    EXPECT_NEAR(values[i], wanted[i], 1e-7) << i;
  }
}

TEST(SphericalHarmonics, AreFiniteAtThePoles)
{
  for (const double z : { -1.0, 1.0 })
  {
    const std::vector<double> values = cactus::harmonicsAt({ 0.0, 0.0, z }, order);
    for (int l = 0; l <= order; l += 2)
    {
      for (int m = -l; m <= l; ++m)
      {
        const double wanted = m == 0 ? std::sqrt((2.0 * l + 1.0) / (4.0 * cactus::pi)) : 0.0;
        EXPECT_NEAR(values[std::size_t(l * (l + 1) / 2 + m)], wanted, 1e-12);
      }
    }
  }
}

TEST(SphericalHarmonics, TurnWithTheirAxes)
{
  const Eigen::Matrix3d axes =
    (Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()) * Eigen::AngleAxisd(2.1, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
  std::vector<double> coefficients(cactus::harmonicCount(order));
  for (std::size_t i = 0; i < coefficients.size(); ++i)
  {
    coefficients[i] = std::cos(3.0 * double(i));
  }
  std::vector<double> turned = coefficients;
  cactus::HarmonicRotation(axes, order).turn(turned);
  for (int i = 0; i < 50; ++i)
  {
    const Eigen::Vector3d direction = Eigen::Vector3d(std::sin(i), std::cos(5.0 * i), std::sin(3.0 * i) + 0.1).normalized();
    EXPECT_NEAR(valueAt(turned, axes * direction), valueAt(coefficients, direction), 1e-10);
  }
}

} // namespace
