// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "TriangleMesh.h"

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

  std::size_t size() const { return fibreIds.size(); }
};

} // namespace cactus
