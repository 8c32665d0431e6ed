// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/FibreCosts.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cactus
{

namespace
{

/// Fraction of its length before optimisation below which a segment resists compression.
constexpr double shortestSegment = 0.75;

/// Smallest radius of curvature, relative to the fibre's radius, that bends without cost.
constexpr double sharpestBend = 1.2;

/// Sums in a fixed order, whatever Eigen vectorises.
double dotProduct(const Eigen::Vector3d& u, const Eigen::Vector3d& w)
{
  return u.x() * w.x() + u.y() * w.y() + u.z() * w.z();
}

} // namespace

FibreCosts::FibreCosts(const Fibres& fibres, const FibreCostWeights& weights, double packingLimit)
  : FibreCosts(fibres, weights, bundleBoxes(fibres, packingLimit))
{
}

FibreCosts::FibreCosts(const Fibres& fibres, const FibreCostWeights& weights, std::vector<BundleBox> boxes)
  : Weights(weights)
  , ReferenceLength(fibres.points.size(), 0.0)
  , SmallestCosine(fibres.points.size(), -1.0f)
  , ReferenceRadius(fibres.radii)
  , Boxes(std::move(boxes))
{
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    for (std::size_t i = fibres.offsets[f]; i + 1 < fibres.offsets[f + 1]; ++i)
    {
      this->ReferenceLength[i] = (fibres.points[i + 1] - fibres.points[i]).norm();
    }
    for (std::size_t i = fibres.offsets[f] + 1; i + 1 < fibres.offsets[f + 1]; ++i)
    {
      // Two segments of length ℓ at the angle θ touch a circle of radius ℓ / (2 sin(θ/2)) in their three points. The angle is at
      // most a right one, and at least the initial one.
      const double length = shortestSegment * std::min(this->ReferenceLength[i - 1], this->ReferenceLength[i]);
      const double sine = std::min(length / (2.0 * sharpestBend * fibres.radii[i]), std::sqrt(0.5));
      const Eigen::Vector3d u = (fibres.points[i] - fibres.points[i - 1]).normalized();
      const Eigen::Vector3d w = (fibres.points[i + 1] - fibres.points[i]).normalized();
      this->SmallestCosine[i] = static_cast<float>(std::min(1.0 - 2.0 * sine * sine, u.dot(w)));
    }
    this->ReferenceChord.push_back(fibres.points[fibres.offsets[f + 1] - 1] - fibres.points[fibres.offsets[f]]);
  }
}

FibreCostTotals FibreCosts::add(const Fibres& fibres, std::size_t f, double relaxation, const FibreGradients& gradients) const
{
  FibreCostTotals totals;
  if (this->Weights.curvature > 0.0)
  {
    this->addCurvature(fibres, f, relaxation * this->Weights.curvature, totals, gradients);
    for (std::size_t i = fibres.offsets[f] + 1; i + 1 < fibres.offsets[f + 1]; ++i)
    {
      this->addBendLimit(fibres, i, totals, gradients);
    }
  }
  if (this->Weights.length > 0.0)
  {
    this->addCompressionLimit(fibres, f, totals, gradients);
    this->addLength(fibres, f, relaxation * this->Weights.length, totals, gradients);
  }
  if (this->Weights.compactness > 0.0)
  {
    this->addChord(fibres, f, relaxation, totals, gradients);
  }
  this->addRadius(fibres, f, totals, gradients);
  if (this->Weights.compactness > 0.0)
  {
    constexpr double held = 0.3; // of the weight, at least
    const double share = this->Boxes[f].holds ? std::max(relaxation, held) : relaxation;
    this->addConfinement(fibres, f, share * this->Weights.compactness, totals, gradients);
  }
  return totals;
}

