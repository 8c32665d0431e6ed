// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/BoxedSurfaces.h"

#include "base/Error.h"
#include "mesh/DisjointSets.h"
#include "mesh/PlaneTriangulation.h"
#include "mesh/SurfaceWall.h"
#include "mesh/TriangleTree.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace cactus
{

namespace
{

using Eigen::Vector3d;

/// µm. Points this near to a face of the box lie on it.
constexpr double faceTolerance = 1e-6;
/// The number of triangles, the largest ones of a compartment's border, from which a point inside it is sought.
constexpr std::size_t soundings = 16;

using FaceBits = std::uint8_t; ///< as in CappedSurface

double faceOf(const Domain& box, int face)
{
  return face % 2 == 0 ? box.lower[face / 2] : box.upper[face / 2];
}

FaceBits facesAt(const Domain& box, const Vector3d& point)
{
  unsigned bits = 0;
  for (int face = 0; face < 6; ++face)
  {
    bits |= std::fabs(point[face / 2] - faceOf(box, face)) <= faceTolerance ? 1U << face : 0U;
  }
  return static_cast<FaceBits>(bits);
}

/// Returns the key of an edge in one of its two directions.
std::uint64_t senseKey(std::int32_t from, std::int32_t to)
{
  return std::uint64_t(std::uint32_t(from)) << 32 | std::uint32_t(to);
}

/// The state of joinInBox().
class BoxJoint
{
public:
  BoxJoint(const Domain& box, std::int32_t around)
    : Box(box)
    , Around(around)
  {
  }

  void add(const CompartmentSurface& surface);
  BoxedSurfaces finish();

private:
  /// An edge of a surface that lies in a face.
  struct Outline
  {
    std::int32_t from;
    std::int32_t to;
  };

  void addPoints(const TriangleMesh& mesh);
  void noteOutlines(const std::vector<std::array<std::int32_t, 3>>& wall, const CompartmentSurface& surface);
  void cutFace(int face);
  std::int32_t cornerPoint(int corner);
  void assignCompartments();

  const Domain& Box;
  std::int32_t Around;
  BoxedSurfaces Joined;
  std::vector<FaceBits> Faces;      ///< per point
  std::vector<std::int32_t> Number; ///< per point of the present surface, its index in the whole, or -1
  std::array<std::vector<Outline>, 6> Outlines;
  std::array<std::vector<std::int32_t>, 6> OnFace;             ///< points of surfaces, by face
  std::unordered_map<std::uint64_t, std::int32_t> Compartment; ///< behind the face's triangle that runs along an outline
  std::map<int, std::int32_t> Corners;                         ///< corners of the box that are points
  std::size_t FirstFaceTriangle = 0;
};

/// Adds a surface without its caps.
void BoxJoint::add(const CompartmentSurface& surface)
{
  const std::vector<std::uint32_t> kept = trianglesOffFaces(surface.mesh, this->Box);
  this->Number.assign(surface.mesh.points.size(), -1);
  std::vector<std::array<std::int32_t, 3>> wall;
  wall.reserve(kept.size());
  for (const std::uint32_t triangle : kept)
  {
    std::array<std::int32_t, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const auto p = std::size_t(surface.mesh.triangles[triangle][i]);
      if (this->Number[p] < 0)
      {
        Vector3d point = surface.mesh.points[p];
        const FaceBits bits = facesAt(this->Box, point);
        require(this->Joined.mesh.points.size() < std::size_t(std::numeric_limits<std::int32_t>::max()),
          "these surfaces have more points than one complex can number: join fewer fibres");
        this->Number[p] = static_cast<std::int32_t>(this->Joined.mesh.points.size());
        for (int face = 0; face < 6; ++face)
        {
          if (bits >> face & 1)
          {
            point[face / 2] = faceOf(this->Box, face);
            this->OnFace[std::size_t(face)].push_back(this->Number[p]);
          }
        }
        if (this->Box.depth(point) < 0.0)
        {
          throw InvalidInput("a surface reaches out of the domain: turn on ClipToDomain in MyelinSurface");
        }
        this->Joined.mesh.points.push_back(point);
        this->Faces.push_back(bits);
      }
      corners[i] = this->Number[p];
    }
    wall.push_back(corners);
  }
  this->noteOutlines(wall, surface);
  this->Joined.mesh.triangles.insert(this->Joined.mesh.triangles.end(), wall.begin(), wall.end());
  this->Joined.sides.insert(this->Joined.sides.end(), wall.size(), { { surface.inside, surface.outside } });
}

/// Records the edges that lie in faces, and the compartments on either side of those where a cap was.
void BoxJoint::noteOutlines(const std::vector<std::array<std::int32_t, 3>>& wall, const CompartmentSurface& surface)
{
  std::unordered_map<std::uint64_t, int> uses;
  for (const auto& t : wall)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      ++uses[senseKey(t[i], t[(i + 1) % 3])];
    }
  }
  for (const auto& t : wall)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::int32_t from = t[i];
      const std::int32_t to = t[(i + 1) % 3];
      const auto shared = unsigned(this->Faces[std::size_t(from)] & this->Faces[std::size_t(to)]);
      const bool isRim = uses.find(senseKey(to, from)) == uses.end();
      if (isRim && shared == 0)
      {
        throw InvalidInput("a surface is not closed, and bounds no compartment");
      }
      for (int face = 0; face < 6; ++face)
      {
        if (shared >> face & 1U)
        {
          this->Outlines[std::size_t(face)].push_back({ from, to });
        }
      }
      if (isRim)
      {
        // The cap ran in the opposite direction.
        this->Compartment[senseKey(to, from)] = surface.inside;
        this->Compartment[senseKey(from, to)] = surface.outside;
      }
    }
  }
}

