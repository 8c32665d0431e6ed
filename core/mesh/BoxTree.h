// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

namespace cactus
{

/// An axis-aligned box in single precision, rounded outwards: it contains its content in spite of rounding. The fourth number is
/// 0, as padding for the vector unit.
struct FloatBox
{
  Eigen::Array4f lower = Eigen::Array4f::Zero();
  Eigen::Array4f upper = Eigen::Array4f::Zero();

  bool overlaps(const FloatBox& other) const
  {
    return (this->lower - other.upper).max(other.lower - this->upper).maxCoeff() <= 0.0F;
  }

  /// Returns a lower bound of the squared distance (µm²) between the contents of the two boxes; 0 if they overlap.
  float squaredDistance(const FloatBox& other) const
  {
    const Eigen::Array4f apart = (this->lower - other.upper).max(other.lower - this->upper).max(Eigen::Array4f::Zero());
    return 0.999999F * (apart * apart).sum(); // corrects possible rounding upwards
  }

  /// Extends the box to contain another one.
  void include(const FloatBox& other)
  {
    this->lower = this->lower.min(other.lower);
    this->upper = this->upper.max(other.upper);
  }

  float longestSide() const { return (this->upper - this->lower).maxCoeff(); }

  /// Returns the smallest box around three points (µm), up to rounding.
  static FloatBox around(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);
  static FloatBox around(const Eigen::Vector3d& point) { return around(point, point, point); }
};

inline auto membersOf(FloatBox& box)
{
  return std::tie(box.lower, box.upper);
}

/// A tree of boxes, which finds those near something.
///
/// Boxes are split at the middle of their centres (at the median, if the middle leaves one side empty or the tree has become
/// deep), down to leaves of up to leafSize: O(n log n), and no deeper than maximumDepth. An entry takes about 70 bytes. The tree
/// is the same for the same boxes, and queries allocate nothing.
class BoxTree
{
public:
  static constexpr std::uint32_t leafSize = 8;
  static constexpr int maximumDepth = 72;

  /// A box and the entry that it belongs to.
  struct Item
  {
    FloatBox box;
    std::uint32_t entry;
  };

  struct Node
  {
    FloatBox box;
    std::uint32_t first; ///< of a leaf its first place in order(), of another node the first of its two children, which are
                         ///< neighbours
    std::uint32_t count; ///< entries of a leaf, 0 for other nodes
    float longestSide;   ///< of the box

    bool isLeaf() const { return this->count > 0; }
  };

  BoxTree() = default;
  explicit BoxTree(std::vector<Item> items);

  bool empty() const { return this->Nodes.empty(); }
  /// Returns the nodes; node 0 is the root, if there is one.
  const std::vector<Node>& nodes() const { return this->Nodes; }
  /// Returns the entries by leaf.
  const std::vector<std::uint32_t>& order() const { return this->Order; }
  /// Returns the boxes of the entries in order().
  const std::vector<FloatBox>& boxes() const { return this->Boxes; }

private:
  std::vector<Node> Nodes;
  std::vector<std::uint32_t> Order;
  std::vector<FloatBox> Boxes;
};

/// Calls visit(place in order()) for the entries of all leaves that `wanted(box)` leads to, until it returns true. Returns
/// whether it did.
template <typename Wanted, typename Visit>
bool visitPlaces(const BoxTree& tree, Wanted&& wanted, Visit&& visit)
{
  std::array<std::uint32_t, BoxTree::maximumDepth + 2> stack;
  std::size_t height = 0;
  if (!tree.empty())
  {
    stack[height++] = 0;
  }
  while (height > 0)
  {
    const BoxTree::Node& node = tree.nodes()[stack[--height]];
    if (!wanted(node.box))
    {
      continue;
    }
    if (!node.isLeaf())
    {
      stack[height++] = node.first + 1;
      stack[height++] = node.first;
      continue;
    }
    for (std::uint32_t place = node.first; place < node.first + node.count; ++place)
    {
      if (visit(place))
      {
        return true;
      }
    }
  }
  return false;
}

/// Calls visit(entry) in the same way.
template <typename Wanted, typename Visit>
bool visitEntries(const BoxTree& tree, Wanted&& wanted, Visit&& visit)
{
  return visitPlaces(tree, wanted, [&](std::uint32_t place) { return visit(tree.order()[place]); });
}

/// Calls visit(place in a.order(), place in b.order()) for all pairs whose boxes overlap, until it returns true. Returns whether
/// it did. For a tree with itself, each pair of different places comes once.
template <typename Visit>
bool visitOverlappingPlaces(const BoxTree& a, const BoxTree& b, Visit&& visit)
{
  const bool same = &a == &b;
  std::array<std::pair<std::uint32_t, std::uint32_t>, 2 * BoxTree::maximumDepth + 4> stack;
  std::size_t height = 0;
  if (!a.empty() && !b.empty() && a.nodes()[0].box.overlaps(b.nodes()[0].box))
  {
    stack[height++] = { 0, 0 };
  }
  while (height > 0)
  {
    const auto [i, j] = stack[--height];
    const BoxTree::Node& p = a.nodes()[i];
    const BoxTree::Node& q = b.nodes()[j];
    const bool withItself = same && i == j;
    if (withItself && !p.isLeaf())
    {
      stack[height] = { p.first, p.first + 1 };
      height += a.nodes()[p.first].box.overlaps(a.nodes()[p.first + 1].box) ? 1 : 0;
      stack[height++] = { p.first + 1, p.first + 1 };
      stack[height++] = { p.first, p.first };
      continue;
    }
    if (!p.isLeaf() || !q.isLeaf())
    {
      // Branch-free, since branches would be mispredicted half the time.
      const bool partA = !p.isLeaf() && (q.isLeaf() || p.longestSide >= q.longestSide);
      const std::uint32_t child = partA ? p.first : q.first;
      const BoxTree::Node* children = (partA ? a : b).nodes().data() + child;
      const FloatBox& whole = (partA ? q : p).box;
      stack[height] = { partA ? child + 1 : i, partA ? j : child + 1 };
      height += children[1].box.overlaps(whole) ? 1 : 0;
      stack[height] = { partA ? child : i, partA ? j : child };
      height += children[0].box.overlaps(whole) ? 1 : 0;
      continue;
    }
    for (std::uint32_t m = p.first; m < p.first + p.count; ++m)
    {
      const FloatBox& box = a.boxes()[m];
      std::array<std::uint32_t, BoxTree::leafSize> hit;
      std::size_t hits = 0;
      for (std::uint32_t n = withItself ? m + 1 : q.first; n < q.first + q.count; ++n)
      {
        hit[hits] = n;
        hits += box.overlaps(b.boxes()[n]) ? 1 : 0;
      }
      for (std::size_t i = 0; i < hits; ++i)
      {
        if (visit(m, hit[i]))
        {
          return true;
        }
      }
    }
  }
  return false;
}

} // namespace cactus
