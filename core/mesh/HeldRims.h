// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/CappedSurface.h"

#include <array>
#include <map>
#include <memory>
#include <set>
#include <vector>

namespace cactus
{

/// The rims that a fresh contour has in held faces (see CappedSurface), where those of two opposite faces have the same points.
/// It keeps them equal while the surface is coarsened.
class HeldRims
{
public:
  /// Chooses the points that stay, so that chords of at most `longest` (µm) are within `error` of the others: by the rim in its
  /// plane alone, so that they are the same in both faces.
  HeldRims(const CappedSurface& surface, double error, double longest);

  /// Returns the places of the points that stay (CappedSurface::stays); null if there is no rim.
  const std::shared_ptr<const std::set<std::array<double, 3>>>& stays() const { return this->Stays; }

  /// Puts points that are left in only one of two opposite rims into the other, too.
  void join(CappedSurface& surface) const;

private:
  using Place = std::array<double, 3>;
  /// The places of a rim, from one that stays to another, or around, in the lower and the upper face.
  using Pair = std::array<std::vector<Place>, 2>;

  std::vector<Pair> Rims;
  std::shared_ptr<const std::set<Place>> Stays;
};

} // namespace cactus
