// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"

#include <cstddef>
#include <vector>

namespace cactus
{

/// Fibres in an order in which those that lie beside each other mostly follow each other, so that loops over neighbours find what
/// they read in the cache: along a Morton curve through the fibres' middles. Made once, for a set of fibres and all states of it.
class FibreOrder
{
public:
  /// Precondition: validate(fibres).
  explicit FibreOrder(const Fibres& fibres);

  /// The same fibres in this order. What is given has as many fibres and control points as those it was made for.
  Fibres ordered(const Fibres& fibres) const;

  /// Puts values per control point, taken in this order, where they belong in the fibres that it was made for.
  template <typename Value>
  void restore(const std::vector<Value>& ordered, std::vector<Value>& original) const
  {
    original.resize(ordered.size());
    for (std::size_t i = 0; i < ordered.size(); ++i)
    {
      original[this->Points[i]] = ordered[i];
    }
  }

  /// The same for some of the values, the first of which belongs to the control point at `place` in this order. `original` has
  /// room for all.
  template <typename Value>
  void restore(const Value* ordered, std::size_t count, std::size_t place, std::vector<Value>& original) const
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      original[this->Points[place + i]] = ordered[i];
    }
  }

private:
  std::vector<std::size_t> Order;  ///< fibre by place
  std::vector<std::size_t> Points; ///< control point by place
};

} // namespace cactus
