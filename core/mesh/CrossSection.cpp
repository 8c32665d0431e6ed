// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/CrossSection.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace cactus
{

namespace
{

/// The piece of an outline within one triangle, from the edge where the boundary enters it to the one where it leaves.
struct Piece
{
  std::uint64_t from;
  std::uint64_t to;
  Eigen::Vector3d start;
};

std::uint64_t edgeKey(std::int32_t a, std::int32_t b)
{
  return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | static_cast<std::uint64_t>(std::max(a, b));
}

bool holds(const std::vector<Eigen::Vector3d>& polygon, const Eigen::Vector3d& point, const Eigen::Vector3d& normal)
{
  const Eigen::Vector3d u = normal.unitOrthogonal();
  const Eigen::Vector3d v = normal.cross(u);
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++)
  {
    const double yi = (polygon[i] - point).dot(v);
    const double yj = (polygon[j] - point).dot(v);
    if ((yi > 0.0) != (yj > 0.0))
    {
      const double xi = (polygon[i] - point).dot(u);
      const double xj = (polygon[j] - point).dot(u);
      inside ^= xi - yi * (xj - xi) / (yj - yi) > 0.0;
    }
  }
  return inside;
}

/// Adds the cut of the plane through a triangle, if it meets it.
void cutTriangle(const TriangleMesh& mesh, const std::array<std::int32_t, 3>& t, const Eigen::Vector3d& point,
  const Eigen::Vector3d& normal, std::vector<Piece>& pieces)
{
  double height[3];
  for (int i = 0; i < 3; ++i)
  {
    height[i] = (mesh.points[static_cast<std::size_t>(t[i])] - point).dot(normal);
  }
  Piece piece{ 0, 0, {} };
  bool cut = false;
  for (int i = 0; i < 3; ++i)
  {
    // A point on the plane counts as above it, so that a triangle has either no cut edge or two.
    const int j = (i + 1) % 3;
    if (height[i] >= 0.0 && height[j] < 0.0)
    {
      const double weight = height[i] / (height[i] - height[j]);
      piece.from = edgeKey(t[i], t[j]);
      piece.start =
        (1.0 - weight) * mesh.points[static_cast<std::size_t>(t[i])] + weight * mesh.points[static_cast<std::size_t>(t[j])];
      cut = true;
    }
    else if (height[i] < 0.0 && height[j] >= 0.0)
    {
      piece.to = edgeKey(t[i], t[j]);
    }
  }
  if (cut)
  {
    pieces.push_back(piece);
  }
}

/// Returns the loop of smallest area around the point, from pieces in the order of their beginnings; empty if there is none.
std::vector<Eigen::Vector3d> smallestLoop(
  const std::vector<Piece>& pieces, const Eigen::Vector3d& point, const Eigen::Vector3d& normal)
{
  std::vector<Eigen::Vector3d> best;
  double bestArea = std::numeric_limits<double>::infinity();
  std::vector<char> visited(pieces.size(), 0);
  std::vector<Eigen::Vector3d> loop;
  for (std::size_t first = 0; first < pieces.size(); ++first)
  {
    loop.clear();
    std::size_t current = first;
    while (current < pieces.size() && !visited[current])
    {
      visited[current] = 1;
      loop.push_back(pieces[current].start);
      const std::uint64_t wanted = pieces[current].to;
      const auto next =
        std::lower_bound(pieces.begin(), pieces.end(), wanted, [](const Piece& p, std::uint64_t key) { return p.from < key; });
      current = next != pieces.end() && next->from == wanted ? static_cast<std::size_t>(next - pieces.begin()) : pieces.size();
    }
    if (current != first || loop.size() < 3)
    {
      continue; // open within this part of the surface
    }
    const double area = polygonArea(loop, normal);
    if (area > 0.0 && area < bestArea && holds(loop, point, normal))
    {
      bestArea = area;
      best = loop;
    }
  }
  return best;
}

} // namespace

