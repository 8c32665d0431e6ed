// SPDX-License-Identifier: BSD-3-Clause
// Guarantee: pieces of a label are those that walkers who cross faces of voxels can go about in.
#include "judge/LabelPieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace cactus;

namespace
{

VoxelBoxes grid(int nx, int ny, int nz)
{
  VoxelBoxes voxels;
  voxels.count = { { nx, ny, nz } };
  return voxels;
}

std::vector<bool> drawn(const std::string& picture)
{
  std::vector<bool> label;
  for (const char c : picture)
  {
    label.push_back(c == '#');
  }
  return label;
}

/// The smallest place of its piece, for each voxel with the label: handed on until nothing changes.
std::vector<std::size_t> names(const VoxelBoxes& voxels, const std::vector<bool>& label, const std::vector<int>& owner)
{
  std::vector<std::size_t> name(label.size());
  std::iota(name.begin(), name.end(), 0);
  for (bool isMoving = true; isMoving;)
  {
    isMoving = false;
    for (int k = 0; k < voxels.count[2]; ++k)
    {
      for (int j = 0; j < voxels.count[1]; ++j)
      {
        for (int i = 0; i < voxels.count[0]; ++i)
        {
          const std::size_t here = voxels.index(i, j, k);
          for (const auto& [di, dj, dk] : { std::array<int, 3>{ 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } })
          {
            if (i + di == voxels.count[0] || j + dj == voxels.count[1] || k + dk == voxels.count[2])
            {
              continue;
            }
            const std::size_t there = voxels.index(i + di, j + dj, k + dk);
            if (label[here] && label[there] && owner[here] == owner[there] && name[here] != name[there])
            {
              name[here] = name[there] = std::min(name[here], name[there]);
              isMoving = true;
            }
          }
        }
      }
    }
  }
  return name;
}

} // namespace

TEST(LabelPieces, OfAPictureByHand)
{
  // Two layers of 5 x 3 voxels, x fastest. Edges and corners do not connect, nor does the end of a row the next one.
  const VoxelBoxes voxels = grid(5, 3, 2);
  const std::vector<bool> label = drawn("##..#"
                                        "..#.."
                                        "#...."
                                        //
                                        ".#..."
                                        ".#..."
                                        "##..#");
  const LabelPieces found = labelPieces(voxels, label);
  EXPECT_EQ(found.voxels, 10u);
  EXPECT_EQ(found.pieces, 4u);
  EXPECT_EQ(found.connected, 7u); // the two above, three below, and the one at the side of the lowest row
  EXPECT_DOUBLE_EQ(found.connectedShare(), 0.7);
  EXPECT_EQ(labelPieces(voxels, std::vector<bool>(30, true)).pieces, 1u);
  EXPECT_EQ(labelPieces(voxels, std::vector<bool>(30, false)).pieces, 0u);
  EXPECT_EQ(labelPieces(voxels, std::vector<bool>(30, false)).connectedShare(), 1.0);
}

TEST(LabelPieces, AreThoseOfAnotherMethod)
{
  std::mt19937 random(3);
  for (const double density : { 0.2, 0.4, 0.7 })
  {
    const VoxelBoxes voxels = grid(9, 8, 7);
    std::vector<bool> label(voxels.size());
    std::vector<int> owner(voxels.size());
    for (std::size_t i = 0; i < voxels.size(); ++i)
    {
      label[i] = std::uniform_real_distribution<double>()(random) < density;
      owner[i] = int(random() % 2);
    }
    for (const bool isOwned : { false, true })
    {
      const std::vector<int> whose = isOwned ? owner : std::vector<int>(voxels.size(), 0);
      const std::vector<std::size_t> name = names(voxels, label, whose);
      std::map<std::pair<int, std::size_t>, std::size_t> sizes;
      for (std::size_t i = 0; i < voxels.size(); ++i)
      {
        if (label[i])
        {
          ++sizes[{ whose[i], name[i] }];
        }
      }
      std::map<int, std::size_t> largest;
      for (const auto& [piece, size] : sizes)
      {
        largest[piece.first] = std::max(largest[piece.first], size);
      }
      const LabelPieces found = labelPieces(voxels, label, isOwned ? owner : std::vector<int>());
      EXPECT_EQ(found.voxels, std::size_t(std::count(label.begin(), label.end(), true)));
      EXPECT_EQ(found.pieces, sizes.size());
      EXPECT_EQ(found.connected, largest[0] + largest[1]);
    }
  }
}
