// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/TractPath.h"

#include "base/Constants.h"
#include "base/Error.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cactus
{

namespace
{

constexpr double mostSamples = 1024.0; ///< on either side of the middle

/// A polyline from the middle outwards.
using Arm = std::vector<Eigen::Vector3d>;

/// Returns the direction at the end of an arm: that of its last step or, without a step, the reverse of the other arm's first
/// step.
Eigen::Vector3d endOf(const Arm& arm, const Arm& other)
{
  return arm.size() > 1 ? (arm[arm.size() - 1] - arm[arm.size() - 2]).normalized() : (other[0] - other[1]).normalized();
}

/// Returns the distance from `from`, inside a ball about the origin, to the ball's surface in a direction (a unit vector).
double wayOut(const Eigen::Vector3d& from, const Eigen::Vector3d& direction, double radius)
{
  const double along = from.dot(direction);
  return std::sqrt(std::max(0.0, along * along + radius * radius - from.squaredNorm())) - along;
}

/// Returns the points until the line leaves the ball of radius `far` about the origin, the exit point included; zero-length steps
/// are skipped.
Arm armOf(const std::vector<Eigen::Vector3d>& points, double far)
{
  const double shortest = 1e-9 * far;
  Arm arm = { points.front() };
  for (std::size_t i = 1; i < points.size(); ++i)
  {
    const Eigen::Vector3d from = arm.back();
    const double length = (points[i] - from).norm();
    if (length <= shortest)
    {
      continue;
    }
    const Eigen::Vector3d direction = (points[i] - from) / length;
    const double way = wayOut(from, direction, far);
    if (way <= length)
    {
      arm.emplace_back(from + way * direction);
      return arm;
    }
    arm.push_back(points[i]);
  }
  return arm;
}

/// Returns the points of a polyline at each `spacing` of its length, without its beginning.
std::vector<Eigen::Vector3d> sampled(const std::vector<Eigen::Vector3d>& line, double spacing)
{
  std::vector<Eigen::Vector3d> samples;
  double next = spacing;
  double begin = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i)
  {
    const Eigen::Vector3d along = line[i] - line[i - 1];
    const double length = along.norm();
    for (; next <= begin + length; next += spacing)
    {
      samples.emplace_back(line[i - 1] + (next - begin) / length * along);
    }
    begin += length;
  }
  return samples;
}

/// Directions along the samples: from neighbour to neighbour.
std::vector<Eigen::Vector3d> tangentsOf(const std::vector<Eigen::Vector3d>& points)
{
  std::vector<Eigen::Vector3d> tangents;
  tangents.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Eigen::Vector3d& after = points[std::min(i + 1, points.size() - 1)];
    tangents.emplace_back((after - points[i == 0 ? 0 : i - 1]).normalized());
  }
  return tangents;
}

/// The deviations of points from the chord between the first and the last, as a sum of sines, which are zero at both.
class Deviations
{
public:
  explicit Deviations(const std::vector<Eigen::Vector3d>& points)
    : First(points.front())
    , Last(points.back())
    , Steps(points.size() - 1)
  {
    this->Sines.reserve(2 * this->Steps);
    this->Coefficients.reserve(this->Steps);
    for (std::size_t i = 0; i < 2 * this->Steps; ++i)
    {
      this->Sines.push_back(std::sin(pi * static_cast<double>(i) / static_cast<double>(this->Steps)));
    }
    for (std::size_t k = 1; k < this->Steps; ++k)
    {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (std::size_t i = 1; i < this->Steps; ++i)
      {
        sum += this->sine(k, i) * (points[i] - this->chord(i));
      }
      this->Coefficients.emplace_back(2.0 / static_cast<double>(this->Steps) * sum);
    }
  }

