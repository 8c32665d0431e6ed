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

/// Where a point that is to move from one place of the box to another shall go: no nearer to a face than `margin` (µm) or, where
/// that is less, than it was. So what is not cut off by a face keeps off it.
inline Eigen::Vector3d keptInside(
  const Eigen::AlignedBox3d& box, const Eigen::Vector3d& from, const Eigen::Vector3d& to, double margin)
{
  const Eigen::Vector3d lower = (box.min().array() + margin).matrix().cwiseMin(from);
  const Eigen::Vector3d upper = (box.max().array() - margin).matrix().cwiseMax(from);
  return box.isEmpty() ? to : Eigen::Vector3d(to.cwiseMax(lower).cwiseMin(upper));
}

/// How much a surface holds.
struct SurfaceMeasure
{
  double volume = 0.0;   ///< µm³, signed: positive where normals point outward
  double freeArea = 0.0; ///< µm², without caps
};

SurfaceMeasure measure(const CappedSurface& surface);

/// Leaves the main part of a surface and says what went: the sum of the other pieces' volumes (µm³), each taken as positive.
///
/// Pieces that the same face of the box cuts off count as one part, since what leaves the box through a face and comes back
/// through it hangs together outside. The main part is the one of the largest volume, without pieces below `smallest` (µm³) but
/// for the largest.
double keepMainPart(CappedSurface& surface, double smallest = 0.0);

/// Moves a surface along its normals, all of it by the same distance, until it holds `volume` (µm³), or by `furthest` (µm) where
/// it would have to move more. Caps stay in their faces. Returns the distance (µm), positive outwards. Nothing is checked of
/// what the surface may run into.
double moveToVolume(CappedSurface& surface, double volume, double furthest);

/// Halves the longest edges of triangles whose longest and shortest squared edges have a ratio above `largest` (more than 16),
/// and of what that leaves, until none has. The shape of the surface does not change. Precondition: closed, no edge without a
/// length.
void splitNeedles(CappedSurface& surface, double largest);

} // namespace cactus
