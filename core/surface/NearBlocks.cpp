// SPDX-License-Identifier: BSD-3-Clause
#include "surface/NearBlocks.h"

#include "base/Error.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <vector>

namespace cactus
{

namespace
{

/// Returns the range and, along axes whose samples repeat, its copies that come as near to the box as `reach` (nodes).
std::vector<NodeRange> imagesOf(const NodeRange& nodes, const SampleBox& samples, int reach)
{
  std::vector<NodeRange> images{ nodes };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::size_t count = samples.repeats[axis] ? images.size() : 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      for (const int shift : { -samples.count[axis], samples.count[axis] })
      {
        NodeRange image = images[i];
        image.first[axis] += shift;
        if (image.first[axis] <= samples.count[axis] + 1 + reach && image.first[axis] + image.count[axis] + reach >= 0)
        {
          images.push_back(image);
        }
      }
    }
  }
  return images;
}

} // namespace

NearBlocks blocksNear(const FibreField& field, const FoundFibre& fibre, int reach)
{
  const NodeLattice lattice = field.lattice();
  require(lattice.blockCount() <= std::numeric_limits<std::uint32_t>::max(),
    "the label image has more blocks of 16³ voxels than 32 bits count: choose a larger VoxelSize");
  constexpr int size = NodeLattice::blockCells;
  const int farthest = std::max(reach, NearBlocks::around);
  struct Known
  {
    NodeRange inside;
    bool isNear = false;
  };
  std::map<std::uint32_t, Known> known;
  const auto enter = [&](const NodeRange& nodes)
  {
    std::array<int, 3> first{};
    std::array<int, 3> last{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      // A block of `size` cells has one node more.
      first[axis] = std::max(0, nodes.first[axis] - farthest - 1) / size;
      last[axis] = std::min(lattice.blocks(int(axis)) - 1, (nodes.first[axis] + nodes.count[axis] - 1 + farthest) / size);
    }
    for (int z = first[2]; z <= last[2]; ++z)
    {
      for (int y = first[1]; y <= last[1]; ++y)
      {
        for (int x = first[0]; x <= last[0]; ++x)
        {
          const std::size_t row = std::size_t(y) + std::size_t(lattice.blocks(1)) * std::size_t(z);
          const auto block = std::uint32_t(std::size_t(x) + std::size_t(lattice.blocks(0)) * row);
          const NodeRange own = nodesOfBlock(lattice, block);
          Known& here = known[block];
          here.inside = here.inside.joined(nodes.within(own.widened(NearBlocks::around)));
          here.isNear = here.isNear || nodes.within(own.widened(reach)).size() > 0;
        }
      }
    }
  };
  for (const FoundBox& box : fibre.boxes)
  {
    for (const NodeRange& nodes : imagesOf(nodesOf(field, box), field.samples(), farthest))
    {
      enter(nodes);
    }
  }
  NearBlocks blocks;
  for (const auto& [block, here] : known)
  {
    if (here.isNear)
    {
      blocks.numbers.push_back(block);
      blocks.inside.push_back(here.inside);
    }
  }
  return blocks;
}

} // namespace cactus
