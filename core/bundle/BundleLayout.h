// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bundle/BundleInitializerOptions.h"
#include "bundle/Circles.h"
#include "bundle/CoherentFlow.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace cactus
{

/// One bundle before it is rotated into place: faces in (u, v) at w = ±length/2.
struct Bundle
{
  int id = 1;
  double length = 0.0;
  double width = 0.0;                                 ///< of layers, along u
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity(); ///< from (u, v, w) to the domain's axes
  double density = 0.0;                               ///< requested density of the circles on each face
  Circles bottom;
  Circles top;
  /// Number of circles of fibres with myelin, which come first; the others lie in clusters.
  std::size_t myelinated = std::numeric_limits<std::size_t>::max();
  FlowPaths paths; ///< paths of the circles' centres from bottom to top, in the flow; without places if fibres are straight
};

/// Returns the item number of a random stream: separate for different bundles and attempts.
inline std::uint64_t itemOf(std::size_t circle, int bundle, int attempt = 0)
{
  return circle + (static_cast<std::uint64_t>(bundle) << 40) + (static_cast<std::uint64_t>(attempt) << 48);
}

/// Returns the size of the box that the fibres cover (µm), along the axes of a single bundle; of fibres that repeat, one period.
inline Eigen::Vector3d regionSize(const BundleInitializerOptions& options)
{
  const Surroundings around = surroundings(options);
  const double ends = options.isLayered() ? around.sides : options.border == Border::Periodic ? 0.0 : around.ends;
  return options.extent() + 2.0 * Eigen::Vector3d(around.sides, around.sides, ends);
}

// The functions below return bundles with radii and, for each circle, its rectangle on the faces; nothing is placed yet. All
// throw InvalidInput if the largest fibre has no room.

/// Makes a single bundle whose circles fill `density` of each face: one frame on each. Of axons without myelin there are
/// `bareSurplus` times as many as asked for.
Bundle layOutSingle(const BundleInitializerOptions& options, double density, double bareSurplus = 1.0);

/// Makes two crossing bundles in alternating layers of equal thickness; each circle, largest first, goes to the layer with most
/// area left. `density` is that of the circles in each layer.
std::vector<Bundle> layOutSheets(const BundleInitializerOptions& options, double density);

/// Makes two crossing bundles in thin layers in random order, about `thicknessInDiameters` mean diameters thick, stacked along y
/// so that both bundles rise evenly.
std::vector<Bundle> layOutInterwoven(const BundleInitializerOptions& options, double density, double thicknessInDiameters);

} // namespace cactus
