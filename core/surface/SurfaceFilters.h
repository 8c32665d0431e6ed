// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/CappedSurface.h"
#include "surface/FibreImage.h"

#include <functional>

namespace cactus
{

/// Another library's functions for making surfaces, in place of contour() and decimate(). Both have to be thread-safe. Their
/// results are not checked while they are made: markFaults() finds their faults.
struct SurfaceFilters
{
  /// Returns the closed, outward surface on which the image's field is `level` (µm), with its caps on the faces of `box` (µm).
  std::function<CappedSurface(const FibreImage& image, double level, const Eigen::AlignedBox3d& box)> contour;
  /// Smooths and coarsens it, and keeps its caps in place. The result needs no guarantees.
  std::function<void(CappedSurface& surface)> finish;
};

} // namespace cactus
