// SPDX-License-Identifier: BSD-3-Clause
#include "BundleBox.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace cactus
{

namespace
{

/// Widens the box laterally until the bundle's capsules fill no more of it than `packingLimit`.
void expandToDensity(const Fibres& fibres, int bundle, double packingLimit, BundleBox& box)
{
  double volume = 0.0;
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    if (fibres.bundleIds[f] != bundle)
    {
      continue;
    }
    volume += chainVolume(fibres, f);
    for (std::size_t i = fibres.offsets[f]; i < fibres.offsets[f + 1]; ++i)
    {
      const double height = fibres.points[i].dot(box.axis);
      lowest = std::min(lowest, height);
      highest = std::max(highest, height);
    }
  }
  const double width = box.upperU - box.lowerU;
  const double depth = box.upperV - box.lowerV;
  const double density = volume / (width * depth * (highest - lowest));
  const double growth = 0.5 * (std::sqrt(std::max(1.0, density / packingLimit)) - 1.0);
  box.lowerU -= growth * width;
  box.upperU += growth * width;
  box.lowerV -= growth * depth;
  box.upperV += growth * depth;
}

} // namespace

std::vector<BundleBox> bundleBoxes(const Fibres& fibres, double packingLimit)
{
  std::map<int, BundleBox> boxes;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    auto found = boxes.find(fibres.bundleIds[f]);
    if (found == boxes.end())
    {
      BundleBox box;
      box.axis = bundleAxis(fibres, fibres.bundleIds[f]);
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
    expandToDensity(fibres, entry.first, packingLimit, entry.second);
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
  const std::vector<BundleBox> tight = bundleBoxes(fibres, 1.0);
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
