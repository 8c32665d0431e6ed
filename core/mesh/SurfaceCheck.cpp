// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/SurfaceCheck.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "base/Limits.h"

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

class DisjointSets
{
public:
  explicit DisjointSets(std::size_t count)
  {
    this->Parent.reserve(count);
    for (std::size_t item = 0; item < count; ++item)
    {
      this->Parent.push_back(item);
    }
  }

  std::size_t find(std::size_t item)
  {
    while (this->Parent[item] != item)
    {
      this->Parent[item] = this->Parent[this->Parent[item]];
      item = this->Parent[item];
    }
    return item;
  }

  /// The smaller index stays the root, so that roots do not depend on the order of joins.
  void join(std::size_t a, std::size_t b)
  {
    a = this->find(a);
    b = this->find(b);
    this->Parent[std::max(a, b)] = std::min(a, b);
  }

private:
  std::vector<std::size_t> Parent;
};

/// One side of a triangle, filed under its lower point.
struct HalfEdge
{
  std::int32_t upper;
  bool rising; ///< the triangle runs from the lower point to the upper one
  std::size_t triangle;
};

std::size_t cornerAt(const TriangleMesh& mesh, std::size_t triangle, std::int32_t point)
{
  const auto& t = mesh.triangles[triangle];
  return 3 * triangle + (t[0] == point ? 0 : t[1] == point ? 1 : 2);
}

bool repeatsCorner(const std::array<std::int32_t, 3>& t)
{
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

void checkIndices(const TriangleMesh& mesh)
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

double angleAt(const Eigen::Vector3d& corner, const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  const Eigen::Vector3d u = a - corner;
  const Eigen::Vector3d v = b - corner;
  return radian * std::atan2(u.cross(v).norm(), u.dot(v));
}

} // namespace

