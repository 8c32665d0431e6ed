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
#include <string>
#include <vector>

namespace cactus
{

/// A descent and all that its caller knows of it: what a checkpoint holds. Where processes share it, each has the states of its
/// own fibres, and all have the rest.
struct OptimisationRun
{
  /// Whether the fibres are those asked for, or have fewer control points.
  enum Level : std::uint8_t
  {
    Fine,
    Coarse
  };

  /// See Descent.
  OptimisationRun(Level level, Fibres& fibres, const FibreShares& shares, std::vector<BundleBox> boxes,
    const CapsuleOptimizerOptions& options, int threads);

  /// Goes on from where `coarse` has come, with the table that it has made.
  void takeOver(OptimisationRun& coarse, const CoarseFibres& fewer);

  /// Notes the state that was just measured.
  void note(const ConvergenceRow& row, double tolerance);

  /// The level of the run in a file.
  static Level levelOf(const std::string& path, std::uint64_t fingerprint);

  /// Throws FileError, and InvalidInput where another run's checkpoint is at `path`; in the first process, which has the file.
  void save(const std::string& path, std::uint64_t fingerprint) const;
  void load(const std::string& path, std::uint64_t fingerprint);

  const Level level;
  const Sharing& sharing;
  Fibres& state;
  Descent descent;
  int iteration = 0;    ///< the next one
  double seconds = 0.0; ///< before this run
  std::vector<ConvergenceRow> rows;
  std::vector<Eigen::Vector3d> bestPoints;
  std::vector<double> bestRadii;
  double bestCost = std::numeric_limits<double>::infinity();
  DescentProgress progress;

private:
  static void loadNumbers(CheckpointReader& file, ByteWriter& put, Level level);
};

} // namespace cactus
