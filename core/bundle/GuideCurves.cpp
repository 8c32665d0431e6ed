// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/GuideCurves.h"

#include "base/Constants.h"
#include "base/Domain.h"

#include <algorithm>
#include <cmath>

namespace cactus
{

namespace
{

constexpr int arcSteps = 512;

/// Appends points of an arc from angle to angle, both included, that has the direction z at `place` and angle 0, and its centre
/// `radius` to the right of there (to the left, if that is negative).
void appendArc(double place, double height, double radius, double from, double to, std::vector<Eigen::Vector2d>& points)
{
  for (int i = 0; i <= arcSteps; ++i)
  {
    const double angle = from + (to - from) * i / arcSteps;
    const double half = std::sin(0.5 * angle);
    points.emplace_back(place + 2.0 * radius * half * half, height + std::abs(radius) * std::sin(angle));
  }
}

/// Returns an arc through the domain's middle plane as far as it is within reach along z. One that ends before, along x, goes on
/// straight until it is beyond reach.
std::vector<Eigen::Vector2d> arcThroughMiddle(double place, double radius, const CurvedBundlesOptions& options)
{
  const double half = std::asin(std::min(1.0, options.reachAlong() / std::abs(radius)));
  std::vector<Eigen::Vector2d> points;
  appendArc(place, 0.0, radius, -half, half, points);
  if (options.reachAlong() >= std::abs(radius) && std::abs(points.back().x()) < options.reach())
  {
    const double end = std::copysign(options.reach(), radius);
    points.insert(points.begin(), { end, points.front().y() });
    points.emplace_back(end, points.back().y());
  }
  return points;
}

/// The arc of a fan's curve.
struct FanArc
{
  double angle = 0.0;  ///< where it ends, positive towards larger x
  double radius = 0.0; ///< negative for a curve towards smaller x
};

FanArc fanArc(const CurvedBundlesOptions& options, double place)
{
  const double edge = 0.5 * options.fanEntry();
  const double within = std::clamp(place, -edge, edge);
  const double angle = 0.5 * options.fanAngle * degree * within / edge;
  return { angle, options.height() / std::sin(angle) - (place - within) };
}

std::vector<Eigen::Vector2d> fanCurve(const CurvedBundlesOptions& options, double place)
{
  constexpr double straight = 1e-9;
  const double bottom = guideHeight(options);
  std::vector<Eigen::Vector2d> points = { { place, -options.reachAlong() } };
  const FanArc arc = fanArc(options, place);
  Eigen::Vector2d direction = Eigen::Vector2d::UnitY();
  if (std::abs(arc.angle) < straight)
  {
    points.emplace_back(place, bottom);
  }
  else
  {
    appendArc(place, bottom, arc.radius, 0.0, std::abs(arc.angle), points);
    direction = Eigen::Vector2d(std::sin(arc.angle), std::cos(arc.angle));
  }
  const double left = options.reachAlong() - points.back().y();
  if (left > 0.0)
  {
    points.emplace_back(points.back() + left / direction.y() * direction);
  }
  return points;
}

} // namespace

double guideHeight(const CurvedBundlesOptions& options)
{
  return options.shape == BundleShape::Fan ? -0.5 * options.height() : 0.0;
}

GuideCurve guideCurve(const CurvedBundlesOptions& options, double place)
{
  switch (options.shape)
  {
  case BundleShape::Fan:
    return { 1, fanCurve(options, place) };
  case BundleShape::Kiss:
  {
    const double sense = place < 0.0 ? -1.0 : 1.0;
    const double inward = std::abs(place) - 0.5 * options.kiss(); // from the bundle's middle
    if (std::abs(inward) > 0.5 * options.kiss())
    {
      return {};
    }
    return { place < 0.0 ? 1 : 2, arcThroughMiddle(place, sense * (options.bendRadius - inward), options) };
  }
  default:
    return { 1, arcThroughMiddle(place, options.bendRadius - place, options) };
  }
}

double farthestPlace(const CurvedBundlesOptions& options)
{
  const double reach = options.reach();
  switch (options.shape)
  {
  case BundleShape::Kiss:
    return std::min(reach, options.kiss());
  case BundleShape::Bend: // a curve beside the middle, on the outer side, comes in at a corner
    return std::hypot(options.bendRadius + reach, options.reachAlong()) - options.bendRadius;
  default:
    return reach;
  }
}

double bundlesShare(const CurvedBundlesOptions& options)
{
  constexpr int places = 1024;
  const Domain domain = options.domain();
  const double width = 2.0 * farthestPlace(options) / places;
  double area = 0.0;
  for (int i = 0; i < places; ++i)
  {
    const std::vector<Eigen::Vector2d> points = guideCurve(options, (i + 0.5 - 0.5 * places) * width).points;
    for (std::size_t p = 1; p < points.size(); ++p)
    {
      const auto part = domain.clip({ points[p - 1].x(), 0.0, points[p - 1].y() }, { points[p].x(), 0.0, points[p].y() });
      area += std::max(0.0, part[1] - part[0]) * (points[p] - points[p - 1]).norm() * width;
    }
  }
  return area / (options.side * options.height());
}

} // namespace cactus
