// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/FibreShares.h"

#include "base/Error.h"
#include "base/EvenParts.h"
#include "fibres/SelectFibres.h"

#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace cactus
{

FibreShares::FibreShares(const Fibres& fibres, const Sharing& sharing)
  : Processes(sharing)
  , FibreIds(fibres.fibreIds)
{
  require(fibres.points.size() <= std::numeric_limits<std::uint32_t>::max(),
    "the fibres have more control points than 32 bits count: make the domain smaller, or the points fewer");
  std::vector<double> capsules;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    capsules.push_back(static_cast<double>(fibres.pointCount(f) - 1));
  }
  this->FibreBegin = evenParts(capsules, static_cast<std::size_t>(sharing.size()));
  for (const std::size_t f : this->FibreBegin)
  {
    this->PointBegin.push_back(fibres.offsets[f]);
  }
}

FibreShares::FibreShares(const Fibres& coarser, const FibreShares& alike)
  : Processes(alike.Processes)
  , FibreBegin(alike.FibreBegin)
  , FibreIds(alike.FibreIds)
{
  for (const std::size_t f : this->FibreBegin)
  {
    this->PointBegin.push_back(coarser.offsets[f]);
  }
}

Fibres FibreShares::own(Fibres all) const
{
  if (this->processes() == 1)
  {
    return all;
  }
  std::vector<std::size_t> own(this->fibreBegin(this->self() + 1) - this->ownFibre());
  std::iota(own.begin(), own.end(), this->ownFibre());
  return selectFibres(all, own);
}

} // namespace cactus
