// SPDX-License-Identifier: BSD-3-Clause
// Common set-up and results of growth tests.
#pragma once

#include "base/Constants.h"
#include "bundle/BundleInitializer.h"
#include "growth/FibreRadialGrowth.h"
#include "growth/GrowthTarget.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cactus_testing
{

inline cactus::Fibres emptyFibres(double side)
{
  cactus::Fibres fibres;
  fibres.domain = cactus::Domain::cube(side);
  return fibres;
}

inline cactus::LabelImage grown(const cactus::Fibres& fibres, const cactus::FibreRadialGrowthOptions& options, int threads = 2)
{
  cactus::Context context;
  context.threads = threads;
  return growFibres(fibres, options, growthFor(fibres, options, context).growth, growthGrid(fibres.domain, options), context);
}

/// Straight fibres for a volume fraction of 0.7 between walls of 8 µm.
inline cactus::Fibres straightBundle(double axisRatio)
{
  cactus::BundleInitializerOptions bundle;
  bundle.side = 8.0;
  bundle.fibreVolumeFraction = 0.5;
  bundle.grownFibreVolumeFraction = 0.7;
  bundle.border = cactus::Border::Walls;
  bundle.calibre.deviation = 0.0;
  bundle.calibre.sectionAxisRatio = axisRatio;
  bundle.meanDispersion = 0.0;
  return cactus::initialiseBundles(bundle, {}, nullptr);
}

/// Returns how many pieces connected by faces a fibre has in an image.
inline int piecesOf(const cactus::LabelImage& image, std::int32_t fibre)
{
  const auto& count = image.grid.count;
  std::vector<bool> seen(image.fibreId.size(), false);
  int pieces = 0;
  for (std::size_t start = 0; start < seen.size(); ++start)
  {
    if (image.fibreId[start] != fibre || seen[start])
    {
      continue;
    }
    ++pieces;
    std::vector<std::size_t> open{ start };
    seen[start] = true;
    while (!open.empty())
    {
      const std::size_t at = open.back();
      open.pop_back();
      const std::size_t strides[3] = { 1, std::size_t(count[0]), std::size_t(count[0]) * std::size_t(count[1]) };
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const std::size_t place = at / strides[axis] % std::size_t(count[axis]);
        for (const int side : { -1, 1 })
        {
          const std::size_t next = side < 0 ? at - strides[axis] : at + strides[axis];
          const bool isInside = side < 0 ? place > 0 : place + 1 < std::size_t(count[axis]);
          if (isInside && image.fibreId[next] == fibre && !seen[next])
          {
            seen[next] = true;
            open.push_back(next);
          }
        }
      }
    }
  }
  return pieces;
}

/// Checks that a straightBundle() is grown to its fraction, each fibre in one piece, and to its TargetRadius on average.
inline void expectOnTarget(const cactus::LabelImage& image, const cactus::Fibres& fibres)
{
  const auto inside = std::count_if(image.fibreId.begin(), image.fibreId.end(), [](std::int32_t id) { return id > 0; });
  EXPECT_NEAR(double(inside) / double(image.fibreId.size()), 0.7, 0.005);
  double relative = 0.0;
  for (std::size_t f = 0; f < fibres.size(); ++f)
  {
    EXPECT_EQ(piecesOf(image, fibres.fibreIds[f]), 1);
    const auto own = std::count(image.fibreId.begin(), image.fibreId.end(), fibres.fibreIds[f]);
    const double area = double(own) * std::pow(image.grid.spacing, 3.0) / 8.0;
    relative += std::sqrt(area / cactus::pi) / fibres.targetRadii[f] - 1.0;
  }
  EXPECT_NEAR(relative / double(fibres.size()), 0.0, 0.02);
}

} // namespace cactus_testing
