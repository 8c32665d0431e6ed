// SPDX-License-Identifier: BSD-3-Clause
#include "judge/OuterSurfaces.h"

#include <cstdint>

namespace cactus
{

namespace
{

/// Approximate number of triangles in a box.
constexpr std::size_t trianglesOfBranch = 256;
/// Bytes per triangle in a tree: its entry (see BoxTree) and its plane.
constexpr std::size_t bytesOfEntry = 70 + sizeof(TrianglePlane);

std::size_t bytesOf(const TreedSurface& surface)
{
  return surface.mesh.points.size() * sizeof(surface.mesh.points[0]) +
         surface.mesh.triangles.size() * (sizeof(surface.mesh.triangles[0]) + bytesOfEntry);
}

/// Returns the boxes of a tree's nodes at the depth that has about `wanted` of them.
std::vector<FloatBox> branchesOf(const BoxTree& tree, std::size_t wanted)
{
  std::vector<std::uint32_t> level;
  if (!tree.empty())
  {
    level.push_back(0);
  }
  for (bool isDeeper = true; isDeeper && level.size() < wanted;)
  {
    isDeeper = false;
    std::vector<std::uint32_t> below;
    for (const std::uint32_t n : level)
    {
      const BoxTree::Node& node = tree.nodes()[n];
      below.push_back(node.isLeaf() ? n : node.first);
      if (!node.isLeaf())
      {
        below.push_back(node.first + 1);
        isDeeper = true;
      }
    }
    level.swap(below);
  }
  std::vector<FloatBox> boxes;
  boxes.reserve(level.size());
  for (const std::uint32_t n : level)
  {
    boxes.push_back(tree.nodes()[n].box);
  }
  return boxes;
}

} // namespace

OuterSurfaces::OuterSurfaces(std::size_t count, std::size_t bytes, Maker maker)
  : Make(std::move(maker))
  , Branches(count)
  , Recent(bytes)
{
}

void OuterSurfaces::enter(std::size_t place, std::shared_ptr<const TreedSurface> surface)
{
  if (surface != nullptr)
  {
    this->Branches[place] = branchesOf(surface->tree, 1 + surface->mesh.triangles.size() / trianglesOfBranch);
    const std::size_t bytes = bytesOf(*surface);
    this->Recent.keep(place, std::move(surface), bytes);
  }
}

std::shared_ptr<const TreedSurface> OuterSurfaces::get(std::size_t place) const
{
  std::shared_ptr<const TreedSurface> surface = this->Recent.find(place);
  if (surface == nullptr)
  {
    surface = this->Make(place);
    this->Recent.keep(place, surface, bytesOf(*surface));
  }
  return surface;
}

} // namespace cactus
