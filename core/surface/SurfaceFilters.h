// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/CappedSurface.h"
#include "surface/FibreImage.h"

#include <functional>

namespace cactus
{

/// The means of another library to make surfaces with, in place of contour() and decimate(). Both may be called from several
/// threads at once. What comes out is not checked while it is made: markFaults() tells what is wrong with it.
struct SurfaceFilters
{
  /// The closed surface, outward, on which the image's field is `level` (µm), with its caps on the faces of `box` (µm).
  std::function<CappedSurface(const FibreImage& image, double level, const Eigen::AlignedBox3d& box)> contour;
  /// Smooths and coarsens it, and leaves its caps where they are. Need not promise what comes out.
  std::function<void(CappedSurface& surface)> finish;
};

} // namespace cactus
