// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/CappedSurface.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace cactus
{

/// Points of a surface around its part in one cell of a lattice or on one face of a cell.
struct PointPolygon
{
  std::array<std::int32_t, 12> corners;
  std::size_t count = 0;

  void add(std::int32_t point) { corners[count++] = point; }
};

/// Cuts a polygon of a surface's points into triangles between its corners, by the shortest diagonals.
inline void cutByDiagonals(PointPolygon p, TriangleMesh& mesh)
{
  auto& c = p.corners;
  const auto squaredLength = [&](std::int32_t a, std::int32_t b)
  { return (mesh.points[std::size_t(a)] - mesh.points[std::size_t(b)]).squaredNorm(); };
  while (p.count > 4)
  {
    const std::size_t last = p.count - 1;
    std::size_t best = 0;
    double shortest = squaredLength(c[last], c[1]);
    for (std::size_t i = 1; i <= last; ++i)
    {
      const double length = squaredLength(c[i - 1], c[i < last ? i + 1 : 0]);
      best = length < shortest ? i : best;
      shortest = std::min(length, shortest);
    }
    mesh.triangles.push_back({ { c[best > 0 ? best - 1 : last], c[best], c[best < last ? best + 1 : 0] } });
    std::copy(c.begin() + std::ptrdiff_t(best) + 1, c.begin() + std::ptrdiff_t(p.count), c.begin() + std::ptrdiff_t(best));
    p.count = last;
  }
  if (p.count == 3)
  {
    mesh.triangles.push_back({ { c[0], c[1], c[2] } });
    return;
  }
  // The shorter of two diagonals, branch-free: the choice is unpredictable.
  const std::size_t cut = squaredLength(c[0], c[2]) < squaredLength(c[3], c[1]) ? 1 : 0;
  mesh.triangles.push_back({ { c[(cut + 3) % 4], c[cut], c[cut + 1] } });
  mesh.triangles.push_back({ { c[1 - cut], c[2], c[3] } });
}

/// Cuts a polygon of more than three corners into triangles around a point in its middle, which lies on no face of the box.
inline void cutAroundMiddle(const PointPolygon& p, CappedSurface& surface)
{
  if (p.count == 3)
  {
    cutByDiagonals(p, surface.mesh);
    return;
  }
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < p.count; ++i)
  {
    middle += surface.mesh.points[std::size_t(p.corners[i])];
  }
  const auto centre = static_cast<std::int32_t>(surface.mesh.points.size());
  surface.mesh.points.push_back(middle / double(p.count));
  surface.faces.push_back(0);
  for (std::size_t i = 0; i < p.count; ++i)
  {
    surface.mesh.triangles.push_back({ { centre, p.corners[i], p.corners[(i + 1) % p.count] } });
  }
}

} // namespace cactus
