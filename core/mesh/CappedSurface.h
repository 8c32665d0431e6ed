// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <memory>
#include <set>
#include <vector>

namespace cactus
{

/// A closed surface in a box with, for each of its points, the faces of the box that it lies on: bit 2·axis for the lower face,
/// bit 2·axis + 1 for the upper one. Triangles whose corners share a face are the flat caps that close the surface there.
struct CappedSurface
{
  TriangleMesh mesh;
  std::vector<std::uint8_t> faces;
  Eigen::AlignedBox3d box; ///< µm; empty if unknown
  /// Faces, as bits, beyond which the surface goes on at the opposite ones: no point of it moves in them, so that the rims of
  /// their caps fit together. See HeldRims.
  std::uint8_t held = 0;
  /// Places of points of such rims that are not removed either; all of these if null.
  std::shared_ptr<const std::set<std::array<double, 3>>> stays = nullptr;

  bool isHeld(std::int32_t point) const { return (faces[std::size_t(point)] & held) != 0; }
  bool isToStay(std::int32_t point) const
  {
    const Eigen::Vector3d& place = mesh.points[std::size_t(point)];
    return isHeld(point) && (stays == nullptr || stays->count({ { place.x(), place.y(), place.z() } }) != 0);
  }
  bool isCap(const std::array<std::int32_t, 3>& t) const
  {
    return (faces[std::size_t(t[0])] & faces[std::size_t(t[1])] & faces[std::size_t(t[2])]) != 0;
  }
};

/// Returns the faces of the box that each point of a mesh lies on, as in CappedSurface: by exact coordinates.
std::vector<std::uint8_t> facesOf(const TriangleMesh& mesh, const Eigen::AlignedBox3d& box);

/// Limits the move of a point in the box: it comes no nearer to a face than `margin` (µm) or, if that is less, than before. So
/// points that no face cuts off stay off the faces.
inline Eigen::Vector3d keptInside(
  const Eigen::AlignedBox3d& box, const Eigen::Vector3d& from, const Eigen::Vector3d& to, double margin)
{
  const Eigen::Vector3d lower = (box.min().array() + margin).matrix().cwiseMin(from);
  const Eigen::Vector3d upper = (box.max().array() - margin).matrix().cwiseMax(from);
  return box.isEmpty() ? to : Eigen::Vector3d(to.cwiseMax(lower).cwiseMin(upper));
}

/// Rounds a mesh's points to single precision, as in files (see io/PlyFile.h), which may turn a needle over; or tells whether
/// that would change nothing.
TriangleMesh inSinglePrecision(TriangleMesh mesh);
bool isInSinglePrecision(const TriangleMesh& mesh);
/// µm, the largest loss of a distance by that rounding.
constexpr double lostInFiles = 5e-5;

/// Rounds points to single precision, so that results on the surface hold for files, too. Points on a face of the box stay on it,
/// whatever its coordinate, and none leaves the box.
void roundPoints(TriangleMesh& mesh, const Eigen::AlignedBox3d& box);

/// Removes points that no triangle uses, and their entries in `faces`, if given. The others keep their order.
void dropUnusedPoints(TriangleMesh& mesh, std::vector<std::uint8_t>* faces);

/// The size of a surface.
struct SurfaceMeasure
{
  double volume = 0.0;   ///< µm³, signed: positive where normals point outward
  double freeArea = 0.0; ///< µm², without caps
};

SurfaceMeasure measure(const CappedSurface& surface);

/// Moves a surface along its normals, all of it by the same distance, until it encloses `volume` (µm³), or by `furthest` (µm) if
/// it would have to move more. Caps stay in their faces, those in held ones as they are. Returns the distance (µm), positive
/// outwards. Collisions are not checked.
double moveToVolume(CappedSurface& surface, double volume, double furthest);

} // namespace cactus
