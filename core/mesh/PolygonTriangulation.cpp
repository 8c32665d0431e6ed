// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/PolygonTriangulation.h"

#include "base/Error.h"
#include "mesh/PlaneTriangulation.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace cactus
{

namespace
{

/// The points of the box come before the polygon's.
constexpr std::int32_t boxCorners = 4;

/// Fills the box around a polygon with triangles that have the polygon's sides among their edges. Returns false if two corners
/// are at the same place. Throws InvalidInput if sides cross, or a corner lies on another side.
bool fillBox(PlaneTriangulation& box, const std::vector<Eigen::Vector2d>& polygon)
{
  const auto count = static_cast<std::int32_t>(polygon.size());
  for (std::int32_t i = 0; i < count; ++i)
  {
    if (box.insert(polygon[std::size_t(i)]) != boxCorners + i)
    {
      return false;
    }
  }
  for (std::int32_t i = 0; i < count; ++i)
  {
    box.insertEdge(boxCorners + i, boxCorners + (i + 1) % count);
  }
  return true;
}

/// Tells whether the corners of a triangle are in the polygon's order: they are inside it, and reversed outside.
bool isInside(const PlaneTriangulation::Triangle& t)
{
  const int rises = int(t[0] < t[1]) + int(t[1] < t[2]) + int(t[2] < t[0]);
  return rises == 2 && *std::min_element(t.begin(), t.end()) >= boxCorners;
}

} // namespace

std::vector<std::array<std::int32_t, 3>> trianglesOf(const std::vector<Eigen::Vector2d>& polygon)
{
  std::vector<std::array<std::int32_t, 3>> inside;
  if (polygon.size() < 3)
  {
    return inside;
  }
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& corner : polygon)
  {
    box.extend(corner);
  }
  const Eigen::Vector2d margin = 0.1 * box.sizes();
  PlaneTriangulation all(box.min() - margin, box.max() + margin);
  try
  {
    if (!fillBox(all, polygon))
    {
      return inside;
    }
  }
  catch (const InvalidInput&)
  {
    return inside; // the polygon crosses or touches itself
  }
  for (const PlaneTriangulation::Triangle& t : all.triangles())
  {
    if (isInside(t))
    {
      inside.push_back({ { t[0] - boxCorners, t[1] - boxCorners, t[2] - boxCorners } });
    }
  }
  return inside;
}

} // namespace cactus
