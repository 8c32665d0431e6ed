// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "optimiser/CapsuleOptimizerOptions.h"
#include "optimiser/CoarseFibres.h"
#include "optimiser/ConvergenceRow.h"
#include "optimiser/Descent.h"
#include "optimiser/StoppingRule.h"

#include <Eigen/Core>

#include <cstdint>
#include <limits>
#include <vector>

namespace cactus
{

/// The state of a run that a checkpoint holds: a descent, its convergence table and its best state. Processes that share it each
/// have the states of their own fibres; the rest is the same in all.
struct OptimisationRun
{
  /// Whether the fibres have all their control points, or fewer.
  enum Level : std::uint8_t
  {
    Fine,
    Coarse
  };

  /// See Descent.
  OptimisationRun(Level level, Fibres& fibres, const FibreShares& shares, std::vector<BundleBox> boxes,
    const CapsuleOptimizerOptions& options, int threads);

  /// Continues from `coarse`, with its table.
  void takeOver(OptimisationRun& coarse, const CoarseFibres& fewer);

  /// Records the state that was just measured.
  void note(const ConvergenceRow& row, double tolerance);

  /// Writes all but the level and the iteration.
  void save(CheckpointWriter& file) const;
  /// Reads the output of save() at the present iteration. Throws FileError if no run can be there.
  void load(CheckpointReader& file);

  const Level level;
  Fibres& state;
  Descent descent;
  int iteration = 0;    ///< the next one
  double seconds = 0.0; ///< before this run
  std::vector<ConvergenceRow> rows;
  std::vector<Eigen::Vector3d> bestPoints;
  std::vector<double> bestRadii;
  double bestCost = std::numeric_limits<double>::infinity();
  DescentProgress progress;
};

} // namespace cactus