/// Returns the point at a corner of the box; its bits are set for axes at the upper end.
std::int32_t BoxJoint::cornerPoint(int corner)
{
  const auto found = this->Corners.find(corner);
  if (found != this->Corners.end())
  {
    return found->second;
  }
  Vector3d place;
  for (int axis = 0; axis < 3; ++axis)
  {
    place[axis] = corner >> axis & 1 ? this->Box.upper[axis] : this->Box.lower[axis];
  }
  const auto number = static_cast<std::int32_t>(this->Joined.mesh.points.size());
  this->Joined.mesh.points.push_back(place);
  this->Faces.push_back(facesAt(this->Box, place));
  return this->Corners[corner] = number;
}

/// Makes the triangles of a face, without compartments.
void BoxJoint::cutFace(int face)
{
  const int axis = face / 2;
  // Seen from outside, corners run counter-clockwise from u to v.
  const int u = face % 2 == 1 ? (axis + 1) % 3 : (axis + 2) % 3;
  const int v = face % 2 == 1 ? (axis + 2) % 3 : (axis + 1) % 3;
  const auto inPlane = [&](const Vector3d& p) { return Eigen::Vector2d(p[u], p[v]); };
  PlaneTriangulation plane(inPlane(this->Box.lower), inPlane(this->Box.upper));
  std::vector<std::int32_t> pointOf(4, -1); // per point of the plane
  std::unordered_map<std::int32_t, std::int32_t> inPlaneOf;
  for (const std::int32_t point : this->OnFace[std::size_t(face)])
  {
    const std::int32_t number = plane.insert(inPlane(this->Joined.mesh.points[std::size_t(point)]));
    pointOf.resize(std::max(pointOf.size(), std::size_t(number) + 1), -1);
    if (pointOf[std::size_t(number)] >= 0)
    {
      throw InvalidInput("two points of surfaces coincide on a face of the domain");
    }
    pointOf[std::size_t(number)] = point;
    inPlaneOf[point] = number;
  }
  const int ends[4][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } };
  for (std::size_t i = 0; i < 4; ++i)
  {
    const int corner = (face % 2) << axis | ends[i][0] << u | ends[i][1] << v;
    if (pointOf[i] >= 0)
    {
      this->Corners[corner] = pointOf[i]; // a surface ends exactly there
    }
    pointOf[i] = this->cornerPoint(corner);
  }
  for (const Outline& outline : this->Outlines[std::size_t(face)])
  {
    plane.insertEdge(inPlaneOf.at(outline.from), inPlaneOf.at(outline.to));
  }
  for (const auto& t : plane.triangles())
  {
    this->Joined.mesh.triangles.push_back(
      { { pointOf[std::size_t(t[0])], pointOf[std::size_t(t[1])], pointOf[std::size_t(t[2])] } });
    this->Joined.sides.push_back({ { BoxedSurfaces::beyond, BoxedSurfaces::beyond } });
  }
}

