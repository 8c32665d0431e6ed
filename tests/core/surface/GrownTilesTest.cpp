// SPDX-License-Identifier: BSD-3-Clause
// Guarantees: samples computed on demand have the bits of the whole image, however few tiles are kept and however many threads
// ask; surfaces made of them have the bits of those made of the image.
#include "growth/GrownTiles.h"
#include "base/Parallel.h"
#include "growth/FibreRadialGrowth.h"
#include "surface/MeetingFibres.h"
#include "surface/MyelinSurface.h"
#include "surface/SurfaceMaker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <vector>

namespace
{

using namespace cactus;

/// Returns how many samples of some random boxes differ from the image's.
std::size_t differences(const GrownTiles& tiles, const LabelImage& image, unsigned seed)
{
  std::mt19937 random(seed);
  const auto below = [&](int end) { return static_cast<int>(random() % unsigned(end)); };
  std::size_t different = 0;
  LabelBuffer buffer;
  for (int n = 0; n < 20; ++n)
  {
    SampleRange range;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      range.first[axis] = below(image.grid.count[axis]);
      range.count[axis] = 1 + below(std::min(40, image.grid.count[axis] - range.first[axis]));
    }
    const LabelImageView view = tiles.samples(range, buffer);
    for (int k = range.first[2]; k < range.first[2] + range.count[2]; ++k)
    {
      for (int j = range.first[1]; j < range.first[1] + range.count[1]; ++j)
      {
        for (int i = range.first[0]; i < range.first[0] + range.count[0]; ++i)
        {
          const std::size_t here = view.grid.index(i, j, k);
          const std::size_t there = image.grid.index(i, j, k);
          different += view.fibreId[here] != image.fibreId[there] || view.depth[here] != image.depth[there] ? 1 : 0;
        }
      }
    }
  }
  return different;
}

// 8·10¹² samples; growFibres() gives any part of them.
TEST(GrownTiles, ReachTheFarCornerOfAVeryLargeImage)
{
  Fibres fibres;
  fibres.domain = Domain::cube(1000.0);
  for (const int id : { 1, 2 })
  {
    fibres.addFibre(id, 1, 0.5);
    fibres.addPoint({ 498.7 + 0.3 * id, 499.0, 480.0 }, 0.4);
    fibres.addPoint({ 498.0 + 0.7 * id, 499.3, 499.9 }, 0.5);
  }
  FibreRadialGrowthOptions options;
  options.voxelSize = 0.05;
  VoxelGrid part = growthGrid(fibres.domain, options);
  ASSERT_EQ(part.count, (std::array<int, 3>{ { 20000, 20000, 20000 } }));
  const GrownTiles tiles(fibres, options, 0.1, 100);
  SampleRange range;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    range.first[axis] = part.lower[axis] = 19950;
    range.count[axis] = part.count[axis] = 50;
  }
  const LabelImage image = growFibres(fibres, options, 0.1, part);
  LabelBuffer buffer;
  const LabelImageView view = tiles.samples(range, buffer);
  std::size_t inside = 0;
  for (std::size_t i = 0; i < image.grid.size(); ++i)
  {
    ASSERT_EQ(view.fibreId[i], image.fibreId[i]);
    ASSERT_EQ(view.depth[i], image.depth[i]);
    inside += image.fibreId[i] != 0 ? 1 : 0;
  }
  EXPECT_GT(inside, 1000u);
}

// Their indices in lists have 32 bits.
TEST(GrownTiles, SayWhereAnImageHasMoreBlocksThanAreCounted)
{
  class Image : public LabelSource
  {
  public:
    Image()
    {
      this->Grid.count = { { 30000, 30000, 30000 } };
      this->Grid.origin.setConstant(-1499.95);
    }
    const VoxelGrid& grid() const override { return this->Grid; }
    double gap() const override { return 0.02; }
    LabelImageView samples(const SampleRange&, LabelBuffer&) const override { throw Cancelled("nobody should ask"); }

  private:
    VoxelGrid Grid;
  };
  LabelImageFacts facts;
  facts.domain = Domain::cube(3000.0);
  facts.surfaceTolerance = FibreRadialGrowthOptions().surfaceTolerance;
  MyelinSurfaceOptions options;
  options.smoothingIterations = 0; // smoothing would first search for thin fibres
  EXPECT_THROW(SurfaceMaker(std::make_shared<Image>(), facts, options, {}), InvalidInput);
}

TEST(GrownTiles, HaveTheBitsOfTheImageOnSeveralThreads)
{
  FibreRadialGrowthOptions options;
  options.margin = 0.3;
  const Fibres fibres = example::fibresThatMeet();
  const LabelImage image = growFibres(fibres, options, 0.2, growthGrid(fibres.domain, options));
  ASSERT_GT(image.grid.count[0], 2 * GrownTiles::edge);
  for (const std::size_t kept : { std::size_t(1), std::size_t(5), std::size_t(1000) })
  {
    const GrownTiles tiles(fibres, options, 0.2, kept);
    EXPECT_EQ(tiles.gap(), options.gap());
    std::vector<std::size_t> different(8);
    Context context;
    context.threads = 2;
    parallelFor(different.size(), context, [&](std::size_t i) { different[i] = differences(tiles, image, unsigned(i)); });
    EXPECT_EQ(different, std::vector<std::size_t>(different.size(), 0));
    if (kept == 1000)
    {
      // Both threads may have computed the same one at the same time.
      EXPECT_LE(tiles.computed(), 2 * (image.grid.size() / 4096 + 30));
    }
  }
}

