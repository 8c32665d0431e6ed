// SPDX-License-Identifier: BSD-3-Clause
#include "fibres/SelectFibres.h"

#include <algorithm>
#include <numeric>

namespace cactus
{

Fibres selectFibres(const Fibres& fibres, const std::vector<std::size_t>& which)
{
  Fibres selected = fibres.emptyCopy();
  std::size_t points = 0;
  for (const std::size_t f : which)
  {
    points += fibres.pointCount(f);
  }
  selected.points.reserve(points);
  selected.radii.reserve(points);
  for (const std::size_t f : which)
  {
    selected.addFibre(fibres, f);
    selected.addPoints(fibres, fibres.offsets[f], fibres.offsets[f + 1]);
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
