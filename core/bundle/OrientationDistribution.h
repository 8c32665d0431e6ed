// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <vector>

namespace cactus
{

struct BundleInitializerOptions;

/// A distribution of the directions of a bundle's fibres, without sense.
class OrientationDistribution
{
public:
  OrientationDistribution() = default;
  OrientationDistribution(const OrientationDistribution&) = delete;
  OrientationDistribution& operator=(const OrientationDistribution&) = delete;
  virtual ~OrientationDistribution() = default;

  /// Returns the direction (unit vector) at the quantiles u and v, both in [0, 1): directions of evenly distributed quantiles
  /// have the distribution.
  virtual Eigen::Vector3d at(double u, double v) const = 0;
  /// Returns its coefficients in real spherical harmonics of the degrees up to 8 (see base/SphericalHarmonics.h), on any scale.
  virtual std::vector<double> harmonics() const = 0;
};

/// A bundle without an axis of its own.
struct OrientedBundle
{
  int id = 1;
  double share = 1.0; ///< of the fibres' volume
  std::unique_ptr<OrientationDistribution> directions;
};

/// Returns the bundles that DispersionModel::Harmonics and Peaks ask for, whose shares add up to 1. Those of Peaks have the
/// numbers of their peaks; a peak of length 0 is none. Throws InvalidInput, naming OrientationPeaks, for peaks that are not
/// finite, and where none has a length; and as HarmonicsDistribution does.
std::vector<OrientedBundle> orientedBundles(const BundleInitializerOptions& options);

/// One given by its coefficients in spherical harmonics: a fibre orientation distribution of diffusion imaging. Its scale does
/// not matter, and it counts as 0 where it is negative. It is taken as constant in cells of about 0.3° to 5°.
///
/// Dense fibres of many directions wind around each other once they are parted, which broadens the distribution of their
/// tangents. So directions are drawn from one that is sharper by as much.
class HarmonicsDistribution final : public OrientationDistribution
{
public:
  /// `fraction`: what the fibres fill while they are parted; 0 draws from the distribution as it is. Throws InvalidInput, naming
  /// OrientationHarmonics, unless there are finite coefficients of an even order up to 16 whose function is positive somewhere.
  explicit HarmonicsDistribution(std::vector<double> coefficients, double fraction = 0.0);

  Eigen::Vector3d at(double u, double v) const override; ///< z ≥ 0
  std::vector<double> harmonics() const override;

private:
  std::vector<double> Asked;
  std::vector<double> Rows;    ///< running sums of the distribution over rows of equal height along z
  std::vector<double> Columns; ///< running sums in each row, over azimuths
};

/// Watson's distribution about an axis.
class AxialDistribution final : public OrientationDistribution
{
public:
  /// `axis`: a unit vector. `meanAngle`: to the axis, in degrees, 0 to 45.
  AxialDistribution(const Eigen::Vector3d& axis, double meanAngle);

  Eigen::Vector3d at(double u, double v) const override;
  std::vector<double> harmonics() const override;

private:
  double angleAt(double quantile) const;

  Eigen::Vector3d Axis;
  double Step = 0.0;                 ///< angle between entries of Angles
  std::vector<double> Angles{ 0.0 }; ///< distribution function of the angle to the axis
};

} // namespace cactus
