// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/EditableSurface.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace cactus
{

/// The possible places of the point that replaces an edge, and their costs.
struct CollapseCandidates
{
  std::array<Eigen::Vector3d, 3> places; ///< µm
  std::array<double, 3> errors;          ///< mean squared distance to the planes of the triangles at the edge, µm²
  std::size_t count = 0;

  void add(const Eigen::Vector3d& place) { this->places[this->count++] = place; }
  std::size_t cheapest() const
  {
    return std::size_t(
      std::min_element(this->errors.begin(), this->errors.begin() + std::ptrdiff_t(this->count)) - this->errors.begin());
  }
};

/// Returns the place of the least quadric error, or the middle of the edge, and the edge's two ends. Points on faces of the box
/// stay on them: of two on different faces only one that is on all of them is a candidate, if there is one. A point on no face
/// keeps `margin` (µm) off the faces of `box` (see keptInside()).
CollapseCandidates collapseCandidates(
  const EditableSurface& surface, std::int32_t u, std::int32_t v, const Eigen::AlignedBox3d& box, double margin);

} // namespace cactus
