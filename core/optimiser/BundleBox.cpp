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
