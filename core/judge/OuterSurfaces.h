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

/// The outer surfaces of a certificate's fibres, by their indices in it. A cache keeps the most recently used ones, up to a
/// certain memory; others are made again on demand. A few boxes around its parts are kept for every surface. Different indices
/// may be used from several threads at once, and get() with any.
class OuterSurfaces
{
public:
  using Maker = std::function<std::shared_ptr<const TreedSurface>(std::size_t place)>;

  /// Makes room for `count` fibres, in about `bytes` and the memory of the surfaces in use.
  OuterSurfaces(std::size_t count, std::size_t bytes, Maker maker);

  /// Registers a surface; null for a fibre without one. Call it once for each index.
  void enter(std::size_t place, std::shared_ptr<const TreedSurface> surface);
  /// Registers one that another process has registered, with its branches().
  void enter(std::size_t place, std::vector<FloatBox> branches) { this->Branches[place] = std::move(branches); }

  std::size_t size() const { return this->Branches.size(); }
  /// Returns the boxes that contain the parts of a surface, neighbours one after the other; none without a surface, or for an
  /// empty one.
  const std::vector<FloatBox>& branches(std::size_t place) const { return this->Branches[place]; }
  std::shared_ptr<const TreedSurface> get(std::size_t place) const;

private:
  Maker Make;
  std::vector<std::vector<FloatBox>> Branches;
  mutable RecentThings<TreedSurface> Recent;
};

} // namespace cactus
