// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "fibres/Fibres.h"
#include "growth/FibreRadialGrowthOptions.h"
#include "growth/LabelImage.h"

#include <cstdint>

namespace cactus
{

/// Returns the whole grid of the label image: cubic voxels that fill the domain exactly, plus the margin; lower is (0, 0, 0). The
/// spacing is voxelSize if it divides every side of the domain, else the nearest that does: for a cube side / round(side /
/// voxelSize), for another box within a tenth of voxelSize. Throws InvalidInput if there is none, or if voxelSize is larger than
/// the domain.
VoxelGrid growthGrid(const Domain& domain, const FibreRadialGrowthOptions& options);

/// Fibre radial growth (paper, section "Fibre radial growth"): all fibres grow outwards from seeds inside their capsules at the
/// same speed until they have grown by g or meet a neighbour, from which they keep a gap.
///
/// The paper grows voxel by voxel, breadth first. This is its limit for small voxels, written as a distance field, so a surface
/// is placed to a fraction of a voxel and no voxel can be claimed twice. With s_i the 1-Lipschitz seed field of fibre i (see
/// CapsuleField), the time at which its front arrives at x is -s_i(x); fibre i owns x if it arrives first. Its field is
///
///     f_i = min( s_i + g, (s_i - max_{j ≠ i} s_j)/2 - gap/2 )
///
/// and the fibre is where f_i > 0. Axons without myelin can have a smaller g, see RankedGrowth. The first term is the free front
/// after growth g; the second is a 1-Lipschitz lower bound of the distance to the surface on which i meets its nearest
/// competitor, less half of the gap. Hence
/// - f_i is 1-Lipschitz, so f_i is never more than the distance to the fibre's surface;
/// - f_i + f_j <= -gap everywhere, so two grown fibres are at least gap apart, also where the capsules overlapped;
/// - f_i does not fall along the way from any point to the centre of the ball that seeded it, so growth adds no islands.
///
/// `part` is the part of `growthGrid()` to compute. In every voxel FibreId is i where f_i > 0 and 0 elsewhere; Depth is f_i
/// inside fibre i, and outside every fibre the largest of all fields (of an axon without myelin perhaps as if it had grown with
/// the others), but at least `-4 spacing`: beyond that, only this bound is known. The result equals that part of the whole bit
/// for bit, on any number of threads. Throws InvalidInput (an empty part or one outside the grid, options, fibres), OutOfMemory,
/// Cancelled.
void growFibres(const Fibres& fibres, const FibreRadialGrowthOptions& options, double growth, const VoxelGrid& part,
  std::int32_t* fibreId, float* depth, const Context& context = {});

/// Does the same into a new label image.
LabelImage growFibres(const Fibres& fibres, const FibreRadialGrowthOptions& options, double growth, const VoxelGrid& part,
  const Context& context = {});

} // namespace cactus
