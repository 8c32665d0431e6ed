// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/FibreCosts.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace cactus
{

namespace
{

/// Share of its length before optimisation below which a segment resists compression.
constexpr double shortest = 0.75;

/// Smallest radius of curvature, relative to the fibre's radius, that a bend is free to take.
constexpr double sharpest = 1.2;

} // namespace

FibreCosts::FibreCosts(const Fibres& fibres, const FibreCostWeights& weights, double packingLimit)
  : Weights(weights)
  , ReferenceLength(fibres.points.size(), 0.0)
  , SmallestCosine(fibres.points.size(), -1.0f)
  , ReferenceRadius(fibres.radii)
  , Boxes(bundleBoxes(fibres, packingLimit))
{
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    for (std::size_t i = fibres.offsets[f]; i + 1 < fibres.offsets[f + 1]; ++i)
    {
      this->ReferenceLength[i] = (fibres.points[i + 1] - fibres.points[i]).norm();
    }
    for (std::size_t i = fibres.offsets[f] + 1; i + 1 < fibres.offsets[f + 1]; ++i)
    {
      // Two segments of length ℓ at the angle θ touch a circle of radius ℓ / (2 sin(θ/2)) in their three points. Never more than
      // a right angle, and never less than there was.
      const double length = shortest * std::min(this->ReferenceLength[i - 1], this->ReferenceLength[i]);
      const double sine = std::min(length / (2.0 * sharpest * fibres.radii[i]), std::sqrt(0.5));
      const Eigen::Vector3d u = (fibres.points[i] - fibres.points[i - 1]).normalized();
      const Eigen::Vector3d w = (fibres.points[i + 1] - fibres.points[i]).normalized();
      this->SmallestCosine[i] = static_cast<float>(std::min(1.0 - 2.0 * sine * sine, u.dot(w)));
    }
    this->ReferenceChord.push_back(fibres.points[fibres.offsets[f + 1] - 1] - fibres.points[fibres.offsets[f]]);
  }
}

FibreCostTotals FibreCosts::add(const Fibres& fibres, std::size_t f, double relaxation, std::vector<Eigen::Vector3d>& gradient,
  std::vector<double>& radiusGradient, std::vector<double>& stiffness) const
{
  FibreCostTotals totals;
  const std::size_t begin = fibres.offsets[f];
  const std::size_t end = fibres.offsets[f + 1];
  const auto& x = fibres.points;
  const auto& r = fibres.radii;

  if (this->Weights.curvature > 0.0)
  {
    for (std::size_t i = begin + 1; i + 1 < end; ++i)
    {
      const Eigen::Vector3d u = x[i] - x[i - 1];
      const Eigen::Vector3d w = x[i + 1] - x[i];
      const double lengthU = u.norm();
      const double lengthW = w.norm();
      const double inverse = 1.0 / (lengthU * lengthW);
      const double cosine = u.dot(w) * inverse;
      const double radiusSum = r[i - 1] + r[i] + r[i + 1];
      const double bend = 1.0 - cosine;
      const double scale = relaxation * this->Weights.curvature * 3.0 / radiusSum;
      totals.curvature += scale * bend * bend;
      const double byCosine = -2.0 * scale * bend;
      const Eigen::Vector3d byU = byCosine * (w * inverse - cosine / (lengthU * lengthU) * u);
      const Eigen::Vector3d byW = byCosine * (u * inverse - cosine / (lengthW * lengthW) * w);
      gradient[i - 1] -= byU;
      gradient[i] += byU - byW;
      gradient[i + 1] += byW;
      const double byRadius = -scale * bend * bend / radiusSum;
      radiusGradient[i - 1] += byRadius;
      radiusGradient[i] += byRadius;
      radiusGradient[i + 1] += byRadius;
      // (1 − cos θ)² ≈ θ⁴/4 has curvature 3 θ² ≈ 6 (1 − cos θ) in θ, and θ changes by 1/ℓ per unit of displacement.
      const double curvature = 6.0 * scale * bend;
      stiffness[i - 1] += 4.0 * curvature / (lengthU * lengthU);
      stiffness[i] += 4.0 * curvature * inverse * 4.0;
      stiffness[i + 1] += 4.0 * curvature / (lengthW * lengthW);
    }
  }
  this->addLimits(fibres, f, totals, gradient, stiffness);
  if (this->Weights.length > 0.0)
  {
    for (std::size_t i = begin; i + 1 < end; ++i)
    {
      const Eigen::Vector3d d = x[i + 1] - x[i];
      const double length = d.norm();
      const double stretch = length - this->ReferenceLength[i];
      if (stretch <= 0.0)
      {
        continue;
      }
      const double inverseRadii = 1.0 / r[i] + 1.0 / r[i + 1];
      const double k = relaxation * this->Weights.length * 20.0 / inverseRadii;
      totals.length += 0.5 * k * stretch * stretch;
      const Eigen::Vector3d pull = k * stretch / length * d;
      gradient[i] -= pull;
      gradient[i + 1] += pull;
      const double byInverse = -0.5 * k * stretch * stretch / inverseRadii;
      radiusGradient[i] -= byInverse / (r[i] * r[i]);
      radiusGradient[i + 1] -= byInverse / (r[i + 1] * r[i + 1]);
      stiffness[i] += 2.0 * k;
      stiffness[i + 1] += 2.0 * k;
    }
  }
  const BundleBox& box = this->Boxes[f];
  if (this->Weights.compactness > 0.0)
  {
    const Eigen::Vector3d turned = x[end - 1] - x[begin] - this->ReferenceChord[f];
    const double length = this->ReferenceLength[begin];
    const double k = 100.0 * relaxation * this->Weights.compactness * length * length;
    totals.compactness += 0.5 * k * turned.squaredNorm();
    gradient[begin] -= k * turned;
    gradient[end - 1] += k * turned;
    stiffness[begin] += 2.0 * k;
    stiffness[end - 1] += 2.0 * k;
  }
  for (std::size_t i = begin; i < end; ++i)
  {
    const double deviation = r[i] - this->ReferenceRadius[i];
    totals.radius += this->Weights.radius * deviation * deviation;
    radiusGradient[i] += 2.0 * this->Weights.radius * deviation;

    if (this->Weights.compactness > 0.0)
    {
      const double before = i > begin ? this->ReferenceLength[i - 1] : this->ReferenceLength[i];
      const double after = i + 1 < end ? this->ReferenceLength[i] : before;
      const double k = relaxation * this->Weights.compactness * 0.25 * (before + after) * (before + after);
      const auto confine = [&](const Eigen::Vector3d& direction, double lower, double upper)
      {
        const double position = x[i].dot(direction);
        const double above = position + r[i] - upper;
        const double below = lower - (position - r[i]);
        const double excess = std::max(above, below);
        if (excess <= 0.0)
        {
          return;
        }
        totals.compactness += 0.5 * k * excess * excess;
        gradient[i] += (above >= below ? k * excess : -k * excess) * direction;
        radiusGradient[i] += k * excess;
        stiffness[i] += k;
      };
      confine(box.u, box.lowerU, box.upperU);
      confine(box.v, box.lowerV, box.upperV);
    }
  }
  return totals;
}

