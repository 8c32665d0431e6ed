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

/// Moves fibres down the gradient of all costs, step by step: evaluate(), step(), evaluate() … It gives the same bits on any
/// number of threads and of processes, each of which moves its own fibres.
class Descent
{
public:
  /// Starts from the given fibres, at rest, and moves them in place. `boxes`: their bundles' cuboids; see bundleBoxes.
  Descent(
    Fibres& fibres, const FibreShares& shares, std::vector<BundleBox> boxes, const CapsuleOptimizerOptions& options, int threads);

  /// Returns costs and penetration at the present positions, and computes the gradient for the next step. `now` is called once in
  /// each process; `moment` receives, in all, the first one's answer and whether any wants to stop. The caller sets iteration and
  /// seconds of the row.
  ConvergenceRow evaluate(const std::function<Moment()>& now, Moment& moment);

  void step();

  const DescentState& state() const { return this->State; }

  /// Tells whether fibres with reduced control points, as last evaluated, have come as far as these are useful: few pairs
  /// overlap, or the costs that shape fibres have nearly faded.
  bool isLaidOut() const;

  /// Continues from a descent of fewer control points, given the points and velocities of all.
  void takeOver(const DescentState& coarse, std::vector<Eigen::Vector3d> points, std::vector<Eigen::Vector3d> velocity);

  void save(CheckpointWriter& file) const { this->State.save(file); }
  /// Continues from a saved state. Throws FileError if no descent from the given fibres can be there.
  void load(CheckpointReader& file);

  /// Tells whether a descent from the given fibres can have reached these positions and radii.
  bool couldReach(const std::vector<Eigen::Vector3d>& points, const std::vector<double>& radii) const;

private:
  void requireFinite() const;
  void refreshNeighbours();
  void setAllowances();
  ConvergenceRow sumUp(const std::vector<std::string>& told, Moment& moment);
  void gatherOverlap(std::size_t f);
  bool move(std::size_t i, const Eigen::Vector3d& by, double growth);
  bool stepMomentum(std::size_t f);
  void accelerate(std::size_t f);
  double changeRadiusWithMomentum(std::size_t i);
  void smoothGradient(std::size_t f);
  void smoothGradientAround(std::size_t f);
  std::size_t firstOfPeriod(std::size_t f) const;
  bool stepAdagrad(std::size_t f);
  double changeRadiusWithAdagrad(std::size_t i);
  void closePeriod(std::size_t f);
  void constrainEnds(std::size_t f, Eigen::Vector3d& first, Eigen::Vector3d& last) const;
  double changeRadius(std::size_t i, double change);
  double stepSize() const;
  double stiffnessOfPoint(std::size_t i) const;
  double stiffnessOfThread(std::size_t i) const;
  bool isSound() const;

  DescentState State;
  const FibreShares& Shares;
  const CapsuleOptimizerOptions& Options;
  int Threads;
  FibreCosts Costs;
  SharedCapsules Bodies;
  std::vector<FibrePeriod> Periods; ///< per fibre, where the domain is periodic along z; else empty
  std::vector<double> ReferenceRadii;
  std::vector<CapsuleOverlap> Overlaps;
  double OverlappingShare = 1.0; ///< overlapping pairs per capsule at the last evaluation
  std::vector<Eigen::Vector3d> Gradient;
  std::vector<double> RadiusGradient;
  std::vector<double> Stiffness;
  std::vector<double> Upper;   ///< work space for the elimination in smoothGradient
  std::vector<double> Closing; ///< the same in smoothGradientAround
};

} // namespace cactus
