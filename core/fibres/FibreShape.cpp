// SPDX-License-Identifier: BSD-3-Clause
#include "fibres/FibreShape.h"

#include "base/Constants.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace cactus
{

namespace
{

double largestCrossingAngle(const Fibres& fibres)
{
  std::vector<Eigen::Vector3d> axes;
  for (const auto& entry : bundleAxes(fibres))
  {
    axes.push_back(entry.second);
  }
  double largest = 0.0;
  for (std::size_t a = 0; a < axes.size(); ++a)
  {
    for (std::size_t b = a + 1; b < axes.size(); ++b)
    {
      // The arc tangent keeps its precision for nearly parallel bundles.
      largest = std::max(largest, radian * std::atan2(axes[a].cross(axes[b]).norm(), std::abs(axes[a].dot(axes[b]))));
    }
  }
  return largest;
}

std::vector<double> sortedMeanRadii(const Fibres& fibres)
{
  std::vector<double> means;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    const auto radii = fibres.radii.begin();
    const double sum = std::accumulate(
      radii + static_cast<std::ptrdiff_t>(fibres.offsets[f]), radii + static_cast<std::ptrdiff_t>(fibres.offsets[f + 1]), 0.0);
    means.push_back(sum / static_cast<double>(fibres.pointCount(f)));
  }
  std::sort(means.begin(), means.end());
  return means;
}

} // namespace

FibreShape measureShape(const Fibres& fibres)
{
  FibreShape shape;
  shape.meanDispersion = meanDispersion(fibres);
  shape.tangentDispersion = meanTangentDispersion(fibres);
  shape.crossingAngle = largestCrossingAngle(fibres);
  shape.smallestBendRadius = std::numeric_limits<double>::infinity();
  shape.smallestCurvatureRadius = std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    for (std::size_t i = fibres.offsets[f]; i + 1 < fibres.offsets[f + 1]; ++i)
    {
      const Eigen::Vector3d v = fibres.points[i + 1] - fibres.points[i];
      shape.totalLength += v.norm();
      if (i == fibres.offsets[f])
      {
        continue;
      }
      const Eigen::Vector3d u = fibres.points[i] - fibres.points[i - 1];
      // Angles below a millionth are rounding.
      const double sine = u.cross(v).norm() / (u.norm() * v.norm());
      if (sine > 1e-6 || u.dot(v) < 0.0)
      {
        const double radius = 0.5 * (u + v).norm() / std::max(sine, 1e-12);
        shape.smallestCurvatureRadius = std::min(shape.smallestCurvatureRadius, radius);
        shape.smallestBendRadius = std::min(shape.smallestBendRadius, radius / fibres.radii[i]);
      }
    }
  }
  return shape;
}

double radiusDistance(const Fibres& a, const Fibres& b)
{
  const std::vector<double> first = sortedMeanRadii(a);
  const std::vector<double> second = sortedMeanRadii(b);
  double distance = 0.0;
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < first.size() && j < second.size())
  {
    // Skips all values that equal the smaller of the two, on both sides.
    const double radius = std::min(first[i], second[j]);
    while (i < first.size() && first[i] == radius)
    {
      ++i;
    }
    while (j < second.size() && second[j] == radius)
    {
      ++j;
    }
    distance = std::max(distance, std::abs(static_cast<double>(i) / static_cast<double>(first.size()) -
                                           static_cast<double>(j) / static_cast<double>(second.size())));
  }
  return distance;
}

std::vector<double> arcLengths(const Fibres& fibres, std::size_t fibre)
{
  std::vector<double> lengths(fibres.pointCount(fibre), 0.0);
  for (std::size_t i = 0; i + 1 < lengths.size(); ++i)
  {
    const std::size_t p = fibres.offsets[fibre] + i;
    lengths[i + 1] = lengths[i] + (fibres.points[p + 1] - fibres.points[p]).norm();
  }
  return lengths;
}

double lengthInDomain(const Fibres& fibres, std::size_t fibre)
{
  double length = 0.0;
  const Domain domain = fibres.domain.unrolled();
  for (std::size_t i = fibres.offsets[fibre]; i + 1 < fibres.offsets[fibre + 1]; ++i)
  {
    const auto [from, to] = domain.clip(fibres.points[i], fibres.points[i + 1]);
    length += std::max(0.0, to - from) * (fibres.points[i + 1] - fibres.points[i]).norm();
  }
  return length;
}

std::vector<Eigen::Vector3d> unitTangents(const Fibres& fibres, std::size_t fibre)
{
  std::vector<Eigen::Vector3d> tangents(fibres.pointCount(fibre), Eigen::Vector3d::Zero());
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < tangents.size(); ++i)
  {
    const std::size_t p = fibres.offsets[fibre] + i;
    const bool isLast = i + 1 == tangents.size();
    const Eigen::Vector3d after =
      isLast ? Eigen::Vector3d::Zero() : Eigen::Vector3d((fibres.points[p + 1] - fibres.points[p]).normalized());
    const Eigen::Vector3d sum = before + after;
    tangents[i] = sum.norm() < 1e-6 ? after : Eigen::Vector3d(sum.normalized());
    before = after;
  }
  return tangents;
}

} // namespace cactus
