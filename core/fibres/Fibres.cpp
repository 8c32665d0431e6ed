// SPDX-License-Identifier: BSD-3-Clause
#include "fibres/Fibres.h"

#include "base/Constants.h"
#include "base/Error.h"
#include "base/Limits.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <unordered_set>

namespace cactus
{

namespace
{

double coneVolume(double r0, double r1, double height)
{
  return pi / 3.0 * (r0 * r0 + r0 * r1 + r1 * r1) * height;
}

Eigen::Vector3d endToEnd(const Fibres& fibres, std::size_t fibre)
{
  const Eigen::Vector3d chord = fibres.points[fibres.offsets[fibre + 1] - 1] - fibres.points[fibres.offsets[fibre]];
  const double length = chord.norm();
  return length > 0.0 ? Eigen::Vector3d(chord / length) : Eigen::Vector3d::Zero();
}

void validateControlPoint(const Fibres& fibres, std::size_t fibre, std::size_t i, const std::string& name)
{
  const auto where = [&] { return name + ", control point " + std::to_string(i - fibres.offsets[fibre]); };
  const Eigen::Vector3d& point = fibres.points[i];
  for (const double coordinate : point)
  {
    if (!limits::coordinate.holds(coordinate))
    {
      requireWithin((where() + ": a coordinate").c_str(), coordinate, limits::coordinate);
    }
  }
  if (!limits::radius.holds(fibres.radii[i]))
  {
    requireWithin((where() + ": Radius").c_str(), fibres.radii[i], limits::radius);
  }
  if (!fibres.myelinFractions.empty() && !limits::part.holds(fibres.myelinFractions[i]))
  {
    requireWithin((where() + ": MyelinFraction").c_str(), fibres.myelinFractions[i], limits::part);
  }
  if (i > fibres.offsets[fibre] && (point - fibres.points[i - 1]).norm() <= 1e-9)
  {
    throw InvalidInput(where() + " coincides with the one before it: remove zero-length segments");
  }
}

/// Gives all control points a myelin fraction, 1 unless they have one, if they are to have some.
void fillMyelinFractions(Fibres& fibres, bool isWanted)
{
  if (isWanted)
  {
    fibres.myelinFractions.resize(fibres.points.size(), 1.0);
  }
}

} // namespace

void Fibres::addFibre(int fibreId, int bundleId, double targetRadius)
{
  fibreIds.push_back(fibreId);
  bundleIds.push_back(bundleId);
  targetRadii.push_back(targetRadius);
  offsets.push_back(points.size());
}

void Fibres::addFibre(const Fibres& from, std::size_t fibre)
{
  this->columns.copyRow(from.columns, fibre, this->size());
  this->addFibre(from.fibreIds[fibre], from.bundleIds[fibre], from.targetRadii[fibre]);
}

void Fibres::addPoint(const Eigen::Vector3d& point, double radius)
{
  points.push_back(point);
  radii.push_back(radius);
  offsets.back() = points.size();
  fillMyelinFractions(*this, !myelinFractions.empty());
}

void Fibres::setMyelinFraction(double fraction)
{
  fillMyelinFractions(*this, !myelinFractions.empty() || fraction != 1.0);
  if (!myelinFractions.empty())
  {
    myelinFractions.back() = fraction;
  }
}

void Fibres::addPoints(const Fibres& from, std::size_t first, std::size_t last)
{
  const auto part = [&](const auto& values) { return values.begin() + static_cast<std::ptrdiff_t>(first); };
  const auto count = static_cast<std::ptrdiff_t>(last - first);
  points.insert(points.end(), part(from.points), part(from.points) + count);
  radii.insert(radii.end(), part(from.radii), part(from.radii) + count);
  offsets.back() = points.size();
  fillMyelinFractions(*this, !myelinFractions.empty() || !from.myelinFractions.empty());
  if (!from.myelinFractions.empty())
  {
    std::copy(part(from.myelinFractions), part(from.myelinFractions) + count, myelinFractions.end() - count);
  }
}

Fibres Fibres::emptyCopy() const
{
  Fibres copy;
  copy.domain = this->domain;
  copy.grownFraction = this->grownFraction;
  copy.orientationHarmonics = this->orientationHarmonics;
  return copy;
}

void validate(const Domain& domain)
{
  if (!domain.lower.allFinite() || !domain.upper.allFinite() || domain.size().minCoeff() <= 0.0)
  {
    throw InvalidInput("the Domain is empty or not finite: give xmin < xmax, ymin < ymax, zmin < zmax in µm");
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    requireWithin("a corner of the Domain", domain.lower[axis], limits::coordinate);
    requireWithin("a corner of the Domain", domain.upper[axis], limits::coordinate);
    requireWithin("a side of the Domain", domain.size()[axis], { limits::side.lowest, 2.0 * limits::coordinate.highest, " µm" });
  }
  if (domain.periodic[0] != domain.periodic[1] || (domain.periodic[2] && !domain.periodic[0]))
  {
    throw InvalidInput("the Domain repeats along some axes only: x and y can be periodic, or all three");
  }
}

void validate(const Fibres& fibres)
{
  if (fibres.size() == 0)
  {
    throw InvalidInput("the input holds no fibres: connect a BundleInitializer, a reader or polylines with a Radius array");
  }
  validate(fibres.domain);
  if (static_cast<double>(fibres.points.size()) > limits::controlPoints)
  {
    throw InvalidInput(text("the input holds ", fibres.points.size(), " control points, and at most ", limits::controlPoints,
      " can be counted: use fewer fibres, or segments less short"));
  }
  std::unordered_set<int> seen;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    const std::string name = "fibre " + std::to_string(fibres.fibreIds[f]) + " (cell " + std::to_string(f) + ")";
    if (fibres.fibreIds[f] < 1 || fibres.bundleIds[f] < 1)
    {
      throw InvalidInput(name + " has a FibreId or BundleId below 1: ids count from 1");
    }
    if (!seen.insert(fibres.fibreIds[f]).second)
    {
      throw InvalidInput(name + " shares its FibreId with another fibre: give each polyline its own id");
    }
    if (fibres.pointCount(f) < 2)
    {
      throw InvalidInput(name + " has " + std::to_string(fibres.pointCount(f)) + " control point(s): a fibre needs at least two");
    }
    for (std::size_t i = fibres.offsets[f]; i < fibres.offsets[f + 1]; ++i)
    {
      validateControlPoint(fibres, f, i, name);
    }
    // Checked after the radii, from which a missing target is computed.
    if (!limits::radius.holds(fibres.targetRadii[f]))
    {
      requireWithin((name + ": TargetRadius").c_str(), fibres.targetRadii[f], limits::radius);
    }
    validateRow(fibres.columns, f, name);
    if (fibres.domain.periodic[2])
    {
      periodOf(fibres, f);
    }
  }
}

