// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: nodes in thin fibres and beside them are smoothed in part, all others fully, wherever thin fibres are.
#include "surface/ThinFibres.h"

#include "growth/FibreRadialGrowth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace
{

using namespace cactus;

/// A thick fibre, and a thin one away from it.
LabelImage thickAndThin(const FibreRadialGrowthOptions& options)
{
  Fibres fibres;
  fibres.domain = Domain::cube(6.0);
  const std::array<double, 2> radii{ { 1.0, 0.25 } };
  for (int f = 0; f < 2; ++f)
  {
    fibres.addFibre(f + 1, 1, radii[std::size_t(f)]);
    fibres.addPoint({ -1.5 + 3.0 * f, 0.2 * f, -4.0 }, radii[std::size_t(f)]);
    fibres.addPoint({ -1.5 + 3.0 * f, 0.5, 4.0 }, radii[std::size_t(f)]);
  }
  return growFibres(fibres, options, 0.05, growthGrid(fibres.domain, options));
}

TEST(ThinFibres, AreSparedWhereverTheyAre)
{
  FibreRadialGrowthOptions options;
  const LabelImage image = thickAndThin(options);
  const FibreField field({ image.grid, image.fibreId.data(), image.depth.data(), options.gap() }, Domain::cube(6.0), true);
  const FoundFibres found = findFibres(field);
  const auto radiusOf = [&](const FoundFibre& fibre) { return 3.0 * fibre.depths / (fibre.samples * image.grid.spacing); };
  ASSERT_GT(radiusOf(found.at(1)), 4.0); // voxels
  const auto part = static_cast<float>((radiusOf(found.at(2)) - 2.0) / 2.0);
  ASSERT_GT(part, 0.0f);
  ASSERT_LT(part, 1.0f);
  const auto partAt = [&](int i, int j, int k)
  {
    const std::int32_t id = image.fibreId[image.grid.index(i, j, k)];
    return id == 2 ? part : id == 1 ? 1.0f : 2.0f;
  };

  const ThinFibres thin(field, found);
  int spared = 0;
  int left = 0;
  constexpr int edge = 12; // no part of a piece of the image
  std::array<float, edge * edge * edge> out{};
  LabelBuffer buffer;
  for (int first = 0; first < 4 * 4 * 4; ++first)
  {
    // Node 1 is sample 0.
    const std::array<int, 3> begin{ { edge * (first % 4), edge * (first / 4 % 4), edge * (first / 16) } };
    const NodeRange range{ { { begin[0] + 1, begin[1] + 1, begin[2] + 1 } }, { { edge, edge, edge } } };
    bool hasThin = false;
    for (std::size_t n = 0; n < out.size(); ++n)
    {
      const int i = int(n);
      hasThin = hasThin || partAt(begin[0] + i % edge, begin[1] + i / edge % edge, begin[2] + i / edge / edge) == part;
    }
    ASSERT_EQ(thin.smoothingAt(range, field.samplesFor(range, buffer), out.data()), hasThin);
    (hasThin ? spared : left) += 1;
    for (int n = 0; hasThin && n < edge * edge * edge; ++n)
    {
      const std::array<int, 3> in{ { n % edge, n / edge % edge, n / edge / edge } };
      if (*std::min_element(in.begin(), in.end()) == 0 || *std::max_element(in.begin(), in.end()) == edge - 1)
      {
        continue; // their neighbours are unknown
      }
      const int i = begin[0] + in[0];
      const int j = begin[1] + in[1];
      const int k = begin[2] + in[2];
      const float beside = std::min({ partAt(i - 1, j, k), partAt(i + 1, j, k), partAt(i, j - 1, k), partAt(i, j + 1, k),
        partAt(i, j, k - 1), partAt(i, j, k + 1), 1.0f });
      ASSERT_EQ(out[std::size_t(n)], partAt(i, j, k) == 2.0f ? beside : partAt(i, j, k));
    }
  }
  EXPECT_GT(spared, 3);
  EXPECT_GT(left, 20);
}

} // namespace
