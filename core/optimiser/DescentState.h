// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/SharedCheckpoint.h"
#include "fibres/Fibres.h"
#include "optimiser/NeighbourSearch.h"

#include <Eigen/Core>

#include <vector>

namespace cactus
{

/// What a descent has done so far.
struct DescentEffort
{
  double pairEvaluations = 0.0; ///< each pair counted from both sides
  int neighbourSearches = 0;
  double evaluationSeconds = 0.0;
  double searchSeconds = 0.0;
};

/// All that the further course of a descent depends on, and what is known of which capsules may touch. Vectors are indexed by
/// control point. Where processes share a descent, each has the control points of its own fibres, and all have the numbers.
struct DescentState
{
  /// A descent at rest.
  DescentState(Fibres& fibres, bool withRadii);

  Fibres& fibres;
  std::vector<Eigen::Vector3d> velocity; ///< for Adagrad the sums of squared gradients
  std::vector<double> radiusVelocity;    ///< empty where radii are kept
  double relaxation = 1.0;               ///< factor of the costs that fade

  std::vector<float> speed; ///< length of the last step (µm)
  std::vector<float> push;  ///< what the gradient added to it
  NeighbourList neighbours;
  std::vector<Eigen::Vector4f> displacement; ///< since the last search, and the sum of the radius's changes
  std::vector<float> allowance;              ///< how far that may go before the next search
  bool exceeded = false;                     ///< whether it has gone further anywhere
  double leastAllowance = 0.3;               ///< as a multiple of the radius
  int stepsSinceSearch = 0;

  DescentEffort effort;

  /// Whether the next evaluation searches for neighbours, so that the lists of now need not be kept.
  bool searchDue() const { return this->neighbours.offsets.empty() || this->exceeded; }

  /// Writes it down, that of each process beside the others'. Neighbours are not: no result depends on when they were searched.
  void save(SharedCheckpointWriter& file) const;
  /// Reads what save() wrote. Whether a descent can be in that state is for the caller to look at.
  void load(SharedCheckpointReader& file);
};

} // namespace cactus