FibrePeriod periodOf(const Fibres& fibres, std::size_t f)
{
  constexpr double tolerance = 1e-4; // µm, of a file with few digits
  const Eigen::Vector3d* points = fibres.points.data() + fibres.offsets[f];
  const auto differ = [&](const std::vector<double>& values, std::size_t i, std::size_t j)
  { return !values.empty() && std::abs(values[fibres.offsets[f] + i] - values[fibres.offsets[f] + j]) > tolerance; };
  const std::size_t count = fibres.pointCount(f);
  const Eigen::Vector3d size = fibres.domain.size();
  constexpr std::size_t fewest = 3; // control points, so that the first and the last one are not beside each other twice
  for (std::size_t n = fewest; n < count; ++n)
  {
    const Eigen::Vector3d along = points[n] - points[0];
    if (std::abs(std::abs(along.z()) - size.z()) > tolerance)
    {
      continue;
    }
    const Eigen::Vector3d shift = (along.array() / size.array()).round() * size.array();
    bool repeats = true;
    for (std::size_t i = 0; repeats && i + n < count; ++i)
    {
      repeats = (points[i + n] - points[i] - shift).cwiseAbs().maxCoeff() <= tolerance && !differ(fibres.radii, i, i + n) &&
                !differ(fibres.myelinFractions, i, i + n);
    }
    if (repeats)
    {
      return { n, shift };
    }
  }
  throw InvalidInput(text("fibre ", fibres.fibreIds[f], " (cell ", f,
    ") does not repeat, with its Radius and MyelinFraction, after the domain's ", size.z(),
    " µm along z, although the domain is periodic there: take it from BundleInitializer, or make the domain periodic along x and "
    "y only"));
}

bool lacksMyelin(const Fibres& fibres, std::size_t fibre)
{
  const auto begin = fibres.myelinFractions.begin();
  return !fibres.myelinFractions.empty() &&
         std::any_of(begin + static_cast<std::ptrdiff_t>(fibres.offsets[fibre]),
           begin + static_cast<std::ptrdiff_t>(fibres.offsets[fibre + 1]), [](double fraction) { return fraction < 1.0; });
}

bool isBare(const Fibres& fibres, std::size_t fibre)
{
  return fibres.columns.value(targetGRatioColumn.name, fibre) == bareGRatio;
}

double rootMeanSquareRadius(const Fibres& fibres, std::size_t fibre)
{
  const auto first = fibres.radii.begin() + static_cast<std::ptrdiff_t>(fibres.offsets[fibre]);
  const auto last = fibres.radii.begin() + static_cast<std::ptrdiff_t>(fibres.offsets[fibre + 1]);
  const auto count = static_cast<double>(last - first);
  const double mean = std::accumulate(first, last, 0.0) / count;
  double squares = 0.0;
  std::for_each(first, last, [&](double radius) { squares += (radius - mean) * (radius - mean); });
  return std::sqrt(mean * mean + squares / count);
}

