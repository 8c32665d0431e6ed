// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mesh/CappedSurface.h"
#include "mesh/PlaneLoops.h"
#include "mesh/SurfaceDecimation.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cactus
{

/// By how much a field exceeds its level in a contour itself, as it does at creases that voxels do not resolve. It is looked at
/// where somebody asks, once.
class BandExcesses
{
public:
  /// Of the options field and level count. What is given has to outlive the object, and stay as it is.
  BandExcesses(const CappedSurface& surface, const PlaneLoops& loops, const SurfaceDecimationOptions& options);

  /// The largest one in a band, µm, at least 0.
  double in(std::size_t band) const;

private:
  const CappedSurface& Surface;
  const SurfaceDecimationOptions& Options;
  std::vector<std::uint32_t> Triangles; ///< those that are looked at, by band
  std::vector<std::size_t> Begins;      ///< per band, and the end
  mutable std::vector<double> Known;    ///< per band, or `unknown`
};

} // namespace cactus
