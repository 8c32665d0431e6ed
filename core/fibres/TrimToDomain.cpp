// SPDX-License-Identifier: BSD-3-Clause
#include "fibres/TrimToDomain.h"

#include "base/Error.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace cactus
{

namespace
{

/// Tells whether a fibre that leaves after one control point comes back at another so near that the two pieces, grown by up to
/// their radius, could meet: then they stay one piece.
bool comesBackAtOnce(const Fibres& fibres, std::size_t left, std::size_t back)
{
  return (fibres.points[back] - fibres.points[left]).norm() < 2.0 * (fibres.radii[left] + fibres.radii[back]);
}

} // namespace

Fibres trimToDomain(const Fibres& fibres, std::vector<std::size_t>* kept)
{
  Fibres trimmed = fibres.emptyCopy();
  if (kept != nullptr)
  {
    kept->clear();
  }
  if (fibres.domain.periodic[2])
  {
    if (kept != nullptr)
    {
      kept->resize(fibres.points.size());
      std::iota(kept->begin(), kept->end(), std::size_t(0));
    }
    return fibres;
  }
  const Domain domain = fibres.domain.unrolled();
  int largestId = fibres.fibreIds.empty() ? 0 : *std::max_element(fibres.fibreIds.begin(), fibres.fibreIds.end());
  const auto freeId = [&]
  {
    if (largestId == std::numeric_limits<int>::max())
    {
      throw InvalidInput(text(
        "a fibre comes back into the domain, and there is no FibreId free above ", largestId, ": give the fibres smaller ids"));
    }
    return ++largestId;
  };
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    std::vector<std::pair<std::size_t, std::size_t>> pieces; // first and last control point
    for (std::size_t i = fibres.offsets[f]; i + 1 < fibres.offsets[f + 1]; ++i)
    {
      const auto [enter, leave] =
        domain.clip(fibres.points[i], fibres.points[i + 1], 2.0 * std::max(fibres.radii[i], fibres.radii[i + 1]));
      if (leave < enter)
      {
        continue;
      }
      if (!pieces.empty() && (pieces.back().second == i || comesBackAtOnce(fibres, pieces.back().second, i)))
      {
        pieces.back().second = i + 1;
      }
      else
      {
        pieces.emplace_back(i, i + 1);
      }
    }
    const auto longest = std::max_element(
      pieces.begin(), pieces.end(), [](const auto& a, const auto& b) { return a.second - a.first < b.second - b.first; });
    for (auto piece = pieces.begin(); piece != pieces.end(); ++piece)
    {
      trimmed.addFibre(fibres, f);
      trimmed.fibreIds.back() = piece == longest ? fibres.fibreIds[f] : freeId();
      trimmed.addPoints(fibres, piece->first, piece->second + 1);
      for (std::size_t i = piece->first; kept != nullptr && i <= piece->second; ++i)
      {
        kept->push_back(i);
      }
    }
  }
  return trimmed;
}

} // namespace cactus
