// SPDX-License-Identifier: BSD-3-Clause
#include "surface/FibreSurvey.h"
#include "base/Bytes.h"
#include "base/Error.h"
#include "surface/MeetingFibres.h"
#include "surface/NearBlocks.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace
{

using namespace cactus;
using example::meetingFibres;

bool areSame(const NodeRange& a, const NodeRange& b)
{
  return a.size() == b.size() && (a.size() == 0 || (a.first == b.first && a.count == b.count));
}

/// Calls visit(node, id, depth) for each sample of a fibre in a field.
template <typename Visit>
void forEachOwnSample(const FibreField& field, const LabelImageView& image, Visit&& visit)
{
  const SampleBox& samples = field.samples();
  for (int k = 0; k < samples.count[2]; ++k)
  {
    for (int j = 0; j < samples.count[1]; ++j)
    {
      for (int i = 0; i < samples.count[0]; ++i)
      {
        const std::size_t at = image.grid.index(samples.first[0] + i, samples.first[1] + j, samples.first[2] + k);
        if (image.fibreId[at] != 0)
        {
          visit(std::array<int, 3>{ { i + 1, j + 1, k + 1 } }, image.fibreId[at], double(image.depth[at]));
        }
      }
    }
  }
}

/// The expected result of findFibres() for a fibre, sample by sample.
struct Expected
{
  double depths = 0.0;
  double samples = 0.0;
  std::map<std::array<int, 3>, NodeRange> boxes; ///< by the piece along each axis, z first
};

std::map<std::int32_t, Expected> foundOneByOne(const FibreField& field, const LabelImageView& image)
{
  std::map<std::int32_t, Expected> found;
  forEachOwnSample(field, image,
    [&](const std::array<int, 3>& node, std::int32_t id, double depth)
    {
      Expected& fibre = found[id];
      fibre.depths += depth;
      fibre.samples += 1.0;
      std::array<int, 3> piece{};
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        piece[2 - axis] = static_cast<int>(std::floor((field.samples().first[axis] + node[axis] - 1) / 16.0));
      }
      NodeRange& box = fibre.boxes[piece];
      box = box.joined({ node, { { 1, 1, 1 } } });
    });
  return found;
}

/// Returns the domain of an image, and of a part of it whose first samples are not the first ones of a piece.
std::vector<Domain> domains()
{
  Domain part = Domain::cube(3.0);
  part.lower[1] += 0.4;
  part.upper[2] -= 0.5;
  return { Domain::cube(3.0), part };
}

struct MeetingImage
{
  /// shift: of the first sample's index, which changes nothing else.
  explicit MeetingImage(int shift)
  {
    FibreRadialGrowthOptions options;
    options.voxelSize = 0.06;
    this->labels = meetingFibres(options);
    VoxelGrid& grid = this->labels.grid;
    grid.lower = { { shift, 2 * shift, 3 * shift } };
    grid.origin -= grid.spacing * Eigen::Vector3d(shift, 2 * shift, 3 * shift);
    this->view = { this->labels.grid, this->labels.fibreId.data(), this->labels.depth.data(), options.gap() };
  }
  LabelImage labels;
  LabelImageView view;
};

// The expected values of the tests below are made of these.
TEST(NodeRange, HasWhatBothHaveAndHoldsBoth)
{
  const NodeRange one{ { { 0, 1, 2 } }, { { 3, 3, 3 } } };
  const NodeRange other{ { { 2, -1, 2 } }, { { 4, 3, 1 } } };
  EXPECT_TRUE(areSame(one.within(other), { { { 2, 1, 2 } }, { { 1, 1, 1 } } }));
  EXPECT_TRUE(areSame(one.joined(other), { { { 0, -1, 2 } }, { { 6, 5, 3 } } }));
  EXPECT_TRUE(areSame(one.joined({}), one));
  EXPECT_TRUE(areSame(NodeRange().joined(one), one));
  EXPECT_EQ(one.within({ { { 3, 1, 2 } }, { { 1, 1, 1 } } }).size(), 0u);
  EXPECT_EQ(one.index(0, 1, 2), 0);
  EXPECT_EQ(one.index(2, 3, 3), 2 + 3 * (2 + 3 * 1));
}

TEST(FibreSurvey, FindsBoxesAndDepths)
{
  for (const int shift : { 0, 5, -7 })
  {
    const MeetingImage image(shift);
    for (const Domain& domain : domains())
    {
      const FibreField field(image.view, domain, true);
      FoundFibres found;
      getAll(bytesOf(findFibres(field)), found); // the bytes keep all of it
      ASSERT_EQ(found.size(), 3u);
      for (const auto& [id, fibre] : foundOneByOne(field, image.view))
      {
        ASSERT_EQ(found.at(id).boxes.size(), fibre.boxes.size());
        EXPECT_GT(fibre.boxes.size(), 4u);
        auto box = found.at(id).boxes.begin();
        for (const auto& [piece, nodes] : fibre.boxes)
        {
          EXPECT_TRUE(areSame(nodesOf(field, *box++), nodes));
        }
        EXPECT_EQ(found.at(id).samples, fibre.samples);
        EXPECT_NEAR(found.at(id).depths, fibre.depths, 1e-9 * fibre.depths);
      }
    }
  }
}

TEST(FibreSurvey, KnowsTheBlocksNearAFibreAndWhereItIsInThem)
{
  const MeetingImage image(-7);
  for (const Domain& domain : domains())
  {
    const FibreField field(image.view, domain, true);
    const NodeLattice lattice = field.lattice();
    ASSERT_GT(lattice.blockCount(), 27u);
    for (const auto& [id, fibre] : findFibres(field))
    {
      for (const int reach : { 0, 1, 7, 20 })
      {
        const NearBlocks near = blocksNear(field, fibre, reach);
        ASSERT_EQ(near.numbers.size(), near.inside.size());
        std::size_t at = 0;
        for (std::uint32_t block = 0; block < lattice.blockCount(); ++block)
        {
          const NodeRange own = nodesOfBlock(lattice, block);
          bool isNear = false;
          NodeRange inside;
          for (const FoundBox& box : fibre.boxes)
          {
            const NodeRange nodes = nodesOf(field, box);
            isNear = isNear || nodes.within(own.widened(reach)).size() > 0;
            inside = inside.joined(nodes.within(own.widened(NearBlocks::around)));
          }
          ASSERT_EQ(isNear, at < near.numbers.size() && near.numbers[at] == block) << id << ' ' << reach << ' ' << block;
          if (isNear)
          {
            EXPECT_TRUE(areSame(near.inside[at], inside));
            ++at;
          }
        }
        EXPECT_EQ(at, near.numbers.size());
      }
    }
  }
}

TEST(FibreSurvey, RefusesWhatIsNoLabelImage)
{
  FibreRadialGrowthOptions options;
  LabelImage image = meetingFibres(options);
  const auto find = [&] {
    findFibres(FibreField({ image.grid, image.fibreId.data(), image.depth.data(), options.gap() }, Domain::cube(3.0), true));
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
