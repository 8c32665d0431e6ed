// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleTree.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace cactus
{

/// The closest points of two surfaces.
struct SurfaceGap
{
  double distance = std::numeric_limits<double>::infinity(); ///< µm; 0 if they meet, infinite if nothing was found
  std::uint32_t triangleA = 0;
  std::uint32_t triangleB = 0;
  Eigen::Vector3d pointA = Eigen::Vector3d::Zero(); ///< on triangleA, and next to pointB; undefined if they meet
  Eigen::Vector3d pointB = Eigen::Vector3d::Zero();

  bool found() const { return this->distance < std::numeric_limits<double>::infinity(); }
};

/// Returns the shortest distance of two surfaces (µm) over all pairs of triangles, between a corner and a face or between two
/// edges, if it is below `below`; else finds nothing. It is 0 exactly if they meet (see trianglesMeet()), accurate to a few units
/// in the last place of the coordinates, and never 0 by rounding. One surface inside the other has a distance, too.
SurfaceGap smallestGap(const TriangleTree& a, const TriangleTree& b, double below = std::numeric_limits<double>::infinity());

/// Returns the triangles of `a` that come nearer than `distance` (µm, positive) to `b`, or meet it, in increasing order.
std::vector<std::uint32_t> trianglesNear(const TriangleTree& a, const TriangleTree& b, double distance);

} // namespace cactus
