// SPDX-License-Identifier: BSD-3-Clause
#include "growth/RankedGrowth.h"

#include "fibres/FibreShape.h"

namespace cactus
{

namespace
{

/// The growth of an axon without myelin before it slows down, in target radii. aimAtTargetRadii() sets its radius for the rest.
constexpr double evenOfBare = 0.3;

} // namespace

bool slowsBare(const Fibres& fibres, const FibreRadialGrowthOptions& options)
{
  bool isAny = false;
  for (std::size_t f = 0; f < fibres.size() && !isAny; ++f)
  {
    isAny = isBare(fibres, f);
  }
  if (!isAny || targetFraction(fibres, options) <= 0.0)
  {
    return false;
  }
  double bare = 0.0;
  double others = 0.0;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    (isBare(fibres, f) ? bare : others) += fibres.targetRadii[f] * fibres.targetRadii[f] * lengthInDomain(fibres, f);
  }
  return bare < others;
}

RankedGrowth::RankedGrowth(
  const Fibres& fibres, const FibreRadialGrowthOptions& options, const CapsuleField& field, double growth)
  : Common(growth)
{
  if (slowsBare(fibres, options))
  {
    for (std::size_t rank = 0; rank < field.size(); ++rank)
    {
      const std::size_t f = field.fibre(static_cast<int>(rank));
      this->Even.push_back(isBare(fibres, f) ? evenOfBare * fibres.targetRadii[f] : std::numeric_limits<double>::infinity());
    }
  }
}

} // namespace cactus
