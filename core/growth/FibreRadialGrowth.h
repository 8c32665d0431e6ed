// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "fibres/Fibres.h"
#include "growth/LabelImage.h"

#include <cstdint>

namespace cactus
{

/// Parameters of fibre radial growth; lengths in µm.
struct FibreRadialGrowthOptions
{
  /// Edge of a voxel. Where it does not divide the domain's sides, the nearest spacing that does is used.
  double voxelSize = 0.1;
  /// Fraction of the domain that the grown fibres fill, in [0, 1), see GrowthTarget.h; 0: grow by `growthIterations` voxels.
  double targetFibreVolumeFraction = 0.0;
  /// Growth in voxels where no target is given.
  int growthIterations = 4;
  /// Least distance between the surfaces of two fibres.
  double minimumGap = 0.02;
  /// Room left beside the gap on either side of it for later steps that move a surface (smoothing, decimation).
  double surfaceTolerance = 0.0075;
  /// How far, as a fraction of its local radius, a fibre may fall short of its capsules before it grows, in [0, 0.5].
  double surfaceRoughness = 0.1;
  /// Width by which the image extends beyond the domain on every side, rounded up to whole voxels.
  double margin = 0.0;
  std::uint64_t seed = 1;

  /// What growth really keeps between two fibres: minimumGap + 2 surfaceTolerance.
  double gap() const { return minimumGap + 2.0 * surfaceTolerance; }
};

/// Throws InvalidInput, naming the parameter, for a value out of range.
void validate(const FibreRadialGrowthOptions& options);

/// The whole grid of the label image: cubic voxels that fill the domain exactly, plus the margin; lower is (0, 0, 0). The
/// spacing is voxelSize where it divides every side of the domain, else the nearest that does: for a cube side / round(side /
/// voxelSize), for another box within a tenth of voxelSize. Throws InvalidInput where there is none, or voxelSize is larger than
/// the domain.
VoxelGrid growthGrid(const Domain& domain, const FibreRadialGrowthOptions& options);

/// Fibre radial growth (paper, section "Fibre radial growth"): all fibres grow outwards from seeds inside their capsules at the
/// same speed until they have grown by g or meet a neighbour, from which they keep a gap.
///
/// The paper grows voxel by voxel, breadth first. This is the limit of that for small voxels, written as a distance field, so a
/// surface is placed to a fraction of a voxel and no voxel can be claimed twice. With s_i the 1-Lipschitz seed field of fibre i
/// (see CapsuleField), the time at which its front arrives at x is -s_i(x); fibre i owns x where it arrives first. Its field is
///
///     f_i = min( s_i + g, (s_i - max_{j ≠ i} s_j)/2 - gap/2 )
///
/// and the fibre is where f_i > 0. The first term is the free front after growth g; the second is a 1-Lipschitz lower bound of
/// the distance to the surface on which i meets its nearest competitor, less half of the gap. Hence
/// - f_i is 1-Lipschitz, so f_i is never more than the distance to the fibre's surface;
/// - f_i + f_j <= -gap everywhere, so two grown fibres are at least gap apart, also where the capsules overlapped;
/// - f_i does not fall along the way from any point to the centre of the ball that seeded it, so growth adds no islands.
///
/// `part` is the part of `growthGrid()` to compute. In every voxel FibreId is i where f_i > 0 and 0 elsewhere; Depth is f_i
/// inside fibre i, and outside every fibre the largest of all fields, but at least `-4 spacing`: farther out it is only known to
/// be as far. The result equals, bit for bit, that part of the whole, on any number of
/// threads. Throws InvalidInput (an empty part or one outside the grid, options, fibres), OutOfMemory, Cancelled.
void growFibres(const Fibres& fibres, const FibreRadialGrowthOptions& options, double growth, const VoxelGrid& part,
  std::int32_t* fibreId, float* depth, const Context& context = {});

/// The same into a label image of its own.
LabelImage growFibres(const Fibres& fibres, const FibreRadialGrowthOptions& options, double growth, const VoxelGrid& part,
  const Context& context = {});

} // namespace cactus
