// SPDX-License-Identifier: BSD-3-Clause
// Small disordered bundles for tests.
#pragma once

#include "fibres/Fibres.h"

#include <cmath>
#include <random>

/// Fibres along z through a cube, placed at random so that they overlap, with bends and tapers.
inline cactus::Fibres randomBundle(unsigned seed, int fibres, int points, double side, double bend)
{
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  // One after the other: the compiler chooses the order in which arguments are evaluated.
  const auto draw = [&](int numbers)
  {
    Eigen::Vector3d drawn = Eigen::Vector3d::Zero();
    for (int axis = numbers - 1; axis >= 0; --axis)
    {
      drawn[axis] = uniform(engine);
    }
    return drawn;
  };
  cactus::Fibres bundle;
  bundle.domain = cactus::Domain::cube(side);
  for (int f = 0; f < fibres; ++f)
  {
    const double radius = 0.2 + 0.6 * std::abs(uniform(engine));
    bundle.addFibre(f + 1, 1, radius);
    const Eigen::Vector3d from = side * draw(2);
    const Eigen::Vector3d to = from + 0.3 * side * draw(2);
    for (int i = 0; i < points; ++i)
    {
      const double t = double(i) / (points - 1);
      Eigen::Vector3d p = (1.0 - t) * from + t * to + bend * draw(3);
      p[2] += side * (t - 0.5);
      bundle.addPoint(p, radius * (1.0 + bend * uniform(engine)));
    }
  }
  return bundle;
}
