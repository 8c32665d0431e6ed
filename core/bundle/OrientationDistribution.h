// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <vector>

namespace cactus
{

/// A distribution of fibres' directions without sense, given by its coefficients in real spherical harmonics of even degrees (see
/// base/SphericalHarmonics.h): a fibre orientation distribution of diffusion imaging. Its scale does not matter, and it counts as
/// 0 where it is negative. It is taken as constant in cells of about 0.3° to 5°.
class OrientationDistribution
{
public:
  /// Throws InvalidInput, naming OrientationHarmonics, unless there are finite coefficients of an even order up to 16 whose
  /// function is positive somewhere.
  explicit OrientationDistribution(const std::vector<double>& coefficients);

  /// Returns the direction (unit vector, z ≥ 0) at the quantiles u and v, both in [0, 1): directions of evenly distributed
  /// quantiles have the distribution.
  Eigen::Vector3d at(double u, double v) const;

private:
  std::vector<double> Rows;    ///< running sums of the distribution over rows of equal height along z
  std::vector<double> Columns; ///< running sums in each row, over azimuths
};

} // namespace cactus
