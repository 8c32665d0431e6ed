// SPDX-License-Identifier: BSD-3-Clause
#include "fibres/SelectFibres.h"

#include <algorithm>
#include <numeric>

namespace cactus
{

Fibres selectFibres(const Fibres& fibres, const std::vector<std::size_t>& which)
{
  Fibres selected;
  selected.domain = fibres.domain;
  selected.grownFraction = fibres.grownFraction;
  std::size_t points = 0;
  for (const std::size_t f : which)
  {
    points += fibres.pointCount(f);
  }
  selected.points.reserve(points);
  selected.radii.reserve(points);
  for (const std::size_t f : which)
  {
    selected.addFibre(fibres.fibreIds[f], fibres.bundleIds[f], fibres.targetRadii[f]);
    for (std::size_t i = fibres.offsets[f]; i < fibres.offsets[f + 1]; ++i)
    {
      selected.addPoint(fibres.points[i], fibres.radii[i]);
    }
  }
  return selected;
}

std::vector<std::size_t> orderById(const Fibres& fibres)
{
  std::vector<std::size_t> order(fibres.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return fibres.fibreIds[a] < fibres.fibreIds[b]; });
  return order;
}

} // namespace cactus
