// SPDX-License-Identifier: BSD-3-Clause
#include "growth/SeedPoints.h"

#include "base/Constants.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdint>

namespace cactus
{

SeedPoints::SeedPoints(const SeedOptions& options, const Fibres& fibres, std::size_t fibre, std::size_t segment)
  : Engine(randomStream(options.seed, RandomStage::SeedPoints,
      (std::uint64_t(std::uint32_t(fibres.fibreIds[fibre])) << 32) | std::uint32_t(segment)))
  , FirstRadius(fibres.radii[fibres.offsets[fibre] + segment])
  , LastRadius(fibres.radii[fibres.offsets[fibre] + segment + 1])
{
  if (options.pointDensity > 0.0)
  {
    const std::size_t p = fibres.offsets[fibre] + segment;
    const double length = (fibres.points[p + 1] - fibres.points[p]).norm();
    const double area =
      pi / 3.0 *
      (this->FirstRadius * this->FirstRadius + this->FirstRadius * this->LastRadius + this->LastRadius * this->LastRadius);
    this->Size = static_cast<std::size_t>(options.pointDensity * area * length + uniform(this->Engine));
  }
}

SeedPoints::Place SeedPoints::next(const Eigen::Vector3d& tangent)
{
  Place place{};
  // Thicker stretches have more of them.
  const double largest = std::max(this->FirstRadius, this->LastRadius);
  double radius = 0.0;
  do
  {
    place.along = uniform(this->Engine);
    radius = this->FirstRadius + place.along * (this->LastRadius - this->FirstRadius);
  } while (uniform(this->Engine) * largest * largest > radius * radius);
  Eigen::Vector2d inDisc;
  do
  {
    inDisc.x() = 2.0 * uniform(this->Engine) - 1.0;
    inDisc.y() = 2.0 * uniform(this->Engine) - 1.0;
  } while (inDisc.squaredNorm() > (1.0 - tip) * (1.0 - tip) || inDisc.squaredNorm() < core * core);
  const Eigen::Vector3d first = tangent.unitOrthogonal();
  place.across = inDisc.x() * first + inDisc.y() * tangent.cross(first);
  return place;
}

} // namespace cactus