  /// Smooths all points but the first and the last by a Gaussian whose standard deviation is given in steps.
  void smooth(double deviation, std::vector<Eigen::Vector3d>& points) const
  {
    const double decay = pi * deviation / static_cast<double>(this->Steps);
    std::vector<Eigen::Vector3d> left;
    for (std::size_t k = 1; k < this->Steps; ++k)
    {
      const double damping = std::exp(-0.5 * std::pow(decay * static_cast<double>(k), 2));
      if (damping < 1e-12)
      {
        break;
      }
      left.emplace_back(damping * this->Coefficients[k - 1]);
    }
    for (std::size_t i = 1; i < this->Steps; ++i)
    {
      points[i] = this->chord(i);
      for (std::size_t k = 1; k <= left.size(); ++k)
      {
        points[i] += this->sine(k, i) * left[k - 1];
      }
    }
  }

private:
  double sine(std::size_t k, std::size_t i) const { return this->Sines[k * i % this->Sines.size()]; }
  Eigen::Vector3d chord(std::size_t i) const
  {
    return this->First + static_cast<double>(i) / static_cast<double>(this->Steps) * (this->Last - this->First);
  }

  Eigen::Vector3d First;
  Eigen::Vector3d Last;
  std::size_t Steps;
  std::vector<double> Sines;                 ///< sin(π i / Steps)
  std::vector<Eigen::Vector3d> Coefficients; ///< longest wave first
};

/// Returns the index of the sample nearest to the origin.
std::size_t nearestSample(const std::vector<Eigen::Vector3d>& points)
{
  const auto nearer = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.squaredNorm() < b.squaredNorm(); };
  return static_cast<std::size_t>(std::min_element(points.begin(), points.end(), nearer) - points.begin());
}

/// Returns a direction across `tangent`: the part across it of the axis that is most nearly perpendicular.
Eigen::Vector3d acrossOf(const Eigen::Vector3d& tangent)
{
  Eigen::Index axis = 0;
  tangent.cwiseAbs().minCoeff(&axis);
  const Eigen::Vector3d chosen = Eigen::Vector3d::Unit(axis);
  return (chosen - chosen.dot(tangent) * tangent).normalized();
}

/// Returns the next point's axis: this one, reflected twice.
Eigen::Vector3d carriedAxis(
  const Eigen::Vector3d& axis, const Eigen::Vector3d& step, const Eigen::Vector3d& tangent, const Eigen::Vector3d& nextTangent)
{
  const double length = step.squaredNorm();
  const Eigen::Vector3d mirrored = axis - 2.0 / length * step.dot(axis) * step;
  const Eigen::Vector3d mirroredTangent = tangent - 2.0 / length * step.dot(tangent) * step;
  const Eigen::Vector3d between = nextTangent - mirroredTangent;
  const double squared = between.squaredNorm();
  const Eigen::Vector3d carried =
    squared > 0.0 ? Eigen::Vector3d(mirrored - 2.0 / squared * between.dot(mirrored) * between) : mirrored;
  return (carried - carried.dot(nextTangent) * nextTangent).normalized(); // corrects rounding
}

} // namespace

TractStretch stretchAround(const Streamlines& streamlines, const StreamlinePlace& place, const Eigen::Vector3d& middle,
  double scale, double far, double spacing)
{
  const auto moved = [&](const Eigen::Vector3d& point) { return Eigen::Vector3d(scale * (point - middle)); };
  std::vector<Eigen::Vector3d> forwards = { moved(place.point) };
  std::vector<Eigen::Vector3d> backwards = forwards;
  for (std::size_t i = place.segment + 1; i < streamlines.offsets[place.streamline + 1]; ++i)
  {
    forwards.push_back(moved(streamlines.points[i]));
  }
  for (std::size_t i = place.segment + 1; i > streamlines.offsets[place.streamline]; --i)
  {
    backwards.push_back(moved(streamlines.points[i - 1]));
  }
  Arm ahead = armOf(forwards, far);
  Arm behind = armOf(backwards, far);
  if (ahead.size() < 2 && behind.size() < 2)
  {
    throw InvalidInput(text("streamline ", place.streamline + 1, " is too short beside the domain: raise ScaleFactor"));
  }
  TractStretch stretch;
  const Eigen::Vector3d directions[] = { endOf(ahead, behind), endOf(behind, ahead) };
  Arm* const arms[] = { &ahead, &behind };
  for (int side = 0; side < 2; ++side)
  {
    Arm& arm = *arms[side];
    if (arm.back().norm() < far * (1.0 - 1e-9))
    {
      stretch.ends.push_back(arm.back());
      arm.emplace_back(arm.back() + wayOut(arm.back(), directions[side], far) * directions[side]);
    }
  }
  const double step = std::max(spacing, std::max(lengthOf(ahead), lengthOf(behind)) / mostSamples);
  stretch.points = sampled(behind, step);
  std::reverse(stretch.points.begin(), stretch.points.end());
  stretch.middle = stretch.points.size();
  stretch.points.push_back(forwards.front());
  const std::vector<Eigen::Vector3d> rest = sampled(ahead, step);
  stretch.points.insert(stretch.points.end(), rest.begin(), rest.end());
  return stretch;
}

