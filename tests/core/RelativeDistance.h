// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Capsules.h"
#include "fibres/SegmentDistance.h"

#include <algorithm>
#include <cmath>

/// Returns the distance of two capsules over the limit up to which they are neighbours: the sum of their radii and reaches.
inline double relativeDistance(const cactus::Capsule& p, const cactus::Capsule& q, double reach)
{
  using Eigen::Vector3d;
  const auto pair = cactus::closestPoints(Vector3d::Map(p.p0), Vector3d::Map(p.p1), Vector3d::Map(q.p0), Vector3d::Map(q.p1));
  return pair.distance / (std::max(p.r0, p.r1) + std::max(q.r0, q.r1) + reach);
}

/// Returns the largest such distance of a pair that findNeighbours() may list.
inline double largestListed(const cactus::Capsule& p, const cactus::Capsule& q, double reach)
{
  using Eigen::Vector3d;
  const double limit = std::max(p.r0, p.r1) + std::max(q.r0, q.r1) + reach;
  const double lengths =
    (Vector3d::Map(p.p1) - Vector3d::Map(p.p0)).squaredNorm() + (Vector3d::Map(q.p1) - Vector3d::Map(q.p0)).squaredNorm();
  return std::sqrt(1.0 + 2.2e-5 * (1.0 + lengths / (limit * limit)));
}
