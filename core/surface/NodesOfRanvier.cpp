// SPDX-License-Identifier: BSD-3-Clause
#include "surface/NodesOfRanvier.h"

#include "base/Random.h"
#include "fibres/FibreShape.h"
#include "fibres/SelectFibres.h"

#include <algorithm>
#include <cmath>

namespace cactus
{

namespace
{

/// Shortest internode, in paranodes: half of it has all of its myelin.
constexpr double leastParanodes = 4.0;

/// Returns the distance (µm) from the middle of a node to that of the next, of a fibre of this outer diameter (µm).
double spacingOf(const MyelinSurfaceOptions& options, double diameter)
{
  return options.nodeLength + std::max(options.internodeFactor * diameter, leastParanodes * options.paranodeLength);
}

} // namespace

std::vector<double> internodeLosses(const Fibres& fibres, const MyelinSurfaceOptions& options)
{
  std::vector<double> losses(fibres.size(), options.internodeLoss);
  if (options.internodeOrder == InternodeOrder::Random)
  {
    return losses;
  }
  std::vector<double> internodes(fibres.size(), 0.0);
  double left = 0.0; // to lose
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    if (!isBare(fibres, f))
    {
      internodes[f] = lengthInDomain(fibres, f) / spacingOf(options, 2.0 * fibres.targetRadii[f]);
      left += options.internodeLoss * internodes[f];
    }
  }
  std::vector<std::size_t> order = orderById(fibres);
  std::stable_sort(order.begin(), order.end(),
    [&](std::size_t one, std::size_t other) { return fibres.targetRadii[one] < fibres.targetRadii[other]; });
  for (const std::size_t f : order)
  {
    losses[f] = internodes[f] > 0.0 ? std::min(1.0, left / internodes[f]) : 0.0;
    left = std::max(0.0, left - internodes[f]);
  }
  return losses;
}

NodesOfRanvier::NodesOfRanvier(
  const MyelinSurfaceOptions& options, std::int32_t fibreId, double diameter, double loss, double period)
  : Seed(options.nodeSeed)
  , FibreId(static_cast<std::uint64_t>(fibreId))
  , Loss(loss)
  , Remyelinated(options.remyelinatedFraction)
  , HalfNode(0.5 * options.nodeLength)
  , Paranode(options.paranodeLength)
{
  RandomEngine engine = randomStream(this->Seed, RandomStage::Nodes, this->FibreId);
  const double phase = uniform(engine);
  this->Spacing = spacingOf(options, diameter);
  if (period > 0.0)
  {
    this->PerPeriod = std::floor(period / this->Spacing + uniform(engine));
    this->Spacing = this->PerPeriod > 0.0 ? period / this->PerPeriod : 0.0;
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

/// Returns the number of the internode at a place, counted from the first node; that of its first image in a line that repeats.
double NodesOfRanvier::internodeNumber(double along) const
{
  if (this->Spacing == 0.0)
  {
    return 0.0;
  }
  const double number = std::floor((along - this->First) / this->Spacing);
  return this->PerPeriod > 0.0 ? number - this->PerPeriod * std::floor(number / this->PerPeriod) : number;
}

Internode NodesOfRanvier::internodeAt(double along) const
{
  if (this->Loss == 0.0)
  {
    return Internode::Whole;
  }
  const auto number = static_cast<std::uint32_t>(static_cast<std::int64_t>(this->internodeNumber(along)));
  RandomEngine engine = randomStream(this->Seed, RandomStage::Internodes, this->FibreId << 32U | number);
  if (uniform(engine) >= this->Loss)
  {
    return Internode::Whole;
  }
  return uniform(engine) < this->Remyelinated ? Internode::Remyelinated : Internode::Lost;
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
  const std::vector<double> nodes = this->between(from - reach, to + reach);
  // Without a node or a paranode, one internode reaches from end to end.
  return !nodes.empty() || this->internodeAt(from) != Internode::Whole;
}

} // namespace cactus
