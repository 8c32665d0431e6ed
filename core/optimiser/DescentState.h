// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/Checkpoint.h"
#include "fibres/Fibres.h"
#include "optimiser/NeighbourSearch.h"

#include <Eigen/Core>

#include <tuple>
#include <vector>

namespace cactus
{

/// The work that a descent has done.
struct DescentEffort
{
  double pairEvaluations = 0.0; ///< each pair counted from both sides
  int neighbourSearches = 0;
  double evaluationSeconds = 0.0;
  double searchSeconds = 0.0;
};

inline auto membersOf(DescentEffort& effort)
{
  return std::tie(effort.pairEvaluations, effort.neighbourSearches, effort.evaluationSeconds, effort.searchSeconds);
}

/// The complete state of a descent, and the list of capsules that may touch. Vectors are indexed by control point. Processes that
/// share a descent each have the control points of their own fibres; scalars are the same in all.
struct DescentState
{
  /// Makes the state of a descent at rest.
  DescentState(Fibres& fibres, bool withRadii);

  Fibres& fibres;
  std::vector<Eigen::Vector3d> velocity; ///< for Adagrad, the sums of squared gradients
  std::vector<double> radiusVelocity;    ///< empty if radii are kept
  double relaxation = 1.0;               ///< factor of the fading costs

  std::vector<float> speed; ///< length of the last step (µm)
  std::vector<float> push;  ///< the gradient's part of it
  NeighbourList neighbours;
  std::vector<Eigen::Vector4f> displacement; ///< since the last search, and the summed changes of the radius
  std::vector<float> allowance;              ///< largest displacement before the next search
  bool exceeded = false;                     ///< whether any displacement is larger
  double leastAllowance = 0.3;               ///< as a multiple of the radius
  int stepsSinceSearch = 0;

  DescentEffort effort;

  /// Tells whether the next evaluation searches for neighbours, so that the present lists need not be kept.
  bool searchDue() const { return this->neighbours.offsets.empty() || this->exceeded; }

  /// Writes the state, each process's part beside the others'. Neighbours are left out: no result depends on when they were
  /// searched.
  void save(CheckpointWriter& file) const;
  /// Reads the output of save(). The caller checks whether a descent can be in that state.
  void load(CheckpointReader& file);
};

} // namespace cactus
