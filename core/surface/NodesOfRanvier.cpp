// SPDX-License-Identifier: BSD-3-Clause
#include "surface/NodesOfRanvier.h"

#include "base/Random.h"

#include <algorithm>
#include <cmath>

namespace cactus
{

namespace
{

/// Shortest internode, in paranodes: half of it has all of its myelin.
constexpr double leastParanodes = 4.0;

} // namespace

NodesOfRanvier::NodesOfRanvier(const MyelinSurfaceOptions& options, std::int32_t fibreId, double diameter, double period)
  : HalfNode(0.5 * options.nodeLength)
  , Paranode(options.paranodeLength)
{
  RandomEngine engine = randomStream(options.nodeSeed, RandomStage::Nodes, static_cast<std::uint64_t>(fibreId));
  const double phase = uniform(engine);
  this->Spacing = options.nodeLength + std::max(options.internodeFactor * diameter, leastParanodes * options.paranodeLength);
  if (period > 0.0)
  {
    const double count = std::floor(period / this->Spacing + uniform(engine));
    this->Spacing = count > 0.0 ? period / count : 0.0;
  }
  this->First = phase * this->Spacing;
}

double NodesOfRanvier::myelinPart(double along) const
{
  if (this->Spacing == 0.0)
  {
    return 1.0;
  }
  const double way = along - this->First;
  const double fromMiddle = std::abs(way - this->Spacing * std::round(way / this->Spacing));
  const double part = std::clamp((fromMiddle - this->HalfNode) / this->Paranode, 0.0, 1.0);
  return part * part * (3.0 - 2.0 * part);
}

std::vector<double> NodesOfRanvier::between(double from, double to) const
{
  std::vector<double> middles;
  for (double n = this->Spacing > 0.0 ? std::ceil((from - this->First) / this->Spacing) : 0.0;
       this->Spacing > 0.0 && this->First + n * this->Spacing <= to; n += 1.0)
  {
    middles.push_back(this->First + n * this->Spacing);
  }
  return middles;
}

bool NodesOfRanvier::reachInto(double from, double to) const
{
  const double reach = this->HalfNode + this->Paranode;
  return !this->between(from - reach, to + reach).empty();
}

} // namespace cactus
