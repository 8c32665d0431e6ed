// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/PlaneLoops.h"

#include <algorithm>
#include <array>
#include <utility>

namespace cactus
{

namespace
{

using Eigen::Vector3d;

/// Returns the loop that runs through a point; empty if it does not return there after `count` points.
std::vector<std::int32_t> follow(const std::vector<std::int32_t>& next, std::int32_t first, std::size_t count)
{
  std::vector<std::int32_t> points;
  std::int32_t point = first;
  do
  {
    points.push_back(point);
    point = next[std::size_t(point)];
  } while (point >= 0 && point != first && points.size() < count);
  return point == first && points.size() == count ? points : std::vector<std::int32_t>();
}

/// Returns the index of the point farthest from the middle of all.
std::size_t farthest(const std::vector<std::int32_t>& points, const std::vector<Vector3d>& places)
{
  Vector3d middle = Vector3d::Zero();
  for (const std::int32_t p : points)
  {
    middle += places[std::size_t(p)];
  }
  middle /= double(points.size());
  const auto distance = [&](std::int32_t p) { return (places[std::size_t(p)] - middle).squaredNorm(); };
  const auto found =
    std::max_element(points.begin(), points.end(), [&](std::int32_t p, std::int32_t q) { return distance(p) < distance(q); });
  return std::size_t(found - points.begin());
}

/// Finds the places at which a loop meets a face, and its beginning.
PlaneLoop anchored(std::vector<std::int32_t> points, const CappedSurface& surface)
{
  PlaneLoop loop;
  const std::size_t count = points.size();
  if (count == 0)
  {
    return loop;
  }
  const auto facesOf = [&](std::size_t i) { return surface.faces[std::size_t(points[i % count])]; };
  for (std::size_t i = 0; i < count; ++i)
  {
    if ((facesOf(i) & ~(facesOf(i + count - 1) & facesOf(i + 1))) != 0)
    {
      loop.anchors.push_back(i);
    }
  }
  const std::size_t first = loop.anchors.empty() ? farthest(points, surface.mesh.points) : loop.anchors.front();
  for (std::size_t& anchor : loop.anchors)
  {
    anchor -= first;
  }
  std::rotate(points.begin(), points.begin() + std::ptrdiff_t(first), points.end());
  loop.points = std::move(points);
  return loop;
}

} // namespace

PlaneLoops::PlaneLoops(const CappedSurface& surface, Eigen::Index axis, const std::vector<double>& planes)
  : Counts(2 * planes.size(), 0)
  , Triangles(planes.size() - 1, 0)
  , Loops(planes.size())
  , IsRing(planes.size() - 1, false)
{
  this->placePoints(surface, axis, planes);
  this->sortTriangles(surface);
  this->findLoops(surface);
  this->findRings();
}

void PlaneLoops::placePoints(const CappedSurface& surface, Eigen::Index axis, const std::vector<double>& planes)
{
  const std::size_t last = planes.size() - 1;
  const double spacing = (planes[last - 1] - planes[1]) / double(last - 2);
  this->Levels.reserve(surface.mesh.points.size());
  for (const Vector3d& point : surface.mesh.points)
  {
    // The plane at the point or before it: rounding may be off by one.
    const double x = point[axis];
    auto plane = static_cast<std::size_t>(std::clamp(1.0 + (x - planes[1]) / spacing, 0.0, double(last - 1)));
    while (plane > 0 && x < planes[plane])
    {
      --plane;
    }
    while (plane < last && x >= planes[plane + 1])
    {
      ++plane;
    }
    this->Levels.push_back(static_cast<int>(2 * plane) + (x == planes[plane] ? 0 : 1));
    ++this->Counts[std::size_t(this->Levels.back())];
  }
}

/// Sorts triangles by bands, and chains the edges in planes: each has one triangle in the band above or, in the last plane,
/// below.
void PlaneLoops::sortTriangles(const CappedSurface& surface)
{
  const int last = static_cast<int>(2 * this->bandCount());
  this->Next.assign(this->Levels.size(), -1);
  this->Bands.reserve(surface.mesh.triangles.size());
  for (const auto& corners : surface.mesh.triangles)
  {
    std::array<int, 3> levels;
    std::transform(corners.begin(), corners.end(), levels.begin(), [&](std::int32_t p) { return this->Levels[std::size_t(p)]; });
    const auto [lowest, highest] = std::minmax({ levels[0], levels[1], levels[2] });
    this->Bands.push_back(std::min(std::size_t(lowest) / 2, this->bandCount() - 1));
    if (lowest == highest && lowest % 2 == 0)
    {
      continue;
    }
    ++this->Triangles[this->Bands.back()];
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::size_t j = (i + 1) % 3;
      if (levels[i] == levels[j] && levels[i] % 2 == 0 && (levels[i] == lowest || levels[i] == last))
      {
        const bool isAbove = levels[i] == lowest;
        this->Next[std::size_t(corners[isAbove ? i : j])] = corners[isAbove ? j : i];
      }
    }
  }
  for (const int outermost : { 0, last })
  {
    std::size_t& count = this->Counts[std::size_t(outermost)];
    count = 0;
    for (std::size_t p = 0; p < this->Levels.size(); ++p)
    {
      count += this->Levels[p] == outermost && this->Next[p] >= 0 ? 1 : 0;
    }
  }
}

void PlaneLoops::findLoops(const CappedSurface& surface)
{
  std::vector<std::int32_t> any(this->planeCount(), -1);
  for (std::size_t p = 0; p < this->Levels.size(); ++p)
  {
    if (this->Levels[p] % 2 == 0 && this->Next[p] >= 0)
    {
      any[std::size_t(this->Levels[p]) / 2] = static_cast<std::int32_t>(p);
    }
  }
  for (std::size_t plane = 0; plane < this->planeCount(); ++plane)
  {
    if (any[plane] >= 0)
    {
      this->Loops[plane] = anchored(follow(this->Next, any[plane], this->Counts[2 * plane]), surface);
    }
  }
}

void PlaneLoops::findRings()
{
  for (std::size_t band = 0; band < this->bandCount(); ++band)
  {
    // The Euler characteristic is 0 if each edge but those of the two loops has a triangle on either side.
    const std::size_t onLoops = this->Counts[2 * band] + this->Counts[2 * band + 2];
    this->IsRing[band] = !this->Loops[band].isEmpty() && !this->Loops[band + 1].isEmpty() &&
                         2 * this->Counts[2 * band + 1] + onLoops == this->Triangles[band];
  }
}

} // namespace cactus
