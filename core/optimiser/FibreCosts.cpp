// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/FibreCosts.h"

#include "optimiser/FibreCostKernels.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

namespace cactus
{

namespace
{

/// Fraction of its length before optimisation below which a segment resists compression.
constexpr double shortestSegment = 0.75;

/// Smallest radius of curvature, relative to the fibre's radius, that bends without cost.
constexpr double sharpestBend = 1.2;

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
  const FibreCostKernels& kernels = bestKernels<FibreCostKernels>();
  const std::size_t begin = fibres.offsets[f];
  const std::size_t count = fibres.pointCount(f);
  const FibreColumns columns = { count, fibres.points[begin].data(), &fibres.radii[begin], &this->ReferenceLength[begin],
    &this->SmallestCosine[begin] };
  const FibreColumnGradients to = { gradients.byPoint[begin].data(), &gradients.byRadius[begin], &gradients.stiffness[begin] };
  const std::unique_ptr<double[]> room(new double[FibreCostKernels::roomFor(count)]);
  if (this->Weights.curvature > 0.0)
  {
    const std::unique_ptr<std::uint32_t[]> sharp(new std::uint32_t[count]);
    const std::size_t sharpOnes =
      kernels.addCurvature(columns, relaxation * this->Weights.curvature, totals.curvature, to, room.get(), sharp.get());
    for (std::size_t n = 0; n < sharpOnes; ++n)
    {
      this->addBendLimit(fibres, begin + sharp[n], totals, gradients);
    }
  }
  if (this->Weights.length > 0.0)
  {
    this->addCompressionLimit(fibres, f, totals, gradients);
    kernels.addLength(columns, relaxation * this->Weights.length, totals.length, to, room.get());
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
