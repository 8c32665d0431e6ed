// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "fibres/Fibres.h"
#include "growth/LabelImage.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

namespace cactus
{

/// How growth is seeded inside the capsules.
struct SeedOptions
{
  /// How far, as a fraction of the local radius, the seeded shape may fall short of the capsule: 0 seeds the capsule itself, more
  /// makes the calibre uneven. In [0, 0.5].
  double surfaceRoughness = 0.1;
  std::uint64_t seed = 1;
};

/// Which values of the two largest fields a sweep has to get exactly right; elsewhere it may leave fibres out, so that `best` and
/// `second` come out too small there. Lengths in µm, b and s standing for the two true values at a sample.
struct FieldRelevance
{
  /// Samples with b <= -bestReach are of no interest.
  double bestReach = 0.0;
  /// s is of interest only where b > -secondReach …
  double secondReach = 0.0;
  /// … and where b + s > -sumReach …
  double sumReach = std::numeric_limits<double>::infinity();
  /// … and where b - s < contrast.
  double contrast = std::numeric_limits<double>::infinity();
};

/// The two largest fields at a small box of samples, x fastest, with fixed strides.
struct FieldCell
{
  static constexpr int sizeX = 8;
  static constexpr int sizeY = 4;
  static constexpr int sizeZ = 4;
  static constexpr int size = sizeX * sizeY * sizeZ;

  int lower[3];        ///< grid index of the cell's first sample
  int begin[3];        ///< the part asked for: cell-relative indices [begin, end)
  int end[3];          ///<
  const float* best;   ///< largest field, `size` values
  const float* second; ///< largest field of any other fibre
  const int* rank;     ///< whose field `best` is (rank as in CapsuleField), -1 where no fibre is near

  /// visit(n) for the samples asked for: their places in `best`, `second` and `rank`.
  template <typename Visit>
  void forEachSample(Visit&& visit) const
  {
    for (int k = this->begin[2]; k < this->end[2]; ++k)
    {
      for (int j = this->begin[1]; j < this->end[1]; ++j)
      {
        const int row = sizeX * (j + sizeY * k);
        for (int i = row + this->begin[0]; i < row + this->end[0]; ++i)
        {
          visit(i);
        }
      }
    }
  }
};

/// The seed fields s_i (µm) of fibres: s_i(x) is the largest radius minus distance to the centre over all balls of fibre i, so
/// it is positive inside the seeded shape, 1-Lipschitz, and never larger than the distance to the shape's surface.
///
/// A capsule is the union of the balls that slide from one control point to the next with linearly interpolated radius (paper,
/// "Fibre capsule-parameterisation"). The paper evaluates the radius at the closest point of the centre line; where the radius
/// changes by m per length that value is smaller by up to m²/2 of the distance and not 1-Lipschitz, so the maximum over the balls
/// is taken in closed form instead.
///
/// With SurfaceRoughness ρ > 0 the seeds of the paper ("FRG description": "randomly placing seed points within all capsule
/// fibres") become a chain of capsules whose radius is, at length l along the fibre, that of the fibre's capsules times
/// 1 - ρ u(l), linearly between places at most 1 µm apart, where u is a smooth random function from 0 to 1 that varies over a few
/// µm. Hence capsule - ρ · radius <= s_i <= capsule. u depends on seed, fibre id and length alone.
///
/// Fibres are ranked by increasing fibre id.
class CapsuleField
{
public:
  /// Prepares the fields for samples inside `region` where only values above -`reach` matter: capsules farther away are left out.
  /// Precondition: validate(fibres). Throws InvalidInput for options out of range and OutOfMemory where the seeds do not fit.
  CapsuleField(const Fibres& fibres, const SeedOptions& options, const Eigen::AlignedBox3d& region, double reach);
  ~CapsuleField();
  CapsuleField(const CapsuleField&) = delete;
  CapsuleField& operator=(const CapsuleField&) = delete;

  std::size_t size() const;
  /// Index into the fibres given, by rank.
  std::size_t fibre(int rank) const;

  /// s of one fibre at a point, in double precision over all its balls: slow, the reference for `sweep`.
  double value(int rank, const Eigen::Vector3d& x) const;

  /// Evaluates the two largest fields at the samples that `grid` holds and hands them over cell by cell. `sink` is called from
  /// several threads at once (its second argument is the thread, below context.threadCount()), in any order, once per cell.
  ///
  /// A value depends on the sample's place in the whole grid (origin, spacing, index), never on which samples are asked for or on
  /// the number of threads: the arithmetic is relative to blocks of the index space. Its rounding error is that of single
  /// precision relative to the size of a block. Throws Cancelled.
  void sweep(const VoxelGrid& grid, const FieldRelevance& relevance, const Context& context, double progressFrom,
    double progressTo, const std::string& message, const std::function<void(const FieldCell&, int)>& sink) const;

private:
  struct Data;
  std::unique_ptr<Data> Seeds;
};

} // namespace cactus
