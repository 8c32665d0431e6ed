// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Random.h"
#include "fibres/Fibres.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

/// Makes a straight bundle along z of about the requested number of capsules, as the optimiser gets them: radii between 0.25 and
/// 1.65 µm (mean 0.6), overlapping at random, dispersion about 4°, three quarters of the cross-section filled. It skips
/// BundleInitializer's packing, so that ten million capsules take a second.
inline cactus::Fibres benchmarkBundle(std::size_t capsules)
{
  const double spacing = 0.8;
  const double pitch = 1.35;
  // side² / pitch² fibres of side / spacing capsules each.
  const double side = std::cbrt(static_cast<double>(capsules) * pitch * pitch * spacing);
  const int rows = std::max(2, static_cast<int>(std::lround(side / pitch)));
  const int segments = std::max(2, static_cast<int>(std::lround(side / spacing)));
  cactus::Fibres fibres;
  fibres.domain = cactus::Domain::cube(side);
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < rows; ++column)
    {
      const auto fibre = static_cast<std::uint64_t>(row) * static_cast<std::uint64_t>(rows) + static_cast<std::uint64_t>(column);
      cactus::RandomEngine random = cactus::randomStream(1, cactus::RandomStage::Directions, fibre);
      // One draw a statement: the order of evaluation within one is the compiler's.
      double numbers[6];
      for (double& number : numbers)
      {
        number = cactus::uniform(random);
      }
      const double radius = 0.25 + 1.4 * numbers[0] * numbers[1];
      const Eigen::Vector3d from(
        (row + numbers[2]) * pitch - 0.5 * side, (column + numbers[3]) * pitch - 0.5 * side, -0.5 * side);
      const Eigen::Vector3d slope(0.2 * numbers[4] - 0.1, 0.2 * numbers[5] - 0.1, 1.0);
      fibres.addFibre(static_cast<int>(fibre) + 1, 1, radius);
      for (int i = 0; i <= segments; ++i)
      {
        fibres.addPoint(from + (side * i / segments) * slope, radius);
      }
    }
  }
  return fibres;
}