void FibreCosts::addCurvature(
  const Fibres& fibres, std::size_t f, double weight, FibreCostTotals& totals, const FibreGradients& gradients) const
{
  struct Bend
  {
    Eigen::Vector3d byU = Eigen::Vector3d::Zero(); // the segment before its control point
    Eigen::Vector3d byW = Eigen::Vector3d::Zero(); // the segment after it
    double byRadius = 0.0;
    double stiffnessBefore = 0.0; // for the control point before it
    double stiffness = 0.0;
    double stiffnessAfter = 0.0;
  };
  const std::size_t begin = fibres.offsets[f];
  const std::size_t count = fibres.pointCount(f);
  if (count < 3)
  {
    return;
  }
  const Eigen::Vector3d* x = &fibres.points[begin];
  const double* r = &fibres.radii[begin];
  std::vector<Bend> bends(count + 2); // one behind its control point's number; the ends have none
  Eigen::Vector3d u = x[1] - x[0];
  double lengthU = std::sqrt(dotProduct(u, u));
  for (std::size_t i = 1; i + 1 < count; ++i)
  {
    const Eigen::Vector3d w = x[i + 1] - x[i];
    const double lengthW = std::sqrt(dotProduct(w, w));
    const double squaredU = lengthU * lengthU;
    const double squaredW = lengthW * lengthW;
    const double inverse = 1.0 / (lengthU * lengthW);
    const double cosine = dotProduct(u, w) * inverse;
    const double radiusSum = r[i - 1] + r[i] + r[i + 1];
    const double bend = 1.0 - cosine;
    const double scale = weight * 3.0 / radiusSum;
    const double cost = scale * bend * bend;
    const double byCosine = -2.0 * scale * bend;
    // (1 − cos θ)² ≈ θ⁴/4 has curvature 3 θ² ≈ 6 (1 − cos θ) in θ, and θ changes by 1/ℓ per unit of displacement.
    const double curvature = 6.0 * scale * bend;
    bends[i + 1] = { byCosine * (w * inverse - cosine / squaredU * u), byCosine * (u * inverse - cosine / squaredW * w),
      -cost / radiusSum, 4.0 * curvature / squaredU, 4.0 * curvature * inverse * 4.0, 4.0 * curvature / squaredW };
    totals.curvature += cost;
    u = w;
    lengthU = lengthW;
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    const Bend& before = bends[i];
    const Bend& here = bends[i + 1];
    const Bend& after = bends[i + 2];
    Eigen::Vector3d& byPoint = gradients.byPoint[begin + i];
    byPoint = byPoint + before.byW + (here.byU - here.byW) - after.byU;
    double& byRadius = gradients.byRadius[begin + i];
    byRadius = byRadius + before.byRadius + here.byRadius + after.byRadius;
    double& stiffness = gradients.stiffness[begin + i];
    stiffness = stiffness + before.stiffnessAfter + here.stiffness + after.stiffnessBefore;
  }
}

void FibreCosts::addLength(
  const Fibres& fibres, std::size_t f, double weight, FibreCostTotals& totals, const FibreGradients& gradients) const
{
  for (std::size_t i = fibres.offsets[f]; i + 1 < fibres.offsets[f + 1]; ++i)
  {
    const Eigen::Vector3d along = fibres.points[i + 1] - fibres.points[i];
    const double length = std::sqrt(dotProduct(along, along));
    const double change = length - this->ReferenceLength[i];
    const double first = fibres.radii[i];
    const double last = fibres.radii[i + 1];
    const double inverseRadii = 1.0 / first + 1.0 / last;
    const double k = weight * 20.0 / inverseRadii;
    totals.length += 0.5 * k * change * change;
    const Eigen::Vector3d pull = k * change / length * along;
    gradients.byPoint[i] -= pull;
    gradients.byPoint[i + 1] += pull;
    const double byInverse = -0.5 * k * change * change / inverseRadii;
    gradients.byRadius[i] -= byInverse / (first * first);
    gradients.byRadius[i + 1] -= byInverse / (last * last);
    gradients.stiffness[i] += 2.0 * k;
    gradients.stiffness[i + 1] += 2.0 * k;
  }
}

/// Adds the limit of the bend at a control point.
void FibreCosts::addBendLimit(const Fibres& fibres, std::size_t i, FibreCostTotals& totals, const FibreGradients& gradients) const
{
  const auto& x = fibres.points;
  const Eigen::Vector3d u = x[i] - x[i - 1];
  const Eigen::Vector3d w = x[i + 1] - x[i];
  const double squaredU = u.squaredNorm();
  const double squaredW = w.squaredNorm();
  const double inverse = 1.0 / std::sqrt(squaredU * squaredW);
  const double cosine = u.dot(w) * inverse;
  const double excess = this->SmallestCosine[i] - cosine;
  if (excess <= 0.0)
  {
    return;
  }
  const double area = this->ReferenceLength[i - 1] * this->ReferenceLength[i];
  const double scale = 0.25 * this->Weights.curvature * area * area;
  totals.curvature += scale * excess * excess;
  const double byCosine = -2.0 * scale * excess;
  const Eigen::Vector3d byU = byCosine * (w * inverse - cosine / squaredU * u);
  const Eigen::Vector3d byW = byCosine * (u * inverse - cosine / squaredW * w);
  gradients.byPoint[i - 1] -= byU;
  gradients.byPoint[i] += byU - byW;
  gradients.byPoint[i + 1] += byW;
  // An end point changes the cosine by at most 1/ℓ per unit of displacement; twice that for all three together.
  gradients.stiffness[i - 1] += 4.0 * scale / squaredU;
  gradients.stiffness[i] += 4.0 * scale * (1.0 / squaredU + 1.0 / squaredW + 2.0 * inverse);
  gradients.stiffness[i + 1] += 4.0 * scale / squaredW;
}