/// Propagates compartments from outlines over the faces, up to the next ones.
void BoxJoint::assignCompartments()
{
  const auto& triangles = this->Joined.mesh.triangles;
  std::unordered_map<std::uint64_t, std::size_t> triangleOf;
  std::vector<std::size_t> reached;
  const auto assign = [&](std::size_t t, std::int32_t compartment)
  {
    std::int32_t& known = this->Joined.sides[t][0];
    if (known == BoxedSurfaces::beyond)
    {
      known = compartment;
      reached.push_back(t);
    }
    else if (known != compartment)
    {
      throw InvalidInput("surfaces lie in each other otherwise than axons in fibres, or meet, on a face of the domain");
    }
  };
  for (std::size_t t = this->FirstFaceTriangle; t < triangles.size(); ++t)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      triangleOf[senseKey(triangles[t][i], triangles[t][(i + 1) % 3])] = t;
    }
  }
  for (std::size_t t = this->FirstFaceTriangle; t < triangles.size(); ++t)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      const auto found = this->Compartment.find(senseKey(triangles[t][i], triangles[t][(i + 1) % 3]));
      if (found != this->Compartment.end())
      {
        assign(t, found->second);
      }
    }
  }
  if (reached.empty())
  {
    assign(this->FirstFaceTriangle, this->Around);
  }
  while (!reached.empty())
  {
    const std::size_t t = reached.back();
    reached.pop_back();
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::uint64_t back = senseKey(triangles[t][(i + 1) % 3], triangles[t][i]);
      if (this->Compartment.find(back) == this->Compartment.end())
      {
        assign(triangleOf.at(back), this->Joined.sides[t][0]);
      }
    }
  }
}

BoxedSurfaces BoxJoint::finish()
{
  this->FirstFaceTriangle = this->Joined.mesh.triangles.size();
  for (int face = 0; face < 6; ++face)
  {
    this->cutFace(face);
  }
  this->assignCompartments();
  return std::move(this->Joined);
}

/// Twice the index of a triangle, plus one for the side that its normal points into.
using TriangleSide = std::uint32_t;

/// Returns the triangle sides that bound the connected parts of compartments' borders, by compartment.
std::vector<std::vector<TriangleSide>> connectedParts(const BoxedSurfaces& surfaces)
{
  struct SideAtEdge
  {
    std::uint64_t edge;
    std::int32_t compartment;
    TriangleSide side;
  };
  const auto& triangles = surfaces.mesh.triangles;
  const auto compartmentOf = [&](TriangleSide side) { return surfaces.sides[side / 2][side % 2]; };
  const auto count = static_cast<TriangleSide>(2 * triangles.size());
  std::vector<SideAtEdge> atEdges;
  atEdges.reserve(3 * std::size_t(count));
  for (TriangleSide side = 0; side < count; ++side)
  {
    const auto& corners = triangles[side / 2];
    for (std::size_t i = 0; i < 3; ++i)
    {
      const auto [least, most] = std::minmax(corners[i], corners[(i + 1) % 3]);
      atEdges.push_back({ senseKey(least, most), compartmentOf(side), side });
    }
  }
  std::sort(atEdges.begin(), atEdges.end(),
    [](const SideAtEdge& a, const SideAtEdge& b)
    { return std::tie(a.edge, a.compartment, a.side) < std::tie(b.edge, b.compartment, b.side); });
  DisjointSets<TriangleSide> sets(count);
  for (std::size_t i = 1; i < atEdges.size(); ++i)
  {
    if (atEdges[i].edge == atEdges[i - 1].edge && atEdges[i].compartment == atEdges[i - 1].compartment)
    {
      sets.join(atEdges[i].side, atEdges[i - 1].side);
    }
  }
  std::map<std::pair<std::int32_t, TriangleSide>, std::vector<TriangleSide>> parts;
  for (TriangleSide side = 0; side < count; ++side)
  {
    if (compartmentOf(side) != BoxedSurfaces::beyond)
    {
      parts[{ compartmentOf(side), sets.find(side) }].push_back(side);
    }
  }
  std::vector<std::vector<TriangleSide>> result;
  result.reserve(parts.size());
  for (auto& part : parts)
  {
    result.push_back(std::move(part.second));
  }
  return result;
}

/// Returns the distance (µm) from a point along a unit direction to the first triangle other than `except`, or `furthest`.
double freeDistance(
  const TriangleTree& tree, const Vector3d& from, const Vector3d& direction, double furthest, std::uint32_t except)
{
  const Vector3d to = from + furthest * direction;
  const FloatBox reach = FloatBox::around(from, to, to);
  double nearest = furthest;
  visitEntries(
    tree, [&reach](const FloatBox& box) { return box.overlaps(reach); },
    [&](std::uint32_t triangle)
    {
      if (triangle == except)
      {
        return false;
      }
      // Möller & Trumbore 1997
      const Vector3d& a = tree.corner(triangle, 0);
      const Vector3d ab = tree.corner(triangle, 1) - a;
      const Vector3d ac = tree.corner(triangle, 2) - a;
      const Vector3d h = direction.cross(ac);
      const double scale = ab.dot(h);
      const Vector3d s = from - a;
      const double p = s.dot(h) / scale;
      const Vector3d q = s.cross(ab);
      const double r = direction.dot(q) / scale;
      const double distance = ac.dot(q) / scale;
      constexpr double slack = 1e-9; // so that no ray slips through between two triangles
      if (p >= -slack && r >= -slack && p + r <= 1.0 + 2.0 * slack && distance >= 0.0)
      {
        nearest = std::min(nearest, distance);
      }
      return false;
    });
  return nearest;
}

} // namespace