/// Returns the tiles of an image that hold samples of each fibre.
std::map<std::int32_t, std::set<std::array<int, 3>>> tilesWithSamples(const LabelImage& image)
{
  std::map<std::int32_t, std::set<std::array<int, 3>>> tiles;
  const VoxelGrid& grid = image.grid;
  for (int k = 0; k < grid.count[2]; ++k)
  {
    for (int j = 0; j < grid.count[1]; ++j)
    {
      for (int i = 0; i < grid.count[0]; ++i)
      {
        const std::int32_t id = image.fibreId[grid.index(i, j, k)];
        if (id != 0)
        {
          tiles[id].insert({ { i / GrownTiles::edge, j / GrownTiles::edge, k / GrownTiles::edge } });
        }
      }
    }
  }
  return tiles;
}

TEST(GrownTiles, KnowInWhichTilesAFibreMayBe)
{
  Fibres fibres = example::fibresThatMeet();
  fibres.addFibre(9, 1, 0.3); // passes outside
  fibres.addPoint({ 6.0, 0.0, -2.0 }, 0.3);
  fibres.addPoint({ 6.0, 0.0, 2.0 }, 0.3);
  for (const double roughness : { 0.0, 0.3 })
  {
    for (const double growth : { -0.2, 0.0, 0.4 })
    {
      FibreRadialGrowthOptions options;
      options.voxelSize = 0.02;
      options.surfaceRoughness = roughness;
      options.margin = 0.1;
      const LabelImage image = growFibres(fibres, options, growth, growthGrid(fibres.domain, options));
      const GrownTiles grown(fibres, options, growth, 1);
      for (const auto& [id, held] : tilesWithSamples(image))
      {
        const std::vector<std::array<int, 3>> tiles = grown.knownFibres()->tilesOf(id);
        const std::set<std::array<int, 3>> told(tiles.begin(), tiles.end());
        EXPECT_EQ(told.size(), tiles.size());
        EXPECT_TRUE(std::includes(told.begin(), told.end(), held.begin(), held.end()));
        EXPECT_LT(double(told.size()), 2.2 * double(held.size()));
        for (const std::array<int, 3>& tile : tiles)
        {
          EXPECT_TRUE(*std::min_element(tile.begin(), tile.end()) >= 0);
          EXPECT_LE(*std::max_element(tile.begin(), tile.end()), (image.grid.count[0] - 1) / GrownTiles::edge);
        }
      }
      EXPECT_TRUE(grown.knownFibres()->tilesOf(9).empty());
      EXPECT_TRUE(grown.knownFibres()->tilesOf(4).empty());
      const std::vector<FibreOutline> outlines = grown.knownFibres()->outlines();
      ASSERT_EQ(outlines.size(), 4u);
      EXPECT_EQ(outlines[1].fibreId, 2);
      EXPECT_EQ(outlines[1].targetRadius, 0.5);
      EXPECT_NEAR(outlines[1].length, (fibres.points[3] - fibres.points[2]).norm(), 1e-9);
      const Eigen::Vector3d middle = 0.5 * (fibres.points[2] + fibres.points[3]);
      const auto& at = outlines[1].middle;
      EXPECT_LT((image.grid.position(at[0], at[1], at[2]) - middle).norm(), image.grid.spacing);
      EXPECT_EQ(outlines[3].length, 0.0);
    }
  }
}

TEST(GrownTiles, MakeTheSameSurfaces)
{
  FibreRadialGrowthOptions growth;
  const Fibres fibres = example::fibresThatMeet();
  const LabelImage image = growFibres(fibres, growth, 0.2, growthGrid(fibres.domain, growth));
  const LabelImageFacts facts = labelImageFacts(fibres, growth);
  for (const int passes : { 0, 2, 9 })
  {
    MyelinSurfaceOptions options;
    options.smoothingIterations = passes;
    const auto wanted = myelinSurfaces({ image.grid, image.fibreId.data(), image.depth.data(), growth.gap() }, facts, options);
    const auto tiles = std::make_shared<GrownTiles>(fibres, growth, 0.2, 2);
    SurfaceMaker maker(tiles, facts, options, {});
    SurfacesInMemory outer(wanted.size());
    SurfacesInMemory inner(wanted.size());
    maker.makeOuter(outer, inner);
    maker.makeInner(outer, inner);
    // Inner surfaces are the same, too, if they are made of kept outer ones.
    SurfaceMaker later(tiles, facts, options, {});
    SurfacesInMemory innerLater(wanted.size());
    later.takeOuter(maker.fibres());
    EXPECT_EQ(later.fibres().front().innerReport.triangles, 0u);
    later.makeInner(outer, innerLater);
    ASSERT_EQ(maker.fibres().size(), wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i)
    {
      ASSERT_FALSE(wanted[i].outer.points.empty());
      EXPECT_EQ(outer.get(i)->points, wanted[i].outer.points);
      EXPECT_EQ(outer.get(i)->triangles, wanted[i].outer.triangles);
      EXPECT_EQ(inner.get(i)->points, wanted[i].inner.points);
      EXPECT_EQ(inner.get(i)->triangles, wanted[i].inner.triangles);
      EXPECT_EQ(innerLater.get(i)->points, wanted[i].inner.points);
      EXPECT_EQ(innerLater.get(i)->triangles, wanted[i].inner.triangles);
      for (const SurfaceMaker* each : { &maker, &later })
      {
        const FibreSurfacePair& made = each->fibres()[i];
        EXPECT_EQ(made.gRatio, wanted[i].gRatio);
        EXPECT_EQ(made.state, wanted[i].state);
        EXPECT_EQ(made.thickness, wanted[i].thickness);
        EXPECT_EQ(made.largestMove(), wanted[i].largestMove());
        EXPECT_EQ(made.droppedVolume(), wanted[i].droppedVolume());
      }
    }
  }
}

} // namespace
