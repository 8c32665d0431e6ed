// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"

#include <Eigen/Core>

#include <vector>

namespace cactus
{

/// How thick a fibre along a line is, and where its line ends (µm).
struct FibreSize
{
  double radius = 0.0;  ///< at the start
  double target = 0.0;  ///< after growth
  double margin = 0.0;  ///< the fibre extends beyond the domain by this and its target radius
  double spacing = 0.0; ///< of control points
  bool isBare = false;  ///< whether it has no myelin
};

/// Adds a fibre along the part of a line between its first entry into the domain with its margin and its last exit, with evenly
/// spaced control points. A part too short for the fibre to touch the domain adds none.
void addFibreAlong(const std::vector<Eigen::Vector3d>& line, int bundleId, const FibreSize& size, Fibres& fibres);

} // namespace cactus
