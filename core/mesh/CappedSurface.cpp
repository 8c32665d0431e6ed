// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/CappedSurface.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace cactus
{

namespace
{

using Eigen::Vector3d;

/// Per point the sum of twice the area normals of its triangles, but for caps; in a face of the box the part along that face, so
/// that points move in it.
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

double keepMainPart(CappedSurface& surface, double smallest)
{
  auto& points = surface.mesh.points;
  auto& triangles = surface.mesh.triangles;
  if (triangles.empty())
  {
    return 0.0;
  }
  std::vector<std::int32_t> parent(points.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto find = [&parent](std::int32_t p)
  {
    while (parent[std::size_t(p)] != p)
    {
      parent[std::size_t(p)] = parent[std::size_t(parent[std::size_t(p)])];
      p = parent[std::size_t(p)];
    }
    return p;
  };
  const auto join = [&](std::int32_t p, std::int32_t q)
  {
    const std::int32_t a = find(p);
    const std::int32_t b = find(q);
    parent[std::size_t(std::max(a, b))] = std::min(a, b);
  };
  for (const auto& t : triangles)
  {
    join(t[0], t[1]);
    join(t[0], t[2]);
  }
  std::vector<std::int32_t> pieceOf(points.size());
  for (std::size_t p = 0; p < points.size(); ++p)
  {
    pieceOf[p] = find(static_cast<std::int32_t>(p));
  }
  if (std::count(pieceOf.begin(), pieceOf.end(), pieceOf.front()) == std::ptrdiff_t(points.size()))
  {
    return 0.0;
  }
  std::vector<double> volumeOfPiece(points.size(), 0.0);
  for (const auto& t : triangles)
  {
    const auto piece = std::size_t(pieceOf[std::size_t(t[0])]);
    const Vector3d a = points[std::size_t(t[0])] - points[piece];
    volumeOfPiece[piece] +=
      a.dot((points[std::size_t(t[1])] - points[piece]).cross(points[std::size_t(t[2])] - points[piece])) / 6.0;
  }
  // From here on a set is a part, not a piece.
  std::array<std::int32_t, 6> onFace;
  onFace.fill(-1);
  for (std::size_t p = 0; p < points.size(); ++p)
  {
    for (std::size_t face = 0; face < 6 && surface.faces[p] != 0; ++face)
    {
      if ((surface.faces[p] >> face) & 1)
      {
        onFace[face] = onFace[face] < 0 ? std::int32_t(p) : onFace[face];
        join(onFace[face], static_cast<std::int32_t>(p));
      }
    }
  }
  std::vector<double> volumeOfPart(points.size(), 0.0);
  for (std::size_t p = 0; p < points.size(); ++p)
  {
    volumeOfPart[std::size_t(find(static_cast<std::int32_t>(p)))] += volumeOfPiece[p];
  }
  const auto main = static_cast<std::int32_t>(std::max_element(volumeOfPart.begin(), volumeOfPart.end()) - volumeOfPart.begin());
  // The largest piece of it stays, however small.
  std::size_t largest = std::size_t(main);
  for (std::size_t p = 0; p < points.size(); ++p)
  {
    const bool isBetter = find(std::int32_t(p)) == main && volumeOfPiece[p] > volumeOfPiece[largest];
    largest = isBetter ? p : largest;
  }
  const auto isKept = [&](std::size_t p)
  {
    const auto piece = std::size_t(pieceOf[p]);
    return piece == largest || (find(std::int32_t(p)) == main && volumeOfPiece[piece] > smallest);
  };

  double dropped = 0.0;
  for (std::size_t p = 0; p < points.size(); ++p)
  {
    dropped += pieceOf[p] == std::int32_t(p) && !isKept(p) ? std::abs(volumeOfPiece[p]) : 0.0;
  }
  std::vector<std::int32_t> number(points.size(), -1);
  std::int32_t used = 0;
  for (std::size_t p = 0; p < points.size(); ++p)
  {
    if (isKept(p))
    {
      points[std::size_t(used)] = points[p];
      surface.faces[std::size_t(used)] = surface.faces[p];
      number[p] = used++;
    }
  }
  points.resize(std::size_t(used));
  surface.faces.resize(std::size_t(used));
  std::size_t count = 0;
  for (const auto& t : triangles)
  {
    if (number[std::size_t(t[0])] >= 0)
    {
      triangles[count++] = { { number[std::size_t(t[0])], number[std::size_t(t[1])], number[std::size_t(t[2])] } };
    }
  }
  triangles.resize(count);
  return dropped;
}

double moveToVolume(CappedSurface& surface, double volume, double furthest)
{
  auto& points = surface.mesh.points;
  const std::vector<Vector3d> directions = normals(surface);
  double moved = 0.0;
  // A step changes the volume by its length times the area; the second makes up for curvature.
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

void splitNeedles(CappedSurface& surface, double largest)
{
  auto& points = surface.mesh.points;
  auto& triangles = surface.mesh.triangles;
  /// Which edge of a triangle is its longest, or -1 where it is no needle.
  const auto edgeToSplit = [&](std::size_t triangle)
  {
    const auto& t = triangles[triangle];
    int longest = 0;
    double squared[3];
    for (int i = 0; i < 3; ++i)
    {
      squared[i] = (points[std::size_t(t[std::size_t((i + 1) % 3)])] - points[std::size_t(t[std::size_t(i)])]).squaredNorm();
      longest = squared[i] > squared[longest] ? i : longest;
    }
    const double shortest = std::min({ squared[0], squared[1], squared[2] });
    return shortest > 0.0 && squared[longest] > largest * shortest ? longest : -1;
  };
  std::vector<std::size_t> needles;
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    if (edgeToSplit(t) >= 0)
    {
      needles.push_back(t);
    }
  }
  if (needles.empty())
  {
    return;
  }
  // Per edge, in the sense in which its triangle runs through it.
  std::unordered_map<std::uint64_t, std::size_t> triangleOf;
  const auto key = [](std::int32_t from, std::int32_t to)
  { return std::uint64_t(std::uint32_t(from)) << 32 | std::uint32_t(to); };
  const auto enter = [&](std::size_t t)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      triangleOf[key(triangles[t][i], triangles[t][(i + 1) % 3])] = t;
    }
  };
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    enter(t);
  }
  while (!needles.empty())
  {
    const std::size_t needle = needles.back();
    needles.pop_back();
    const int edge = edgeToSplit(needle);
    if (edge < 0)
    {
      continue; // its neighbour's split has mended it
    }
    const std::int32_t a = triangles[needle][std::size_t(edge)];
    const std::int32_t b = triangles[needle][std::size_t((edge + 1) % 3)];
    const std::size_t neighbour = triangleOf.at(key(b, a));
    const auto middle = static_cast<std::int32_t>(points.size());
    points.push_back(0.5 * (points[std::size_t(a)] + points[std::size_t(b)]));
    surface.faces.push_back(surface.faces[std::size_t(a)] & surface.faces[std::size_t(b)]);
    for (const std::size_t t : { needle, neighbour })
    {
      // The part at one end stays in its place, the other is new.
      auto other = triangles[t];
      const std::int32_t from = t == needle ? a : b;
      const std::int32_t to = t == needle ? b : a;
      std::replace(triangles[t].begin(), triangles[t].end(), to, middle);
      std::replace(other.begin(), other.end(), from, middle);
      triangles.push_back(other);
      enter(t);
      enter(triangles.size() - 1);
      needles.push_back(t);
      needles.push_back(triangles.size() - 1);
    }
    triangleOf.erase(key(a, b));
    triangleOf.erase(key(b, a));
  }
}

} // namespace cactus
