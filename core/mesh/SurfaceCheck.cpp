// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SurfaceCheck.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "base/Limits.h"
#include "mesh/DisjointSets.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

namespace cactus
{

namespace
{

/// Twice a triangle's area over its longest edge squared: below this its normal is rounding noise.
constexpr double degenerateRatio = 1e-12;

/// One side of a triangle, stored under its lower point.
struct HalfEdge
{
  std::int32_t upper;
  bool rising; ///< the triangle runs from the lower point to the upper one
  std::size_t triangle;
};

/// All half-edges by their lower point: those of point p are first[p] to first[p + 1] - 1. Triangles that use a point twice are
/// left out.
struct HalfEdges
{
  std::vector<HalfEdge> all;
  std::vector<std::size_t> first;
};

using Sets = DisjointSets<std::size_t>;

std::size_t cornerAt(const TriangleMesh& mesh, std::size_t triangle, std::int32_t point)
{
  const auto& t = mesh.triangles[triangle];
  return 3 * triangle + (t[0] == point ? 0 : t[1] == point ? 1 : 2);
}

bool repeatsCorner(const std::array<std::int32_t, 3>& t)
{
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

double angleAt(const Eigen::Vector3d& corner, const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  const Eigen::Vector3d u = a - corner;
  const Eigen::Vector3d v = b - corner;
  return radian * std::atan2(u.cross(v).norm(), u.dot(v));
}

/// Counts, sums up and fills.
HalfEdges halfEdgesOf(const TriangleMesh& mesh)
{
  HalfEdges edges;
  edges.first.assign(mesh.points.size() + 1, 0);
  for (const auto& t : mesh.triangles)
  {
    for (int i = 0; i < 3; ++i)
    {
      edges.first[static_cast<std::size_t>(std::min(t[i], t[(i + 1) % 3])) + 1] += repeatsCorner(t) ? 0 : 1;
    }
  }
  std::partial_sum(edges.first.begin(), edges.first.end(), edges.first.begin());
  edges.all.resize(edges.first.back());
  std::vector<std::size_t> next(edges.first.begin(), edges.first.end() - 1);
  for (std::size_t triangle = 0; triangle < mesh.triangles.size(); ++triangle)
  {
    const auto& t = mesh.triangles[triangle];
    for (int i = 0; i < 3 && !repeatsCorner(t); ++i)
    {
      const std::int32_t from = t[i];
      const std::int32_t to = t[(i + 1) % 3];
      edges.all[next[static_cast<std::size_t>(std::min(from, to))]++] = { std::max(from, to), from < to, triangle };
    }
  }
  return edges;
}

/// Joins triangles across edges into `pieces`, and corners of one point across edges into its `fans`. Counts defects of edges.
/// Sorts the half-edges of each point.
void joinAcrossEdges(const TriangleMesh& mesh, HalfEdges& edges, Sets& pieces, Sets& fans, SurfaceReport& report)
{
  for (std::size_t lower = 0; lower < mesh.points.size(); ++lower)
  {
    const auto first = edges.all.begin() + static_cast<std::ptrdiff_t>(edges.first[lower]);
    const auto last = edges.all.begin() + static_cast<std::ptrdiff_t>(edges.first[lower + 1]);
    std::sort(first, last,
      [](const HalfEdge& a, const HalfEdge& b) { return a.upper != b.upper ? a.upper < b.upper : a.triangle < b.triangle; });
    for (auto edge = first; edge != last;)
    {
      auto end = edge + 1;
      for (; end != last && end->upper == edge->upper; ++end)
      {
        pieces.join(edge->triangle, end->triangle);
        for (const std::int32_t point : { static_cast<std::int32_t>(lower), edge->upper })
        {
          fans.join(cornerAt(mesh, edge->triangle, point), cornerAt(mesh, end->triangle, point));
        }
      }
      const auto sharing = end - edge;
      report.openEdges += sharing == 1 ? 1 : 0;
      report.crowdedEdges += sharing > 2 ? 1 : 0;
      report.flippedEdges += sharing == 2 && edge->rising == (edge + 1)->rising ? 1 : 0;
      edge = end;
    }
  }
}

void measureTriangles(const TriangleMesh& mesh, SurfaceReport& report)
{
  constexpr double infinite = std::numeric_limits<double>::infinity();
  report.smallestAngle = 180.0;
  report.smallestAltitude = infinite;
  for (const auto& t : mesh.triangles)
  {
    const Eigen::Vector3d& a = mesh.points[static_cast<std::size_t>(t[0])];
    const Eigen::Vector3d& b = mesh.points[static_cast<std::size_t>(t[1])];
    const Eigen::Vector3d& c = mesh.points[static_cast<std::size_t>(t[2])];
    const double edges[3] = { (b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm() };
    const double longest = *std::max_element(edges, edges + 3);
    const double shortest = *std::min_element(edges, edges + 3);
    const double twiceArea = (b - a).cross(c - a).norm();
    report.area += 0.5 * twiceArea;
    report.degenerateTriangles += twiceArea <= degenerateRatio * longest ? 1 : 0;
    report.repeatedCorners += repeatsCorner(t) ? 1 : 0;
    report.largestSquaredEdgeRatio = std::max(report.largestSquaredEdgeRatio, shortest > 0.0 ? longest / shortest : infinite);
    report.smallestAltitude = std::min(report.smallestAltitude, longest > 0.0 ? twiceArea / std::sqrt(longest) : 0.0);
    report.largestAspect = std::max(report.largestAspect, twiceArea > 0.0 ? longest / twiceArea : infinite);
    // The smallest angle lies opposite the shortest edge.
    report.smallestAngle = std::min(report.smallestAngle, shortest == edges[0]   ? angleAt(c, a, b)
                                                          : shortest == edges[1] ? angleAt(a, b, c)
                                                                                 : angleAt(b, c, a));
  }
}

void measureNormals(const TriangleMesh& mesh, SurfaceReport& report)
{
  std::vector<Eigen::Vector3d> ofTriangle;
  ofTriangle.reserve(mesh.triangles.size());
  std::vector<Eigen::Vector3d> ofPoint(mesh.points.size(), Eigen::Vector3d::Zero());
  for (const auto& t : mesh.triangles)
  {
    const Eigen::Vector3d& a = mesh.points[static_cast<std::size_t>(t[0])];
    const Eigen::Vector3d normal =
      (mesh.points[static_cast<std::size_t>(t[1])] - a).cross(mesh.points[static_cast<std::size_t>(t[2])] - a);
    ofTriangle.push_back(normal);
    for (const std::int32_t point : t)
    {
      ofPoint[static_cast<std::size_t>(point)] += normal;
    }
  }
  double smallest = 1.0; // cosine
  for (Eigen::Vector3d& normal : ofPoint)
  {
    normal.normalize(); // leaves zero as it is
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
  {
    const double length = ofTriangle[i].norm();
    for (const std::int32_t point : mesh.triangles[i])
    {
      const double along = ofPoint[static_cast<std::size_t>(point)].dot(ofTriangle[i]);
      smallest = length > 0.0 ? std::min(smallest, along / length) : smallest;
    }
  }
  report.largestNormalAngle = radian * std::acos(std::max(smallest, -1.0));
}

/// Numbers the pieces by their first triangles, and measures their volumes.
void measurePieces(const TriangleMesh& mesh, Sets& pieces, SurfaceReport& report, std::vector<std::uint32_t>* componentOf)
{
  const std::size_t count = mesh.triangles.size();
  std::vector<double> volumeOf(count, 0.0);
  for (std::size_t triangle = 0; triangle < count; ++triangle)
  {
    const auto& t = mesh.triangles[triangle];
    const std::size_t piece = pieces.find(triangle);
    // About a point of the same component, so that a component's volume does not depend on where the others lie.
    const Eigen::Vector3d& origin = mesh.points[static_cast<std::size_t>(mesh.triangles[piece][0])];
    const Eigen::Vector3d& a = mesh.points[static_cast<std::size_t>(t[0])];
    const Eigen::Vector3d& b = mesh.points[static_cast<std::size_t>(t[1])];
    const Eigen::Vector3d& c = mesh.points[static_cast<std::size_t>(t[2])];
    volumeOf[piece] += (a - origin).dot((b - origin).cross(c - origin)) / 6.0;
  }
  if (componentOf != nullptr)
  {
    componentOf->assign(count, 0);
  }
  for (std::size_t triangle = 0; triangle < count; ++triangle)
  {
    const std::size_t root = pieces.find(triangle);
    if (componentOf != nullptr)
    {
      (*componentOf)[triangle] = root == triangle ? static_cast<std::uint32_t>(report.pieces.size()) : (*componentOf)[root];
    }
    if (root == triangle && !repeatsCorner(mesh.triangles[triangle]))
    {
      report.volume += volumeOf[triangle];
      report.inwardComponents += volumeOf[triangle] > 0.0 ? 0 : 1;
      report.pieces.push_back(mesh.triangles[triangle][0]);
    }
  }
  report.components = report.pieces.size();
}

/// Counts points, and those whose corners belong to several fans.
void countPoints(const TriangleMesh& mesh, Sets& fans, SurfaceReport& report)
{
  std::vector<char> isUsed(mesh.points.size(), 0);
  std::vector<char> isPinched(mesh.points.size(), 0);
  std::vector<std::int64_t> fanOf(mesh.points.size(), -1);
  for (std::size_t triangle = 0; triangle < mesh.triangles.size(); ++triangle)
  {
    const auto& t = mesh.triangles[triangle];
    for (std::size_t i = 0; i < 3; ++i)
    {
      const auto point = static_cast<std::size_t>(t[i]);
      isUsed[point] = 1;
      if (!repeatsCorner(t))
      {
        const auto fan = static_cast<std::int64_t>(fans.find(3 * triangle + i));
        isPinched[point] |= static_cast<char>(fanOf[point] >= 0 && fanOf[point] != fan);
        fanOf[point] = fan;
      }
    }
  }
  report.points = static_cast<std::size_t>(std::count(isUsed.begin(), isUsed.end(), 1));
  report.pinchedPoints = static_cast<std::size_t>(std::count(isPinched.begin(), isPinched.end(), 1));
}

} // namespace

void requireCorners(const TriangleMesh& mesh)
{
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    for (const std::int32_t point : mesh.triangles[t])
    {
      if (point < 0 || static_cast<std::size_t>(point) >= mesh.points.size())
      {
        throw InvalidInput("triangle " + std::to_string(t) + " uses point " + std::to_string(point) + " of " +
                           std::to_string(mesh.points.size()) + ": the surface is damaged");
      }
      if (!mesh.points[static_cast<std::size_t>(point)].allFinite())
      {
        throw InvalidInput("point " + std::to_string(point) + " of triangle " + std::to_string(t) +
                           " has a coordinate that is not finite (NaN or infinite)");
      }
      if (mesh.points[static_cast<std::size_t>(point)].cwiseAbs().maxCoeff() > limits::coordinate.highest)
      {
        throw InvalidInput(text("point ", point, " of triangle ", t, " lies ",
          mesh.points[static_cast<std::size_t>(point)].cwiseAbs().maxCoeff(), " µm from 0 along an axis, beyond the ",
          limits::coordinate.highest, " µm that coordinates may have: give the surface in µm"));
      }
    }
  }
}

SurfaceReport checkSurface(const TriangleMesh& mesh, std::vector<std::uint32_t>* componentOf)
{
  requireCorners(mesh);
  SurfaceReport report;
  report.triangles = mesh.triangles.size();
  if (mesh.triangles.empty())
  {
    return report;
  }
  HalfEdges edges = halfEdgesOf(mesh);
  Sets pieces(mesh.triangles.size());
  Sets fans(3 * mesh.triangles.size());
  joinAcrossEdges(mesh, edges, pieces, fans, report);
  measureTriangles(mesh, report);
  measureNormals(mesh, report);
  measurePieces(mesh, pieces, report, componentOf);
  countPoints(mesh, fans, report);
  return report;
}

} // namespace cactus
