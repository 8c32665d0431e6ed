// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/OpenTile.h"

#include "base/Error.h"
#include "mesh/CappedSurface.h"
#include "mesh/SurfaceWall.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace cactus
{

namespace
{

using TileTriangle = std::array<std::int32_t, 3>;
using TileEdge = std::pair<std::int32_t, std::int32_t>;

/// The faces of a box, numbered as the bits of CappedSurface.
constexpr std::size_t tileFaces = 6;

double placeOfFace(const Domain& domain, std::size_t face)
{
  return (face % 2 == 0 ? domain.lower : domain.upper)[Eigen::Index(face / 2)];
}

/// A plane in which a surface ends, in a face of the domain or a little before it.
class TileEnd
{
public:
  TileEnd(const TriangleMesh& mesh, const Domain& domain, std::size_t face)
  {
    const auto axis = Eigen::Index(face / 2);
    const double sense = face % 2 == 0 ? -1.0 : 1.0;
    double outermost = -std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& point : mesh.points)
    {
      outermost = std::max(outermost, sense * point[axis]);
    }
    if (sense * placeOfFace(domain, face) - outermost > largestInset)
    {
      return;
    }
    this->IsIn.reserve(mesh.points.size());
    for (const Eigen::Vector3d& point : mesh.points)
    {
      this->IsIn.push_back(sense * point[axis] == outermost ? 1 : 0);
    }
  }

  bool holds(std::size_t point) const { return !this->IsIn.empty() && this->IsIn[point] != 0; }
  bool holds(const TileTriangle& t) const
  {
    return this->holds(std::size_t(t[0])) && this->holds(std::size_t(t[1])) && this->holds(std::size_t(t[2]));
  }

private:
  std::vector<char> IsIn; ///< per point; empty if the surface ends nowhere near the face
};

/// Returns the edges of a wall, in the sense of its triangles, that neither another of these nor a cap has in the opposite sense.
std::vector<TileEdge> openEdges(const std::vector<TileTriangle>& wall, const std::vector<TileTriangle>& caps)
{
  std::vector<TileEdge> edges;
  edges.reserve(3 * (wall.size() + caps.size()));
  for (const std::vector<TileTriangle>* triangles : { &wall, &caps })
  {
    for (const TileTriangle& t : *triangles)
    {
      edges.insert(edges.end(), { { t[0], t[1] }, { t[1], t[2] }, { t[2], t[0] } });
    }
  }
  std::vector<TileEdge> open(edges.begin(), edges.begin() + std::ptrdiff_t(3 * wall.size()));
  std::sort(edges.begin(), edges.end());
  const auto hasOther = [&edges](const TileEdge& edge)
  { return std::binary_search(edges.begin(), edges.end(), TileEdge(edge.second, edge.first)); };
  open.erase(std::remove_if(open.begin(), open.end(), hasOther), open.end());
  return open;
}

/// Throws if an edge lies in no periodic face, or if those of two opposite faces differ.
void requireEqualRims(const std::vector<Eigen::Vector3d>& points, const std::vector<TileEdge>& edges, const Domain& domain)
{
  using Places = std::array<double, 4>; // of both ends, in the plane
  std::array<std::vector<Places>, tileFaces> rims;
  for (const auto& [from, to] : edges)
  {
    const Eigen::Vector3d& p = points[std::size_t(from)];
    const Eigen::Vector3d& q = points[std::size_t(to)];
    std::size_t face = 0;
    const auto isInFace = [&](std::size_t f)
    {
      const auto axis = Eigen::Index(f / 2);
      return domain.periodic[f / 2] && p[axis] == placeOfFace(domain, f) && q[axis] == placeOfFace(domain, f);
    };
    while (face < tileFaces && !isInFace(face))
    {
      ++face;
    }
    if (face == tileFaces)
    {
      throw InvalidInput(" is not closed");
    }
    const auto u = Eigen::Index((face / 2 + 1) % 3);
    const auto v = Eigen::Index((face / 2 + 2) % 3);
    // The rim in the upper face runs the other way round.
    rims[face].push_back(face % 2 == 0 ? Places{ { p[u], p[v], q[u], q[v] } } : Places{ { q[u], q[v], p[u], p[v] } });
  }
  for (std::vector<Places>& rim : rims)
  {
    std::sort(rim.begin(), rim.end());
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (rims[2 * axis] != rims[2 * axis + 1])
    {
      throw InvalidInput(text(" does not end alike in the two faces across ", "xyz"[axis]));
    }
  }
}

} // namespace

TriangleMesh openAtPeriodicFaces(const TriangleMesh& mesh, const Domain& domain)
{
  TriangleMesh opened{ mesh.points, {} };
  std::vector<TileTriangle> otherCaps;
  std::array<bool, tileFaces> isOpen{};
  std::vector<TileEnd> ends;
  for (std::size_t face = 0; face < tileFaces; ++face)
  {
    ends.emplace_back(mesh, domain, face);
  }
  for (const TileTriangle& t : mesh.triangles)
  {
    bool isDropped = false;
    bool isOtherCap = false;
    for (std::size_t face = 0; face < tileFaces; ++face)
    {
      const bool isCap = ends[face].holds(t);
      isOpen[face] = isOpen[face] || (isCap && domain.periodic[face / 2]);
      isDropped = isDropped || (isCap && domain.periodic[face / 2]);
      isOtherCap = isOtherCap || isCap;
    }
    if (!isDropped)
    {
      (isOtherCap ? otherCaps : opened.triangles).push_back(t);
    }
  }
  for (std::size_t face = 0; face < tileFaces; ++face)
  {
    for (std::size_t p = 0; isOpen[face] && p < mesh.points.size(); ++p)
    {
      double& place = opened.points[p][Eigen::Index(face / 2)];
      place = ends[face].holds(p) ? placeOfFace(domain, face) : place;
    }
  }
  requireEqualRims(opened.points, openEdges(opened.triangles, otherCaps), domain);
  opened.triangles.insert(opened.triangles.end(), otherCaps.begin(), otherCaps.end());
  dropUnusedPoints(opened, nullptr);
  return opened;
}

} // namespace cactus
