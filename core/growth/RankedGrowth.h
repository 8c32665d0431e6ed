// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fibres/Fibres.h"
#include "growth/CapsuleField.h"
#include "growth/FibreRadialGrowthOptions.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace cactus
{

/// Tells whether axons without myelin slow down as fibres grow: in a bundle that grows to a fraction, and of which they are less
/// than a half by volume. They are so thin that common growth can be more than their radius, and would fill more with them than
/// their share.
bool slowsBare(const Fibres& fibres, const FibreRadialGrowthOptions& options);

/// The growth of each fibre where it meets no neighbour, by its rank in a CapsuleField: the same for all, but for axons without
/// myelin that slow down. These grow as the others by a part of their radius, and at a tenth of the speed then.
class RankedGrowth
{
public:
  /// `growth` (µm) is that of the others.
  RankedGrowth(const Fibres& fibres, const FibreRadialGrowthOptions& options, const CapsuleField& field, double growth);

  /// Returns the growth (µm) of fibres that do not slow down.
  double common() const { return this->Common; }
  bool isUneven() const { return !this->Even.empty(); }
  /// Returns the growth (µm) of a fibre; -1 stands for no fibre.
  double operator()(int rank) const
  {
    const double even = this->evenOf(rank);
    return this->Common <= even ? this->Common : even + speed * (this->Common - even);
  }
  /// Returns the common growth (µm) at which a fibre has grown by `own`.
  double commonFor(int rank, double own) const
  {
    const double even = this->evenOf(rank);
    return own <= even ? own : even + (own - even) / speed;
  }

private:
  static constexpr double speed = 0.1; ///< of axons that have slowed down, relative to the others
  double evenOf(int rank) const
  {
    return this->Even.empty() ? std::numeric_limits<double>::infinity() : this->Even[static_cast<std::size_t>(std::max(rank, 0))];
  }

  double Common;
  std::vector<double> Even; ///< µm by which a fibre grows as the others do, by rank; empty: all do always
};

} // namespace cactus
