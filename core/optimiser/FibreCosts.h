// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"
#include "optimiser/BundleBox.h"

#include <Eigen/Core>

#include <cstddef>
#include <tuple>
#include <vector>

namespace cactus
{

/// Weights of the terms that keep a fibre in shape, relative to the overlap cost.
struct FibreCostWeights
{
  double curvature = 10.0;
  double length = 10.0;
  double radius = 1.0;
  double compactness = 2.0;
};

/// Sums of the cost terms over fibres.
struct FibreCostTotals
{
  double curvature = 0.0;
  double length = 0.0;
  double radius = 0.0;
  double compactness = 0.0;
};

inline auto membersOf(FibreCostTotals& totals)
{
  return std::tie(totals.curvature, totals.length, totals.radius, totals.compactness);
}

/// The arrays to which the terms add their derivatives, indexed by control point.
struct FibreGradients
{
  std::vector<Eigen::Vector3d>& byPoint;
  std::vector<double>& byRadius;
  std::vector<double>& stiffness; ///< diagonal that bounds the curvature of the cost
};

/// The terms that involve one fibre alone (the paper names them; the supplement that defines them is not published):
///  - curvature, per triple of control points: 3 / (r1 + r2 + r3) · (1 − cos θ)², θ the angle between the two segments;
///  - length, per segment: k/2 · (ℓ − L)², k = 20 / (1/r1 + 1/r2), L the segment's length before optimisation, so that fibres
///    stay as sinuous as they come;
///  - radius, per control point: (r − r_target)²;
///  - compactness, per control point: ½ ℓ² e², e the distance by which the fibre's surface leaves its bundle's cuboid sideways, ℓ
///    the mean length of the segments at the point (it replaces an attraction to the axis, which would compress the core of an
///    already dense bundle; the cuboid of a bundle that is held keeps 0.3 of its weight); and per fibre 50 L1² |c − C|², c its
///    chord from end to end, C that before optimisation, L1 its first segment's length.
/// Two limits do not fade, since a fibre that folds up cannot unfold: they belong to curvature and length, and share their
/// weights.
///  - bends, per triple: ¼ (L1 L2)² · max(0, cos θ_max − cos θ)², θ_max the angle at which the radius of curvature is 1.2 fibre
///    radii (at most 90°);
///  - compression, per segment: ½ L² · max(0, ¾ L − ℓ)².
/// Each adds weight × its exact gradient, and a bound on its curvature, to the control points of one fibre only.
class FibreCosts
{
public:
  /// Takes reference lengths, target radii and cuboids from the input fibres.
  FibreCosts(const Fibres& fibres, const FibreCostWeights& weights, double packingLimit);
  /// Does the same for some of the fibres, with their cuboids, which depend on all.
  FibreCosts(const Fibres& fibres, const FibreCostWeights& weights, std::vector<BundleBox> boxes);

  /// Adds the derivatives of fibre f's costs, and returns the costs. `relaxation` scales curvature, length and compactness, but
  /// not their limits.
  FibreCostTotals add(const Fibres& fibres, std::size_t f, double relaxation, const FibreGradients& gradients) const;

  const BundleBox& boxOf(std::size_t fibre) const { return this->Boxes[fibre]; }

private:
  void addCurvature(
    const Fibres& fibres, std::size_t f, double weight, FibreCostTotals& totals, const FibreGradients& gradients) const;
  void addLength(
    const Fibres& fibres, std::size_t f, double weight, FibreCostTotals& totals, const FibreGradients& gradients) const;
  void addBendLimit(const Fibres& fibres, std::size_t i, FibreCostTotals& totals, const FibreGradients& gradients) const;
  void addCompressionLimit(const Fibres& fibres, std::size_t f, FibreCostTotals& totals, const FibreGradients& gradients) const;
  void addChord(
    const Fibres& fibres, std::size_t f, double relaxation, FibreCostTotals& totals, const FibreGradients& gradients) const;
  void addRadius(const Fibres& fibres, std::size_t f, FibreCostTotals& totals, const FibreGradients& gradients) const;
  void addConfinement(
    const Fibres& fibres, std::size_t f, double weight, FibreCostTotals& totals, const FibreGradients& gradients) const;

  FibreCostWeights Weights;
  std::vector<double> ReferenceLength; ///< per segment, at its first control point
  std::vector<float> SmallestCosine;   ///< of the bend at a control point; below it the bend is too sharp
  std::vector<double> ReferenceRadius;
  std::vector<Eigen::Vector3d> ReferenceChord; ///< from a fibre's first control point to its last
  std::vector<BundleBox> Boxes;
};

} // namespace cactus
