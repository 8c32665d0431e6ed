// SPDX-License-Identifier: BSD-3-Clause
#include "surface/FibreSurvey.h"
#include "base/Error.h"
#include "surface/MeetingFibres.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace
{

using namespace cactus;
using example::meetingFibres;

/// The same sample by sample, and node by node.
FoundFibres foundOneByOne(const FibreField& field, const LabelImageView& image, int reach)
{
  FoundFibres found;
  const NodeLattice lattice = field.lattice();
  for (std::size_t block = 0; block < lattice.blockCount(); ++block)
  {
    const NodeRange own = nodesOfBlock(lattice, block);
    const NodeRange range = own.widened(reach);
    std::set<std::int32_t> ids;
    for (int k = range.first[2]; k < range.first[2] + range.count[2]; ++k)
    {
      for (int j = range.first[1]; j < range.first[1] + range.count[1]; ++j)
      {
        for (int i = range.first[0]; i < range.first[0] + range.count[0]; ++i)
        {
          const SampleBox& samples = field.samples();
          ids.insert(image.fibreId[image.grid.index(samples.sampleOf(0, i), samples.sampleOf(1, j), samples.sampleOf(2, k))]);
        }
      }
    }
    for (const std::int32_t id : ids)
    {
      if (id != 0)
      {
        found[id].blocks.push_back(static_cast<std::uint32_t>(block));
      }
    }
  }
  const SampleBox& samples = field.samples();
  for (int k = samples.first[2]; k < samples.first[2] + samples.count[2]; ++k)
  {
    for (int j = samples.first[1]; j < samples.first[1] + samples.count[1]; ++j)
    {
      for (int i = samples.first[0]; i < samples.first[0] + samples.count[0]; ++i)
      {
        const std::size_t at = image.grid.index(i, j, k);
        if (image.fibreId[at] != 0)
        {
          found[image.fibreId[at]].depths += double(image.depth[at]);
          found[image.fibreId[at]].samples += 1.0;
        }
      }
    }
  }
  return found;
}

TEST(FibreSurvey, FindsBlocksAndDepths)
{
  FibreRadialGrowthOptions options;
  options.voxelSize = 0.06;
  const LabelImage image = meetingFibres(options);
  const LabelImageView view{ image.grid, image.fibreId.data(), image.depth.data(), options.gap() };
  Domain part = Domain::cube(3.0);
  part.lower[1] += 0.4;
  part.upper[2] -= 0.5;
  for (const Domain& domain : { Domain::cube(3.0), part })
  {
    const FibreField field(view, domain, true);
    ASSERT_GT(field.lattice().blockCount(), 27u);
    for (const int reach : { 0, 1, 7, 20 })
    {
      const FoundFibres found = findFibres(field, reach);
      const FoundFibres expected = foundOneByOne(field, view, reach);
      ASSERT_EQ(found.size(), 3u);
      for (const auto& [id, fibre] : expected)
      {
        EXPECT_EQ(found.at(id).blocks, fibre.blocks);
        EXPECT_EQ(found.at(id).samples, fibre.samples);
        EXPECT_NEAR(found.at(id).depths, fibre.depths, 1e-9 * fibre.depths);
      }
    }
  }
  const FibreField field(view, part, true);
  EXPECT_THROW(findFibres(field, -1), InvalidInput);
  EXPECT_THROW(findFibres(field, 21), InvalidInput);
}

TEST(FibreSurvey, RefusesWhatIsNoLabelImage)
{
  FibreRadialGrowthOptions options;
  LabelImage image = meetingFibres(options);
  const auto find = [&] {
    findFibres(FibreField({ image.grid, image.fibreId.data(), image.depth.data(), options.gap() }, Domain::cube(3.0), true), 1);
  };
  EXPECT_NO_THROW(find());
  const float depth = image.depth[1234];
  image.depth[1234] = std::nanf("");
  EXPECT_THROW(find(), InvalidInput);
  image.depth[1234] = depth > 0.0f ? 1e30f : -1e30f;
  EXPECT_THROW(find(), InvalidInput);
  image.depth[1234] = depth > 0.0f ? -depth : 1.0f;
  EXPECT_THROW(find(), InvalidInput);
  EXPECT_THROW(FibreField({ image.grid, image.fibreId.data(), nullptr, 0.03 }, Domain::cube(3.0), true), InvalidInput);
}

} // namespace