void FibreCosts::addCompressionLimit(
  const Fibres& fibres, std::size_t f, FibreCostTotals& totals, const FibreGradients& gradients) const
{
  for (std::size_t i = fibres.offsets[f]; i + 1 < fibres.offsets[f + 1]; ++i)
  {
    const Eigen::Vector3d d = fibres.points[i + 1] - fibres.points[i];
    const double length = d.norm();
    const double compression = shortestSegment * this->ReferenceLength[i] - length;
    if (compression <= 0.0)
    {
      continue;
    }
    const double k = this->Weights.length * this->ReferenceLength[i] * this->ReferenceLength[i];
    totals.length += 0.5 * k * compression * compression;
    const Eigen::Vector3d push = k * compression / length * d;
    gradients.byPoint[i] += push;
    gradients.byPoint[i + 1] -= push;
    gradients.stiffness[i] += 2.0 * k;
    gradients.stiffness[i + 1] += 2.0 * k;
  }
}

void FibreCosts::addChord(
  const Fibres& fibres, std::size_t f, double relaxation, FibreCostTotals& totals, const FibreGradients& gradients) const
{
  const std::size_t first = fibres.offsets[f];
  const std::size_t last = fibres.offsets[f + 1] - 1;
  const Eigen::Vector3d turned = fibres.points[last] - fibres.points[first] - this->ReferenceChord[f];
  const double length = this->ReferenceLength[first];
  const double k = 100.0 * relaxation * this->Weights.compactness * length * length;
  totals.compactness += 0.5 * k * turned.squaredNorm();
  gradients.byPoint[first] -= k * turned;
  gradients.byPoint[last] += k * turned;
  gradients.stiffness[first] += 2.0 * k;
  gradients.stiffness[last] += 2.0 * k;
}

void FibreCosts::addRadius(const Fibres& fibres, std::size_t f, FibreCostTotals& totals, const FibreGradients& gradients) const
{
  for (std::size_t i = fibres.offsets[f]; i < fibres.offsets[f + 1]; ++i)
  {
    const double deviation = fibres.radii[i] - this->ReferenceRadius[i];
    totals.radius += this->Weights.radius * deviation * deviation;
    gradients.byRadius[i] += 2.0 * this->Weights.radius * deviation;
  }
}

void FibreCosts::addConfinement(
  const Fibres& fibres, std::size_t f, double weight, FibreCostTotals& totals, const FibreGradients& gradients) const
{
  const BundleBox& box = this->Boxes[f];
  const std::size_t begin = fibres.offsets[f];
  const std::size_t end = fibres.offsets[f + 1];
  for (std::size_t i = begin; i < end; ++i)
  {
    const double before = i > begin ? this->ReferenceLength[i - 1] : this->ReferenceLength[i];
    const double after = i + 1 < end ? this->ReferenceLength[i] : before;
    const double k = weight * 0.25 * (before + after) * (before + after);
    const auto confine = [&](const Eigen::Vector3d& direction, double lower, double upper)
    {
      const double position = fibres.points[i].dot(direction);
      const double above = position + fibres.radii[i] - upper;
      const double below = lower - (position - fibres.radii[i]);
      const double excess = std::max(above, below);
      if (excess <= 0.0)
      {
        return;
      }
      totals.compactness += 0.5 * k * excess * excess;
      gradients.byPoint[i] += (above >= below ? k * excess : -k * excess) * direction;
      gradients.byRadius[i] += k * excess;
      gradients.stiffness[i] += k;
    };
    confine(box.u, box.lowerU, box.upperU);
    confine(box.v, box.lowerV, box.upperV);
  }
}

} // namespace cactus
