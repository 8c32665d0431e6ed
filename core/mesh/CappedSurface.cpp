// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/CappedSurface.h"

#include "base/SinglePrecision.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace cactus
{

namespace
{

using Eigen::Vector3d;

Vector3d rounded(const Vector3d& point)
{
  return { inSinglePrecision(point[0]), inSinglePrecision(point[1]), inSinglePrecision(point[2]) };
}

/// Returns, per point, the sum of twice the area normals of its triangles, without caps; in a face of the box only the part along
/// that face, so that points move in it.
std::vector<Vector3d> normals(const CappedSurface& surface)
{
  std::vector<Vector3d> result(surface.mesh.points.size(), Vector3d::Zero());
  const auto& points = surface.mesh.points;
  for (const auto& t : surface.mesh.triangles)
  {
    if (surface.isCap(t))
    {
      continue;
    }
    const Vector3d& a = points[std::size_t(t[0])];
    const Vector3d normal = (points[std::size_t(t[1])] - a).cross(points[std::size_t(t[2])] - a);
    for (const std::int32_t corner : t)
    {
      result[std::size_t(corner)] += normal;
    }
  }
  for (std::size_t p = 0; p < result.size(); ++p)
  {
    if (surface.isHeld(static_cast<std::int32_t>(p)))
    {
      result[p].setZero();
    }
    for (Eigen::Index axis = 0; axis < 3; ++axis)
    {
      if ((surface.faces[p] >> (2 * axis)) & 3)
      {
        result[p][axis] = 0.0;
      }
    }
  }
  return result;
}

} // namespace

std::vector<std::uint8_t> facesOf(const TriangleMesh& mesh, const Eigen::AlignedBox3d& box)
{
  std::vector<std::uint8_t> faces(mesh.points.size(), 0);
  for (std::size_t p = 0; p < faces.size(); ++p)
  {
    for (Eigen::Index axis = 0; axis < 3; ++axis)
    {
      const double x = mesh.points[p][axis];
      faces[p] |= static_cast<std::uint8_t>((x == box.min()[axis] ? 1 : x == box.max()[axis] ? 2 : 0) << (2 * axis));
    }
  }
  return faces;
}

void roundPoints(TriangleMesh& mesh, const Eigen::AlignedBox3d& box)
{
  for (Vector3d& point : mesh.points)
  {
    Vector3d place = rounded(point);
    for (Eigen::Index axis = 0; axis < 3; ++axis)
    {
      const bool isOnFace = point[axis] == box.min()[axis] || point[axis] == box.max()[axis];
      place[axis] = isOnFace ? point[axis] : place[axis];
    }
    point = keptInside(box, point, place, 0.0);
  }
}

TriangleMesh inSinglePrecision(TriangleMesh mesh)
{
  for (Vector3d& point : mesh.points)
  {
    point = rounded(point);
  }
  return mesh;
}

bool isInSinglePrecision(const TriangleMesh& mesh)
{
  return std::all_of(mesh.points.begin(), mesh.points.end(), [](const Vector3d& point) { return point == rounded(point); });
}

void dropUnusedPoints(TriangleMesh& mesh, std::vector<std::uint8_t>* faces)
{
  std::vector<std::int32_t> number(mesh.points.size(), -1);
  for (const auto& t : mesh.triangles)
  {
    for (const std::int32_t p : t)
    {
      number[std::size_t(p)] = 0;
    }
  }
  std::size_t used = 0;
  for (std::size_t p = 0; p < number.size(); ++p)
  {
    if (number[p] == 0)
    {
      number[p] = static_cast<std::int32_t>(used);
      mesh.points[used] = mesh.points[p];
      if (faces != nullptr)
      {
        (*faces)[used] = (*faces)[p];
      }
      ++used;
    }
  }
  mesh.points.resize(used);
  if (faces != nullptr)
  {
    faces->resize(used);
  }
  for (auto& t : mesh.triangles)
  {
    t = { { number[std::size_t(t[0])], number[std::size_t(t[1])], number[std::size_t(t[2])] } };
  }
}

SurfaceMeasure measure(const CappedSurface& surface)
{
  SurfaceMeasure result;
  const auto& points = surface.mesh.points;
  for (const auto& t : surface.mesh.triangles)
  {
    // About a point of the surface, so that one far from the origin loses no digits.
    const Vector3d& origin = points[std::size_t(surface.mesh.triangles.front()[0])];
    const Vector3d a = points[std::size_t(t[0])] - origin;
    const Vector3d b = points[std::size_t(t[1])] - origin;
    const Vector3d c = points[std::size_t(t[2])] - origin;
    result.volume += a.dot(b.cross(c)) / 6.0;
    if (!surface.isCap(t))
    {
      result.freeArea += 0.5 * (b - a).cross(c - a).norm();
    }
  }
  return result;
}

double moveToVolume(CappedSurface& surface, double volume, double furthest)
{
  auto& points = surface.mesh.points;
  const std::vector<Vector3d> directions = normals(surface);
  double moved = 0.0;
  // A step changes the volume by its length times the area; the second step corrects for curvature.
  for (int step = 0; step < 2; ++step)
  {
    const SurfaceMeasure now = measure(surface);
    if (!(now.freeArea > 0.0))
    {
      break;
    }
    const double wanted = std::clamp(moved + (volume - now.volume) / now.freeArea, -furthest, furthest);
    for (std::size_t p = 0; p < points.size(); ++p)
    {
      const double length = directions[p].norm();
      if (length > 0.0)
      {
        points[p] = keptInside(surface.box, points[p], points[p] + ((wanted - moved) / length) * directions[p], furthest);
      }
    }
    moved = wanted;
  }
  return moved;
}

} // namespace cactus
