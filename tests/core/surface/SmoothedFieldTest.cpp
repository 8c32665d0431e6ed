// SPDX-License-Identifier: BSD-3-Clause
// Guarantees: a smoothed field equals smoothing every node, for any number of passes, or is far outside away from the fibre; two
// sum to at most -gap everywhere on the grid, even if thin fibres are spared; a field does not depend on the requested blocks; an
// invalid label image is refused.
#include "surface/SmoothedField.h"
#include "mesh/Isosurface.h"
#include "mesh/SurfaceCheck.h"
#include "surface/FibreSurvey.h"
#include "surface/MeetingFibres.h"
#include "surface/NearBlocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace
{

using namespace cactus;
using example::meetingFibres;

/// Farther than any block is away.
constexpr int anywhere = 1000;

bool isHeld(const SmoothedField& field, std::uint32_t block)
{
  return std::binary_search(field.blocks().begin(), field.blocks().end(), block);
}

/// Values are far outside if the block is not stored.
std::vector<float> valuesAt(const SmoothedField& field, std::uint32_t block)
{
  const NodeRange range = nodesOfBlock(field.lattice(), block).widened(1);
  std::vector<float> values(range.size(), -1e6f);
  if (isHeld(field, block))
  {
    field.values(0.0, 0.0, range, values.data());
  }
  return values;
}

/// The largest sum of two of the three fibres' smoothed fields at a node.
double largestSum(const FibreField& field, int passes, const ThinFibres* thin = nullptr)
{
  const NodeLattice lattice = field.lattice();
  const FoundFibres found = findFibres(field);
  const SmoothedField one(field, 1, blocksNear(field, found.at(1), anywhere), passes, thin);
  const SmoothedField two(field, 2, blocksNear(field, found.at(2), anywhere), passes, thin);
  const SmoothedField three(field, 3, blocksNear(field, found.at(3), anywhere), passes, thin);
  double largest = -1.0;
  for (std::uint32_t block = 0; block < lattice.blockCount(); ++block)
  {
    const std::vector<float> a = valuesAt(one, block);
    const std::vector<float> b = valuesAt(two, block);
    const std::vector<float> c = valuesAt(three, block);
    for (std::size_t n = 0; n < a.size(); ++n)
    {
      largest = std::max({ largest, double(a[n]) + b[n], double(b[n]) + c[n], double(c[n]) + a[n] });
    }
  }
  return largest;
}

TEST(SmoothedField, FieldsOfTwoFibresSumToAtMostMinusTheGap)
{
  FibreRadialGrowthOptions options;
  const LabelImage image = meetingFibres(options);
  const FibreField field({ image.grid, image.fibreId.data(), image.depth.data(), options.gap() }, Domain::cube(3.0), true);
  for (const int passes : { 0, 1, 4 })
  {
    const double sum = largestSum(field, passes);
    EXPECT_LE(sum, -options.gap() + 1e-6);
    EXPECT_GE(sum, -options.gap() - 0.01);
  }
}

// A moved outer surface may lie further in than its field; the axon keeps clear of it all the same.
TEST(SmoothedField, FieldsOfThinFibresDoSoToo)
{
  FibreRadialGrowthOptions options;
  for (const double voxelSize : { 0.25, 0.4 }) // so that fibres are smoothed in part, and not at all
  {
    options.voxelSize = voxelSize;
    const LabelImage image = meetingFibres(options);
    const FibreField field({ image.grid, image.fibreId.data(), image.depth.data(), options.gap() }, Domain::cube(3.0), true);
    const double smoothed = largestSum(field, 4);
    const ThinFibres thin(field, findFibres(field));
    const double spared = largestSum(field, 4, &thin);
    EXPECT_LE(spared, -options.gap() + 1e-6);
    EXPECT_NE(spared, smoothed);
  }
}

/// Compares two fields of a fibre at those nodes of a block that are at most two from one inside it along each axis. Returns how
/// many are inside.
int compareBesideFibre(const SmoothedField& one, const SmoothedField& other, std::uint32_t block)
{
  EXPECT_EQ(isHeld(one, block), isHeld(other, block));
  const NodeRange range = nodesOfBlock(one.lattice(), block).widened(1);
  const std::vector<float> a = valuesAt(one, block);
  const std::vector<float> b = valuesAt(other, block);
  int inside = 0;
  for (int n = 0; n < int(a.size()); ++n)
  {
    const std::array<int, 3> at{ { n % range.count[0], n / range.count[0] % range.count[1],
      n / range.count[0] / range.count[1] } };
    inside += a[std::size_t(n)] > 0.0f ? 1 : 0;
    for (int d = 0; a[std::size_t(n)] > 0.0f && d < 125; ++d)
    {
      const std::array<int, 3> next{ { at[0] + d % 5 - 2, at[1] + d / 5 % 5 - 2, at[2] + d / 25 - 2 } };
      if (next[0] >= 0 && next[1] >= 0 && next[2] >= 0 && next[0] < range.count[0] && next[1] < range.count[1] &&
          next[2] < range.count[2])
      {
        const auto m = std::size_t(next[0] + range.count[0] * (next[1] + range.count[1] * next[2]));
        EXPECT_EQ(a[m], b[m]);
      }
    }
  }
  return inside;
}

// Blocks are smoothed together, and only around the fibre; the result does not depend on which are requested.
TEST(SmoothedField, BlocksAreSmoothedTheSameAloneOrTogether)
{
  for (const double voxelSize : { 0.06, 0.15 })
  {
    FibreRadialGrowthOptions options;
    options.voxelSize = voxelSize;
    const LabelImage image = meetingFibres(options);
    const FibreField field({ image.grid, image.fibreId.data(), image.depth.data(), options.gap() }, Domain::cube(3.0), true);
    const NodeLattice lattice = field.lattice();
    const FoundFibres found = findFibres(field);
    const NearBlocks all = blocksNear(field, found.at(1), anywhere);
    ASSERT_EQ(all.numbers.size(), lattice.blockCount());
    ASSERT_GE(all.numbers.size(), 8u);
    const ThinFibres thin(field, found); // for larger voxels, in part
    for (const int passes : { 0, 2, 9, 20 })
    {
      const SmoothedField together(field, 1, all, passes, &thin);
      int inside = 0;
      for (std::size_t i = 0; i < all.numbers.size(); ++i)
      {
        const SmoothedField alone(field, 1, { { all.numbers[i] }, { all.inside[i] } }, passes, &thin);
        inside += compareBesideFibre(together, alone, all.numbers[i]);
      }
      EXPECT_GT(inside, 500);
    }
  }
}

TEST(SmoothedField, InterpolatesTheSamples)
{
  FibreRadialGrowthOptions options;
  const LabelImage image = meetingFibres(options);
  const FibreField field({ image.grid, image.fibreId.data(), image.depth.data(), options.gap() }, Domain::cube(3.0), true);
  const FoundFibres found = findFibres(field);
  ASSERT_EQ(found.size(), 3u);
  const SmoothedField one(field, 1, blocksNear(field, found.at(1), 0), 0);
  int inside = 0;
  for (int k = 0; k < image.grid.count[2]; ++k)
  {
    for (int j = 0; j < image.grid.count[1]; ++j)
    {
      for (int i = 0; i < image.grid.count[0]; ++i)
      {
        if (image.fibreId[image.grid.index(i, j, k)] == 1)
        {
          ASSERT_NEAR(one.value(image.grid.position(i, j, k)), image.depth[image.grid.index(i, j, k)], 1e-6);
          ++inside;
        }
      }
    }
  }
  EXPECT_GT(inside, 1000);
}

/// A field at the nodes of a lattice and `beyond` more on every side, smoothed there node by node.
struct SmoothedByHand
{
  NodeRange range;
  std::vector<float> before;
  std::vector<double> after; ///< correct except for as many nodes at the rim as there are passes

  SmoothedByHand(const FibreField& field, int passes, int beyond)
  {
    const NodeLattice lattice = field.lattice();
    range = NodeRange{ {}, { { lattice.nodes(0), lattice.nodes(1), lattice.nodes(2) } } }.widened(beyond);
    before.resize(range.size());
    LabelBuffer buffer;
    field.atNodes(1, range, field.samplesFor(range, buffer), before.data());
    after.assign(before.begin(), before.end());
    for (int pass = 0; pass < passes; ++pass)
    {
      for (const std::ptrdiff_t step : { range.index(range.first[0] + 1, range.first[1], range.first[2]),
             range.index(range.first[0], range.first[1] + 1, range.first[2]),
             range.index(range.first[0], range.first[1], range.first[2] + 1) })
      {
        const std::vector<double> from = after;
        for (std::ptrdiff_t n = step; n + step < std::ptrdiff_t(from.size()); ++n)
        {
          after[std::size_t(n)] = 0.25 * (from[std::size_t(n - step)] + 2.0 * from[std::size_t(n)] + from[std::size_t(n + step)]);
        }
      }
    }
  }
  bool isInsideNear(int i, int j, int k, int nodes) const
  {
    for (int z = k - nodes; z <= k + nodes; ++z)
    {
      for (int y = j - nodes; y <= j + nodes; ++y)
      {
        for (int x = i - nodes; x <= i + nodes; ++x)
        {
          if (before[std::size_t(range.index(x, y, z))] > 0.0f)
          {
            return true;
          }
        }
      }
    }
    return false;
  }
};

/// A thin fibre that bends on its way through a cube of 3 µm, not along one of its axes.
LabelImage bentFibre(std::uint32_t seed, const FibreRadialGrowthOptions& options)
{
  std::mt19937 numbers(seed);
  const auto at = [&] { return 2.4 * (double(numbers()) / std::mt19937::max() - 0.5); };
  Fibres fibres;
  fibres.domain = Domain::cube(3.0);
  fibres.addFibre(1, 1, 0.15);
  for (const double z : { -2.0, -1.0, 0.0, 1.0, 2.0 })
  {
    const double x = at();
    fibres.addPoint({ x, at(), z }, 0.15);
  }
  return growFibres(fibres, options, 0.0, growthGrid(fibres.domain, options));
}

TEST(SmoothedField, IsWhatSmoothingEveryNodeGives)
{
  FibreRadialGrowthOptions options;
  options.voxelSize = 0.06;
  for (const std::uint32_t seed : { 1, 32, 63, 98 })
  {
    const LabelImage image = bentFibre(seed, options);
    const FibreField field({ image.grid, image.fibreId.data(), image.depth.data(), options.gap() }, Domain::cube(3.0), true);
    const FoundFibre found = findFibres(field).at(1);
    for (const int passes : { 1, 3, 4, 5, 9, 20 })
    {
      const SmoothedField smoothed(field, 1, blocksNear(field, found, passes), passes);
      const SmoothedByHand all(field, passes, passes + 4);
      int wrong = 0;
      for (const std::uint32_t block : smoothed.blocks())
      {
        const NodeRange range = nodesOfBlock(smoothed.lattice(), block).widened(1);
        const std::vector<float> values = valuesAt(smoothed, block);
        for (int n = 0; n < int(values.size()); ++n)
        {
          const int i = range.first[0] + n % range.count[0];
          const int j = range.first[1] + n / range.count[0] % range.count[1];
          const int k = range.first[2] + n / range.count[0] / range.count[1];
          const float value = values[std::size_t(n)];
          const bool isRight = std::abs(value - all.after[std::size_t(all.range.index(i, j, k))]) < 1e-5;
          wrong += !isRight && (value > -1e5f || all.isInsideNear(i, j, k, 2)) ? 1 : 0;
        }
      }
      EXPECT_EQ(wrong, 0) << "seed " << seed << ", passes " << passes;
      const CappedSurface surface = contour(smoothed.lattice(), smoothed.blocks(),
        [&](const NodeRange& around, float* out) { smoothed.values(-0.02, 1e-4, around, out); });
      EXPECT_TRUE(surface.mesh.triangles.empty() || checkSurface(surface.mesh).closedManifold())
        << "seed " << seed << ", passes " << passes;
    }
  }
}

} // namespace
