// SPDX-License-Identifier: BSD-3-Clause
#include "fibres/JoinFibres.h"

#include "base/Error.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

namespace cactus
{

namespace
{

/// Returns the ids of `added`, all moved above the largest of `taken` if one of them is in use.
std::vector<int> freeIds(const std::vector<int>& taken, const std::vector<int>& added)
{
  const std::unordered_set<int> used(taken.begin(), taken.end());
  const bool isFree = std::none_of(added.begin(), added.end(), [&](int id) { return used.count(id) > 0; });
  const std::int64_t shift = isFree ? 0 : *std::max_element(taken.begin(), taken.end());
  std::vector<int> ids;
  for (const int id : added)
  {
    if (id + shift > std::numeric_limits<int>::max())
    {
      throw InvalidInput("id " + std::to_string(id) + " is in use by another input or block, and there is none free above " +
                         std::to_string(shift) + ": give the fibres smaller ids");
    }
    ids.push_back(static_cast<int>(id + shift));
  }
  return ids;
}

/// Returns the sum of two lists of harmonics; none if one is unknown.
std::vector<double> sumOf(const std::vector<double>& a, const std::vector<double>& b)
{
  if (a.empty() || b.empty())
  {
    return {};
  }
  std::vector<double> sum = a.size() < b.size() ? b : a;
  const std::vector<double>& shorter = a.size() < b.size() ? a : b;
  std::transform(shorter.begin(), shorter.end(), sum.begin(), sum.begin(), std::plus<>());
  return sum;
}

} // namespace

bool appendFibres(const Fibres& added, Fibres& all)
{
  const std::vector<int> fibreIds = freeIds(all.fibreIds, added.fibreIds);
  const std::vector<int> bundleIds = freeIds(all.bundleIds, added.bundleIds);
  // Bundles that were made by themselves all count their fibres from 1, while pieces of one substrate share what it says as a
  // whole.
  const bool isPartOfTheSame = fibreIds == added.fibreIds && all.grownFraction == added.grownFraction;
  for (std::size_t f = 0; f < added.size(); ++f)
  {
    all.addFibre(added, f);
    all.fibreIds.back() = fibreIds[f];
    all.bundleIds.back() = bundleIds[f];
    all.addPoints(added, added.offsets[f], added.offsets[f + 1]);
  }
  if (isPartOfTheSame)
  {
    if (all.orientationHarmonics != added.orientationHarmonics)
    {
      all.orientationHarmonics.clear();
    }
    return true;
  }
  const bool isKnown = all.grownFraction > 0.0 && added.grownFraction > 0.0;
  all.grownFraction = isKnown ? all.grownFraction + added.grownFraction : 0.0;
  all.orientationHarmonics = sumOf(all.orientationHarmonics, added.orientationHarmonics);
  return false;
}

Fibres joinFibres(std::vector<Fibres> inputs)
{
  Fibres all;
  for (std::size_t i = 0; i < inputs.size(); ++i)
  {
    if (i == 0)
    {
      all = std::move(inputs.front());
      continue;
    }
    if (!isSame(inputs[i].domain, all.domain))
    {
      throw InvalidInput("input " + std::to_string(i + 1) +
                         " has another Domain than the first: give all bundles the same Side and periodic borders");
    }
    appendFibres(inputs[i], all);
  }
  return all;
}

bool isSame(const Domain& a, const Domain& b)
{
  return (a.lower - b.lower).cwiseAbs().maxCoeff() <= 1e-9 && (a.upper - b.upper).cwiseAbs().maxCoeff() <= 1e-9 &&
         a.periodic == b.periodic;
}

} // namespace cactus
