// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <vector>

namespace cactus
{

struct BundleInitializerOptions;

/// The direction of a fibre (unit vector), and the number of its bundle, from 1.
struct DrawnDirection
{
  Eigen::Vector3d direction;
  int bundle = 1;
};

/// A distribution of fibres' directions without sense.
class OrientationDistribution
{
public:
  OrientationDistribution() = default;
  OrientationDistribution(const OrientationDistribution&) = delete;
  OrientationDistribution& operator=(const OrientationDistribution&) = delete;
  virtual ~OrientationDistribution() = default;

  /// Returns the direction at the quantiles u and v, both in [0, 1): directions of evenly distributed quantiles have the
  /// distribution.
  virtual DrawnDirection at(double u, double v) const = 0;
  /// Returns its coefficients in real spherical harmonics of the degrees up to 8 (see base/SphericalHarmonics.h), on any scale.
  virtual std::vector<double> harmonics() const = 0;
};

/// Returns the distribution that DispersionModel::Harmonics and Peaks ask for. Throws as the classes below do.
std::unique_ptr<OrientationDistribution> orientationDistribution(const BundleInitializerOptions& options);

/// One given by its coefficients in spherical harmonics: a fibre orientation distribution of diffusion imaging. Its scale does
/// not matter, and it counts as 0 where it is negative. It is taken as constant in cells of about 0.3° to 5°.
class HarmonicsDistribution final : public OrientationDistribution
{
public:
  /// Throws InvalidInput, naming OrientationHarmonics, unless there are finite coefficients of an even order up to 16 whose
  /// function is positive somewhere.
  explicit HarmonicsDistribution(std::vector<double> coefficients);

  DrawnDirection at(double u, double v) const override; ///< z ≥ 0
  std::vector<double> harmonics() const override;

private:
  std::vector<double> Asked;
  std::vector<double> Rows;    ///< running sums of the distribution over rows of equal height along z
  std::vector<double> Columns; ///< running sums in each row, over azimuths
};

/// Bundles with Watson's distribution about an axis each.
class PeaksDistribution final : public OrientationDistribution
{
public:
  /// `peaks`: an axis of each bundle, whose length is the bundle's share; those without a length are left out. `meanAngle`: of a
  /// bundle's fibres to its axis, in degrees, 0 to 45. Throws InvalidInput, naming OrientationPeaks, for peaks that are not
  /// finite, and where none has a length.
  PeaksDistribution(const std::vector<Eigen::Vector3d>& peaks, double meanAngle);

  DrawnDirection at(double u, double v) const override;
  std::vector<double> harmonics() const override;

private:
  double angleAt(double quantile) const;

  std::vector<Eigen::Vector3d> Axes; ///< unit vectors
  std::vector<int> Bundles;          ///< the peaks' numbers
  std::vector<double> Shares;        ///< running sums, up to 1
  double Step = 0.0;                 ///< angle between entries of Angles
  std::vector<double> Angles{ 0.0 }; ///< distribution function of the angle to the axis
};

} // namespace cactus
