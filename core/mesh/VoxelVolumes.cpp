// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/VoxelVolumes.h"

#include "mesh/SurfaceCheck.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cactus
{

namespace
{

/// A convex polygon: a triangle cut by six planes has at most nine corners, and rounding may add one where a cut runs along a
/// side.
struct Polygon
{
  std::array<Eigen::Vector3d, 16> corners;
  std::size_t size = 0;

  void add(const Eigen::Vector3d& corner) { this->corners[this->size++] = corner; }
};

/// Returns the part of a convex polygon on one side of a plane: where sense · (x[axis] - place) >= 0.
Polygon cut(const Polygon& polygon, int axis, double place, double sense)
{
  Polygon part;
  for (std::size_t i = 0; i < polygon.size; ++i)
  {
    const Eigen::Vector3d& from = polygon.corners[i];
    const Eigen::Vector3d& to = polygon.corners[i + 1 < polygon.size ? i + 1 : 0];
    const double a = sense * (from[axis] - place);
    const double b = sense * (to[axis] - place);
    if (a >= 0.0)
    {
      part.add(from);
    }
    if ((a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0))
    {
      Eigen::Vector3d between = from + (to - from) * (a / (a - b));
      between[axis] = place;
      part.add(between);
    }
  }
  return part;
}

/// Returns the first and the last of `count` layers of voxels that a polygon reaches into along an axis.
std::array<int, 2> layers(const Polygon& polygon, int axis, int count)
{
  double low = polygon.corners[0][axis];
  double high = low;
  for (std::size_t i = 1; i < polygon.size; ++i)
  {
    low = std::min(low, polygon.corners[i][axis]);
    high = std::max(high, polygon.corners[i][axis]);
  }
  const double last = count - 1.0;
  return { { int(std::clamp(std::floor(low), 0.0, last)), int(std::clamp(std::floor(high), 0.0, last)) } };
}

/// Returns the part of a polygon from 0 to `count` along an axis.
Polygon within(const Polygon& polygon, int axis, int count)
{
  return cut(cut(polygon, axis, 0.0, 1.0), axis, count, -1.0);
}

/// Calls visit(layer, part) for the part of a polygon in each of `count` layers of voxels along an axis. The polygon lies within
/// them.
template <typename Visit>
void slice(const Polygon& polygon, int axis, int count, Visit&& visit)
{
  const auto [first, last] = layers(polygon, axis, count);
  Polygon rest = polygon;
  for (int layer = first; layer < last; ++layer)
  {
    const Polygon part = cut(rest, axis, layer + 1.0, -1.0);
    rest = cut(rest, axis, layer + 1.0, 1.0);
    if (part.size >= 3)
    {
      visit(layer, part);
    }
  }
  if (rest.size >= 3)
  {
    visit(last, rest);
  }
}

/// The sums of the contributions of pieces of triangles to the rows of voxels along x. Lengths in voxels, relative to the block's
/// corner.
class RowSums
{
public:
  explicit RowSums(const std::array<int, 3>& count)
    : Count(count)
    , Own(std::size_t(count[0]) * std::size_t(count[1]) * std::size_t(count[2]), 0.0)
    , Behind(this->Own.size(), 0.0)
  {
  }

  void add(const Polygon& triangle)
  {
    const Polygon seen = within(within(triangle, 2, this->Count[2]), 1, this->Count[1]);
    if (seen.size < 3)
    {
      return;
    }
    slice(seen, 2, this->Count[2],
      [&](int k, const Polygon& slab)
      { slice(slab, 1, this->Count[1], [&](int j, const Polygon& beam) { this->addBeam(beam, j, k); }); });
  }

  /// Returns the volume in each voxel, as a fraction of the voxel's.
  std::vector<double> volumes() &&
  {
    const auto row = std::size_t(this->Count[0]);
    for (std::size_t begin = 0; begin < this->Own.size(); begin += row)
    {
      double area = 0.0; // of all pieces before this voxel, as seen along x
      for (std::size_t voxel = begin; voxel < begin + row; ++voxel)
      {
        this->Own[voxel] += area;
        area += this->Behind[voxel];
      }
    }
    return std::move(this->Own);
  }

private:
  /// Adds a part of a triangle in one row of voxels. The part before the row affects all of its voxels, the part behind none.
  void addBeam(const Polygon& beam, int j, int k)
  {
    // A corner in the first face itself is inside.
    const auto end = beam.corners.begin() + std::ptrdiff_t(beam.size);
    if (std::any_of(beam.corners.begin(), end, [](const Eigen::Vector3d& corner) { return corner[0] < 0.0; }))
    {
      Polygon before = cut(beam, 0, 0.0, -1.0);
      for (std::size_t i = 0; i < before.size; ++i)
      {
        before.corners[i][0] = 0.0;
      }
      this->addPiece(before, 0, j, k);
    }
    const Polygon inside = within(beam, 0, this->Count[0]);
    if (inside.size >= 3)
    {
      slice(inside, 0, this->Count[0], [&](int i, const Polygon& piece) { this->addPiece(piece, i, j, k); });
    }
  }

  /// Adds a piece. Its area as seen along x is positive where the inside begins. Its prism fills the space behind it in its own
  /// voxel, and all voxels further on.
  void addPiece(const Polygon& piece, int i, int j, int k)
  {
    const std::size_t voxel =
      (std::size_t(k) * std::size_t(this->Count[1]) + std::size_t(j)) * std::size_t(this->Count[0]) + std::size_t(i);
    const Eigen::Vector3d& a = piece.corners[0];
    for (std::size_t n = 2; n < piece.size; ++n) // no triangles for a piece without an area
    {
      const Eigen::Vector3d& b = piece.corners[n - 1];
      const Eigen::Vector3d& c = piece.corners[n];
      const double area = -0.5 * ((b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]));
      this->Behind[voxel] += area;
      this->Own[voxel] += area * (i + 1.0 - (a[0] + b[0] + c[0]) / 3.0);
    }
  }

  std::array<int, 3> Count;
  std::vector<double> Own;    ///< of pieces in the voxel itself
  std::vector<double> Behind; ///< area of the pieces in a voxel
};

/// Returns the voxels that a surface reaches into; none if it lies outside all of them.
VoxelVolumes blockAround(const TriangleMesh& mesh, const VoxelBoxes& voxels)
{
  VoxelVolumes block;
  for (int axis = 0; axis < 3; ++axis)
  {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const Eigen::Vector3d& point : mesh.points)
    {
      low = std::min(low, point[axis]);
      high = std::max(high, point[axis]);
    }
    const auto a = std::size_t(axis);
    const double first = std::max(0.0, std::floor((low - voxels.origin[axis]) / voxels.spacing));
    const double last = std::min(voxels.count[a] - 1.0, std::floor((high - voxels.origin[axis]) / voxels.spacing));
    if (!(last >= first))
    {
      return {};
    }
    block.lower[a] = int(first);
    block.count[a] = int(last - first) + 1;
  }
  return block;
}

} // namespace

VoxelVolumes voxelVolumes(const TriangleMesh& mesh, const VoxelBoxes& voxels)
{
  requireCorners(mesh);
  VoxelVolumes block = blockAround(mesh, voxels);
  if (block.count[0] == 0)
  {
    return block;
  }
  const Eigen::Vector3d corner = voxels.origin + voxels.spacing * Eigen::Vector3d(block.lower[0], block.lower[1], block.lower[2]);
  RowSums sums(block.count);
  for (const auto& triangle : mesh.triangles)
  {
    Polygon polygon;
    for (const std::int32_t point : triangle)
    {
      polygon.add((mesh.points[std::size_t(point)] - corner) / voxels.spacing);
    }
    sums.add(polygon);
  }
  block.volumes = std::move(sums).volumes();
  const double unit = voxels.spacing * voxels.spacing * voxels.spacing;
  for (double& volume : block.volumes)
  {
    volume *= unit;
  }
  return block;
}

} // namespace cactus
