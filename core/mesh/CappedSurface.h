// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

namespace cactus
{

/// A closed surface in a box and, for each of its points, on which faces of the box it lies: bit 2·axis for the lower face, bit
/// 2·axis + 1 for the upper one. Triangles whose corners share a face are the flat caps that close the surface there.
struct CappedSurface
{
  TriangleMesh mesh;
  std::vector<std::uint8_t> faces;
  Eigen::AlignedBox3d box; ///< µm; empty where nothing is said of it

  bool isCap(const std::array<std::int32_t, 3>& t) const
  {
    return (faces[std::size_t(t[0])] & faces[std::size_t(t[1])] & faces[std::size_t(t[2])]) != 0;
  }
};

/// The faces of the box that each point of a mesh lies on, as CappedSurface has them: by its very coordinates.
std::vector<std::uint8_t> facesOf(const TriangleMesh& mesh, const Eigen::AlignedBox3d& box);

/// Where a point goes that is to move from one place of the box to another: no nearer to a face than `margin` (µm) or, if that is
/// less, than it was. So what is not cut off by a face keeps off it.
inline Eigen::Vector3d keptInside(
  const Eigen::AlignedBox3d& box, const Eigen::Vector3d& from, const Eigen::Vector3d& to, double margin)
{
  const Eigen::Vector3d lower = (box.min().array() + margin).matrix().cwiseMin(from);
  const Eigen::Vector3d upper = (box.max().array() - margin).matrix().cwiseMax(from);
  return box.isEmpty() ? to : Eigen::Vector3d(to.cwiseMax(lower).cwiseMin(upper));
}

/// A mesh as files hold it (see io/PlyFile.h), its points rounded to single precision, by which a needle may turn over; and
/// whether one is the same there.
TriangleMesh inSinglePrecision(TriangleMesh mesh);
bool isInSinglePrecision(const TriangleMesh& mesh);
/// µm that a distance may lose by that.
constexpr double lostInFiles = 5e-5;

/// Rounds points to single precision, so that what is found of the surface holds for files, too. Points on a face of the box stay
/// on it, whatever its coordinate, and none leaves the box.
void roundPoints(TriangleMesh& mesh, const Eigen::AlignedBox3d& box);

/// Removes points that no triangle has, and of `faces`, where given, what is said of them. The others keep their order.
void dropUnusedPoints(TriangleMesh& mesh, std::vector<std::uint8_t>* faces);

/// How much a surface holds.
struct SurfaceMeasure
{
  double volume = 0.0;   ///< µm³, signed: positive where normals point outward
  double freeArea = 0.0; ///< µm², without caps
};

SurfaceMeasure measure(const CappedSurface& surface);

/// Moves a surface along its normals, all of it by the same distance, until it holds `volume` (µm³), or by `furthest` (µm) where
/// it would have to move more. Caps stay in their faces. Returns the distance (µm), positive outwards. Nothing is checked of
/// what the surface may run into.
double moveToVolume(CappedSurface& surface, double volume, double furthest);

} // namespace cactus
