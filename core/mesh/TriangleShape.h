// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cactus
{

/// Measures of a triangle's shape.
struct TriangleShape
{
  double edgeRatio; ///< longest over shortest squared edge; infinite if an edge has zero length
  double flatness;  ///< twice the area over the longest squared edge: the height on that edge over its length
};

inline TriangleShape shapeOf(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  const double edges[3] = { (b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm() };
  const double longest = std::max({ edges[0], edges[1], edges[2] });
  const double shortest = std::min({ edges[0], edges[1], edges[2] });
  return { shortest > 0.0 ? longest / shortest : std::numeric_limits<double>::infinity(),
    longest > 0.0 ? (b - a).cross(c - a).norm() / longest : 0.0 };
}

/// What triangles may be like where a surface is cut.
struct TriangleLimits
{
  double largestSquaredEdgeRatio;
  double leastFlatness; ///< as TriangleShape has it
  double leastHeight;   ///< µm

  /// Tells whether a triangle may be made of others, the flattest of which is as flat as `flattest`.
  bool allow(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, double flattest) const
  {
    const TriangleShape shape = shapeOf(a, b, c);
    const double longest = std::sqrt(std::max({ (b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm() }));
    return shape.edgeRatio <= this->largestSquaredEdgeRatio && shape.flatness >= std::min(flattest, this->leastFlatness) &&
           shape.flatness * longest >= this->leastHeight;
  }
};

} // namespace cactus
