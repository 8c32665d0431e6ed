// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"

#include <cstddef>
#include <vector>

namespace cactus
{

/// An order in which fibres beside each other mostly follow each other, so that loops over neighbours read from the cache: along
/// a Morton curve through the fibres' middles. Made once, for a set of fibres and all its states.
class FibreOrder
{
public:
  /// Precondition: validate(fibres).
  explicit FibreOrder(const Fibres& fibres);

  /// Returns the same fibres in this order. `fibres` has as many fibres and control points as those of the constructor.
  Fibres ordered(const Fibres& fibres) const;

  /// Writes values per control point, given in this order, in the order of the constructor's fibres.
  template <typename Value>
  void restore(const std::vector<Value>& ordered, std::vector<Value>& original) const
  {
    original.resize(ordered.size());
    for (std::size_t i = 0; i < ordered.size(); ++i)
    {
      original[this->Points[i]] = ordered[i];
    }
  }

  /// Does the same for a part of the values, the first of which belongs to the control point at `place` in this order. `original`
  /// already has its full size.
  template <typename Value>
  void restore(const Value* ordered, std::size_t count, std::size_t place, std::vector<Value>& original) const
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      original[this->Points[place + i]] = ordered[i];
    }
  }

private:
  std::vector<std::size_t> Order;  ///< fibre index by place
  std::vector<std::size_t> Points; ///< control point index by place
};

} // namespace cactus
