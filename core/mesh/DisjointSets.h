// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace cactus
{

/// Disjoint sets of the numbers from 0 to count - 1, initially one each. A set is named by its smallest member, so that names do
/// not depend on the order of joins.
template <typename Number>
class DisjointSets
{
public:
  explicit DisjointSets(std::size_t count)
    : Parent(count)
  {
    std::iota(this->Parent.begin(), this->Parent.end(), Number(0));
  }

  Number find(Number item)
  {
    while (this->parent(item) != item)
    {
      this->parent(item) = this->parent(this->parent(item));
      item = this->parent(item);
    }
    return item;
  }

  void join(Number a, Number b)
  {
    a = this->find(a);
    b = this->find(b);
    this->parent(std::max(a, b)) = std::min(a, b);
  }

private:
  Number& parent(Number item) { return this->Parent[static_cast<std::size_t>(item)]; }

  std::vector<Number> Parent;
};

} // namespace cactus
