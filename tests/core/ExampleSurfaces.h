// SPDX-License-Identifier: BSD-3-Clause
// Surfaces for tests.
#pragma once

#include "base/Constants.h"
#include "mesh/FibreSurfaces.h"
#include "mesh/TriangleMesh.h"

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace example
{

/// A tetrahedron with a corner at `origin` and edges of length `size` along the axes.
inline cactus::TriangleMesh tetrahedron(const Eigen::Vector3d& origin, double size)
{
  cactus::TriangleMesh mesh;
  mesh.points = { origin, origin + Eigen::Vector3d(size, 0, 0), origin + Eigen::Vector3d(0, size, 0),
    origin + Eigen::Vector3d(0, 0, size) };
  mesh.triangles = { { { 0, 2, 1 } }, { { 0, 1, 3 } }, { { 0, 3, 2 } }, { { 1, 2, 3 } } };
  return mesh;
}

/// Makes it point outward, whatever the order of its corners.
inline cactus::TriangleMesh tetrahedronOf(
  const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d)
{
  const bool outward = (b - a).cross(c - a).dot(d - a) < 0.0;
  return { { a, outward ? b : c, outward ? c : b, d }, { { { 0, 1, 2 } }, { { 0, 3, 1 } }, { { 1, 3, 2 } }, { { 2, 3, 0 } } } };
}

/// A box from corner to corner, wound outward.
inline cactus::TriangleMesh box(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper)
{
  cactus::TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner)
  {
    mesh.points.push_back({ (corner & 1 ? upper : lower)[0], (corner & 2 ? upper : lower)[1], (corner & 4 ? upper : lower)[2] });
  }
  mesh.triangles = { { { 0, 2, 1 } }, { { 1, 2, 3 } }, { { 4, 5, 6 } }, { { 5, 7, 6 } }, { { 0, 1, 4 } }, { { 1, 5, 4 } },
    { { 2, 6, 3 } }, { { 3, 6, 7 } }, { { 0, 4, 2 } }, { { 2, 4, 6 } }, { { 1, 3, 5 } }, { { 3, 7, 5 } } };
  return mesh;
}

/// A closed tube along z around (x, y), from z = `lower` to `upper`, with capped ends; its rings are moved sideways by up to
/// `noise`.
inline cactus::TriangleMesh tube(double x, double y, double radius, double lower, double upper, int sides = 24, int rings = 20,
  double noise = 0.0, unsigned seed = 1)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-noise, noise);
  cactus::TriangleMesh mesh;
  for (int ring = 0; ring <= rings; ++ring)
  {
    for (int side = 0; side < sides; ++side)
    {
      const double angle = 2.0 * cactus::pi * side / sides;
      const double sine = 2 * side % sides == 0 ? 0.0 : std::sin(angle); // the points on the x axis lie on it exactly
      mesh.points.emplace_back(x + radius * std::cos(angle) + (noise > 0.0 ? uniform(random) : 0.0),
        y + radius * sine + (noise > 0.0 ? uniform(random) : 0.0), lower + (upper - lower) * ring / rings);
    }
  }
  const auto bottom = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.emplace_back(x, y, lower);
  mesh.points.emplace_back(x, y, upper);
  for (int side = 0; side < sides; ++side)
  {
    const int next = (side + 1) % sides;
    for (int ring = 0; ring < rings; ++ring)
    {
      const int low = ring * sides;
      const int high = low + sides;
      mesh.triangles.push_back({ { low + side, low + next, high + next } });
      mesh.triangles.push_back({ { low + side, high + next, high + side } });
    }
    mesh.triangles.push_back({ { bottom, next, side } });
    mesh.triangles.push_back({ { bottom + 1, rings * sides + side, rings * sides + next } });
  }
  return mesh;
}

/// Returns both surfaces as one.
inline cactus::TriangleMesh both(cactus::TriangleMesh a, const cactus::TriangleMesh& b)
{
  const auto shift = static_cast<std::int32_t>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (const auto& t : b.triangles)
  {
    a.triangles.push_back({ { t[0] + shift, t[1] + shift, t[2] + shift } });
  }
  return a;
}

/// Returns surfaces of fibres with these ids, increasing, in one bundle.
inline cactus::FibreSurfaces surfacesOf(const std::vector<int>& ids, const std::vector<cactus::TriangleMesh>& meshes)
{
  cactus::FibreSurfaces surfaces;
  surfaces.fibreIds = ids;
  surfaces.bundleIds.assign(ids.size(), 1);
  surfaces.mesh = [meshes](std::size_t i) { return meshes[i]; };
  return surfaces;
}

} // namespace example
