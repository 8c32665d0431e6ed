// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/VectorUnit.h"

#include <cstddef>
#include <cstdint>

namespace cactus
{

/// One fibre, and what its costs compare it with (see FibreCosts). All are indexed by control point.
struct FibreColumns
{
  std::size_t count;              ///< number of its control points, at least 2
  const double* points;           ///< x, y and z of one point after the other
  const double* radii;            ///< at each
  const double* referenceLengths; ///< per segment, at its first control point
  const float* smallestCosines;   ///< limit of the bend at each inner control point
};

/// Where derivatives by its control points are added, as in FibreGradients.
struct FibreColumnGradients
{
  double* byPoint;
  double* byRadius;
  double* stiffness;
};

/// The terms of FibreCosts that apply to all control points of a fibre.
struct FibreCostKernels
{
  /// Size of the kernels' work space for that many control points.
  static constexpr std::size_t roomFor(std::size_t points) { return 23 * (points + 32); }

  /// Adds the cost of curvature. Writes to `sharp` the control points whose bends are sharper than is free to take, and returns
  /// their number.
  std::size_t (*addCurvature)(const FibreColumns& fibre, double weight, double& total, const FibreColumnGradients& gradients,
    double* room, std::uint32_t* sharp);

  /// Adds the cost of length.
  void (*addLength)(const FibreColumns& fibre, double weight, double& total, const FibreColumnGradients& gradients, double* room);
};

CACTUS_KERNEL_VERSIONS(FibreCostKernels);

} // namespace cactus
