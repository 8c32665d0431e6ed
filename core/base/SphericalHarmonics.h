// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace cactus
{

/// Real spherical harmonics of even degrees l up to an order, in MRtrix's basis and order: the coefficient of (l, m) has the
/// index l(l + 1)/2 + m; √2 N P_l^|m|(cos θ) sin |m|φ for m < 0, N P_l(cos θ) for m = 0 and √2 N P_l^m(cos θ) cos mφ for m > 0,
/// where N² = (2l + 1)(l − |m|)!/(4π(l + |m|)!) and P_l^m has the Condon–Shortley sign (−1)^m. They are orthonormal over the
/// sphere.

/// Returns their number: (order + 1)(order + 2)/2. `order` is even and not negative, here and below.
std::size_t harmonicCount(int order);

/// Returns the order that has this number of them; -1 if none has, or more than 16.
int orderOfHarmonics(std::size_t count);

/// Returns all of them at a direction (unit vector), by their indices.
std::vector<double> harmonicsAt(const Eigen::Vector3d& direction, int order);

/// Rotates functions on the sphere that are given by coefficients.
class HarmonicRotation
{
public:
  /// `axes`: the rotated axes x, y and z, as columns.
  HarmonicRotation(const Eigen::Matrix3d& axes, int order);

  /// Replaces the coefficients by those of the rotated function, whose value at axes·d is that of the given one at d. The list
  /// has harmonicCount() entries.
  void turn(std::vector<double>& coefficients) const;

private:
  std::vector<Eigen::MatrixXd> Blocks; ///< per degree, since degrees rotate separately
};

} // namespace cactus