double chainVolume(const Fibres& fibres, std::size_t fibre)
{
  double volume = 0.0;
  for (std::size_t i = fibres.offsets[fibre]; i + 1 < fibres.offsets[fibre + 1]; ++i)
  {
    volume += coneVolume(fibres.radii[i], fibres.radii[i + 1], (fibres.points[i + 1] - fibres.points[i]).norm());
  }
  return volume;
}

namespace
{

/// Adds the volume of the capsules [first, last) in the domain.
double volumeBetween(const Fibres& fibres, std::size_t first, std::size_t last, const Domain& domain, double volume)
{
  for (std::size_t i = first; i + 1 < last; ++i)
  {
    const auto [t0, t1] = domain.clip(fibres.points[i], fibres.points[i + 1]);
    if (t1 <= t0)
    {
      continue;
    }
    const double r0 = fibres.radii[i] + t0 * (fibres.radii[i + 1] - fibres.radii[i]);
    const double r1 = fibres.radii[i] + t1 * (fibres.radii[i + 1] - fibres.radii[i]);
    volume += coneVolume(r0, r1, (t1 - t0) * (fibres.points[i + 1] - fibres.points[i]).norm());
  }
  return volume;
}

} // namespace

double capsuleVolumeInDomain(const Fibres& fibres)
{
  double volume = 0.0;
  const Domain domain = fibres.domain.unrolled();
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    volume = volumeBetween(fibres, fibres.offsets[f], fibres.offsets[f + 1], domain, volume);
  }
  return volume;
}

double capsuleVolumeInDomain(const Fibres& fibres, std::size_t fibre)
{
  return volumeBetween(fibres, fibres.offsets[fibre], fibres.offsets[fibre + 1], fibres.domain.unrolled(), 0.0);
}

double targetVolumeInDomain(const Fibres& fibres)
{
  double volume = 0.0;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    const double factor = fibres.targetRadii[f] / rootMeanSquareRadius(fibres, f);
    volume += factor * factor * capsuleVolumeInDomain(fibres, f);
  }
  return volume;
}

std::map<int, Eigen::Vector3d> bundleAxes(const Fibres& fibres)
{
  std::map<int, Eigen::Vector3d> axes;
  std::map<int, Eigen::Vector3d> sense;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    const Eigen::Vector3d direction = endToEnd(fibres, f);
    const int bundle = fibres.bundleIds[f];
    if (sense.count(bundle) == 0 && direction.squaredNorm() > 0.0)
    {
      sense[bundle] = direction;
      axes[bundle].setZero();
    }
    if (sense.count(bundle) > 0)
    {
      axes[bundle] += direction.dot(sense[bundle]) < 0.0 ? Eigen::Vector3d(-direction) : direction;
    }
  }
  for (auto& entry : axes)
  {
    entry.second.normalize();
  }
  // Fibres that all end where they begin have no direction.
  for (const int bundle : fibres.bundleIds)
  {
    axes.emplace(bundle, Eigen::Vector3d::UnitZ());
  }
  return axes;
}

double angleBetweenLines(const Eigen::Vector3d& direction, const Eigen::Vector3d& axis)
{
  // atan2 keeps full precision at small angles, where acos loses half the digits.
  return radian * std::atan2(direction.cross(axis).norm(), std::abs(direction.dot(axis)));
}

double meanDispersion(const Fibres& fibres, int bundleId)
{
  const auto axes = bundleAxes(fibres);
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    const auto axis = axes.find(fibres.bundleIds[f]);
    if (axis != axes.end() && (bundleId == 0 || bundleId == fibres.bundleIds[f]))
    {
      sum += angleBetweenLines(endToEnd(fibres, f), axis->second);
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

double meanTangentDispersion(const Fibres& fibres, int bundleId)
{
  const auto axes = bundleAxes(fibres);
  double sum = 0.0;
  double length = 0.0;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    const auto axis = axes.find(fibres.bundleIds[f]);
    if (axis == axes.end() || (bundleId != 0 && bundleId != fibres.bundleIds[f]))
    {
      continue;
    }
    for (std::size_t i = fibres.offsets[f]; i + 1 < fibres.offsets[f + 1]; ++i)
    {
      const Eigen::Vector3d d = fibres.points[i + 1] - fibres.points[i];
      sum += d.norm() * angleBetweenLines(d, axis->second);
      length += d.norm();
    }
  }
  return length > 0.0 ? sum / length : 0.0;
}

} // namespace cactus
