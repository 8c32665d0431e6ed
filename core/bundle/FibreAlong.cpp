// SPDX-License-Identifier: BSD-3-Clause
#include "bundle/FibreAlong.h"

#include "bundle/TractPath.h"

#include <algorithm>
#include <cmath>

namespace cactus
{

namespace
{

/// Returns the part of a line between its first entry into a domain grown by `margin` and its last exit.
std::vector<Eigen::Vector3d> partWithin(const std::vector<Eigen::Vector3d>& line, const Domain& domain, double margin)
{
  std::vector<Eigen::Vector3d> kept;
  std::vector<Eigen::Vector3d> outside; ///< points since the last exit
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
  {
    const auto part = domain.clip(line[i], line[i + 1], margin);
    const Eigen::Vector3d along = line[i + 1] - line[i];
    if (part[1] > part[0])
    {
      kept.insert(kept.end(), outside.begin(), outside.end());
      outside.clear();
      if (kept.empty())
      {
        kept.emplace_back(line[i] + part[0] * along);
      }
      kept.emplace_back(line[i] + part[1] * along);
    }
    else if (!kept.empty())
    {
      outside.push_back(line[i + 1]);
    }
  }
  return kept;
}

/// Adds a fibre along a line, with evenly spaced control points.
void addAlong(
  const std::vector<Eigen::Vector3d>& line, double length, int bundleId, double radius, double spacing, Fibres& fibres)
{
  const int segments = std::max(2, static_cast<int>(std::lround(length / spacing)));
  fibres.addFibre(static_cast<int>(fibres.size()) + 1, bundleId, radius);
  fibres.addPoint(line.front(), radius);
  double begin = 0.0;
  int next = 1;
  for (std::size_t i = 1; i < line.size() && next < segments; ++i)
  {
    const Eigen::Vector3d along = line[i] - line[i - 1];
    const double step = along.norm();
    for (; next < segments && length * next / segments <= begin + step; ++next)
    {
      fibres.addPoint(line[i - 1] + (length * next / segments - begin) / step * along, radius);
    }
    begin += step;
  }
  fibres.addPoint(line.back(), radius);
}

} // namespace

void addFibreAlong(const std::vector<Eigen::Vector3d>& line, int bundleId, const FibreSize& size, Fibres& fibres)
{
  const std::vector<Eigen::Vector3d> kept = partWithin(line, fibres.domain, size.margin + size.target);
  const double length = lengthOf(kept);
  // A shorter piece cuts a corner of the grown domain, too far outside for the fibre to touch the domain.
  if (length > 0.8 * size.target)
  {
    addAlong(kept, length, bundleId, size.radius, size.spacing, fibres);
    fibres.targetRadii.back() = size.target;
    if (size.isBare)
    {
      fibres.columns.set(targetGRatioColumn.name, fibres.size() - 1, bareGRatio);
    }
  }
}

} // namespace cactus
