// SPDX-License-Identifier: BSD-3-Clause
#include "fibres/Capsules.h"

#include "base/Error.h"
#include "base/Random.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace cactus
{

std::vector<Eigen::Vector3d> placesOf(const std::vector<int>& fibreIds)
{
  std::vector<Eigen::Vector3d> places;
  places.reserve(fibreIds.size());
  for (const int id : fibreIds)
  {
    RandomEngine engine = randomStream(0, RandomStage::Optimiser, static_cast<std::uint64_t>(id));
    const double x = uniform(engine);
    const double y = uniform(engine);
    places.emplace_back(x, y, uniform(engine));
  }
  return places;
}

Capsules capsulesOf(const Fibres& fibres)
{
  Capsules capsules;
  capsules.places = placesOf(fibres.fibreIds);
  require(fibres.points.size() <= std::numeric_limits<std::uint32_t>::max(),
    "the fibres have more control points than 32 bits count: make the domain smaller, or the points fewer");
  capsules.bodies.reserve(fibres.points.size());
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    for (std::size_t i = fibres.offsets[f]; i + 1 < fibres.offsets[f + 1]; ++i)
    {
      Capsule capsule;
      std::copy_n(fibres.points[i].data(), 3, capsule.p0);
      std::copy_n(fibres.points[i + 1].data(), 3, capsule.p1);
      capsule.r0 = fibres.radii[i];
      capsule.r1 = fibres.radii[i + 1];
      capsules.bodies.push_back(capsule);
      capsules.first.push_back(static_cast<std::uint32_t>(i));
      capsules.fibre.push_back(static_cast<std::uint32_t>(f));
    }
  }
  return capsules;
}

} // namespace cactus
