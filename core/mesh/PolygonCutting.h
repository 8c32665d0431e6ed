// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/CappedSurface.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace cactus
{

/// Cuts a polygon of a surface's points into triangles between its corners, by the shortest diagonals. Leaves at most four
/// corners of it.
inline void cutByDiagonals(std::vector<std::int32_t>& p, TriangleMesh& mesh)
{
  const auto squaredLength = [&](std::int32_t a, std::int32_t b)
  { return (mesh.points[std::size_t(a)] - mesh.points[std::size_t(b)]).squaredNorm(); };
  while (p.size() > 4)
  {
    std::size_t best = 0;
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < p.size(); ++i)
    {
      const std::int32_t before = p[(i + p.size() - 1) % p.size()];
      const std::int32_t behind = p[(i + 1) % p.size()];
      const double length = squaredLength(before, behind);
      if (length < shortest)
      {
        shortest = length;
        best = i;
      }
    }
    mesh.triangles.push_back({ { p[(best + p.size() - 1) % p.size()], p[best], p[(best + 1) % p.size()] } });
    p.erase(p.begin() + std::ptrdiff_t(best));
  }
  if (p.size() == 3)
  {
    mesh.triangles.push_back({ { p[0], p[1], p[2] } });
    return;
  }
  // Of two diagonals, without branches: it cannot be foretold which is the shorter one.
  const std::size_t cut = squaredLength(p[0], p[2]) < squaredLength(p[3], p[1]) ? 1 : 0;
  mesh.triangles.push_back({ { p[(cut + 3) % 4], p[cut], p[cut + 1] } });
  mesh.triangles.push_back({ { p[1 - cut], p[2], p[3] } });
}

/// Cuts a polygon of more than three corners into triangles around a point in its middle, which lies on no face of the box.
inline void cutAroundMiddle(std::vector<std::int32_t>& p, CappedSurface& surface)
{
  if (p.size() == 3)
  {
    cutByDiagonals(p, surface.mesh);
    return;
  }
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const std::int32_t point : p)
  {
    middle += surface.mesh.points[std::size_t(point)];
  }
  const auto centre = static_cast<std::int32_t>(surface.mesh.points.size());
  surface.mesh.points.push_back(middle / double(p.size()));
  surface.faces.push_back(0);
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    surface.mesh.triangles.push_back({ { centre, p[i], p[(i + 1) % p.size()] } });
  }
}

} // namespace cactus
