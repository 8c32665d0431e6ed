// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/BoxTree.h"

#include "base/Error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cactus
{

namespace
{

constexpr float unbounded = std::numeric_limits<float>::infinity();
/// Depth from which boxes are split at the median, which adds at most 32 levels for 32-bit indices.
constexpr int depthOfMedians = 36;

/// Round one or two steps down, or up: branch-free, and safe.
float roundedDown(double value)
{
  const auto rounded = static_cast<float>(value);
  return rounded - (std::fabs(rounded) * std::numeric_limits<float>::epsilon() + std::numeric_limits<float>::min());
}

float roundedUp(double value)
{
  const auto rounded = static_cast<float>(value);
  return rounded + (std::fabs(rounded) * std::numeric_limits<float>::epsilon() + std::numeric_limits<float>::min());
}

struct ItemRange
{
  std::uint32_t node;
  std::uint32_t first;
  std::uint32_t last;
  int depth;
};

/// Returns twice the centre of an item's box.
float centre(const BoxTree::Item& item, int axis)
{
  return item.box.lower[axis] + item.box.upper[axis];
}

/// Returns where to split the items of a range, which are reordered for it; neither part is empty.
std::uint32_t part(std::vector<BoxTree::Item>& items, const ItemRange& range)
{
  Eigen::Array4f lower = Eigen::Array4f::Constant(unbounded);
  Eigen::Array4f upper = -lower;
  for (std::uint32_t i = range.first; i < range.last; ++i)
  {
    const Eigen::Array4f centre = items[i].box.lower + items[i].box.upper;
    lower = lower.min(centre);
    upper = upper.max(centre);
  }
  int longest = 0;
  (upper - lower).head<3>().maxCoeff(&longest);
  const auto first = items.begin() + range.first;
  const auto last = items.begin() + range.last;
  if (range.depth < depthOfMedians)
  {
    const float middle = 0.5F * (lower[longest] + upper[longest]);
    const auto split = std::partition(first, last, [&](const BoxTree::Item& item) { return centre(item, longest) < middle; });
    if (split != first && split != last)
    {
      return static_cast<std::uint32_t>(split - items.begin());
    }
  }
  const auto split = first + (last - first) / 2;
  std::nth_element(first, split, last,
    [longest](const BoxTree::Item& a, const BoxTree::Item& b)
    {
      const float ca = centre(a, longest);
      const float cb = centre(b, longest);
      return ca != cb ? ca < cb : a.entry < b.entry;
    });
  return static_cast<std::uint32_t>(split - items.begin());
}

} // namespace

FloatBox FloatBox::around(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  FloatBox box;
  for (int axis = 0; axis < 3; ++axis)
  {
    box.lower[axis] = roundedDown(std::min({ a[axis], b[axis], c[axis] }));
    box.upper[axis] = roundedUp(std::max({ a[axis], b[axis], c[axis] }));
  }
  return box;
}

BoxTree::BoxTree(std::vector<Item> items)
{
  if (items.empty())
  {
    return;
  }
  require(items.size() < std::size_t(1) << 31, "there are more boxes than a tree of boxes can number");
  this->Nodes.reserve(items.size());
  this->Nodes.emplace_back();
  std::vector<ItemRange> ranges{ { 0, 0, static_cast<std::uint32_t>(items.size()), 0 } };
  while (!ranges.empty())
  {
    const ItemRange range = ranges.back();
    ranges.pop_back();
    if (range.last - range.first <= leafSize)
    {
      Node& leaf = this->Nodes[range.node];
      leaf = { items[range.first].box, range.first, range.last - range.first, 0.0F };
      for (std::uint32_t i = range.first + 1; i < range.last; ++i)
      {
        leaf.box.include(items[i].box);
      }
      continue;
    }
    const std::uint32_t split = part(items, range);
    const auto child = static_cast<std::uint32_t>(this->Nodes.size());
    this->Nodes[range.node].first = child;
    this->Nodes[range.node].count = 0;
    this->Nodes.resize(this->Nodes.size() + 2);
    ranges.push_back({ child + 1, split, range.last, range.depth + 1 });
    ranges.push_back({ child, range.first, split, range.depth + 1 });
  }
  // Children are stored after their parents.
  for (std::size_t n = this->Nodes.size(); n-- > 0;)
  {
    Node& node = this->Nodes[n];
    if (!node.isLeaf())
    {
      node.box = this->Nodes[node.first].box;
      node.box.include(this->Nodes[node.first + 1].box);
    }
    node.longestSide = node.box.longestSide();
  }
  this->Order.resize(items.size());
  this->Boxes.resize(items.size());
  for (std::size_t i = 0; i < items.size(); ++i)
  {
    this->Order[i] = items[i].entry;
    this->Boxes[i] = items[i].box;
  }
  this->Nodes.shrink_to_fit();
}

} // namespace cactus