std::vector<double> BoxedSurfaces::volumes(std::size_t compartments) const
{
  std::vector<double> result(compartments, 0.0);
  for (std::size_t t = 0; t < this->mesh.triangles.size(); ++t)
  {
    const auto& corners = this->mesh.triangles[t];
    // About one of the surface's own points, so that a box far from the origin loses no digits.
    const Vector3d& origin = this->mesh.points.front();
    const Vector3d a = this->mesh.points[std::size_t(corners[0])] - origin;
    const Vector3d b = this->mesh.points[std::size_t(corners[1])] - origin;
    const Vector3d c = this->mesh.points[std::size_t(corners[2])] - origin;
    const double part = a.dot(b.cross(c)) / 6.0;
    for (const int side : { 0, 1 })
    {
      const std::int32_t compartment = this->sides[t][std::size_t(side)];
      if (compartment != beyond)
      {
        result[std::size_t(compartment)] += side == 0 ? part : -part;
      }
    }
  }
  return result;
}

std::vector<CompartmentPoint> BoxedSurfaces::pointsInside(const Context& context) const
{
  std::vector<double> areas(this->mesh.triangles.size());
  for (std::size_t t = 0; t < areas.size(); ++t)
  {
    areas[t] = areaOf(this->mesh, { static_cast<std::uint32_t>(t) });
  }
  const TriangleTree tree(this->mesh);
  std::vector<CompartmentPoint> points;
  for (std::vector<TriangleSide>& part : connectedParts(*this))
  {
    context.checkpoint();
    const std::size_t count = std::min(soundings, part.size());
    std::partial_sort(part.begin(), part.begin() + std::ptrdiff_t(count), part.end(),
      [&](TriangleSide a, TriangleSide b) { return std::make_pair(-areas[a / 2], a) < std::make_pair(-areas[b / 2], b); });
    CompartmentPoint best{ this->sides[part[0] / 2][part[0] % 2], Vector3d::Zero() };
    double furthest = -1.0;
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::uint32_t triangle = part[i] / 2;
      const Vector3d& a = tree.corner(triangle, 0);
      const Vector3d normal = (tree.corner(triangle, 1) - a).cross(tree.corner(triangle, 2) - a).normalized();
      const Vector3d direction = part[i] % 2 == 0 ? Vector3d(-normal) : normal;
      const Vector3d middle = (a + tree.corner(triangle, 1) + tree.corner(triangle, 2)) / 3.0;
      const double free = freeDistance(tree, middle, direction, 2.0 * std::sqrt(areas[triangle]), triangle);
      if (free > furthest)
      {
        furthest = free;
        best.point = middle + 0.5 * free * direction;
      }
    }
    points.push_back(best);
  }
  return points;
}

std::vector<std::uint32_t> trianglesOffFaces(const TriangleMesh& mesh, const Domain& box)
{
  std::vector<std::uint32_t> kept;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    unsigned shared = 0x3f;
    for (const std::int32_t corner : mesh.triangles[t])
    {
      shared &= facesAt(box, mesh.points[std::size_t(corner)]);
    }
    if (shared == 0)
    {
      kept.push_back(static_cast<std::uint32_t>(t));
    }
  }
  return kept;
}

bool extendToFace(TriangleMesh& mesh, const Domain& box, int face, double furthest)
{
  const int axis = face / 2;
  const double sense = face % 2 == 0 ? -1.0 : 1.0;
  double outermost = -std::numeric_limits<double>::infinity();
  for (const Vector3d& point : mesh.points)
  {
    outermost = std::max(outermost, sense * point[axis]);
  }
  const auto isAtEnd = [&](std::int32_t p) { return sense * mesh.points[std::size_t(p)][axis] >= outermost - faceTolerance; };
  const double missing = sense * faceOf(box, face) - outermost;
  const bool isFlat = std::any_of(
    mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) { return std::all_of(t.begin(), t.end(), isAtEnd); });
  if (!isFlat || missing <= faceTolerance || missing > furthest)
  {
    return false;
  }
  for (std::size_t p = 0; p < mesh.points.size(); ++p)
  {
    if (isAtEnd(static_cast<std::int32_t>(p)))
    {
      mesh.points[p][axis] = faceOf(box, face);
    }
  }
  return true;
}

BoxedSurfaces joinInBox(const Domain& box, const std::vector<CompartmentSurface>& surfaces, std::int32_t around)
{
  BoxJoint joint(box, around);
  for (const CompartmentSurface& surface : surfaces)
  {
    joint.add(surface);
  }
  return joint.finish();
}

} // namespace cactus
