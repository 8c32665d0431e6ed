// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SurfacePieces.h"

#include "mesh/DisjointSets.h"
#include "mesh/SurfaceSide.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace cactus
{

namespace
{

using Eigen::Vector3d;

/// Keeps the selected pieces, given the piece of each triangle, and the entries of their points in `faces`, if given.
void keepPieces(TriangleMesh& mesh, std::vector<std::uint8_t>* faces, const std::vector<std::uint32_t>& pieceOf,
  const std::vector<char>& isKept)
{
  std::vector<std::array<std::int32_t, 3>> kept;
  for (std::size_t t = 0; t < pieceOf.size(); ++t)
  {
    if (pieceOf[t] < isKept.size() && isKept[pieceOf[t]]) // a triangle that uses a point twice may have no piece
    {
      kept.push_back(mesh.triangles[t]);
    }
  }
  mesh.triangles = std::move(kept);
  dropUnusedPoints(mesh, faces);
}

/// Returns, per point, one of the same piece without an earlier neighbour: the end of a chain of neighbours, each before the
/// last. Most points of a contour lead to the same few, which are then joined quickly.
std::vector<std::int32_t> pointsTowardsFirst(const TriangleMesh& mesh)
{
  std::vector<std::int32_t> towards(mesh.points.size());
  std::iota(towards.begin(), towards.end(), 0);
  for (const auto& t : mesh.triangles)
  {
    const std::int32_t first = std::min(t[0], std::min(t[1], t[2]));
    for (const std::int32_t p : t)
    {
      towards[std::size_t(p)] = std::min(towards[std::size_t(p)], first);
    }
  }
  for (std::int32_t& point : towards)
  {
    point = towards[std::size_t(point)];
  }
  return towards;
}

/// Returns the signed volume of each piece, indexed by its first point.
std::vector<double> volumesOf(const TriangleMesh& mesh, const std::vector<std::int32_t>& pieceOf)
{
  const auto& points = mesh.points;
  std::vector<double> volumes(points.size(), 0.0);
  for (const auto& t : mesh.triangles)
  {
    // About a point of the same piece, so that small pieces far away lose no digits.
    const auto piece = std::size_t(pieceOf[std::size_t(t[0])]);
    const Vector3d a = points[std::size_t(t[0])] - points[piece];
    volumes[piece] += a.dot((points[std::size_t(t[1])] - points[piece]).cross(points[std::size_t(t[2])] - points[piece])) / 6.0;
  }
  return volumes;
}

void joinAcrossFaces(const CappedSurface& surface, DisjointSets<std::int32_t>& sets)
{
  std::array<std::int32_t, 6> onFace;
  onFace.fill(-1);
  for (std::size_t p = 0; p < surface.faces.size(); ++p)
  {
    for (std::size_t face = 0; face < 6 && surface.faces[p] != 0; ++face)
    {
      if ((surface.faces[p] >> face) & 1)
      {
        // What goes on beyond a face does so at the opposite one.
        std::int32_t& first = onFace[(surface.held >> face & 1) != 0 ? face & ~std::size_t(1) : face];
        first = first < 0 ? std::int32_t(p) : first;
        sets.join(first, static_cast<std::int32_t>(p));
      }
    }
  }
}

/// Tells, by the first point of each piece, whether it belongs to the part of the largest volume and is large enough.
std::vector<char> piecesOfMainPart(
  const std::vector<double>& volumes, DisjointSets<std::int32_t>& parts, const std::vector<double>& smallest)
{
  std::vector<double> volumeOfPart(volumes.size(), 0.0);
  for (std::size_t p = 0; p < volumes.size(); ++p)
  {
    volumeOfPart[std::size_t(parts.find(static_cast<std::int32_t>(p)))] += volumes[p];
  }
  const auto main = static_cast<std::int32_t>(std::max_element(volumeOfPart.begin(), volumeOfPart.end()) - volumeOfPart.begin());
  auto largest = std::size_t(main);
  std::vector<char> isKept(volumes.size(), 0);
  for (std::size_t p = 0; p < volumes.size(); ++p)
  {
    if (parts.find(static_cast<std::int32_t>(p)) == main)
    {
      isKept[p] = volumes[p] > smallest[p] ? 1 : 0;
      largest = volumes[p] > volumes[largest] ? p : largest;
    }
  }
  isKept[largest] = 1;
  return isKept;
}

} // namespace

double keepMainPart(CappedSurface& surface, double smallest)
{
  const auto& triangles = surface.mesh.triangles;
  const std::size_t count = surface.mesh.points.size();
  std::vector<std::int32_t> pieceOf = pointsTowardsFirst(surface.mesh);
  DisjointSets<std::int32_t> sets(count);
  for (const auto& t : triangles)
  {
    const std::int32_t piece = pieceOf[std::size_t(t[0])];
    for (const std::int32_t other : { pieceOf[std::size_t(t[1])], pieceOf[std::size_t(t[2])] })
    {
      if (other != piece)
      {
        sets.join(piece, other);
      }
    }
  }
  for (std::int32_t& piece : pieceOf)
  {
    piece = sets.find(piece);
  }
  if (triangles.empty() || std::count(pieceOf.begin(), pieceOf.end(), pieceOf.front()) == std::ptrdiff_t(count))
  {
    return 0.0;
  }
  const std::vector<double> volumes = volumesOf(surface.mesh, pieceOf);
  for (std::size_t p = 0; p < count; ++p)
  {
    sets.join(pieceOf[p], static_cast<std::int32_t>(p));
  }
  joinAcrossFaces(surface, sets); // from here on a set is a part, not a piece
  std::vector<double> smallestOf(count, smallest);
  for (std::size_t p = 0; p < count; ++p)
  {
    // However small, it has a counterpart at the opposite face.
    smallestOf[std::size_t(pieceOf[p])] =
      surface.isHeld(static_cast<std::int32_t>(p)) ? 0.0 : smallestOf[std::size_t(pieceOf[p])];
  }
  const std::vector<char> isKept = piecesOfMainPart(volumes, sets, smallestOf);
  double dropped = 0.0;
  for (std::size_t p = 0; p < count; ++p)
  {
    dropped += pieceOf[p] == std::int32_t(p) && !isKept[p] ? std::abs(volumes[p]) : 0.0;
  }
  std::vector<std::uint32_t> pieceOfTriangle;
  pieceOfTriangle.reserve(triangles.size());
  for (const auto& t : triangles)
  {
    pieceOfTriangle.push_back(static_cast<std::uint32_t>(pieceOf[std::size_t(t[0])]));
  }
  keepPieces(surface.mesh, &surface.faces, pieceOfTriangle, isKept);
  return dropped;
}

SurfaceReport keepSoundPieces(TriangleMesh& mesh, double& dropped)
{
  SurfaceReport report = checkSurface(mesh);
  if (report.sound() || mesh.triangles.empty())
  {
    return report;
  }
  std::vector<std::uint32_t> pieceOf;
  std::vector<double> volumes(checkSurface(mesh, &pieceOf).pieces.size(), 0.0);
  for (std::size_t t = 0; report.closedManifold() && t < pieceOf.size(); ++t)
  {
    // About a point of the same piece, as in checkSurface().
    const Vector3d& origin = mesh.points[std::size_t(report.pieces[pieceOf[t]])];
    const auto corner = [&](std::size_t i) -> Vector3d { return mesh.points[std::size_t(mesh.triangles[t][i])] - origin; };
    volumes[pieceOf[t]] += corner(0).dot(corner(1).cross(corner(2))) / 6.0;
  }
  std::vector<char> isKept;
  for (const double volume : volumes)
  {
    isKept.push_back(volume > 0.0);
    dropped += volume > 0.0 ? 0.0 : -volume;
  }
  keepPieces(mesh, nullptr, pieceOf, isKept);
  SurfaceReport rest = checkSurface(mesh);
  if (!rest.sound())
  {
    mesh = TriangleMesh();
    return SurfaceReport();
  }
  return rest;
}

void keepPiecesInside(CappedSurface& surface, const TriangleTree& around)
{
  std::vector<std::uint32_t> pieceOf;
  std::vector<char> isKept;
  for (const std::int32_t point : checkSurface(surface.mesh, &pieceOf).pieces)
  {
    isKept.push_back(sideOf(around, surface.mesh.points[std::size_t(point)]) == Side::Inside);
  }
  keepPieces(surface.mesh, &surface.faces, pieceOf, isKept);
}

bool liesInside(const TriangleMesh& mesh, const SurfaceReport& report, const TriangleTree& around)
{
  return std::all_of(report.pieces.begin(), report.pieces.end(),
    [&](std::int32_t point) { return sideOf(around, mesh.points[std::size_t(point)]) == Side::Inside; });
}

bool anyLiesInside(const TriangleMesh& mesh, const SurfaceReport& report, const TriangleTree& around)
{
  return std::any_of(report.pieces.begin(), report.pieces.end(),
    [&](std::int32_t point) { return sideOf(around, mesh.points[std::size_t(point)]) == Side::Inside; });
}

bool holdsItself(const TriangleMesh& mesh)
{
  std::vector<std::uint32_t> pieceOf;
  const std::vector<std::int32_t> pieces = checkSurface(mesh, &pieceOf).pieces;
  for (std::uint32_t around = 0; around < pieces.size(); ++around)
  {
    std::vector<std::uint32_t> triangles;
    for (std::size_t t = 0; t < pieceOf.size(); ++t)
    {
      if (pieceOf[t] == around)
      {
        triangles.push_back(static_cast<std::uint32_t>(t));
      }
    }
    const TriangleTree tree(mesh, triangles);
    for (std::uint32_t inside = 0; inside < pieces.size(); ++inside)
    {
      if (inside != around && sideOf(tree, mesh.points[std::size_t(pieces[inside])]) == Side::Inside)
      {
        return true;
      }
    }
  }
  return false;
}

} // namespace cactus
