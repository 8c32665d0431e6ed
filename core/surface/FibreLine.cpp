// SPDX-License-Identifier: BSD-3-Clause
#include "surface/FibreLine.h"

#include "fibres/FibreShape.h"
#include "fibres/PeriodicImages.h"

#include <algorithm>
#include <limits>

namespace cactus
{

namespace
{

/// Returns the squared distance (µm²) of a point from the segment between two others.
double squaredDistance(const Eigen::Vector3d& point, const Eigen::Vector3d& from, const Eigen::Vector3d& to)
{
  const Eigen::Vector3d way = to - from;
  const double part = std::clamp((point - from).dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (point - from - part * way).squaredNorm();
}

} // namespace

FibreLine::FibreLine(const Fibres& fibres, std::size_t fibre)
  : Box(fibres.domain)
  , Points(fibres.points.begin() + std::ptrdiff_t(fibres.offsets[fibre]),
      fibres.points.begin() + std::ptrdiff_t(fibres.offsets[fibre + 1]))
  , Tangents(unitTangents(fibres, fibre))
  , Along(arcLengths(fibres, fibre))
{
  if (!fibres.myelinFractions.empty())
  {
    const auto begin = fibres.myelinFractions.begin();
    this->Myelin.assign(begin + std::ptrdiff_t(fibres.offsets[fibre]), begin + std::ptrdiff_t(fibres.offsets[fibre + 1]));
  }
  if (fibres.domain.periodic[2])
  {
    this->Period = this->Along[periodOf(fibres, fibre).points];
  }
}

std::size_t FibreLine::segmentAt(double along) const
{
  const auto above = std::upper_bound(this->Along.begin() + 1, this->Along.end() - 1, along);
  return std::size_t(above - this->Along.begin()) - 1;
}

double FibreLine::partOf(std::size_t segment, double along) const
{
  return std::clamp((along - this->Along[segment]) / (this->Along[segment + 1] - this->Along[segment]), 0.0, 1.0);
}

Eigen::Vector3d FibreLine::point(double along) const
{
  const std::size_t i = this->segmentAt(along);
  const double part = this->partOf(i, along);
  return this->Points[i] + part * (this->Points[i + 1] - this->Points[i]);
}

Eigen::Vector3d FibreLine::direction(double along) const
{
  const std::size_t i = this->segmentAt(along);
  return (this->Points[i + 1] - this->Points[i]).normalized();
}

double FibreLine::myelinAt(double along) const
{
  if (this->Myelin.empty())
  {
    return 1.0;
  }
  const std::size_t i = this->segmentAt(along);
  return this->Myelin[i] + this->partOf(i, along) * (this->Myelin[i + 1] - this->Myelin[i]);
}

bool FibreLine::lacksMyelin(double from, double to) const
{
  for (std::size_t i = 0; i < this->Myelin.size(); ++i)
  {
    const double begin = this->Along[i > 0 ? i - 1 : 0];
    const double end = this->Along[std::min(i + 1, this->Myelin.size() - 1)];
    if (this->Myelin[i] < 1.0 && begin <= to && end >= from)
    {
      return true;
    }
  }
  return false;
}

FibreLine::Near FibreLine::near(const Eigen::AlignedBox3d& box) const
{
  Eigen::AlignedBox3d body;
  for (const Eigen::Vector3d& point : this->Points)
  {
    body.extend(point);
  }
  // Half a period more, and the nearest image is among those that come so near.
  const Eigen::Vector3d more = 0.5 * this->Box.size();
  std::vector<Eigen::Vector3d> shifts;
  forEachImage(
    this->Box, body, { box.min() - more, box.max() + more }, [&](const Eigen::Vector3d& shift) { shifts.push_back(shift); });
  const Eigen::Vector3d centre = box.center();
  const auto distanceOf = [&](std::size_t i, const Eigen::Vector3d& shift)
  { return std::sqrt(squaredDistance(centre - shift, this->Points[i], this->Points[i + 1])); };
  double nearest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& shift : shifts)
  {
    for (std::size_t i = 0; i + 1 < this->Points.size(); ++i)
    {
      nearest = std::min(nearest, distanceOf(i, shift));
    }
  }
  Near result;
  result.Line = this;
  // What is nearest to a point of the box is no farther from its centre.
  const double reach = nearest + box.diagonal().norm() * (1.0 + 1e-9);
  for (const Eigen::Vector3d& shift : shifts)
  {
    for (std::size_t i = 0; i + 1 < this->Points.size(); ++i)
    {
      if (distanceOf(i, shift) <= reach)
      {
        result.Segments.push_back({ i, shift });
      }
    }
  }
  return result;
}

LinePlace FibreLine::Near::at(const Eigen::Vector3d& point) const
{
  const FibreLine& line = *this->Line;
  const Segment* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const Segment& segment : this->Segments)
  {
    const double distance = squaredDistance(point - segment.shift, line.Points[segment.first], line.Points[segment.first + 1]);
    if (distance < least)
    {
      least = distance;
      nearest = &segment;
    }
  }
  const Eigen::Vector3d at = point - nearest->shift;
  const auto ahead = [&](std::size_t i) { return (at - line.Points[i]).dot(line.Tangents[i]); };
  // Besides a bend, the planes of the segment's ends may both lie to one side of the point.
  std::size_t i = nearest->first;
  const bool isBefore = ahead(i) < 0.0;
  while (isBefore && i > 0 && ahead(i) < 0.0)
  {
    --i;
  }
  while (!isBefore && i + 2 < line.Points.size() && ahead(i + 1) > 0.0)
  {
    ++i;
  }
  const double before = std::max(ahead(i), 0.0);
  const double behind = std::max(-ahead(i + 1), 0.0);
  const double part = before + behind > 0.0 ? before / (before + behind) : 0.5;
  return { line.Along[i] + part * (line.Along[i + 1] - line.Along[i]), std::sqrt(least) };
}

} // namespace cactus
