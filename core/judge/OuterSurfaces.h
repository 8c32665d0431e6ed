// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "base/RecentThings.h"
#include "mesh/TriangleTree.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace cactus
{

/// A surface and the tree over it, which refers to it.
struct TreedSurface
{
  explicit TreedSurface(TriangleMesh surface)
    : mesh(std::move(surface))
    , tree(this->mesh)
  {
  }
  TreedSurface(const TreedSurface&) = delete;
  TreedSurface& operator=(const TreedSurface&) = delete;

  TriangleMesh mesh;
  TriangleTree tree;
};

/// The outer surfaces of a certificate's fibres, by their places in it. Those that were used last are kept, as many as a certain
/// memory holds; others are made again when they are asked for. Of all of them it keeps a few boxes that hold their parts.
/// Different places may be used from several threads at once, and get() with any.
class OuterSurfaces
{
public:
  using Maker = std::function<std::shared_ptr<const TreedSurface>(std::size_t place)>;

  /// For `count` fibres, in about so many `bytes` and those of the surfaces in use.
  OuterSurfaces(std::size_t count, std::size_t bytes, Maker maker);

  /// Gets to know a surface; null for a fibre without one. Once for each place.
  void enter(std::size_t place, std::shared_ptr<const TreedSurface> surface);
  /// The same for one that another process has got to know, from what branches() is there.
  void enter(std::size_t place, std::vector<FloatBox> branches) { this->Branches[place] = std::move(branches); }

  std::size_t size() const { return this->Branches.size(); }
  /// The boxes that hold the parts of a surface, neighbours one after the other; none where there is no surface, or an empty one.
  const std::vector<FloatBox>& branches(std::size_t place) const { return this->Branches[place]; }
  std::shared_ptr<const TreedSurface> get(std::size_t place) const;

private:
  Maker Make;
  std::vector<std::vector<FloatBox>> Branches;
  mutable RecentThings<TreedSurface> Recent;
};

} // namespace cactus
