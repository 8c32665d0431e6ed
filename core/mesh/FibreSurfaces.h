// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/TriangleMesh.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace cactus
{

/// One surface per fibre (all outer, or all inner), each made when it is asked for, so that a large substrate is not held twice.
struct FibreSurfaces
{
  std::vector<int> fibreIds;  ///< increasing, unique
  std::vector<int> bundleIds; ///< one per surface
  /// The surface (µm) of fibreIds[index]. May be called from several threads at once.
  std::function<TriangleMesh(std::size_t index)> mesh;
  /// Whether there is such a set of surfaces at all, however empty; one that holds a surface counts in any case.
  bool isGiven = false;
  /// Fibres that were to have a surface, where whoever made the surfaces has said so; in any order.
  std::vector<int> wantedIds;
  /// µm that surfaces were made to keep from each other at least; 0 where nobody has said.
  double promisedGap = 0.0;

  bool given() const { return this->isGiven || !this->fibreIds.empty(); }

  std::size_t size() const { return fibreIds.size(); }
};

} // namespace cactus
