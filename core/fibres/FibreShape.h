// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace cactus
{

/// The shape of fibres, which an optimiser should change as little as it can.
struct FibreShape
{
  double meanDispersion = 0.0;     ///< degrees, see meanDispersion
  double tangentDispersion = 0.0;  ///< degrees, see meanTangentDispersion
  double crossingAngle = 0.0;      ///< degrees, largest angle between the axes of two bundles; 0 for a single one
  double totalLength = 0.0;        ///< µm, of all centre lines
  double smallestBendRadius = 0.0; ///< smallest radius of the circle through three consecutive control points, as a multiple of
                                   ///< the fibre's radius there; infinite where all are straight
  double smallestCurvatureRadius = 0.0; ///< µm, the smallest such radius itself
};

/// Measures the fibres over their whole length, also outside the domain.
FibreShape measureShape(const Fibres& fibres);

/// Kolmogorov–Smirnov distance between the radii of two sets of fibres: the largest difference of their distribution functions,
/// each fibre counting once with the mean radius of its control points.
double radiusDistance(const Fibres& a, const Fibres& b);

/// Returns the length (µm) of a fibre's centre line up to each of its control points.
std::vector<double> arcLengths(const Fibres& fibres, std::size_t fibre);

/// Returns the length (µm) of fibre number `fibre`'s centre line inside the domain.
double lengthInDomain(const Fibres& fibres, std::size_t fibre);

/// Returns the unit vector along a fibre at each of its control points, halfway between those of the segments there; where the
/// line turns back on itself, that of the next segment.
std::vector<Eigen::Vector3d> unitTangents(const Fibres& fibres, std::size_t fibre);

} // namespace cactus
