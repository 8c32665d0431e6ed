// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: a fibre's image holds its field; contoured linearly it is closed, and cut off where the caps belong.
#include "surface/FibreImage.h"
#include "FieldAtSample.h"
#include "base/Error.h"
#include "growth/FibreRadialGrowth.h"
#include "surface/FibreSurvey.h"
#include "surface/NearBlocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace
{

using namespace cactus;

/// Two fibres side by side along z.
struct Example
{
  explicit Example(double spacing = 0.2, const Domain& box = Domain::cube(4.0))
  {
    Fibres fibres;
    fibres.domain = Domain::cube(4.0);
    for (int f = 0; f < 2; ++f)
    {
      fibres.addFibre(f + 1, 1, 0.6);
      fibres.addPoint({ f == 0 ? -0.7 : 0.7, 0.03, -4.0 }, 0.6);
      fibres.addPoint({ f == 0 ? -0.7 : 0.7, 0.03, 4.0 }, 0.6);
    }
    FibreRadialGrowthOptions options;
    options.voxelSize = spacing;
    options.surfaceRoughness = 0.0;
    labels = growFibres(fibres, options, 0.3, growthGrid(fibres.domain, options));
    view.grid = labels.grid;
    view.fibreId = labels.fibreId.data();
    view.depth = labels.depth.data();
    view.gap = 0.03;
    domain = box;
  }
  FibreImage image(std::int32_t fibre, double level = 0.0, double inset = 0.0) const
  {
    const FibreField field(view, domain, true);
    return fibreImage(field, fibre, blocksNear(field, findFibres(field).at(fibre), 1).numbers, level, inset);
  }

  LabelImage labels;
  LabelImageView view;
  Domain domain;
};

float at(const FibreImage& image, int i, int j, int k)
{
  return image.values[image.grid.index(i, j, k)];
}

/// Returns where along z a linear contour at `level` ends, for a column that reaches from one face to the other.
std::array<double, 2> ends(const FibreImage& image, int i, int j, double level)
{
  const int lowest = image.grid.lower[2];
  const int highest = lowest + image.grid.count[2] - 1;
  const auto crossing = [&](int from, int to)
  {
    const double a = at(image, i, j, from) - level;
    const double b = at(image, i, j, to) - level;
    return image.grid.origin[2] + image.grid.spacing * (from + (to - from) * a / (a - b));
  };
  std::array<double, 2> found{ { std::nan(""), std::nan("") } };
  for (int k = lowest; k < highest; ++k)
  {
    const bool here = double(at(image, i, j, k)) >= level;
    const bool next = double(at(image, i, j, k + 1)) >= level;
    if (here != next)
    {
      found[here ? 1 : 0] = here ? crossing(k, k + 1) : crossing(k + 1, k);
    }
  }
  return found;
}

/// Tells whether all outermost samples lie outside, so that the contour is closed; a value at the level counts as inside.
bool closes(const FibreImage& image, double level)
{
  const VoxelGrid& grid = image.grid;
  for (int k = 0; k < grid.count[2]; ++k)
  {
    for (int j = 0; j < grid.count[1]; ++j)
    {
      for (int i = 0; i < grid.count[0]; ++i)
      {
        const bool isLast =
          i == 0 || j == 0 || k == 0 || i + 1 == grid.count[0] || j + 1 == grid.count[1] || k + 1 == grid.count[2];
        if (isLast && double(at(image, grid.lower[0] + i, grid.lower[1] + j, grid.lower[2] + k)) >= level)
        {
          return false;
        }
      }
    }
  }
  return true;
}

/// Expects every column well inside the fibre to end at the two caps.
void expectCaps(const FibreImage& image, double level, double lower, double upper)
{
  EXPECT_TRUE(closes(image, level));
  int columns = 0;
  const int middle = image.grid.lower[2] + image.grid.count[2] / 2;
  for (int j = image.grid.lower[1]; j < image.grid.lower[1] + image.grid.count[1]; ++j)
  {
    for (int i = image.grid.lower[0]; i < image.grid.lower[0] + image.grid.count[0]; ++i)
    {
      if (double(at(image, i, j, middle)) > level + 0.02)
      {
        const auto found = ends(image, i, j, level);
        EXPECT_NEAR(found[0], lower, 2e-4 * image.grid.spacing) << i << ' ' << j;
        EXPECT_NEAR(found[1], upper, 2e-4 * image.grid.spacing) << i << ' ' << j;
        ++columns;
      }
    }
  }
  EXPECT_GT(columns, 0);
}

TEST(FibreImage, HoldsTheFieldOfOneFibre)
{
  const Example example(0.1);
  const FibreField field(example.view, example.domain, true);
  for (const std::int32_t fibre : { 1, 2 })
  {
    const FibreImage image = example.image(fibre);
    const VoxelGrid& grid = image.grid;
    EXPECT_LT(grid.count[0], example.view.grid.count[0]); // a box around the fibre
    EXPECT_EQ(grid.count[2], example.view.grid.count[2] + 2);
    std::size_t inside = 0;
    for (int k = grid.lower[2] + 1; k < grid.lower[2] + grid.count[2] - 1; ++k)
    {
      for (int j = grid.lower[1] + 1; j < grid.lower[1] + grid.count[1] - 1; ++j)
      {
        for (int i = grid.lower[0] + 1; i < grid.lower[0] + grid.count[0] - 1; ++i)
        {
          ASSERT_EQ(double(at(image, i, j, k)), fieldAtSample(field, fibre, i, j, k));
          inside += at(image, i, j, k) > 0.0f ? 1 : 0;
        }
      }
    }
    EXPECT_EQ(std::ptrdiff_t(inside), std::count(example.labels.fibreId.begin(), example.labels.fibreId.end(), fibre));
  }
}

TEST(FibreImage, ContoursEndOnTheFacesOfTheBox)
{
  const Example example;
  expectCaps(example.image(1), 0.0, -2.0, 2.0);
  expectCaps(example.image(1, 0.25), 0.25, -2.0, 2.0);
  expectCaps(example.image(2, 0.0, 0.04), 0.0, -1.96, 1.96);
}

TEST(FibreImage, CapsMayLieMoreOrLessThanAVoxelBeyondTheLastSample)
{
  // The last samples used are those at least 0.3 voxels inside: caps are 0.3 to 1.3 voxels beyond them.
  bool onePast = false;
  for (const double part : { 0.05, 0.3, 0.499, 0.5, 0.501, 0.7, 0.79, 0.81, 0.95 })
  {
    const double half = 1.0 + 0.2 * part;
    Domain box = Domain::cube(4.0);
    box.lower[2] = -half;
    box.upper[2] = half;
    const Example example(0.2, box);
    const FibreImage image = example.image(1);
    onePast = onePast || image.grid.position(0, 0, image.grid.lower[2])[2] < -half - 0.2 * 0.7;
    expectCaps(image, 0.0, -half, half);
    expectCaps(example.image(1, 0.2, 0.05), 0.2, -half + 0.05, half - 0.05);
  }
  EXPECT_TRUE(onePast);
}

TEST(FibreImage, ClosesRoundOneSample)
{
  Domain box = Domain::cube(4.0);
  box.lower[2] = 0.0;
  box.upper[2] = 0.2; // one layer of voxels
  const FibreImage image = Example(0.2, box).image(2);
  EXPECT_EQ(image.grid.count[2], 3);
  expectCaps(image, 0.0, 0.0, 0.2);
}

TEST(FibreImage, ClosesWhereTheFieldIsJustTheLevel)
{
  Example example;
  for (std::size_t i = 0; i < example.labels.depth.size(); ++i)
  {
    if (example.labels.fibreId[i] == 0)
    {
      example.labels.depth[i] = 0.0f;
    }
  }
  EXPECT_TRUE(closes(example.image(1), 0.0));
  // Beyond the deepest point nothing is inside.
  const FibreImage image = example.image(1, 5.0);
  EXPECT_EQ(std::count_if(image.values.begin(), image.values.end(), [](float value) { return value >= 5.0f; }), 0);
}

TEST(FibreImage, RefusesWhatIsNoContour)
{
  const Example example;
  const FibreField field(example.view, example.domain, true);
  const auto blocks = blocksNear(field, findFibres(field).at(1), 1).numbers;
  EXPECT_THROW(fibreImage(field, 1, {}), InvalidInput);
  EXPECT_THROW(fibreImage(field, 1, blocks, -0.1), InvalidInput);
  EXPECT_THROW(fibreImage(field, 1, blocks, std::numeric_limits<double>::quiet_NaN()), InvalidInput);
  EXPECT_THROW(fibreImage(field, 1, blocks, 0.0, 0.3 * 0.2), InvalidInput);
  EXPECT_THROW(fibreImage(field, 1, blocks, 0.0, -0.01), InvalidInput);
}

} // namespace
