// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Recollection.h"
#include "base/Sharing.h"
#include "mesh/SurfaceStore.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cactus
{

/// Result of keepApart().
struct SpacingReport
{
  std::vector<std::size_t> moved;   ///< surfaces that were changed, increasing
  std::vector<std::size_t> tooNear; ///< surfaces still nearer than the gap to another, increasing
};

/// Moves points of closed, outward surfaces inwards, a nanometre or so at a time, until any two surfaces are at least `gap` (µm)
/// apart: only points of triangles that are too near move. It is meant for surfaces that kept the gap before they were coarsened,
/// and gives up on pairs that some fifty rounds do not part. Surfaces that meet are moved a few nanometres at a time. Distances
/// are those of the triangles (see smallestGap()), not of samples.
///
/// The gap also holds for files with points in single precision: surfaces nearer than the gap plus 0.00005 µm are moved. Points
/// on a face of `box` stay on it, so that flat caps stay flat; the caller has to check other collisions, such as a cap that
/// folds. Points on the faces in `held` (bits as in CappedSurface) do not move; where two opposite ones are held the box repeats,
/// and surfaces keep the gap from the images of others, too. Empty surfaces are skipped. The result is the same on any number of
/// threads.
///
/// It processes `box` in slabs of 10 µm along z, and holds only the surfaces' parts in one slab, with search trees for those near
/// others. A point's displacement depends on the missing gap within its slab. It reads each surface once from the store, for its
/// extent; its parts in the slabs; these again after a move; and each moved surface whenever it is moved. So reading and work per
/// µm of a fibre do not depend on its length.
///
/// Only pairs with a surface in `changed` (increasing), or with one that is moved, are measured: the others are assumed to be
/// apart. Progress runs from `from` to `to`. Throws Cancelled. Processes that share the work share the store. Slabs in `known`
/// are not measured again; the surfaces have to be the same as then.
SpacingReport keepApart(SurfaceStore& surfaces, const std::vector<std::size_t>& changed, double gap,
  const Eigen::AlignedBox3d& box, const Context& context = {}, double from = 0.0, double to = 1.0,
  const Sharing& sharing = Sharing(), const Recollection& known = {}, std::uint8_t held = 0);

/// Does the same for all surfaces.
SpacingReport keepApart(SurfaceStore& surfaces, double gap, const Eigen::AlignedBox3d& box, const Context& context = {},
  double from = 0.0, double to = 1.0);

} // namespace cactus
