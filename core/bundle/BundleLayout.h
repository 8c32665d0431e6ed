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

/// One bundle before it is turned into its place: faces in (u, v) at w = ±length/2, v being the domain's y.
struct Bundle
{
  int id = 1;
  double length = 0.0;
  double angle = 0.0;   ///< of the axis, from +z towards +x (radians)
  double density = 0.0; ///< wanted of the circles on each face
  Circles bottom;
  Circles top;
  FlowPaths paths; ///< of the circles' middles from bottom to top, in the flow; no places where fibres are straight
};

/// Random streams of different bundles and attempts are kept apart by these offsets of the item number.
inline std::uint64_t itemOf(std::size_t circle, int bundle, int attempt = 0)
{
  return circle + (static_cast<std::uint64_t>(bundle) << 40) + (static_cast<std::uint64_t>(attempt) << 48);
}

/// The side of the cube that fibres are to cover (µm).
inline double regionSide(const BundleInitializerOptions& options)
{
  return options.side + 2.0 * options.margin;
}

// Bundles with radii and, for each circle, the rectangle of the faces that it has to lie in; nothing is placed yet. All throw
// InvalidInput where the largest fibre has no room.

/// A single bundle: one square frame on each face.
Bundle layOutSingle(const BundleInitializerOptions& options);

/// Two crossing bundles in layers of equal thickness that take turns; each circle, largest first, goes to the layer with most
/// area left. `density` is wanted of the circles in each layer.
std::vector<Bundle> layOutSheets(const BundleInitializerOptions& options, double density);

/// Two crossing bundles in thin layers in random order, about `thicknessInDiameters` mean diameters thick, stacked along y so
/// that both bundles rise evenly.
std::vector<Bundle> layOutInterwoven(const BundleInitializerOptions& options, double density, double thicknessInDiameters);

} // namespace cactus
