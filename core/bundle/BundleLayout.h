// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bundle/BundleInitializerOptions.h"
#include "bundle/Circles.h"
#include "bundle/CoherentFlow.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cactus
{

/// One bundle before it is rotated into place: faces in (u, v) at w = ±length/2, with v along the domain's y.
struct Bundle
{
  int id = 1;
  double length = 0.0;
  double angle = 0.0;   ///< from +z towards +x to the axis (radians)
  double density = 0.0; ///< requested density of the circles on each face
  Circles bottom;
  Circles top;
  FlowPaths paths; ///< paths of the circles' centres from bottom to top, in the flow; without places if fibres are straight
};

/// Returns the item number of a random stream: separate for different bundles and attempts.
inline std::uint64_t itemOf(std::size_t circle, int bundle, int attempt = 0)
{
  return circle + (static_cast<std::uint64_t>(bundle) << 40) + (static_cast<std::uint64_t>(attempt) << 48);
}

/// Returns the side of the cube that the fibres cover (µm).
inline double regionSide(const BundleInitializerOptions& options)
{
  return options.side + 2.0 * surroundings(options).sides;
}

// The functions below return bundles with radii and, for each circle, its rectangle on the faces; nothing is placed yet. All
// throw InvalidInput if the largest fibre has no room.

/// Makes a single bundle whose circles fill `density` of each face: one square frame on each.
Bundle layOutSingle(const BundleInitializerOptions& options, double density);

/// Makes two crossing bundles in alternating layers of equal thickness; each circle, largest first, goes to the layer with most
/// area left. `density` is that of the circles in each layer.
std::vector<Bundle> layOutSheets(const BundleInitializerOptions& options, double density);

/// Makes two crossing bundles in thin layers in random order, about `thicknessInDiameters` mean diameters thick, stacked along y
/// so that both bundles rise evenly.
std::vector<Bundle> layOutInterwoven(const BundleInitializerOptions& options, double density, double thicknessInDiameters);

} // namespace cactus
