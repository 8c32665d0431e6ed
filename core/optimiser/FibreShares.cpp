// SPDX-License-Identifier: BSD-3-Clause
#include "optimiser/FibreShares.h"

#include "base/Error.h"
#include "fibres/SelectFibres.h"

#include <algorithm>
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
  const auto count = static_cast<std::size_t>(sharing.size());
  const std::size_t capsules = fibres.points.size() - fibres.size();
  std::size_t f = 0;
  for (std::size_t process = 0; process <= count; ++process)
  {
    while (f < fibres.size() && (process == count || fibres.offsets[f] - f < capsules * process / count))
    {
      ++f;
    }
    this->FibreBegin.push_back(f);
    this->PointBegin.push_back(fibres.offsets[f]);
  }
}

std::size_t FibreShares::ownerOf(std::size_t capsule) const
{
  std::size_t process = 0;
  while (capsule >= this->capsuleBegin(process + 1))
  {
    ++process;
  }
  return process;
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
