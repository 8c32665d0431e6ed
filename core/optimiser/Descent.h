// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"
#include "optimiser/CapsuleOptimizerOptions.h"
#include "optimiser/CapsuleOverlap.h"
#include "optimiser/ConvergenceRow.h"
#include "optimiser/DescentState.h"
#include "optimiser/FibreCosts.h"
#include "optimiser/FibreShares.h"
#include "optimiser/SharedCapsules.h"
#include "optimiser/StoppingRule.h"

#include <Eigen/Core>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace cactus
{

/// Moves fibres down the gradient of all costs, step by step: evaluate(), step(), evaluate() … Same bits on any number of
/// threads, and of processes, each of which moves its own fibres.
class Descent
{
public:
  /// From the fibres as they are, at rest; they are moved in place. `boxes`: their bundles' cuboids; see bundleBoxes.
  Descent(
    Fibres& fibres, const FibreShares& shares, std::vector<BundleBox> boxes, const CapsuleOptimizerOptions& options, int threads);

  /// Costs and penetration at the present positions, and the gradient that the next step follows. `now` is asked once in each
  /// process; what the first says, and whether any of them wants to stop, is in `moment` in all. Iteration and seconds of the
  /// row are left to the caller.
  ConvergenceRow evaluate(const std::function<Moment()>& now, Moment& moment);

  void step();

  const DescentState& state() const { return this->State; }

  /// Whether fibres with fewer control points than asked for, as they were last evaluated, have come as far as these serve: few
  /// pairs overlap, or the costs that shape fibres have nearly faded.
  bool isLaidOut() const;

  /// Goes on from where a descent of fewer control points has come, whose points and velocities are given for all.
  void takeOver(const DescentState& coarse, std::vector<Eigen::Vector3d> points, std::vector<Eigen::Vector3d> velocity);

  void save(SharedCheckpointWriter& file) const { this->State.save(file); }
  /// Goes on from what was saved. Throws FileError where no descent from the fibres given can be there.
  void load(SharedCheckpointReader& file);

  /// Whether a descent from the fibres given can have made these positions and radii.
  bool couldReach(const std::vector<Eigen::Vector3d>& points, const std::vector<double>& radii) const;

private:
  void requireFinite() const;
  void refreshNeighbours();
  void setAllowances();
  std::string tell(const OverlapParts& overlap, const std::vector<FibreCostTotals>& perFibre, const Moment& moment) const;
  ConvergenceRow sumUp(const std::vector<std::string>& told, Moment& moment);
  void gatherOverlap(std::size_t f);
  bool move(std::size_t i, const Eigen::Vector3d& by, double growth);
  bool stepMomentum(std::size_t f);
  void accelerate(std::size_t f);
  double changeRadiusWithMomentum(std::size_t i);
  void smoothGradient(std::size_t f);
  bool stepAdagrad(std::size_t f);
  double changeRadiusWithAdagrad(std::size_t i);
  void constrainEnds(std::size_t f, Eigen::Vector3d& first, Eigen::Vector3d& last) const;
  double changeRadius(std::size_t i, double change);
  double stiffnessOfPoint(std::size_t i) const;
  double stiffnessOfThread(std::size_t i) const;
  bool isSound() const;

  DescentState State;
  const FibreShares& Shares;
  const CapsuleOptimizerOptions& Options;
  int Threads;
  FibreCosts Costs;
  SharedCapsules Bodies;
  std::vector<double> ReferenceRadii;
  std::vector<CapsuleOverlap> Overlaps;
  double OverlappingShare = 1.0; ///< pairs, relative to the capsules, when it was last evaluated
  std::vector<Eigen::Vector3d> Gradient;
  std::vector<double> RadiusGradient;
  std::vector<double> Stiffness;
  std::vector<double> Upper; ///< room for the elimination in smoothGradient
};

} // namespace cactus