double lengthOf(const std::vector<Eigen::Vector3d>& line)
{
  double length = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i)
  {
    length += (line[i] - line[i - 1]).norm();
  }
  return length;
}

double smallestBend(const std::vector<Eigen::Vector3d>& points)
{
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i + 1 < points.size(); ++i)
  {
    const Eigen::Vector3d before = points[i] - points[i - 1];
    const Eigen::Vector3d after = points[i + 1] - points[i];
    const double sides = before.norm() * after.norm() * (before + after).norm();
    const double area = 2.0 * before.cross(after).norm();
    const bool turnsBack = before.dot(after) <= 0.0; // or does not move
    if (area > 0.0 || turnsBack)
    {
      smallest = std::min(smallest, turnsBack ? 0.0 : sides / area);
    }
  }
  return smallest;
}

double roundOff(TractStretch& stretch, double radius)
{
  if (smallestBend(stretch.points) >= radius)
  {
    return 0.0;
  }
  const double chord = (stretch.points.back() - stretch.points.front()).norm();
  const Deviations deviations(stretch.points);
  const double spacing = (stretch.points[1] - stretch.points[0]).norm();
  const auto steps = static_cast<double>(stretch.points.size());
  constexpr double finer = 1.25; ///< ratio of each Gaussian to the one before
  for (double deviation = 0.5; chord >= radius && deviation < 4.0 * steps; deviation *= finer)
  {
    deviations.smooth(deviation, stretch.points);
    if (smallestBend(stretch.points) >= radius)
    {
      return deviation * spacing;
    }
  }
  throw Infeasible(
    text("a streamline comes back to within ", chord, " µm of where it began, too sharply for a bundle of a radius of ", radius,
      " µm: choose a smaller BundleDiameter, a smaller Side or a larger ScaleFactor"));
}

void bringToOrigin(TractStretch& stretch, double far)
{
  const Eigen::Vector3d shift = stretch.points[stretch.middle];
  for (Eigen::Vector3d& point : stretch.points)
  {
    point -= shift;
  }
  std::vector<Eigen::Vector3d>& points = stretch.points;
  std::vector<Eigen::Vector3d> before;
  const Eigen::Vector3d back = points[0] - points[1];
  while ((before.empty() ? points.front() : before.back()).norm() < far)
  {
    before.emplace_back((before.empty() ? points.front() : before.back()) + back);
  }
  points.insert(points.begin(), before.rbegin(), before.rend());
  stretch.middle += before.size();
  const Eigen::Vector3d on = points[points.size() - 1] - points[points.size() - 2];
  while (points.back().norm() < far)
  {
    points.emplace_back(points.back() + on);
  }
}

TractPath pathThrough(const TractStretch& stretch, double reach, double radius)
{
  const std::vector<Eigen::Vector3d>& points = stretch.points;
  const std::vector<Eigen::Vector3d> tangents = tangentsOf(points);
  const std::size_t middle = nearestSample(points);
  const auto isBeyond = [&](std::size_t i, double sense)
  { return sense * points[i].dot(tangents[i]) >= reach || points[i].norm() >= reach + radius; };
  std::size_t begin = middle;
  while (begin > 0 && !isBeyond(begin, -1.0))
  {
    --begin;
  }
  std::size_t end = middle;
  while (end + 1 < points.size() && !isBeyond(end, 1.0))
  {
    ++end;
  }
  TractPath path;
  for (std::size_t i = begin; i <= end; ++i)
  {
    path.points.push_back(points[i]);
    path.u.push_back(
      i == begin ? acrossOf(tangents[i]) : carriedAxis(path.u.back(), points[i] - points[i - 1], tangents[i - 1], tangents[i]));
    path.v.emplace_back(tangents[i].cross(path.u.back()));
  }
  return path;
}

} // namespace cactus
