// SPDX-License-Identifier: BSD-3-Clause
#include "judge/LabelPieces.h"

#include <algorithm>
#include <array>
#include <map>

namespace cactus
{

LabelPieces labelPieces(
  const VoxelBoxes& voxels, const std::vector<bool>& hasLabel, const std::vector<int>& owner, const Context& context)
{
  const std::array<std::size_t, 3> count{ { std::size_t(voxels.count[0]), std::size_t(voxels.count[1]),
    std::size_t(voxels.count[2]) } };
  const std::array<std::size_t, 3> step{ { 1, count[0], count[0] * count[1] } };
  std::vector<bool> left = hasLabel; // voxels that no piece has yet
  std::vector<std::size_t> open;     // voxels of the piece whose neighbours have not been looked at
  std::map<int, std::size_t> largest;
  LabelPieces found;
  const auto take = [&](std::size_t voxel)
  {
    left[voxel] = false;
    open.push_back(voxel);
  };
  const auto takeNeighbour = [&](std::size_t voxel, std::size_t neighbour)
  {
    if (left[neighbour] && (owner.empty() || owner[neighbour] == owner[voxel]))
    {
      take(neighbour);
    }
  };
  for (std::size_t first = 0; first < left.size(); ++first)
  {
    if (!left[first])
    {
      continue;
    }
    context.checkpoint();
    std::size_t size = 0;
    take(first);
    for (; !open.empty(); ++size)
    {
      const std::size_t voxel = open.back();
      open.pop_back();
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const std::size_t place = voxel / step[axis] % count[axis];
        if (place > 0)
        {
          takeNeighbour(voxel, voxel - step[axis]);
        }
        if (place + 1 < count[axis])
        {
          takeNeighbour(voxel, voxel + step[axis]);
        }
      }
    }
    std::size_t& most = largest[owner.empty() ? 0 : owner[first]];
    most = std::max(most, size);
    found.voxels += size;
    ++found.pieces;
  }
  for (const auto& entry : largest)
  {
    found.connected += entry.second;
  }
  return found;
}

} // namespace cactus
