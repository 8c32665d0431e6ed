// SPDX-License-Identifier: BSD-3-Clause
#include "fibres/ResampledFibres.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace cactus
{

namespace
{

/// Lengths of capsules over the radius: dense fibres have shorter ones than the first, and get the second. The optimiser bends
/// chains of shorter capsules up, and chains of longer ones straight.
constexpr double shortestCapsule = 0.5;
constexpr double newCapsule = 0.6;

/// Radius (µm) above which lengths of capsules grow no more: those of BundleInitializer end at 2 µm.
constexpr double thickest = 2.5;

/// A fibre's polyline with the lengths along it.
class FibreLine
{
public:
  FibreLine(const Fibres& fibres, std::size_t fibre)
    : All(fibres)
    , First(fibres.offsets[fibre])
    , Along(fibres.pointCount(fibre), 0.0)
  {
    for (std::size_t i = 1; i < this->Along.size(); ++i)
    {
      this->Along[i] = this->Along[i - 1] + (this->point(i) - this->point(i - 1)).norm();
    }
  }

  std::size_t size() const { return this->Along.size(); }
  double length() const { return this->Along.back(); }
  double lengthTo(std::size_t i) const { return this->Along[i]; }
  const Eigen::Vector3d& point(std::size_t i) const { return this->All.points[this->First + i]; }
  double radius(std::size_t i) const { return this->All.radii[this->First + i]; }

  Eigen::Vector3d pointAt(double length) const
  {
    const auto [i, share] = this->place(length);
    return this->point(i) + share * (this->point(i + 1) - this->point(i));
  }

  double radiusAt(double length) const
  {
    const auto [i, share] = this->place(length);
    return this->radius(i) + share * (this->radius(i + 1) - this->radius(i));
  }

  double myelinAt(double length) const
  {
    if (this->All.myelinFractions.empty())
    {
      return 1.0;
    }
    const auto [i, share] = this->place(length);
    const double* fraction = this->All.myelinFractions.data() + this->First;
    return fraction[i] + share * (fraction[i + 1] - fraction[i]);
  }

  /// Root of the mean squared radius between two lengths.
  double meanRadius(double from, double to) const
  {
    double sum = 0.0;
    double begin = from;
    double radius = this->radiusAt(from);
    const auto add = [&](double end, double next)
    {
      sum += (radius * radius + radius * next + next * next) / 3.0 * (end - begin);
      begin = end;
      radius = next;
    };
    for (std::size_t i = this->place(from).first + 1; i + 1 < this->size() && this->Along[i] < to; ++i)
    {
      add(this->Along[i], this->radius(i));
    }
    add(to, this->radiusAt(to));
    return std::sqrt(sum / (to - from));
  }

private:
  /// The segment that holds this length, and the share of it up to there.
  std::pair<std::size_t, double> place(double length) const
  {
    const auto after = std::upper_bound(this->Along.begin() + 1, this->Along.end() - 1, length);
    const auto i = static_cast<std::size_t>(after - this->Along.begin()) - 1;
    return { i, std::clamp((length - this->Along[i]) / (this->Along[i + 1] - this->Along[i]), 0.0, 1.0) };
  }

  const Fibres& All;
  std::size_t First;
  std::vector<double> Along;
};

double distanceToSegment(const Eigen::Vector3d& point, const Eigen::Vector3d& from, const Eigen::Vector3d& to)
{
  const Eigen::Vector3d along = to - from;
  const double square = along.squaredNorm();
  const double share = square > 0.0 ? std::clamp((point - from).dot(along) / square, 0.0, 1.0) : 0.0;
  return (point - from - share * along).norm();
}

/// How many segments of equal length the fibre is to have; its own number where it is not dense.
std::size_t segmentsFor(const FibreLine& line)
{
  const std::size_t segments = line.size() - 1;
  const double radius = std::min(line.meanRadius(0.0, line.length()), thickest);
  if (line.length() >= shortestCapsule * radius * static_cast<double>(segments))
  {
    return segments;
  }
  return std::min(segments, static_cast<std::size_t>(std::max(2.0, std::round(line.length() / (newCapsule * radius)))));
}

/// Points at equal lengths along the fibre, both ends among them.
std::vector<Eigen::Vector3d> evenPoints(const FibreLine& line, std::size_t segments)
{
  std::vector<Eigen::Vector3d> points{ line.point(0) };
  for (std::size_t k = 1; k < segments; ++k)
  {
    points.push_back(line.pointAt(line.length() * static_cast<double>(k) / static_cast<double>(segments)));
  }
  points.push_back(line.point(line.size() - 1));
  return points;
}

/// Whether two consecutive points coincide, as where a polyline runs back the way it came.
bool hasCoincidingPoints(const std::vector<Eigen::Vector3d>& points)
{
  const auto coincide = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return (b - a).norm() <= 1e-6; };
  return std::adjacent_find(points.begin(), points.end(), coincide) != points.end();
}

/// The largest distance of the fibre's control points from even points.
double deviationOf(const FibreLine& line, const std::vector<Eigen::Vector3d>& points)
{
  const std::size_t segments = points.size() - 1;
  double deviation = 0.0;
  for (std::size_t i = 0; i < line.size(); ++i)
  {
    const double place = line.lengthTo(i) / line.length() * static_cast<double>(segments);
    const auto k = std::min(segments - 1, static_cast<std::size_t>(place));
    deviation = std::max(deviation, distanceToSegment(line.point(i), points[k], points[k + 1]));
  }
  return deviation;
}

/// Adds control points to the last fibre; the fibre's own radius is averaged around each.
void addPoints(const FibreLine& line, const std::vector<Eigen::Vector3d>& points, Fibres& fibres)
{
  const double spacing = line.length() / static_cast<double>(points.size() - 1);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    const double length = spacing * static_cast<double>(k);
    const double from = std::max(0.0, length - 0.5 * spacing);
    const double to = std::min(line.length(), length + 0.5 * spacing);
    fibres.addPoint(points[k], line.meanRadius(from, to));
    fibres.setMyelinFraction(line.myelinAt(length));
  }
}

} // namespace

Resampling resampleDenseFibres(Fibres& fibres)
{
  std::vector<std::size_t> segments;
  bool isAnyDense = false;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    segments.push_back(segmentsFor(FibreLine(fibres, f)));
    isAnyDense = isAnyDense || segments[f] + 1 < fibres.pointCount(f);
  }
  Resampling done;
  if (!isAnyDense)
  {
    return done;
  }
  Fibres resampled = fibres.emptyCopy();
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    resampled.addFibre(fibres, f);
    const FibreLine line(fibres, f);
    if (segments[f] + 1 < line.size())
    {
      if (const auto points = evenPoints(line, segments[f]); !hasCoincidingPoints(points))
      {
        addPoints(line, points, resampled);
        done.largestDeviation = std::max(done.largestDeviation, deviationOf(line, points));
        ++done.fibres;
        continue;
      }
    }
    resampled.addPoints(fibres, fibres.offsets[f], fibres.offsets[f + 1]);
  }
  fibres = std::move(resampled);
  return done;
}

} // namespace cactus
