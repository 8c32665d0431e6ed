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

/// The excess of a field over its level in a contour itself, as at creases that voxels do not resolve. It is evaluated on demand,
/// once.
class BandExcesses
{
public:
  /// Uses the options' field and level. All arguments have to outlive the object unchanged.
  BandExcesses(const CappedSurface& surface, const PlaneLoops& loops, const SurfaceDecimationOptions& options);

  /// Returns the largest excess in a band, µm, at least 0.
  double in(std::size_t band) const;

private:
  const CappedSurface& Surface;
  const SurfaceDecimationOptions& Options;
  std::vector<std::uint32_t> Triangles; ///< those that are evaluated, by band
  std::vector<std::size_t> Begins;      ///< per band, and the end
  mutable std::vector<double> Known;    ///< per band, or `unknown`
};

} // namespace cactus