SurfaceReport checkSurface(const TriangleMesh& mesh, std::vector<std::uint32_t>* componentOf)
{
  checkIndices(mesh);
  SurfaceReport report;
  report.triangles = mesh.triangles.size();
  if (mesh.triangles.empty())
  {
    return report;
  }

  // Half-edges by their lower point: count, prefix sum, fill.
  const std::size_t pointCount = mesh.points.size();
  std::vector<std::size_t> begin(pointCount + 1, 0);
  std::vector<char> used(pointCount, 0);
  for (const auto& t : mesh.triangles)
  {
    for (int i = 0; i < 3; ++i)
    {
      used[static_cast<std::size_t>(t[i])] = 1;
      begin[static_cast<std::size_t>(std::min(t[i], t[(i + 1) % 3])) + 1] += repeatsCorner(t) ? 0 : 1;
    }
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<HalfEdge> halfEdges(begin.back());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for (std::size_t triangle = 0; triangle < mesh.triangles.size(); ++triangle)
  {
    const auto& t = mesh.triangles[triangle];
    if (repeatsCorner(t))
    {
      ++report.repeatedCorners;
      continue;
    }
    for (int i = 0; i < 3; ++i)
    {
      const std::int32_t from = t[i];
      const std::int32_t to = t[(i + 1) % 3];
      halfEdges[next[static_cast<std::size_t>(std::min(from, to))]++] = { std::max(from, to), from < to, triangle };
    }
  }

  // Triangles joined across edges make components; corners of one point joined across edges make its fans.
  DisjointSets pieces(mesh.triangles.size());
  DisjointSets corners(3 * mesh.triangles.size());
  for (std::size_t lower = 0; lower < pointCount; ++lower)
  {
    const auto first = halfEdges.begin() + static_cast<std::ptrdiff_t>(begin[lower]);
    const auto last = halfEdges.begin() + static_cast<std::ptrdiff_t>(begin[lower + 1]);
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
          corners.join(cornerAt(mesh, edge->triangle, point), cornerAt(mesh, end->triangle, point));
        }
      }
      const auto sharing = end - edge;
      report.openEdges += sharing == 1 ? 1 : 0;
      report.crowdedEdges += sharing > 2 ? 1 : 0;
      report.flippedEdges += sharing == 2 && edge->rising == (edge + 1)->rising ? 1 : 0;
      edge = end;
    }
  }

  std::vector<std::int64_t> fanOf(pointCount, -1);
  std::vector<char> pinched(pointCount, 0);
  std::vector<double> volumeOf(mesh.triangles.size(), 0.0);
  report.smallestAngle = 180.0;
  report.smallestAltitude = std::numeric_limits<double>::infinity();
  for (std::size_t triangle = 0; triangle < mesh.triangles.size(); ++triangle)
  {
    const auto& t = mesh.triangles[triangle];
    const Eigen::Vector3d& a = mesh.points[static_cast<std::size_t>(t[0])];
    const Eigen::Vector3d& b = mesh.points[static_cast<std::size_t>(t[1])];
    const Eigen::Vector3d& c = mesh.points[static_cast<std::size_t>(t[2])];
    const double edges[3] = { (b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm() };
    const double longest = *std::max_element(edges, edges + 3);
    const double shortest = *std::min_element(edges, edges + 3);
    const double twiceArea = (b - a).cross(c - a).norm();
    report.area += 0.5 * twiceArea;
    report.degenerateTriangles += twiceArea <= degenerateRatio * longest ? 1 : 0;
    report.largestSquaredEdgeRatio =
      std::max(report.largestSquaredEdgeRatio, shortest > 0.0 ? longest / shortest : std::numeric_limits<double>::infinity());
    report.smallestAltitude = std::min(report.smallestAltitude, longest > 0.0 ? twiceArea / std::sqrt(longest) : 0.0);
    report.largestAspect =
      std::max(report.largestAspect, twiceArea > 0.0 ? longest / twiceArea : std::numeric_limits<double>::infinity());
    // The smallest angle lies across from the shortest edge.
    report.smallestAngle = std::min(report.smallestAngle, shortest == edges[0]   ? angleAt(c, a, b)
                                                          : shortest == edges[1] ? angleAt(a, b, c)
                                                                                 : angleAt(b, c, a));

    const std::size_t piece = pieces.find(triangle);
    report.components += piece == triangle && !repeatsCorner(t) ? 1 : 0;
    // About a point of the same component, so that a component's volume does not depend on where the others lie.
    const Eigen::Vector3d& origin = mesh.points[static_cast<std::size_t>(mesh.triangles[piece][0])];
    volumeOf[piece] += (a - origin).dot((b - origin).cross(c - origin)) / 6.0;

    for (int i = 0; i < 3 && !repeatsCorner(t); ++i)
    {
      const auto point = static_cast<std::size_t>(t[i]);
      const auto fan = static_cast<std::int64_t>(corners.find(3 * triangle + static_cast<std::size_t>(i)));
      pinched[point] |= static_cast<char>(fanOf[point] >= 0 && fanOf[point] != fan);
      fanOf[point] = fan;
    }
  }
  if (componentOf != nullptr)
  {
    componentOf->assign(mesh.triangles.size(), 0);
  }
  for (std::size_t triangle = 0; triangle < mesh.triangles.size(); ++triangle)
  {
    if (componentOf != nullptr)
    {
      // A component's root is its first triangle.
      const std::size_t root = pieces.find(triangle);
      (*componentOf)[triangle] = root == triangle ? static_cast<std::uint32_t>(report.pieces.size()) : (*componentOf)[root];
    }
    if (pieces.find(triangle) == triangle && !repeatsCorner(mesh.triangles[triangle]))
    {
      report.volume += volumeOf[triangle];
      report.inwardComponents += volumeOf[triangle] > 0.0 ? 0 : 1;
      report.pieces.push_back(mesh.triangles[triangle][0]);
    }
  }
  for (std::size_t point = 0; point < pointCount; ++point)
  {
    report.points += used[point] ? 1 : 0;
    report.pinchedPoints += pinched[point] ? 1 : 0;
  }
  return report;
}

} // namespace cactus