void FibreCosts::addLimits(const Fibres& fibres, std::size_t f, FibreCostTotals& totals, std::vector<Eigen::Vector3d>& gradient,
  std::vector<double>& stiffness) const
{
  const std::size_t begin = fibres.offsets[f];
  const std::size_t end = fibres.offsets[f + 1];
  const auto& x = fibres.points;
  if (this->Weights.curvature > 0.0)
  {
    for (std::size_t i = begin + 1; i + 1 < end; ++i)
    {
      const Eigen::Vector3d u = x[i] - x[i - 1];
      const Eigen::Vector3d w = x[i + 1] - x[i];
      const double squaredU = u.squaredNorm();
      const double squaredW = w.squaredNorm();
      const double inverse = 1.0 / std::sqrt(squaredU * squaredW);
      const double cosine = u.dot(w) * inverse;
      const double excess = this->SmallestCosine[i] - cosine;
      if (excess <= 0.0)
      {
        continue;
      }
      const double area = this->ReferenceLength[i - 1] * this->ReferenceLength[i];
      const double scale = 0.25 * this->Weights.curvature * area * area;
      totals.curvature += scale * excess * excess;
      const double byCosine = -2.0 * scale * excess;
      const Eigen::Vector3d byU = byCosine * (w * inverse - cosine / squaredU * u);
      const Eigen::Vector3d byW = byCosine * (u * inverse - cosine / squaredW * w);
      gradient[i - 1] -= byU;
      gradient[i] += byU - byW;
      gradient[i + 1] += byW;
      // An end point changes the cosine by at most 1/ℓ per unit of displacement; twice that for what the three do together.
      stiffness[i - 1] += 4.0 * scale / squaredU;
      stiffness[i] += 4.0 * scale * (1.0 / squaredU + 1.0 / squaredW + 2.0 * inverse);
      stiffness[i + 1] += 4.0 * scale / squaredW;
    }
  }
  if (this->Weights.length > 0.0)
  {
    for (std::size_t i = begin; i + 1 < end; ++i)
    {
      const Eigen::Vector3d d = x[i + 1] - x[i];
      const double length = d.norm();
      const double compression = shortest * this->ReferenceLength[i] - length;
      if (compression <= 0.0)
      {
        continue;
      }
      const double k = this->Weights.length * this->ReferenceLength[i] * this->ReferenceLength[i];
      totals.length += 0.5 * k * compression * compression;
      const Eigen::Vector3d push = k * compression / length * d;
      gradient[i] += push;
      gradient[i + 1] -= push;
      stiffness[i] += 2.0 * k;
      stiffness[i + 1] += 2.0 * k;
    }
  }
}

} // namespace cactus
