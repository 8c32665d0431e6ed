// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SurfaceWall.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cactus
{

namespace
{

/// µm. Triangles whose corners are all this near to a plane lie in it.
constexpr double capTolerance = 1e-6;

} // namespace

std::vector<std::uint32_t> wallTriangles(const TriangleMesh& mesh, const Domain& box, double inset)
{
  Eigen::Vector3d lower = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d upper = -lower;
  for (const Eigen::Vector3d& point : mesh.points)
  {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    lower[axis] = lower[axis] > box.lower[axis] + inset ? box.lower[axis] : lower[axis];
    upper[axis] = upper[axis] < box.upper[axis] - inset ? box.upper[axis] : upper[axis];
  }
  const Eigen::Vector3d planes[4] = { box.lower, box.upper, lower, upper };
  std::vector<unsigned> faces(mesh.points.size(), 0U);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
  {
    for (int face = 0; face < 12; ++face)
    {
      const int axis = face % 3;
      faces[i] |= std::fabs(mesh.points[i][axis] - planes[face / 3][axis]) <= capTolerance ? 1U << face : 0U;
    }
  }
  std::vector<std::uint32_t> wall;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
  {
    const auto& t = mesh.triangles[i];
    if ((faces[std::size_t(t[0])] & faces[std::size_t(t[1])] & faces[std::size_t(t[2])]) == 0U)
    {
      wall.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return wall;
}

Domain betweenCaps(const TriangleMesh& mesh, const Domain& box, double inset)
{
  Domain between = box;
  const std::vector<std::uint32_t> wall = wallTriangles(mesh, box, inset);
  auto next = wall.begin();
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
  {
    if (next != wall.end() && *next == i)
    {
      ++next;
      continue;
    }
    const auto& t = mesh.triangles[i];
    const Eigen::Vector3d& a = mesh.points[std::size_t(t[0])];
    const Eigen::Vector3d& b = mesh.points[std::size_t(t[1])];
    const Eigen::Vector3d& c = mesh.points[std::size_t(t[2])];
    // The axis perpendicular to the triangle.
    int axis = 0;
    (a.cwiseMax(b).cwiseMax(c) - a.cwiseMin(b).cwiseMin(c)).minCoeff(&axis);
    const bool isLow = a[axis] - box.lower[axis] < box.upper[axis] - a[axis];
    double& side = isLow ? between.lower[axis] : between.upper[axis];
    side = isLow ? std::max(side, a[axis]) : std::min(side, a[axis]);
  }
  return between;
}

double areaOf(const TriangleMesh& mesh, const std::vector<std::uint32_t>& triangles)
{
  double area = 0.0;
  for (const std::uint32_t triangle : triangles)
  {
    const auto& t = mesh.triangles[triangle];
    const Eigen::Vector3d& corner = mesh.points[std::size_t(t[0])];
    area += 0.5 * (mesh.points[std::size_t(t[1])] - corner).cross(mesh.points[std::size_t(t[2])] - corner).norm();
  }
  return area;
}

} // namespace cactus
