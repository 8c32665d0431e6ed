// SPDX-License-Identifier: BSD-3-Clause
#include "growth/VolumeInDomain.h"

#include "base/Constants.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace cactus
{

namespace
{

/// Returns the area (µm²) in the domain of the disc around `centre` across the unit vector `axis`.
double discInDomain(const Domain& domain, const Eigen::Vector3d& centre, const Eigen::Vector3d& axis, double radius, int samples)
{
  const double depth = domain.depth(centre);
  if (depth >= radius || depth <= -radius)
  {
    return depth > 0.0 ? pi * radius * radius : 0.0;
  }
  // A sunflower: each point stands for the same area, and no line of points is parallel to the domain's faces.
  const Eigen::Vector3d side = axis.unitOrthogonal();
  const Eigen::Vector3d other = axis.cross(side);
  int inside = 0;
  for (int n = 0; n < samples; ++n)
  {
    const double out = radius * std::sqrt((n + 0.5) / samples);
    const double angle = n * goldenAngle;
    inside += domain.depth(centre + out * (std::cos(angle) * side + std::sin(angle) * other)) > 0.0;
  }
  return pi * radius * radius * inside / samples;
}

} // namespace

double volumeInDomain(const Fibres& fibres, std::size_t f, double factor, int samples)
{
  double volume = 0.0;
  const Domain domain = fibres.domain.unrolled();
  const std::size_t begin = fibres.offsets[f];
  const std::size_t last = fibres.offsets[f + 1] - 1;
  for (std::size_t p = begin; p < last; ++p)
  {
    const Eigen::Vector3d along = fibres.points[p + 1] - fibres.points[p];
    const double length = along.norm();
    const double radius = factor * std::min(fibres.radii[p], fibres.radii[p + 1]);
    constexpr double mostSteps = 1000.0;
    const double wanted = std::ceil(2.0 * length / radius);
    // For very long segments, only the part in the domain.
    const std::array<double, 2> part = wanted <= mostSteps ? std::array<double, 2>{ { 0.0, 1.0 } }
                                                           : domain.clip(fibres.points[p], fibres.points[p + 1],
                                                               factor * std::max(fibres.radii[p], fibres.radii[p + 1]));
    const double share = std::max(0.0, part[1] - part[0]);
    const int steps = static_cast<int>(std::min(std::ceil(share * wanted), mostSteps));
    for (int n = 0; n < steps; ++n)
    {
      const double t = part[0] + share * ((n + 0.5) / steps);
      volume += share * length / steps *
                discInDomain(domain, fibres.points[p] + t * along, along / length,
                  factor * ((1.0 - t) * fibres.radii[p] + t * fibres.radii[p + 1]), samples);
    }
  }
  const auto halfBall = [&](std::size_t end, std::size_t next)
  {
    constexpr int steps = 4;
    const Eigen::Vector3d out = (fibres.points[end] - fibres.points[next]).normalized();
    const double radius = factor * fibres.radii[end];
    for (int n = 0; n < steps; ++n)
    {
      const double t = (n + 0.5) / steps;
      volume += radius / steps *
                discInDomain(domain, fibres.points[end] + t * radius * out, out, radius * std::sqrt(1.0 - t * t), samples);
    }
  };
  halfBall(begin, begin + 1);
  halfBall(last, last - 1);
  return volume;
}

} // namespace cactus
