// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "base/Recollection.h"
#include "base/Sharing.h"
#include "mesh/SurfaceStore.h"

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace cactus
{

/// What keepApart() did.
struct SpacingReport
{
  std::vector<std::size_t> moved;   ///< surfaces that were changed, increasing
  std::vector<std::size_t> tooNear; ///< those that are still nearer than the gap to another, increasing
};

/// Moves points of closed, outward surfaces inwards, a nanometre or so at a time, until any two surfaces are at least `gap` (µm)
/// apart: those of the triangles that come nearer. Meant for surfaces that kept the gap before they were coarsened; it
/// gives up on pairs that some fifty rounds do not part. Surfaces that meet are moved a few nanometres at a time. Distances are
/// those of the triangles (see smallestGap()), no samples.
///
/// "At least" is meant for files, too, that hold points in single precision: what is nearer than 0.00005 µm more than the gap is
/// moved. Points on a face of `box` stay on it, so that flat caps stay flat; what else a surface may run into, such as a cap that
/// folds, is for the caller to check. Empty surfaces are left out. Same result on any number of threads.
///
/// It looks at one slab of `box` after the other, 10 µm thick along z, and holds what of the surfaces is in that slab alone, and
/// there near others, with search trees. How far a place is moved depends on what is missing of the gap within its slab. Of the
/// store it asks each surface once, for where it is; its parts in the slabs; these again where anything was moved; and each
/// surface that is moved, as often as it is. So what it reads and does is the same for each µm of a fibre, however long that is.
///
/// Only pairs with a surface among those in `changed` (increasing), or one that is moved, are looked at: the others are taken to
/// be apart.
/// Progress runs from `from` to `to`. Throws Cancelled. Processes that share it have the store in common. What `known` has of a
/// slab is not measured again; the surfaces have to be what they were then.
SpacingReport keepApart(SurfaceStore& surfaces, const std::vector<std::size_t>& changed, double gap,
  const Eigen::AlignedBox3d& box, const Context& context = {}, double from = 0.0, double to = 1.0,
  const Sharing& sharing = Sharing(), const Recollection& known = {});

/// All of them.
SpacingReport keepApart(SurfaceStore& surfaces, double gap, const Eigen::AlignedBox3d& box, const Context& context = {},
  double from = 0.0, double to = 1.0);

} // namespace cactus
