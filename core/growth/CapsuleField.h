// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Context.h"
#include "fibres/Fibres.h"
#include "growth/Calibre.h"
#include "growth/CapsuleSeeds.h"
#include "growth/FieldCell.h"
#include "growth/FieldRelevance.h"
#include "growth/LabelImage.h"
#include "growth/SeedBins.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace cactus
{

class BlockEvaluation;

/// The seed fields s_i (µm) of fibres: s_i(x) is the largest radius minus distance to the centre over all balls of fibre i, so
/// it is positive inside the seeded shape, 1-Lipschitz, and never larger than the distance to the shape's surface.
///
/// A capsule is the union of the balls that slide from one control point to the next with linearly interpolated radius (paper,
/// "Fibre capsule-parameterisation"). The paper evaluates the radius at the closest point of the centre line; where the radius
/// changes by m per length that value is smaller by up to m²/2 of the distance and not 1-Lipschitz, so the maximum over the balls
/// is taken in closed form instead.
///
/// Where the calibre varies (see Calibre) the seeds of the paper ("FRG description": "randomly placing seed points within all
/// capsule fibres") become a chain of capsules whose radius is that of the fibre's capsules times the calibre's fraction,
/// linearly between places at most 1 µm apart. Hence capsule - ρ · radius <= s_i <= capsule for a SurfaceRoughness ρ.
/// With random points (see SeedPoints) s_i lies between the fields of a thinner chain and of the capsules.
///
/// A fibre that has a TargetAxisRatio is seeded by three chains beside each other, see SectionShape.
///
/// Fibres are ranked by increasing fibre id.
class CapsuleField
{
public:
  /// Prepares the fields for samples inside `region` where only values above -`reach` matter: capsules farther away are left out.
  /// Precondition: validate(fibres). Throws InvalidInput for options out of range and OutOfMemory if the seeds do not fit into
  /// memory. Threads share the work.
  CapsuleField(
    const Fibres& fibres, const SeedOptions& options, const Eigen::AlignedBox3d& region, double reach, int threads = 1);

  std::size_t size() const { return this->Seeds.fibreOfRank.size(); }
  /// Returns the index into the given fibres, by rank.
  std::size_t fibre(int rank) const { return this->Seeds.fibreOfRank[static_cast<std::size_t>(rank)]; }

  /// Returns s of one fibre at a point, in double precision over all its balls: slow, the reference for `sweep`.
  double value(int rank, const Eigen::Vector3d& x) const;

  /// Returns the length (µm) of a fibre's centre lines and sets `middle` to their centroid; `middle` stays as it is if there are
  /// none.
  double length(int rank, Eigen::Vector3d& middle) const;

  /// Returns all blocks of a grid's index space (see BlockEvaluation) with samples of the grid where s of a fibre, rounded as in
  /// sweep(), is above -`reach`, and possibly others near it: the first sample divided by the size of a block, per axis; each
  /// block once.
  std::vector<std::array<int, 3>> blocksNear(int rank, const VoxelGrid& grid, double reach) const;

  /// Evaluates the two largest fields at the samples of `grid` and passes them on cell by cell. `sink` is called from several
  /// threads at once (its second argument is the thread, below context.threadCount()), in any order, once per cell.
  ///
  /// A value depends on the sample's place in the whole grid (origin, spacing, index), never on which samples are asked for or on
  /// the number of threads: the arithmetic is relative to blocks of the index space. Its rounding error is that of single
  /// precision relative to the size of a block. Throws Cancelled.
  void sweep(const VoxelGrid& grid, const FieldRelevance& relevance, const Context& context, double progressFrom,
    double progressTo, const std::string& message, const FieldSink& sink) const;

  /// Returns an evaluation of single blocks of `grid` with the same values. One thread at a time may use it; it passes `thread`
  /// to `sink`. All arguments passed by reference have to outlive it.
  std::unique_ptr<BlockEvaluation> evaluation(
    const VoxelGrid& grid, const FieldRelevance& relevance, const FieldSink& sink, int thread) const;

private:
  CapsuleSeeds Seeds;
  SeedBins Bins;
};

} // namespace cactus
