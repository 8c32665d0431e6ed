// SPDX-License-Identifier: BSD-3-Clause
// Pairs of nearly parallel capsules, whose distance is least accurate in single precision.
#pragma once

#include "fibres/Fibres.h"
#include "fibres/SegmentDistance.h"

#include <cmath>
#include <random>

/// Makes fibres of one capsule each. Fibres 2n and 2n + 1 are at angles of 10⁻² to 10⁻⁷, side by side or one behind the other,
/// `relativeDistance` times the sum of their radii apart, and far from all others.
inline cactus::Fibres nearlyParallelPairs(unsigned seed, int pairs, double relativeDistance)
{
  using Eigen::Vector3d;
  std::mt19937 engine(seed);
  const auto uniform = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(engine); };
  cactus::Fibres fibres;
  fibres.domain = cactus::Domain::cube(100.0);
  for (int n = 0; n < pairs; ++n)
  {
    const Vector3d origin = 10.0 * Vector3d(n % 10, n / 10 % 10, n / 100) - Vector3d::Constant(45.0);
    const double radii[2] = { uniform(0.1, 0.8), uniform(0.1, 0.8) };
    const double angle = uniform(0.0, 6.3);
    const Vector3d sideways(std::cos(angle), std::sin(angle), 0.0);
    const double slope = std::pow(10.0, -uniform(2.0, 7.0));
    const Vector3d p0 = origin;
    const Vector3d p1 = origin + Vector3d(0.0, 0.0, uniform(0.3, 3.0));
    Vector3d q0 = origin + Vector3d(1.0, 0.0, uniform(-2.0, 2.0));
    Vector3d q1 = q0 + uniform(0.3, 3.0) * (Vector3d::UnitZ() + slope * sideways);
    for (int i = 0; i < 4; ++i)
    {
      const cactus::SegmentPair closest = cactus::closestPoints(p0, p1, q0, q1);
      const Vector3d apart = q0 + closest.t * (q1 - q0) - p0 - closest.s * (p1 - p0);
      const Vector3d shift = (relativeDistance * (radii[0] + radii[1]) / closest.distance - 1.0) * apart;
      q0 += shift;
      q1 += shift;
    }
    for (int which = 0; which < 2; ++which)
    {
      fibres.addFibre(2 * n + which + 1, 1, radii[which]);
      fibres.addPoint(which == 0 ? p0 : q0, radii[which]);
      fibres.addPoint(which == 0 ? p1 : q1, radii[which]);
    }
  }
  return fibres;
}
