// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace cactus
{

/// One surface per fibre (all outer, or all inner), each made on demand, so that a large substrate is not stored twice.
struct FibreSurfaces
{
  std::vector<int> fibreIds;  ///< increasing, unique
  std::vector<int> bundleIds; ///< one per surface
  /// One per outer surface: the g-ratio that its maker has recorded, which is above 0 if the fibre has an inner one; empty if
  /// unknown.
  std::vector<double> gRatios;
  /// Returns the surface (µm) of fibreIds[index]. Thread-safe.
  std::function<TriangleMesh(std::size_t index)> mesh;
  /// Whether this set of surfaces exists at all, possibly empty; a set with a surface exists in any case.
  bool isGiven = false;
  /// Fibres that were to have a surface, in any order, if the maker of the surfaces has recorded them.
  std::vector<int> wantedIds;
  /// Least distance (µm) that surfaces were made to keep from each other; 0 if unknown.
  double promisedGap = 0.0;

  bool given() const { return this->isGiven || !this->fibreIds.empty(); }

  std::size_t size() const { return fibreIds.size(); }

  /// Returns the index of a fibre's surface, if it has one.
  std::optional<std::size_t> placeOf(int fibreId) const
  {
    const auto found = std::lower_bound(this->fibreIds.begin(), this->fibreIds.end(), fibreId);
    const bool isThere = found != this->fibreIds.end() && *found == fibreId;
    return isThere ? std::optional<std::size_t>(std::size_t(found - this->fibreIds.begin())) : std::nullopt;
  }
};

} // namespace cactus
