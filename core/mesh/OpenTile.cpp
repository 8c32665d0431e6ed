// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/OpenTile.h"

#include "base/Error.h"
#include "base/SinglePrecision.h"
#include "mesh/CappedSurface.h"
#include "mesh/SurfaceWall.h"

#include <algorithm>
#include <array>
#include <cmath>
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
    this->Face = placeOfFace(domain, face);
    this->Inset = sense * this->Face - outermost;
    if (this->Inset > largestInset)
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

  /// Returns where a point at `place` along the axis goes when the end is moved into the face.
  double extended(std::size_t point, double place) const
  {
    const double before = std::abs(this->Face - place);
    if (this->holds(point) || !(before < 2.0 * this->Inset))
    {
      return this->holds(point) ? this->Face : place;
    }
    const double moved = inSinglePrecision(this->Face + (place - this->Face) * (2.0 - 2.0 * this->Inset / before));
    return place < this->Face ? std::min(moved, this->Face) : std::max(moved, this->Face);
  }

private:
  double Face = 0.0;
  double Inset = 0.0;     ///< µm before the face
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

/// A surface without its caps in periodic faces.
struct OpenedSurface
{
  TriangleMesh mesh;                   ///< the wall
  std::vector<TileTriangle> otherCaps; ///< in other faces
  std::vector<TileEnd> ends;           ///< per face
};

OpenedSurface opened(const TriangleMesh& mesh, const Domain& domain)
{
  OpenedSurface result{ { mesh.points, {} }, {}, {} };
  std::array<bool, tileFaces> isOpen{};
  std::vector<TileEnd>& ends = result.ends;
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
      (isOtherCap ? result.otherCaps : result.mesh.triangles).push_back(t);
    }
  }
  for (std::size_t face = 0; face < tileFaces; ++face)
  {
    for (std::size_t p = 0; isOpen[face] && p < mesh.points.size(); ++p)
    {
      double& place = result.mesh.points[p][Eigen::Index(face / 2)];
      place = ends[face].extended(p, place);
    }
  }
  return result;
}

TriangleMesh whole(OpenedSurface&& surface)
{
  TriangleMesh mesh = std::move(surface.mesh);
  mesh.triangles.insert(mesh.triangles.end(), surface.otherCaps.begin(), surface.otherCaps.end());
  dropUnusedPoints(mesh, nullptr);
  return mesh;
}

} // namespace

TriangleMesh openAtPeriodicFaces(const TriangleMesh& mesh, const Domain& domain)
{
  OpenedSurface surface = opened(mesh, domain);
  std::vector<TileEdge> edges = openEdges(surface.mesh.triangles, surface.otherCaps);
  // Where a thin cap in another face has vanished beside one of two opposite faces, the wall ends on the edge of the domain.
  const auto isOnEdge = [&](const TileEdge& edge)
  {
    bool isInOther = false;
    for (std::size_t face = 0; face < tileFaces; ++face)
    {
      const TileEnd& end = surface.ends[face];
      isInOther =
        isInOther || (!domain.periodic[face / 2] && end.holds(std::size_t(edge.first)) && end.holds(std::size_t(edge.second)));
    }
    return isInOther;
  };
  edges.erase(std::remove_if(edges.begin(), edges.end(), isOnEdge), edges.end());
  requireEqualRims(surface.mesh.points, edges, domain);
  return whole(std::move(surface));
}

TriangleMesh withoutPeriodicCaps(const TriangleMesh& mesh, const Domain& domain)
{
  return whole(opened(mesh, domain));
}

} // namespace cactus
