// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SurfacePart.h"

#include <array>
#include <cstddef>

namespace cactus
{

SurfacePart cutOut(const TriangleMesh& surface, double lower, double upper)
{
  std::vector<unsigned char> beyond(surface.points.size());
  for (std::size_t p = 0; p < beyond.size(); ++p)
  {
    const double z = surface.points[p][2];
    beyond[p] = static_cast<unsigned char>((z < lower ? 1 : 0) + (z > upper ? 2 : 0));
  }
  SurfacePart part;
  constexpr std::int32_t none = -1;
  std::vector<std::int32_t> placeOf(surface.points.size(), none);
  for (const auto& t : surface.triangles)
  {
    if ((beyond[std::size_t(t[0])] & beyond[std::size_t(t[1])] & beyond[std::size_t(t[2])]) != 0)
    {
      continue;
    }
    std::array<std::int32_t, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
    {
      std::int32_t& place = placeOf[std::size_t(t[i])];
      if (place == none)
      {
        place = static_cast<std::int32_t>(part.pointOf.size());
        part.pointOf.push_back(t[i]);
        part.mesh.points.push_back(surface.points[std::size_t(t[i])]);
      }
      corners[i] = place;
    }
    part.mesh.triangles.push_back(corners);
  }
  return part;
}

} // namespace cactus
