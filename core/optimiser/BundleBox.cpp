// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/BundleBox.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace cactus
{

namespace
{

/// The content of a bundle, for its density.
struct BundleContent
{
  double volume = 0.0;
  double lowest = std::numeric_limits<double>::infinity(); ///< along the axis
  double highest = -std::numeric_limits<double>::infinity();
  double thickest = 0.0; ///< radius

  void add(const Fibres& fibres, std::size_t f, const Eigen::Vector3d& axis)
  {
    this->volume += chainVolume(fibres, f);
    for (std::size_t i = fibres.offsets[f]; i < fibres.offsets[f + 1]; ++i)
    {
      const double height = fibres.points[i].dot(axis);
      this->lowest = std::min(this->lowest, height);
      this->highest = std::max(this->highest, height);
      this->thickest = std::max(this->thickest, fibres.radii[i]);
    }
  }
};

/// How a bundle's volume is spread along a lateral direction.
class Spread
{
public:
  void add(double place, double volume)
  {
    this->Weight += volume;
    this->First += volume * place;
    this->Second += volume * place * place;
  }

  /// Narrows limits that lie outside the domain to those of an even distribution with the same variance, and a little room, but
  /// not into the domain. Returns whether that changed them.
  bool narrow(double domainLower, double domainUpper, double& lower, double& upper) const
  {
    constexpr double room = 1.045;
    constexpr double beyond = 1.0; // µm
    if (lower > domainLower - beyond || upper < domainUpper + beyond)
    {
      return false;
    }
    const double mean = this->First / this->Weight;
    const double half = room * std::sqrt(3.0 * std::max(0.0, this->Second / this->Weight - mean * mean));
    const double low = std::max(lower, std::min(mean - half, domainLower - beyond));
    const double high = std::min(upper, std::max(mean + half, domainUpper + beyond));
    const bool isNarrower = low > lower || high < upper;
    lower = low;
    upper = high;
    return isNarrower;
  }

private:
  double Weight = 0.0;
  double First = 0.0;
  double Second = 0.0;
};

/// Cuts the box of a bundle that frays to its bulk.
void cutToBulk(const Fibres& fibres, int bundle, BundleBox& box)
{
  Spread alongU;
  Spread alongV;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    for (std::size_t i = fibres.offsets[f]; fibres.bundleIds[f] == bundle && i + 1 < fibres.offsets[f + 1]; ++i)
    {
      const double volume = fibres.radii[i] * fibres.radii[i] * (fibres.points[i + 1] - fibres.points[i]).norm();
      alongU.add(fibres.points[i].dot(box.u), volume);
      alongV.add(fibres.points[i].dot(box.v), volume);
    }
  }
  const Eigen::Vector3d half = 0.5 * fibres.domain.size();
  const Eigen::Vector3d centre = 0.5 * (fibres.domain.lower + fibres.domain.upper);
  const auto narrow = [&](const Spread& spread, const Eigen::Vector3d& direction, double& lower, double& upper)
  {
    const double side = half.dot(direction.cwiseAbs());
    return spread.narrow(centre.dot(direction) - side, centre.dot(direction) + side, lower, upper);
  };
  box.holds = narrow(alongU, box.u, box.lowerU, box.upperU);
  box.holds = narrow(alongV, box.v, box.lowerV, box.upperV) || box.holds;
}

/// Widens the box laterally until the bundle's capsules fill no more of it than `packingLimit`.
void expandToDensity(const BundleContent& content, double packingLimit, BundleBox& box)
{
  const double width = box.upperU - box.lowerU;
  const double depth = box.upperV - box.lowerV;
  // Fibres that all lie across the axis, as flat loops do, are at least as high as the thickest of them.
  const double height = std::max(content.highest - content.lowest, 2.0 * content.thickest);
  const double density = content.volume / (width * depth * height);
  const double growth = 0.5 * (std::sqrt(std::max(1.0, density / packingLimit)) - 1.0);
  box.lowerU -= growth * width;
  box.upperU += growth * width;
  box.lowerV -= growth * depth;
  box.upperV += growth * depth;
}

} // namespace

std::vector<BundleBox> bundleBoxes(const Fibres& fibres, double packingLimit)
{
  const std::map<int, Eigen::Vector3d> axes = bundleAxes(fibres);
  std::map<int, BundleBox> boxes;
  std::map<int, BundleContent> contents;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    auto found = boxes.find(fibres.bundleIds[f]);
    if (found == boxes.end())
    {
      BundleBox box;
      box.axis = axes.at(fibres.bundleIds[f]);
      int lateral = 0;
      box.axis.cwiseAbs().minCoeff(&lateral);
      box.v = Eigen::Vector3d::Unit(lateral);
      box.v = (box.v - box.v.dot(box.axis) * box.axis).normalized();
      box.u = box.v.cross(box.axis);
      box.lowerU = box.lowerV = std::numeric_limits<double>::infinity();
      box.upperU = box.upperV = -std::numeric_limits<double>::infinity();
      found = boxes.emplace(fibres.bundleIds[f], box).first;
    }
    BundleBox& box = found->second;
    contents[fibres.bundleIds[f]].add(fibres, f, box.axis);
    for (std::size_t i = fibres.offsets[f]; i < fibres.offsets[f + 1]; ++i)
    {
      const double u = fibres.points[i].dot(box.u);
      const double v = fibres.points[i].dot(box.v);
      const double r = fibres.radii[i];
      box.lowerU = std::min(box.lowerU, u - r);
      box.upperU = std::max(box.upperU, u + r);
      box.lowerV = std::min(box.lowerV, v - r);
      box.upperV = std::max(box.upperV, v + r);
    }
  }
  for (auto& entry : boxes)
  {
    if (fibres.domain.isPeriodic())
    {
      // The copies of the domain confine the fibres.
      constexpr double everywhere = 1e9;
      entry.second.lowerU = entry.second.lowerV = -everywhere;
      entry.second.upperU = entry.second.upperV = everywhere;
      continue;
    }
    if (boxes.size() > 1)
    {
      cutToBulk(fibres, entry.first, entry.second);
    }
    expandToDensity(contents.at(entry.first), packingLimit, entry.second);
  }
  std::vector<BundleBox> perFibre;
  for (const int bundle : fibres.bundleIds)
  {
    perFibre.push_back(boxes.at(bundle));
  }
  return perFibre;
}

void spreadBundles(Fibres& fibres, double packingLimit)
{
  if (fibres.domain.isPeriodic())
  {
    return;
  }
  const std::vector<BundleBox> tight = bundleBoxes(fibres, std::numeric_limits<double>::infinity());
  const std::vector<BundleBox> wide = bundleBoxes(fibres, packingLimit);
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (std::size_t i = fibres.offsets[f]; i < fibres.offsets[f + 1]; ++i)
    {
      middle += fibres.points[i] / static_cast<double>(fibres.pointCount(f));
    }
    const BundleBox& from = tight[f];
    const BundleBox& to = wide[f];
    const double growthU = (to.upperU - to.lowerU) / (from.upperU - from.lowerU) - 1.0;
    const double growthV = (to.upperV - to.lowerV) / (from.upperV - from.lowerV) - 1.0;
    const Eigen::Vector3d shift = growthU * (middle.dot(to.u) - 0.5 * (to.lowerU + to.upperU)) * to.u +
                                  growthV * (middle.dot(to.v) - 0.5 * (to.lowerV + to.upperV)) * to.v;
    for (std::size_t i = fibres.offsets[f]; i < fibres.offsets[f + 1]; ++i)
    {
      fibres.points[i] += shift;
    }
  }
}

} // namespace cactus