CrossSections::CrossSections(const TriangleMesh& mesh)
  : Mesh(mesh)
  , FirstBin(mesh.triangles.size(), 0)
{
  if (mesh.triangles.empty())
  {
    return;
  }
  Eigen::Vector3d lower = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d upper = -lower;
  for (const auto& t : mesh.triangles)
  {
    for (const std::int32_t point : t)
    {
      lower = lower.cwiseMin(mesh.points[static_cast<std::size_t>(point)]);
      upper = upper.cwiseMax(mesh.points[static_cast<std::size_t>(point)]);
    }
  }
  (upper - lower).maxCoeff(&this->Axis);
  this->Lower = lower[this->Axis];
  this->Upper = upper[this->Axis];
  // About 64 triangles per bin keep a bin shorter than a cut's window without storing many triangles twice. A surface without an
  // extent has one bin, which every search reaches.
  const bool hasExtent = this->Upper > this->Lower;
  this->Begin.assign((hasExtent ? std::clamp<std::size_t>(mesh.triangles.size() / 64, 1, 65536) : 1) + 1, 0);

  std::vector<std::size_t> lastBin(mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
  {
    const auto& t = mesh.triangles[i];
    const double a = mesh.points[static_cast<std::size_t>(t[0])][this->Axis];
    const double b = mesh.points[static_cast<std::size_t>(t[1])][this->Axis];
    const double c = mesh.points[static_cast<std::size_t>(t[2])][this->Axis];
    this->FirstBin[i] = this->binOf(std::min({ a, b, c }));
    lastBin[i] = this->binOf(std::max({ a, b, c }));
    for (std::size_t bin = this->FirstBin[i]; bin <= lastBin[i]; ++bin)
    {
      ++this->Begin[bin + 1];
    }
  }
  for (std::size_t bin = 1; bin < this->Begin.size(); ++bin)
  {
    this->Begin[bin] += this->Begin[bin - 1];
  }
  this->Triangles.resize(this->Begin.back());
  std::vector<std::size_t> next(this->Begin.begin(), this->Begin.end() - 1);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
  {
    for (std::size_t bin = this->FirstBin[i]; bin <= lastBin[i]; ++bin)
    {
      this->Triangles[next[bin]++] = i;
    }
  }
}

std::size_t CrossSections::binOf(double coordinate) const
{
  const std::size_t bins = this->Begin.size() - 1;
  const double extent = this->Upper - this->Lower;
  const double fraction = extent > 0.0 ? (coordinate - this->Lower) / extent : 0.0;
  return std::min(bins - 1, static_cast<std::size_t>(std::clamp(fraction, 0.0, 1.0) * static_cast<double>(bins)));
}

std::vector<Eigen::Vector3d> CrossSections::outlineAround(
  const Eigen::Vector3d& point, const Eigen::Vector3d& normal, double reach) const
{
  const std::size_t bins = this->Begin.size() - 1;
  for (;; reach *= 2.0)
  {
    const std::size_t firstBin = this->binOf(point[this->Axis] - reach);
    const std::size_t lastBin = this->binOf(point[this->Axis] + reach);
    // A loop that closes within a part of the surface is a loop of the whole.
    auto outline = this->outlineWithin(point, normal, firstBin, lastBin);
    if (!outline.empty() || (firstBin == 0 && lastBin + 1 == bins))
    {
      return outline;
    }
  }
}

std::vector<Eigen::Vector3d> CrossSections::outlineWithin(
  const Eigen::Vector3d& point, const Eigen::Vector3d& normal, std::size_t firstBin, std::size_t lastBin) const
{
  std::vector<Piece> pieces;
  for (std::size_t bin = firstBin; bin <= lastBin; ++bin)
  {
    for (std::size_t entry = this->Begin[bin]; entry < this->Begin[bin + 1]; ++entry)
    {
      const std::size_t triangle = this->Triangles[entry];
      if (std::max(this->FirstBin[triangle], firstBin) == bin) // else found in an earlier bin
      {
        cutTriangle(this->Mesh, this->Mesh.triangles[triangle], point, normal, pieces);
      }
    }
  }
  std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.from < b.from; });
  return smallestLoop(pieces, point, normal);
}

double polygonArea(const std::vector<Eigen::Vector3d>& polygon, const Eigen::Vector3d& normal)
{
  double twice = 0.0;
  for (std::size_t i = 2; i < polygon.size(); ++i)
  {
    twice += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]).dot(normal);
  }
  return 0.5 * twice;
}

double polygonAxisRatio(const std::vector<Eigen::Vector3d>& polygon, const Eigen::Vector3d& normal)
{
  Eigen::Matrix<double, 2, 3> axes;
  axes.row(0) = normal.unitOrthogonal();
  axes.row(1) = normal.cross(axes.row(0).transpose());
  // Of the triangles from the first point on: one with corners at 0, p, q has the moments A/12 (pp' + qq' + (p + q)(p + q)').
  double area = 0.0;
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  for (std::size_t i = 2; i < polygon.size(); ++i)
  {
    const Eigen::Vector2d p = axes * (polygon[i - 1] - polygon[0]);
    const Eigen::Vector2d q = axes * (polygon[i] - polygon[0]);
    const Eigen::Vector2d sum = p + q;
    const double part = 0.5 * (p.x() * q.y() - p.y() * q.x());
    area += part;
    first += part / 3.0 * sum;
    second += part / 12.0 * (p * p.transpose() + q * q.transpose() + sum * sum.transpose());
  }
  second -= first * first.transpose() / area;
  const double mean = 0.5 * second.trace();
  const double spread = std::hypot(0.5 * (second(0, 0) - second(1, 1)), second(0, 1));
  return std::sqrt(std::max(0.0, mean - spread) / (mean + spread));
}

double polygonPerimeter(const std::vector<Eigen::Vector3d>& polygon)
{
  double length = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    length += (polygon[(i + 1) % polygon.size()] - polygon[i]).norm();
  }
  return length;
}

} // namespace cactus
